"""Look for a picture or a recipe that breaks the whole way: open, analyse, draw, write a page.

    python tests/fuzz/whole_way.py FOLDER -max_total_time=1200

A file that begins with "{" is a recipe: as text, and as a picture carries it in EXIF, XMP and
Radiance HDR. Any other is a picture. What must hold: a photo, or an error of ours in one printable
sentence; maps and light that are finite; the photo itself where the sun is unmoved; a page whose
state is still JSON. FOLDER, the options and what is left behind are those of photo_readers.py.
"""

import contextlib
import html.parser
import io
import json
import sys
import warnings
import zlib
from pathlib import Path

import atheris

with atheris.instrument_imports(
    include=[
        *(f"sunwidget.{name}" for name in ("decode", "decode_deep", "edit", "exif", "icc")),
        *(f"sunwidget.{name}" for name in ("openexr", "photo", "radiance", "recipe", "xmp")),
        *(f"sunwidget.analysis.{name}" for name in ("analyze", "horizon", "strokes", "sun")),
        *(
            "sunwidget.analysis.strokes.apply",
            "sunwidget.widgets.page.html",
            "sunwidget.widgets.page.standalone",
        ),
    ]
):
    import sunwidget as sw
    from sunwidget.analysis import analyze as _analysis  # noqa: F401 - the fuzzer's coverage
    from sunwidget.edit.table import Edit
    from sunwidget.errors import EditError, PhotoError, PhotoWarning
    from sunwidget.formats import pixels, xmp
    from sunwidget.photo.photo import Photo, open_photo
    from sunwidget.widgets.page import html as _page  # noqa: F401 - likewise

import numpy as np
from PIL import Image

sys.path[:0] = [str(Path(__file__).parents[1] / "support"), str(Path(__file__).parent)]
import photo_corpus  # noqa: E402 - a neighbour's folder
import photo_readers  # noqa: E402 - which are no packages

pixels.MAX_PIXELS = 20_000  # what is slow for many pixels is as wrong for few
# One picture in so many goes the whole way: by its checksum, so that a finding can be repeated.
_WHOLE_WAY = 8


class _Content(html.parser.HTMLParser):
    """Collects the page's scripts by id."""

    def __init__(self) -> None:
        super().__init__()
        self.inside: str | None = None
        self.found: dict[str, str] = {}
        self.scripts = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "script":
            self.scripts += 1
            self.inside = dict(attrs).get("id")

    def handle_endtag(self, tag: str) -> None:
        if tag == "script":
            self.inside = None

    def handle_data(self, data: str) -> None:
        if self.inside is not None:
            self.found[self.inside] = self.found.get(self.inside, "") + data


def check(data: bytes) -> None:
    """Raise unless the bytes go the whole way, or an error of ours says why not."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if data.startswith(b"{"):
            _check_recipe(data)
            return
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", PhotoWarning)
        try:
            photo = open_photo(data)
        except PhotoError as error:
            _check_sentence(str(error))
            return
        recipe = photo.recipe
        if recipe is not None or zlib.crc32(data) % _WHOLE_WAY == 0:
            _check_whole_way(photo, recipe)


def _check_sentence(text: str) -> None:
    assert text.isprintable(), ascii(text)


def _check_recipe(text: bytes) -> None:
    edit = _edit_of(text)
    if edit is not None:
        assert Edit.from_json(edit.to_json()) == edit
        assert eval(edit.to_code(), {"sw": sw}) == edit
    for file in _pictures_with(text):
        photo = open_photo(file)
        recorded = photo.recipe
        if recorded is not None:
            assert edit is None or recorded == edit, "a picture carries another recipe"
    if edit is not None and zlib.crc32(text) % _WHOLE_WAY == 0:
        _check_whole_way(open_photo(photo_corpus.ramp(24, 32)), edit)


def _edit_of(text: bytes) -> Edit | None:
    try:
        return Edit.from_json(text)
    except EditError as error:
        _check_sentence(str(error))
        return None


def _pictures_with(text: bytes) -> list[bytes]:
    """Return pictures that carry the text where sunwidget puts recipes."""
    ramp = Image.fromarray(photo_corpus.ramp(4, 4))
    block = Image.Exif()
    block.get_ifd(0x8769)[0x9286] = b"ASCII\0\0\0" + text
    files = []
    with contextlib.suppress(ValueError):  # longer than a JPEG's segment holds
        buffer = io.BytesIO()
        ramp.save(buffer, "PNG", exif=block.tobytes())
        files.append(buffer.getvalue())
    packet = xmp.record(None, {"sun_elevation": 3.0}, "sunwidget", before="")
    if packet is not None:
        own = json.dumps({"sun_elevation": 3.0}).replace('"', "&quot;").encode()
        assert own in packet, packet
        buffer = io.BytesIO()
        ramp.save(buffer, "TIFF", tiffinfo={700: packet.replace(own, _escaped(text))})
        files.append(buffer.getvalue())
    head, rest = photo_corpus.hdr_file(np.ones((4, 4, 3))).split(b"\n", 1)
    line = text.replace(b"\n", b" ")
    files.append(head + b"\n# recipe: " + line + b"\n" + rest)
    return files


def _escaped(text: bytes) -> bytes:
    for sign, name in ((b"&", b"&amp;"), (b'"', b"&quot;"), (b"<", b"&lt;")):
        text = text.replace(sign, name)
    return text


def _check_whole_way(photo: Photo, recipe: Edit | None) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what a photo is warned of has tests of its own
        scene = sw.analyze(photo)
        for name in ("sky", "clouds", "water"):
            values = np.asarray(getattr(scene, name))
            assert np.isfinite(values).all(), f"{name} is not finite"
            assert values.min() >= 0, name
            assert values.max() <= 1, name
        same = sw.render(scene, Edit())
        off = np.abs(same.astype(int) - photo.preview(100_000).astype(int)).max()
        assert off <= 1, f"an unmoved sun changes the photo by {off}"
        edit = recipe if recipe is not None else Edit(sun_elevation=2, sun_azimuth=5)
        light = sw.render(scene, edit, dtype="float32")
        assert np.isfinite(light).all(), "light that is not finite"
        text = sw.to_html(scene, edit)
    page = _Content()
    page.feed(text)
    assert page.scripts == 2, f"{page.scripts} scripts"
    assert isinstance(json.loads(page.found["content"]), dict)


def seeds() -> dict[str, bytes]:
    """Return small pictures of every kind and recipes of every parameter, by name."""
    found = photo_readers.seeds()
    found = {name: data for name, data in found.items() if len(data) < 6000}
    found["recipe-all"] = json.dumps(Edit().to_dict()).encode()
    found["recipe-one"] = b'{"sun_elevation": 3}'
    strokes = [{"kind": "sky", "points": [[0.1, 0.2], [0.8, 0.3]], "radius": 0.05}]
    found["recipe-strokes"] = json.dumps({"version": 1, "strokes": strokes}).encode()
    found["recipe-nested"] = b'{"strokes": ' + b"[" * 60 + b"]" * 60 + b"}"
    carried = _pictures_with(b'{"sun_elevation": -3.5, "shading": "thesis"}')
    found |= {f"carried-{number}": data for number, data in enumerate(carried)}
    return found


if __name__ == "__main__":
    photo_readers.run(check, seeds(), "-max_len=6000", "-timeout=300", "-rss_limit_mb=4000")
