"""Picture files of every kind, made here byte by byte where no library writes them.

Nothing in this module uses sunwidget: what it makes is what the reader is judged by.
"""

import io
import struct
import tempfile
import zlib
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import tifffile
from PIL import Image

SRGB_PRIMARIES = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
P3_PRIMARIES = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060))
ADOBE_PRIMARIES = ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06))
D65 = (0.3127, 0.3290)
SRGB_PARAMETERS = (2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045)
BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
D50_XYZ = np.array([0.9642, 1.0, 0.8249])


def ramp(height=24, width=32, seed=1):
    """An 8-bit picture with a smooth gradient, a little noise, and both ends of the range."""
    y, x = np.mgrid[0:height, 0:width].astype(float)
    u, v = x / max(width - 1, 1), y / max(height - 1, 1)
    picture = np.stack([255 * u, 255 * v, 255 * (1 - u) * (1 - v)], -1)
    picture += np.random.default_rng(seed).normal(0, 3, picture.shape)
    picture = np.clip(picture, 0, 255).round().astype(np.uint8)
    picture[0, 0], picture[-1, -1] = 0, 255
    return picture


def ramp16(height=24, width=32, seed=2):
    """The same with 16 bits, using the low byte too."""
    noise = np.random.default_rng(seed).integers(0, 257, (height, width, 3))
    picture = np.minimum(ramp(height, width).astype(np.int64) * 257 + noise, 65535)
    picture = picture.astype(np.uint16)
    picture[0, 0] = 0
    return picture


# --- colour profiles -------------------------------------------------------------------


def matrix_profile(primaries=SRGB_PRIMARIES, trc=("para", 3, SRGB_PARAMETERS), white=D65):
    """An ICC v4 display profile: primaries adapted to D50 by Bradford, one tone curve."""
    to_xyz = np.array([[x / y, 1, (1 - x - y) / y] for x, y in primaries]).T
    white_xyz = np.array([white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]])
    columns = to_xyz * np.linalg.solve(to_xyz, white_xyz)
    adapt = np.linalg.inv(BRADFORD) @ np.diag(BRADFORD @ D50_XYZ / (BRADFORD @ white_xyz))
    columns = adapt @ BRADFORD @ columns
    tags = [(b"desc", mluc("test profile")), (b"wtpt", xyz(D50_XYZ))]
    tags += [(name, xyz(columns[:, i])) for i, name in enumerate((b"rXYZ", b"gXYZ", b"bXYZ"))]
    tags += [(name, tone_curve(*trc)) for name in (b"rTRC", b"gTRC", b"bTRC")]
    return profile(b"RGB ", b"XYZ ", tags)


def grey_profile(gamma=1.8):
    return profile(
        b"GRAY",
        b"XYZ ",
        [(b"desc", mluc("grey")), (b"wtpt", xyz(D50_XYZ)), (b"kTRC", tone_curve("gamma", gamma))],
    )


def table_profile(space, labs):
    """A profile that is a look-up table: one Lab value for each corner of the device cube."""
    channels = {b"RGB ": 3, b"CMYK": 4}[space]
    assert len(labs) == 2**channels
    grid = bytes(round(value) for L, a, b in labs for value in (L * 2.55, a + 128, b + 128))
    straight = bytes(range(256))
    lut = b"mft1" + bytes(4) + bytes((channels, 3, 2, 0))
    lut += struct.pack(">9i", *(65536 if i % 4 == 0 else 0 for i in range(9)))
    lut += straight * channels + grid + straight * 3
    return profile(
        space,
        b"Lab ",
        [(b"desc", mluc("table")), (b"wtpt", xyz(D50_XYZ)), (b"A2B0", lut)],
        kind=b"prtr",
    )


def profile(space, connection, tags, kind=b"mntr"):
    table, body, offset = b"", b"", 128 + 4 + 12 * len(tags)
    for name, data in tags:
        table += struct.pack(">4sII", name, offset + len(body), len(data))
        body += data + bytes(-len(data) % 4)
    size = offset + len(body)
    header = struct.pack(
        ">I4sI4s4s4s12s4s4sIII8sI3i4s44s",
        *(size, b"test", 0x04300000, kind, space, connection, bytes(12), b"acsp", bytes(4)),
        *(0, 0, 0, bytes(8), 0, 63190, 65536, 54061, b"test", bytes(44)),
    )
    assert len(header) == 128
    return header + struct.pack(">I", len(tags)) + table + body


def xyz(values):
    return b"XYZ " + bytes(4) + struct.pack(">3i", *(round(v * 65536) for v in values))


def mluc(text):
    data = text.encode("utf-16-be")
    return b"mluc" + bytes(4) + struct.pack(">II2s2sII", 1, 12, b"en", b"US", len(data), 28) + data


def tone_curve(kind, *values):
    if kind == "gamma":
        return b"curv" + bytes(4) + struct.pack(">IH", 1, round(values[0] * 256))
    if kind == "table":
        samples = np.round(np.asarray(values[0]) * 65535).astype(">u2")
        return b"curv" + bytes(4) + struct.pack(">I", len(samples)) + samples.tobytes()
    number, parameters = values
    fixed = [round(p * 65536) for p in parameters]
    return b"para" + bytes(4) + struct.pack(f">HH{len(fixed)}i", number, 0, *fixed)


ADOBE_RGB = matrix_profile(ADOBE_PRIMARIES, ("gamma", 2.19921875))
DISPLAY_P3 = matrix_profile(P3_PRIMARIES)
PLAIN_SRGB = matrix_profile()
LUT_RGB = table_profile(
    b"RGB ",
    [
        *((0, 0, 0), (30, 60, -90), (85, -80, 70), (90, -40, -10)),
        *((50, 75, 60), (60, 90, -55), (97, -15, 90), (100, 0, 0)),
    ],
)
# Corners in the order of C, M, Y, K bits from high to low; K = 1 is black.
CMYK_PROFILE = table_profile(
    b"CMYK",
    [
        *((100, 0, 0), (5, 0, 0), (90, -5, 90), (4, 0, 0)),
        *((50, 72, -2), (4, 0, 0), (48, 66, 45), (3, 0, 0)),
        *((60, -35, -45), (4, 0, 0), (50, -65, 28), (3, 0, 0)),
        *((25, 20, -45), (2, 0, 0), (22, 0, 0), (0, 0, 0)),
    ],
)


# --- files -----------------------------------------------------------------------------


def pillow_file(picture, kind, **options):
    image = picture if isinstance(picture, Image.Image) else Image.fromarray(picture)
    out = io.BytesIO()
    image.save(out, kind, **options)
    return out.getvalue()


def jpeg_file(picture, **options):
    return pillow_file(picture, "JPEG", **{"quality": 95, "subsampling": 0, **options})


def png_file(samples, depth=8, color_type=2, chunks=(), size=None):
    """A PNG written by hand: any depth and colour type, any extra chunks before the data."""
    samples = np.asarray(samples)
    height, width = samples.shape[:2]
    if depth == 16:
        rows = [b"\0" + row.astype(">u2").tobytes() for row in samples]
    elif depth == 8:
        rows = [b"\0" + row.astype(np.uint8).tobytes() for row in samples]
    elif depth == 1:
        rows = [b"\0" + row.tobytes() for row in np.packbits(samples.astype(bool), axis=1)]
    else:
        weights = (2**depth) ** np.arange(8 // depth)[::-1].astype(np.int64)
        pad = -width % (8 // depth)
        padded = np.pad(samples.astype(np.int64), ((0, 0), (0, pad)))
        groups = padded.reshape(height, -1, 8 // depth) @ weights
        rows = [b"\0" + row.astype(np.uint8).tobytes() for row in groups]
    width, height = size or (width, height)
    head = struct.pack(">IIBBBBB", width, height, depth, color_type, 0, 0, 0)
    data = zlib.compress(b"".join(rows), 1)
    parts = [(b"IHDR", head), *chunks, (b"IDAT", data), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        for name, body in parts
    )


def png16_file(picture, **options):
    return png_file(picture, 16, {1: 0, 2: 4, 3: 2, 4: 6}[picture.shape[2]], **options)


def tiff_file(picture, **options):
    out = io.BytesIO()
    tifffile.imwrite(out, picture, **options)
    return out.getvalue()


def icc_chunk(icc):
    return (b"iCCP", b"profile\0\0" + zlib.compress(icc))


def hdr_file(light, lines=()):
    """A Radiance HDR, packed by OpenCV, with further lines in its header."""
    done, packed = cv2.imencode(".hdr", light[..., ::-1].astype(np.float32))
    assert done
    data = packed.tobytes()
    start = data.index(b"\n") + 1
    return data[:start] + b"".join(line + b"\n" for line in lines) + data[start:]


def exr_file(light, dtype=np.float32, **attributes):
    """An OpenEXR of (H, W, 3 or 4) values as they are."""
    import OpenEXR

    names = ("R", "G", "B", "A")[: light.shape[2]]
    channels = {name: np.ascontiguousarray(light[..., i], dtype) for i, name in enumerate(names)}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "picture.exr")
        OpenEXR.File(header | attributes, channels).write(str(path))
        return path.read_bytes()


def exif_block(tags=None, shot=None, gps=None, orientation=None):
    exif = Image.Exif()
    for tag, value in (tags or {}).items():
        exif[tag] = value
    if orientation is not None:
        exif[0x0112] = orientation
    for ifd, values in ((0x8769, shot), (0x8825, gps)):
        if values:
            exif.get_ifd(ifd).update(values)
            exif[ifd] = exif.get_ifd(ifd)
    return exif.tobytes()


# What a camera that was turned stores, by EXIF orientation: the way back from upright.
STORED = {
    1: lambda a: a,
    2: np.fliplr,
    3: lambda a: np.rot90(a, 2),
    4: np.flipud,
    5: lambda a: np.swapaxes(a, 0, 1),
    6: lambda a: np.rot90(a, 1),
    7: lambda a: np.rot90(np.swapaxes(a, 0, 1), 2),
    8: lambda a: np.rot90(a, -1),
}


@dataclass(frozen=True)
class Readable:
    """A file that opens: with these code values (within ``tolerance``), depth and note."""

    data: bytes
    codes: np.ndarray
    tolerance: float = 0
    alpha: np.ndarray | None = None
    note: str | None = None


def readable():
    """Return every kind of good file, by name."""
    base, deep = ramp(), ramp16()
    grey = base[..., 0]
    alpha = base[..., 1]
    grey3 = np.repeat(grey[..., None], 3, -1)
    palette = np.random.default_rng(3).integers(0, 256, (16, 3)).astype(np.uint8)
    index = (np.arange(24 * 32).reshape(24, 32) // 3) % 16
    light = (base / 255.0).astype(np.float32) ** 2.2

    def two():
        # Made anew each time: Pillow leaves an encoder's settings on the frames it wrote.
        return {"save_all": True, "append_images": [Image.fromarray(255 - base)]}

    cmyk = Image.fromarray(255 - np.dstack([base, np.full_like(grey, 255)]), "CMYK")
    naive = np.asarray(cmyk.convert("RGB"))
    bits = (grey > 128).astype(np.uint8)
    rgba, rgba16 = np.dstack([base, alpha]), np.dstack([deep, deep[..., 0]])
    la, la16 = np.dstack([grey, alpha]), deep[..., :2]
    # JPEG is lossy: 17 levels at the two extreme corners of this picture, at quality 95.
    near = 20
    return {
        "jpeg": Readable(jpeg_file(base), base, near),
        "jpeg_progressive": Readable(jpeg_file(base, progressive=True), base, near),
        "jpeg_grey": Readable(jpeg_file(grey), grey3, near),
        "jpeg_cmyk": Readable(jpeg_file(cmyk), naive, near, note="CMYK"),
        # Phones keep a second picture, such as a depth map, behind the first.
        "jpeg_mpo": Readable(
            pillow_file(base, "MPO", quality=95, subsampling=0, **two()), base, near
        ),
        "jpeg_wrong_icc": Readable(jpeg_file(base, icc_profile=b"no"), base, near, note="profile"),
        "png": Readable(png_file(base), base),
        "png_grey": Readable(png_file(grey, color_type=0), grey3),
        "png_grey_alpha": Readable(png_file(la, color_type=4), grey3, alpha=alpha / 255),
        "png_bilevel": Readable(png_file(bits, 1, 0), np.repeat(bits[..., None] * 255, 3, -1)),
        "png_palette": Readable(
            png_file(index, 4, 3, [(b"PLTE", palette.tobytes())]), palette[index]
        ),
        "png_palette_alpha": Readable(
            png_file(index, 8, 3, [(b"PLTE", palette.tobytes()), (b"tRNS", b"\x00\x80")]),
            palette[index],
            alpha=np.array([0, 128] + [255] * 14)[index] / 255,
        ),
        "png_alpha": Readable(png_file(rgba, color_type=6), base, alpha=alpha / 255),
        "png_16": Readable(png16_file(deep), deep),
        "png_16_grey": Readable(png16_file(deep[..., :1]), np.repeat(deep[..., :1], 3, -1)),
        "png_16_alpha": Readable(png16_file(rgba16), deep, alpha=deep[..., 0] / 65535),
        "png_16_grey_alpha": Readable(
            png16_file(la16), np.repeat(deep[..., :1], 3, -1), alpha=deep[..., 1] / 65535
        ),
        "png_animated": Readable(pillow_file(base, "PNG", **two()), base, note="2 frames"),
        "tiff": Readable(pillow_file(base, "TIFF"), base),
        "tiff_lzw": Readable(pillow_file(base, "TIFF", compression="tiff_lzw"), base),
        "tiff_grey": Readable(tiff_file(grey), grey3),
        "tiff_cmyk": Readable(pillow_file(cmyk, "TIFF"), naive, note="CMYK"),
        "tiff_16": Readable(tiff_file(deep), deep),
        "tiff_16_big_endian": Readable(tiff_file(deep, byteorder=">"), deep),
        "tiff_16_grey": Readable(tiff_file(deep[..., 0]), np.repeat(deep[..., :1], 3, -1)),
        "tiff_16_alpha": Readable(
            tiff_file(rgba16, extrasamples=["unassalpha"], photometric="rgb"),
            deep,
            alpha=deep[..., 0] / 65535,
        ),
        "tiff_16_tiles": Readable(tiff_file(deep, tile=(16, 16)), deep),
        "tiff_16_deflate": Readable(tiff_file(deep, compression="zlib", predictor=True), deep),
        "tiff_16_big": Readable(tiff_file(deep, bigtiff=True), deep),
        "tiff_16_white_is_zero": Readable(
            tiff_file(deep[..., 0], photometric="miniswhite"),
            np.repeat(65535 - deep[..., :1], 3, -1),
        ),
        "tiff_white_is_zero": Readable(tiff_file(grey, photometric="miniswhite"), 255 - grey3),
        "tiff_float": Readable(tiff_file(light, photometric="rgb"), light),
        "tiff_float_grey": Readable(tiff_file(light[..., 0]), np.repeat(light[..., :1], 3, -1)),
        "tiff_pages": Readable(pillow_file(base, "TIFF", **two()), base, note="2 frames"),
        "webp": Readable(pillow_file(base, "WEBP", lossless=True), base),
        "webp_alpha": Readable(
            pillow_file(rgba, "WEBP", lossless=True, exact=True), base, alpha=alpha / 255
        ),
        "webp_animated": Readable(
            pillow_file(base, "WEBP", lossless=True, **two()), base, note="2 frames"
        ),
        "gif": Readable(
            pillow_file(Image.fromarray(palette[index]).quantize(16), "GIF"), palette[index]
        ),
        "bmp": Readable(pillow_file(base, "BMP"), base),
        # Lossy like JPEG.
        "avif": Readable(pillow_file(base, "AVIF", quality=95, subsampling="4:4:4"), base, near),
        # Eight bits of the brightest channel; OpenCV cuts where rounding is due.
        "hdr": Readable(hdr_file(light), light, light.max() / 128),
        "exr": Readable(exr_file(light), light),
        "exr_half_alpha": Readable(
            exr_file(np.dstack([light, np.full_like(light[..., 0], 0.5)]), np.float16),
            light * 2,  # OpenEXR's colors are multiplied by alpha
            light.max() / 512,
            alpha=np.full(light.shape[:2], 0.5),
        ),
        "one_pixel": Readable(png_file(base[:1, :1]), base[:1, :1]),
        "one_wide": Readable(png_file(ramp(5000, 1)), ramp(5000, 1)),
        "one_high": Readable(png_file(ramp(1, 5000)), ramp(1, 5000)),
        "very_wide": Readable(png_file(ramp(100, 20_000)), ramp(100, 20_000)),
    }


XMP = (
    b'<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-'
    b'syntax-ns#"><rdf:Description xmlns:tiff="http://ns.adobe.com/tiff/1.0/" tiff:Orientation="6" '
    b'xmlns:s="urn:sunwidget:edit:1:" s:recipe="{&quot;version&quot;: 1}"/></rdf:RDF></x:xmpmeta>'
)


def with_metadata():
    """Return small files full of metadata, by name: what a mutation of them can break is much."""
    base = ramp(12, 16)
    camera = {0x010F: "Maker", 0x0110: "Model", 0x0131: "Firmware"}
    lens = {0xA405: 28, 0x920A: 4.2, 0xA20E: 300.0, 0xA210: 2, 0xA002: 16, 0xA003: 12}
    moment = {0x9003: "2026:06:21 21:30:00", 0x9011: "+02:00", 0x927C: b"maker's own"}
    place = {1: "N", 2: (59.0, 30.0, 1.5), 3: "W", 4: (18.0, 3.0, 0.0), 5: b"\0", 6: 12.5}
    fix = {7: (19.0, 30.0, 0.0), 16: "T", 17: 271.5, 29: "2026:06:21"}
    comment = {0x9286: b'ASCII\0\0\0{"version": 1}'}
    block = exif_block(camera, lens | moment | comment, place | fix, 6)
    text = (b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + XMP)
    gamma = (b"gAMA", struct.pack(">I", 100_000))
    sixth = (b"eXIf", block[6:])
    curve = matrix_profile(P3_PRIMARIES, ("table", np.linspace(0, 1, 9) ** 2))
    lines = [b"EXPOSURE=2.5", b"PRIMARIES=0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.329"]
    lines += [b'# recipe: {"version": 1}', b"# xmp: PHg+", b"# exif: SUkqAAgAAAA="]
    return {
        "jpeg_metadata": jpeg_file(base, exif=block, icc_profile=DISPLAY_P3, xmp=XMP),
        "jpeg_table": jpeg_file(base, icc_profile=LUT_RGB),
        "jpeg_cmyk_profile": jpeg_file(
            Image.fromarray(base).convert("CMYK"), icc_profile=CMYK_PROFILE
        ),
        "png_metadata": png_file(base, chunks=[icc_chunk(ADOBE_RGB), sixth, text]),
        "png_gamma": png16_file(ramp16(12, 16), chunks=[gamma]),
        "tiff_metadata": pillow_file(base, "TIFF", exif=block, icc_profile=curve),
        "tiff_16_profile": tiff_file(
            ramp16(12, 16), iccprofile=ADOBE_RGB, extratags=[(274, "H", 1, 6, True)]
        ),
        "webp_metadata": pillow_file(
            base, "WEBP", lossless=True, exif=block, icc_profile=grey_profile(), xmp=XMP
        ),
        "hdr_metadata": hdr_file(base / 255, lines),
        "exr_metadata": exr_file(
            base / 255,
            np.float16,
            **{"sunwidget.edit.recipe": '{"version": 1}', "xDensity": 300.0},
            chromaticities=(0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.329),
        ),
    }


def unreadable():
    """Return every kind of bad file, by name, with what its error message must say."""
    base, deep = ramp(96, 128), ramp16(96, 128)
    jpeg, png, tiff = jpeg_file(base), png_file(base), pillow_file(base, "TIFF")
    webp, png16 = pillow_file(base, "WEBP"), png16_file(deep)
    holes = (base / 255.0).astype(np.float32)
    holes[3, 4, 1], holes[5, 6, 0] = np.nan, np.inf
    done, hdr = cv2.imencode(".hdr", base.astype(np.float32))
    assert done
    return {
        "empty": (b"", "empty"),
        "one_byte": (b"\xff", "not a picture"),
        "text": (b"Dear diary, today the sun ", "not a picture"),
        "zeros": (bytes(4096), "not a picture"),
        "jpeg_cut": (jpeg[: len(jpeg) // 2], "damaged"),
        "jpeg_head_only": (jpeg[:100], "damaged"),
        "jpeg_magic_only": (jpeg[:4], "damaged"),
        "png_cut": (png[: len(png) // 2], "damaged"),
        "png_head_only": (png[:40], "damaged"),
        "png_wrong_checksum": (png[:60] + b"\x55" + png[61:], "damaged"),
        "png_16_cut": (png16[: len(png16) // 2], "damaged"),
        "tiff_cut": (tiff[: len(tiff) // 2], "damaged"),
        "tiff_head_only": (tiff[:8], "damaged"),
        "webp_cut": (webp[: len(webp) // 2], "damaged"),
        "bomb": (png_file(base, size=(30_000, 30_000)), "900 million"),
        "pdf": (b"%PDF-1.7\n", "PDF"),
        "svg": (b"<svg xmlns='http://www.w3.org/2000/svg'/>", "SVG"),
        "heic": (b"\0\0\0\x18ftypheic" + bytes(64), "HEIC"),
        "zip": (b"PK\x03\x04" + bytes(64), "ZIP"),
        "postscript": (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n", "not a picture"),
        "hdr": (hdr.tobytes()[:200], "damaged Radiance"),
        "hdr_header": (hdr.tobytes()[:20], "Radiance HDR file that is damaged"),
        "exr": (b"v/1\1" + bytes(40), "OpenEXR"),
        "raw": (b"FUJIFILMCCD-RAW " + bytes(200), "camera raw file"),
        "tiff_16_planes": (
            tiff_file(np.moveaxis(deep, -1, 0), planarconfig="separate", photometric="rgb"),
            "separate planes",
        ),
        "tiff_nan": (tiff_file(holes, photometric="rgb"), "NaN or infinite"),
        "tiff_double": (tiff_file(holes.astype(np.float64), photometric="rgb"), "NaN or infinite"),
        "tiff_32_bit": (tiff_file(base[..., 0].astype(np.int32) * 70_000), "32-bit"),
    }
