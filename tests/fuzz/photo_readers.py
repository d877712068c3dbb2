"""Look for a picture file that the readers fail on, guided by the code that each file reaches.

    python tests/fuzz/photo_readers.py FOLDER -max_total_time=1200

keeps what it learns in FOLDER and writes a file that breaks a reader beside it (crash-…,
timeout-…, oom-…); run again with that file instead of FOLDER it shows the error. Further options
are libFuzzer's. Needs Atheris (pip install atheris).
"""

import contextlib
import dataclasses
import re
import struct
import sys
import tempfile
import warnings
import zlib
from collections.abc import Callable
from pathlib import Path

import atheris

# Where coverage counts: our readers, and those parts of Pillow's that are Python.
with atheris.instrument_imports(
    include=[
        *(f"sunwidget.{name}" for name in ("color_management", "decode", "decode_deep")),
        *(f"sunwidget.{name}" for name in ("decode_raw", "exif", "exif_place", "exif_values")),
        *(f"sunwidget.{name}" for name in ("icc", "layout", "openexr", "photo", "radiance", "xmp")),
        *(f"sunwidget.{name}" for name in ("apple", "decode_heif", "gain_map", "photo_sources")),
        *(f"PIL.{name}ImagePlugin" for name in ("Bmp", "Gif", "Jpeg", "Mpo", "Png", "Tiff")),
    ]
):
    from sunwidget.errors import PhotoError, PhotoWarning
    from sunwidget.export.gain_map_file import append_gain_map, with_gain_map_xmp
    from sunwidget.formats import exif, icc, pixels, xmp
    from sunwidget.formats.gain_map import GainMap, packed
    from sunwidget.photo.decode import _formats
    from sunwidget.photo.photo import Photo, open_photo

    _formats()  # loads Pillow's readers

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
import heif_files
import photo_corpus
import raw_files

# What a fuzzer learns from a large picture it learns from a small one, sooner.
pixels.MAX_PIXELS = 250_000
_PNG = b"\x89PNG\r\n\x1a\n"


def check(data: bytes) -> None:
    """Raise unless the bytes become a sound photo, or an error that says why not."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a library's own warning must not leak either
        warnings.simplefilter("ignore", PhotoWarning)
        try:
            photo = open_photo(data)
        except PhotoError as error:
            text = str(error)
            assert text.endswith("."), text
            assert text.isprintable(), ascii(text)
            return
        _check_photo(photo)


def _check_photo(photo: Photo) -> None:
    assert photo.encoded.ndim == 3, photo.encoded.shape
    assert photo.encoded.shape[2] == 3, photo.encoded.shape
    assert photo.encoded.dtype in (np.uint8, np.uint16, np.float32), photo.encoded.dtype
    assert photo.width * photo.height <= pixels.MAX_PIXELS, photo.size
    assert np.isfinite(photo.pixels).all(), "light that is not finite"
    assert photo.preview(8).dtype == np.uint8
    assert photo.gain_map is None or photo.gain_map.levels.dtype == np.uint8
    assert photo.depth is None or np.isfinite(photo.depth.values).all()
    assert photo.alpha is None or photo.alpha.shape == photo.encoded.shape[:2]
    assert 0.5 <= photo.field_of_view.vertical <= 150, photo.field_of_view
    assert all(note.isprintable() for note in photo.notes), photo.notes
    # What an export does with the metadata.
    read = exif.load(photo.exif) if photo.exif else None
    exif.dump(read, photo.size, {"sun_elevation": 3.0}, "sunwidget")
    xmp.record(photo.xmp, {"sun_elevation": 3.0}, "sunwidget", before=str(photo.facts))
    assert photo.icc is None or icc.color_space(photo.icc) == "RGB"
    if photo.bit_depth < 32:
        codes = photo.profile.encode(photo.pixels, photo.encoded.dtype)
        assert codes.dtype == photo.encoded.dtype


def mutated(data: bytes, longest: int, seed: int) -> bytes:
    """Mutate, and mend the checksums of a PNG: without that nothing behind them is reached."""
    data = bytes(atheris.Mutate(data, longest))
    return _with_checksums(data)[:longest] if data.startswith(_PNG) else data


def _with_checksums(png: bytes) -> bytes:
    parts, at = [png[:8]], 8
    while at + 12 <= len(png):
        (length,) = struct.unpack_from(">I", png, at)
        chunk = png[at + 4 : at + 8 + length]
        parts += [png[at : at + 4], chunk, struct.pack(">I", zlib.crc32(chunk))]
        at += 12 + length
    return b"".join(parts)


def seeds() -> dict[str, bytes]:
    """Return small files of every kind, good and bad, by name."""
    found = {f"good-{name}": file.data for name, file in photo_corpus.readable().items()}
    found |= {f"bad-{name}": data for name, (data, _) in photo_corpus.unreadable().items()}
    found |= photo_corpus.with_metadata()
    found["raw"] = raw_files.dng(raw_files.ramp(16, 16))
    found["gain_map"] = _with_gain_map()
    with contextlib.suppress(ImportError):  # without the extra heif
        grey = photo_corpus.ramp()[..., 0]
        kinds = (heif_files.DEPTH, heif_files.APPLE_GAIN_MAP)
        found["heic"] = heif_files.heic(photo_corpus.ramp(), [(kind, grey) for kind in kinds])
    return {name: data for name, data in found.items() if len(data) < 20_000}


def _with_gain_map() -> bytes:
    told = GainMap(b"", high=(2.0, 2.0, 2.0), headroom=2.0)
    told = dataclasses.replace(told, jpeg=packed(photo_corpus.ramp(), told))
    picture = photo_corpus.jpeg_file(photo_corpus.ramp(), xmp=with_gain_map_xmp(None, told, 65_000))
    return append_gain_map(picture, told)


def words(files: dict[str, bytes]) -> list[bytes]:
    """Return what files begin with and what their parts are called: libFuzzer's dictionary."""
    heads = {data[:count] for data in files.values() if data for count in (4, 8)}
    names = {
        word for data in files.values() for word in re.findall(rb"[A-Za-z0-9:=#?.-]{4,16}", data)
    }
    return sorted(heads | {name for name in names if len(name) == 4 or len(name) > 7})


def run(checked: Callable[[bytes], None], files: dict[str, bytes], *limits: str) -> None:
    """Fill the folder that the command line names with the seeds, and fuzz."""
    given = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
    options = [argument for argument in sys.argv[1:] if argument.startswith("-")]
    with contextlib.ExitStack() as stack:
        if not given or Path(given[0]).is_dir() or not Path(given[0]).exists():
            folder = Path(given[0] if given else stack.enter_context(tempfile.TemporaryDirectory()))
            folder.mkdir(parents=True, exist_ok=True)
            for name, data in files.items():
                Path(folder, name).write_bytes(data)
            given = [str(folder)]
            listed = stack.enter_context(tempfile.NamedTemporaryFile("w", suffix=".dict"))
            for word in words(files):
                listed.write('"' + "".join(f"\\x{byte:02x}" for byte in word) + '"\n')
            listed.flush()
            options += [f"-dict={listed.name}", f"-artifact_prefix={folder}-"]
        atheris.Setup([sys.argv[0], *limits, *options, *given], checked, custom_mutator=mutated)
        atheris.Fuzz()


if __name__ == "__main__":
    run(check, seeds(), "-max_len=20000", "-timeout=20", "-rss_limit_mb=3000")
