"""The stand-alone page: valid HTML, whole or absent, and deaf to hostile texts."""

import base64
import hashlib
import io
import json
import re

import html5lib
import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.errors import RendererError
from sunwidget.widgets import SkyExplorer, SunEditor
from sunwidget.widgets.editor.editor_state import editor_state
from sunwidget.widgets.page import html as module
from sunwidget.widgets.page import standalone as parts
from sunwidget.widgets.page.html import Still, page

HOSTILE = "</script><script>alert(1)</script>\"'<!--<script>&amp;\u2028\u2029\x00\udcff\r\n.jpg"


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(192))


@pytest.fixture(scope="module")
def text(scene):
    return sw.to_html(scene, sw.Edit(sun_elevation=3))


def parsed(text):
    """The tree of a page; anything that HTML 5 calls an error raises."""
    parser = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False)
    return parser.parse(text)


def content(text):
    return json.loads(parsed(text).find(".//script[@id='content']").text)


def test_the_page_is_valid_html_with_title_picture_and_fallback(text):
    tree = parsed(text)
    assert tree.find("head/title").text == "array"
    still = tree.find(".//figure/img")
    assert (still.get("width"), still.get("height")) == ("192", "128")
    assert "sun moved" in still.get("alt")
    assert "JavaScript" in tree.find(".//noscript/p").text
    assert tree.get("lang") == "en"


def test_the_page_holds_the_edit_and_names_no_address(text):
    state = content(text)["state"]
    assert state["sun_elevation"] == 3
    assert state["_history"] == {"past": [], "future": []}
    assert state["_scene"]["notes"] == []  # nothing can be corrected in a page
    assert not {"layout", "_model_name", "_dom_classes"} & set(state)
    elements = list(parsed(text).iter())
    for name in ("src", "href", "action", "srcset", "data"):
        assert all(e.get(name, "data:").startswith("data:") for e in elements)
    assert not re.findall(r"url\((?!data:)", text)


def test_the_front_end_comes_back_to_the_letter_and_ends_no_element(text):
    assert content(text)["state"]["_esm"] == SunEditor._esm
    assert len(re.findall("<script", text)) == len(re.findall("</script", text)) == 2


def test_the_policy_lets_only_the_pages_own_code_run(text):
    tree = parsed(text)
    (policy,) = [
        meta.get("content")
        for meta in tree.iter("meta")
        if meta.get("http-equiv") == "Content-Security-Policy"
    ]
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert rules["default-src"] == "'none'"

    def digest(code):
        return base64.b64encode(hashlib.sha256(code.encode()).digest()).decode()

    (starter,) = [s.text for s in tree.iter("script") if s.get("type") == "module"]
    assert rules["script-src"] == f"'sha256-{digest(starter)}' blob:"
    (style,) = tree.iter("style")
    assert rules["style-src-elem"] == f"'sha256-{digest(style.text)}'"
    assert rules["require-trusted-types-for"] == "'script'"
    assert rules["trusted-types"] == "'none'"
    assert "unsafe-inline" not in rules["script-src"] + rules["style-src-elem"]


def test_hostile_names_and_titles_stay_text(scene):
    photo = sw.open(scene.photo.encoded)
    object.__setattr__(photo, "name", HOSTILE)
    hostile = sw.analyze(photo)
    for text in (sw.to_html(hostile), sw.to_html(scene, title=HOSTILE)):
        tree = parsed(text)
        assert len(list(tree.iter("script"))) == 2
        assert tree.find("head/title").text.startswith('</script><script>alert(1)</script>"')
        text.encode("utf-8")
        assert not set("\x00\u2028\u2029\r") & set(text)


def test_hostile_state_stays_text(scene):
    still = Still(b"\x89PNG", (1, 1), HOSTILE)
    embedded = {"state": {"_css": "", "_scene": {"warnings": [HOSTILE]}}, "buffers": []}
    text = page(embedded, still, title="x")
    assert content(text)["state"]["_scene"]["warnings"] == [HOSTILE]
    tree = parsed(text)
    assert len(list(tree.iter("script"))) == 2
    assert tree.find(".//img").get("alt").startswith("</script>")


def test_code_that_could_end_its_element_is_refused():
    still = Still(b"\x89PNG", (1, 1), "")
    with pytest.raises(ValueError, match="</style"):
        page({"state": {"_css": "a{}</STYLE>"}}, still, title="x")
    with pytest.raises(ValueError, match="JSON"):
        page({"state": {"value": float("nan")}}, still, title="x")


def test_the_file_is_whole_or_absent(scene, tmp_path, monkeypatch):
    path = tmp_path / "beach.html"
    assert sw.to_html(scene, path=path) == path
    assert path.read_text("utf-8").endswith("</html>\n")
    before = path.read_bytes()
    with pytest.raises(FileExistsError, match="overwrite=True"):
        sw.to_html(scene, path=path)
    with pytest.raises(FileNotFoundError, match="no folder"):
        sw.to_html(scene, path=tmp_path / "none" / "x.html")

    def full(self, data):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(OSError, match="was not written: the disk is full"):
        sw.to_html(scene, path=path, overwrite=True)
    assert [p.name for p in tmp_path.iterdir()] == ["beach.html"]
    assert path.read_bytes() == before


def test_an_editor_writes_what_it_shows(scene):
    editor = SunEditor(scene, sun_azimuth=5)
    editor._photo_place = {"latitude": 47.123456}
    editor.exposure = 0.5
    text = editor.to_html(title="Evening")
    assert parsed(text).find("head/title").text == "Evening"
    state = content(text)["state"]
    assert (state["sun_azimuth"], state["exposure"]) == (5, 0.5)
    # The maker's own history stays where it is.
    assert len(editor._history["past"]) == 1
    # Nor does a page tell where the photo was taken, unless a place was set.
    assert "47.123456" not in text


def test_a_page_holds_what_an_editor_of_the_same_edit_shows(scene):
    edit = sw.Edit(
        sun_elevation=3,
        strokes=(sw.Stroke("not_sky", ((0.3, 0.2), (0.5, 0.25)), 0.05),),
        horizon_hint=((0, 0.6), (1, 0.61)),
        place=sw.Place(50.09, 14.42, "2024-03-20", 17.0, 270.0),
    )
    editor = SunEditor(scene, recipe=edit).wait()
    shown = parts.widget_state(editor)
    shown["state"]["_scene"]["notes"] = []
    shown["state"]["_photo_place"] = {}
    session = editor._source["session"]
    made = parts.embedded_state(editor_state(scene, edit, session=session))
    assert made["state"] == shown["state"]
    for state in (made, shown):
        state["buffers"].sort(key=lambda buffer: buffer["path"])
    assert made["buffers"] == shown["buffers"]
    # What its maker keeps beside the edit goes along.
    editor.keep("low")
    editor.key_frames = [(0, sw.Edit()), (2, edit)]
    state = content(editor.to_html())["state"]
    for name in ("_versions", "key_frames", "_source"):
        assert state[name] == parts.widget_state(editor)["state"][name]
    assert (len(state["_versions"]), len(state["key_frames"])) == (1, 2)


def test_binary_traits_are_where_they_were(scene):
    editor = SunEditor(scene).wait()
    embedded = parts.widget_state(editor)
    names = {tuple(row["path"]) for row in embedded["buffers"]}
    assert {("_photo",), ("_layers",), ("_surface",)} <= names
    for row in embedded["buffers"]:
        data, sent = base64.b64decode(row["data"]), getattr(editor, row["path"][0])
        assert len(data) <= len(sent)
        same = [np.asarray(Image.open(io.BytesIO(picture))) for picture in (data, sent)]
        assert np.array_equal(*same)


def test_an_explorer_writes_what_it_shows(tmp_path):
    explorer = SkyExplorer(sun_elevation=7)
    text = explorer.to_html(title="Dusk & dawn")
    tree = parsed(text)
    assert tree.find("head/title").text == "Dusk & dawn"
    assert tree.find(".//figure/img").get("width") == "960"
    assert content(text)["state"]["sun_elevation"] == 7
    path = explorer.to_html(tmp_path / "sky.html")
    assert parsed(path.read_text("utf-8")).find("head/title").text == "Sky explorer"
    with pytest.raises(FileExistsError):
        explorer.to_html(path)


def test_as_a_cells_output_the_page_is_in_a_frame_that_nothing_in_it_can_end(scene):
    object.__setattr__(scene.photo, "name", HOSTILE)
    shown = SunEditor(scene, sun_elevation=3).render_static()
    parser = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False)
    (frame,) = parser.parseFragment(shown._repr_html_())
    assert frame.tag == "iframe"
    assert frame.get("srcdoc") == shown.html
    assert "allow-same-origin" not in frame.get("sandbox"), "the page must not see its host"
    assert content(frame.get("srcdoc"))["state"]["sun_elevation"] == 3
    assert SkyExplorer().render_static(title="Dusk & dawn").title == "Dusk & dawn"


def test_an_explorer_needs_no_renderer_for_a_page(monkeypatch):
    def broken(*_):
        raise RendererError("no EGL")

    explorer = SkyExplorer()
    monkeypatch.setattr(explorer, "render", broken)
    tree = parsed(explorer.to_html())
    assert tree.find(".//figure/img") is None
    assert tree.find(".//figure/figcaption") is not None


def test_without_a_renderer_the_still_is_the_photo(scene):
    def broken(**_options):
        raise RendererError("no EGL")

    still = parts.still_of(scene.photo, broken)
    assert still.description.endswith("as it was taken")
    picture = np.asarray(Image.open(io.BytesIO(still.data)).convert("RGB")).astype(int)
    assert np.abs(picture - scene.photo.preview(1024)).mean() < 4


def test_a_front_end_that_is_not_built_is_said(monkeypatch, tmp_path):
    monkeypatch.setattr(module, "_STARTER", tmp_path / "standalone.js")
    with pytest.raises(ImportError, match="make build"):
        page({"state": {}}, Still(b"", (1, 1), ""), title="x")
