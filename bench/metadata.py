"""Metadata of five files before and after an edit: a table of tags on stdout.

usage: python bench/metadata.py [PHOTO ...] [--all]

Every photo is analyzed small, its sun moved, and saved in its own format (camera raw as TIFF). Tags
are read before and after by exiftool if it is installed, else by exifread (EXIF only). A tag is
kept, changed, added or lost; tags that describe how a file stores its pixels (strip offsets,
Huffman tables, dates of the file …) are not metadata and omitted. Changes by the edit itself are
expected: Software, UserComment, XMP's recipe and history, orientation and size of a picture that
was turned upright. --all also lists the kept tags.

Without photos five are made: a phone's JPEG stored on its side, a 16-bit TIFF in Adobe RGB with a
program's history, a 16-bit PNG in Display P3, a WebP, and a DNG. The exit status is 1 if a tag was
lost or changed unexpectedly.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import cv2
import numpy as np
from PIL import Image

import sunwidget as sw

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
import photo_corpus as corpus
import raw_files

_ASKED = ("-EXIF:all", "-XMP:all", "-ICC_Profile:all", "-JFIF:all", "-PNG:pHYs", "-MakerNotes:all")
# How a file stores its pixels, and what is computed from that.
_STORAGE = re.compile(
    r"Strip|^(Compression|BitsPerSample|SamplesPerPixel|PhotometricInterpretation|Predictor|"
    r"PlanarConfiguration|Image(Width|Height|Length)|XMPToolkit|JFIFVersion|ExifByteOrder|ExifOffset|"
    r"GPSInfo|InterColorProfile|CFA.*|DNG.*|BlackLevel|WhiteLevel|UniqueCameraModel|ColorMatrix1|"
    r"AsShotNeutral|CalibrationIlluminant1|ExtraSamples|ApplicationNotes|SubfileType|Tag 0xC6..)$"
)
_OF_THE_EDIT = ("Software", "UserComment", "CreatorTool", "HistoryAction", "HistorySoftwareAgent")
_OF_TURNING = ("Orientation", "ExifImageWidth", "ExifImageLength", "ExifImageHeight")


def main() -> int:
    """Print a table for each photo."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("photos", nargs="*", type=Path)
    parser.add_argument("--all", action="store_true", help="list the kept tags as well")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        photos = options.photos or made(folder)
        print(f"read by {'exiftool' if shutil.which('exiftool') else 'exifread: EXIF only'}")
        bad = sum(compare(photo, folder, listed=options.all) for photo in photos)
    return 1 if bad else 0


def compare(path: Path, folder: Path, *, listed: bool) -> int:
    """Print the outcome for each tag of one file; return the number of lost tags."""
    photo = sw.open(path)
    scene = sw.analyze(photo)
    ending = ".tif" if photo.format == "RAW" else path.suffix
    after = sw.save((scene, sw.Edit(sun_elevation=3)), folder / f"after-{path.stem}{ending}")
    before, now = tags(path), tags(after)
    fates = {tag: fate(before.get(tag), now.get(tag)) for tag in sorted(before | now)}
    counts = {word: list(fates.values()).count(word) for word in sorted(set(fates.values()))}
    print(f"\n{path.name} → {after.name}: " + ", ".join(f"{n} {w}" for w, n in counts.items()))
    bad = 0
    for tag, what in fates.items():
        if what == "kept" and not listed:
            continue
        name = tag.rpartition(":")[2]
        expected = name in _OF_THE_EDIT or name in _OF_TURNING or what in ("kept", "added")
        bad += not expected
        mark = "" if expected else "  ← not expected"
        print(f"  {what:8}{tag:40}{short(before.get(tag)):30}{short(now.get(tag))}{mark}")
    return bad


def fate(before: str | None, now: str | None) -> str:
    """Name the outcome for a tag."""
    if before is None or now is None:
        return "added" if before is None else "lost"
    return "kept" if before == now else "changed"


def tags(path: Path) -> dict[str, str]:
    """Return every tag of a file except those that describe how it stores its pixels."""
    if shutil.which("exiftool"):
        command = ["exiftool", "-j", "-G0", "-a", "-n", *_ASKED, str(path)]
        said = subprocess.run(command, capture_output=True, check=True, text=True)
        found = json.loads(said.stdout)[0]
        found.pop("SourceFile")
    else:
        import exifread

        with path.open("rb") as file:
            read = exifread.process_file(file, details=False)
        found = {f"EXIF:{key.partition(' ')[2]}": value for key, value in read.items()}
    return {k: str(v) for k, v in found.items() if not _STORAGE.search(k.rpartition(":")[2])}


def short(value: str | None) -> str:
    """Return a value on one line, truncated."""
    line = " ".join((value or "–").split())
    return line if len(line) <= 28 else line[:27] + "…"


def made(folder: Path) -> list[Path]:
    """Make five files with as much metadata as those of cameras and programs."""
    codes = cv2.resize(sw.sample("coast").encoded, (384, 256), interpolation=cv2.INTER_AREA)
    deep = codes.astype(np.uint16) * 257
    first = {0x010F: "Maker", 0x0110: "Model 3", 0x0131: "Firmware 2.1", 0x013B: "A. Person"}
    first |= {0x0132: "2024:06:21 19:30:05", 0x8298: "© A. Person", 0x010E: "Evening"}
    shot = {0x9003: "2024:06:21 19:30:05", 0x9011: "+02:00", 0x829A: 0.004, 0x829D: 8.0}
    shot |= {0x8827: 200, 0x920A: 4.25, 0xA405: 28, 0xA434: "28 mm f/1.8", 0x927C: b"secret" * 50}
    shot |= {0xA002: 256, 0xA003: 384, 0xA001: 1}
    gps = {1: "N", 2: (50.0, 3.0, 57.6), 3: "W", 4: (5.0, 42.0, 57.6), 6: 12.0, 16: "T", 17: 242.8}
    exif = corpus.exif_block(first, shot, gps, 6)
    upright = corpus.exif_block(first, {**shot, 0xA002: 384, 0xA003: 256}, gps)
    stored = Image.fromarray(np.ascontiguousarray(np.rot90(codes)))
    files = {name: folder / name for name in ("phone.jpg", "adobe.tif", "p3.png", "web.webp")}
    stored.save(
        files["phone.jpg"], quality=95, exif=exif, xmp=packet(), dpi=(72, 72),
        icc_profile=corpus.PLAIN_SRGB,
    )  # fmt: skip
    extra = [(700, "B", len(packet()), packet(), True)]
    extra += [(34675, "B", len(corpus.ADOBE_RGB), corpus.ADOBE_RGB, True)]
    extra += [(271, "s", 0, "Maker", True), (315, "s", 0, "A. Person", True)]
    files["adobe.tif"].write_bytes(
        corpus.tiff_file(
            deep, photometric="rgb", extratags=extra, software="Darkroom 3",
            resolution=(300, 300), resolutionunit=2, metadata=None, datetime="2024:06:21 19:30:05",
        )
    )  # fmt: skip
    chunks = [
        corpus.icc_chunk(corpus.DISPLAY_P3),
        (b"eXIf", upright[6:]),
        (b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + packet()),
        (b"pHYs", (11811).to_bytes(4, "big") * 2 + b"\1"),
    ]
    files["p3.png"].write_bytes(corpus.png_file(deep, 16, 2, chunks))
    Image.fromarray(codes).save(
        files["web.webp"], quality=95, exif=upright, xmp=packet(), icc_profile=corpus.PLAIN_SRGB
    )
    raw = folder / "camera.dng"
    raw.write_bytes(raw_files.dng(sw.open(codes).pixels))
    return [*files.values(), raw]


def packet() -> bytes:
    """Return a program's XMP: rating, keywords, place, history."""
    return b"""<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF
 xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description rdf:about=""
 xmlns:xmp="http://ns.adobe.com/xap/1.0/" xmlns:dc="http://purl.org/dc/elements/1.1/"
 xmlns:photoshop="http://ns.adobe.com/photoshop/1.0/"
 xmlns:xmpMM="http://ns.adobe.com/xap/1.0/mm/"
 xmlns:stEvt="http://ns.adobe.com/xap/1.0/sType/ResourceEvent#"
 xmp:CreatorTool="Darkroom 3" xmp:Rating="4" photoshop:City="Newlyn"
 xmpMM:DocumentID="xmp.did:1234">
 <dc:subject><rdf:Bag><rdf:li>sea</rdf:li><rdf:li>evening</rdf:li></rdf:Bag></dc:subject>
 <xmpMM:History><rdf:Seq><rdf:li stEvt:action="saved" stEvt:softwareAgent="Darkroom 3"/></rdf:Seq>
 </xmpMM:History></rdf:Description></rdf:RDF></x:xmpmeta>"""


if __name__ == "__main__":
    sys.exit(main())
