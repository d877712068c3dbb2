"""The export panel: stills, films along key frames, played in the picture before they are made."""

import base64

import pytest
from chromium import connect, picture_of, widget_state

import sunwidget as sw
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def widget(coast):
    return SunEditor(coast, sun_elevation=4).wait()


@pytest.fixture(scope="module")
def state(widget):
    return widget_state(widget)


@pytest.fixture(scope="module")
def choices(widget):
    """What the kernel answers when the panel asks what there is."""
    return widget._describe_exports({}, lambda *_: None)[0]


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def sent(page, action):
    """The last request of a kind."""
    requests = page.evaluate("model.sent")
    return [request for request in requests if request.get("action") == action][-1]


def answer(page, action, result, data=None):
    """Answer it as the kernel does."""
    message = {"type": "response", "id": sent(page, action)["id"], "result": result}
    text = None if data is None else base64.b64encode(data).decode("ascii")
    page.evaluate(
        """([message, text]) => {
          const bytes = text && Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
          const buffers = bytes ? [new DataView(bytes.buffer)] : [];
          model.fire("msg:custom", message, buffers);
        }""",
        [message, text],
    )


def show(page, state, choices, tab):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    page.locator(".sw-sun").focus()
    page.keyboard.press("e")
    answer(page, "exports", choices)
    page.get_by_role("tab", name=tab).click()


def field(page, label):
    """A field of the page of the panel that is open."""
    return page.locator(".sw-export-page:visible").get_by_label(label, exact=True)


def canvas_of(page):
    url = page.evaluate("document.querySelector('.sw-canvas').toDataURL('image/png')")
    return picture_of(url.split(",")[1])


def drawn_anew(page, before):
    """Wait until the canvas shows another picture; returns it."""
    for _ in range(200):
        now = canvas_of(page)
        if now.shape != before.shape or (now != before).any():
            return now
        page.wait_for_timeout(50)
    raise AssertionError("the picture stayed as it was")


def sun_stands(page, elevation):
    """Wait until the read-out says where the sun of the picture is."""
    page.wait_for_function(
        "(text) => document.querySelector('.sw-readout').textContent.endsWith(text)",
        arg=f" {elevation} elevation",
    )


def add_key_frame(page, **edit):
    page.evaluate("(edit) => model.receive(edit)", edit)
    page.get_by_role("button", name="Add key frame").click()


def test_key_frames_are_made_timed_and_ordered(page, state, choices, screenshots):
    show(page, state, choices, "Film")
    assert page.get_by_text("from the photo to the current edit").is_visible()
    add_key_frame(page)
    add_key_frame(page, sun_elevation=12, sun_azimuth=-9)
    add_key_frame(page, sun_elevation=1, exposure=0.5)
    assert [frame["seconds"] for frame in trait(page, "key_frames")] == [0, 2, 4]
    seconds = field(page, "Seconds of key frame 2")
    seconds.fill("1.5")
    seconds.press("Enter")
    page.get_by_role("button", name="Move key frame 3 earlier").click()
    elevations = [frame["recipe"]["sun_elevation"] for frame in trait(page, "key_frames")]
    assert elevations == [4, 1, 12]
    assert [frame["seconds"] for frame in trait(page, "key_frames")] == [0, 1.5, 4]

    # A key frame is gone to as one step, which undo takes back.
    page.get_by_role("button", name="Go to key frame 3").click()
    assert trait(page, "sun_elevation") == 12
    page.keyboard.press("Control+z")
    assert trait(page, "sun_elevation") == 1
    # The film's length stretches them all.
    length = field(page, "Seconds")
    length.fill("8")
    length.press("Enter")
    assert [frame["seconds"] for frame in trait(page, "key_frames")] == [0, 3, 8]

    pictured = "document.querySelectorAll('.sw-key-frame .sw-drawn').length === 3"
    page.wait_for_function(pictured)
    page.screenshot(path=screenshots / "export-film-light.png", full_page=True)
    page.emulate_media(color_scheme="dark")
    page.screenshot(path=screenshots / "export-film-dark.png", full_page=True)
    page.get_by_role("button", name="Delete key frame 2").click()
    assert len(trait(page, "key_frames")) == 2
    page.locator(".sw-notice").get_by_role("button", name="Undo").click()
    assert len(trait(page, "key_frames")) == 3
    # From Python, or another view.
    page.evaluate("model.receive({ key_frames: [] })")
    assert page.locator(".sw-key-frame").count() == 0
    assert page.errors == []


def test_a_film_is_played_in_the_picture_and_the_edit_stays(page, state, choices):
    frames = [
        {"seconds": 0, "recipe": {"sun_elevation": 2}},
        {"seconds": 60, "recipe": {"sun_elevation": 30, "exposure": 1}},
    ]
    show(page, {**state, "key_frames": frames}, choices, "Film")
    still = canvas_of(page)
    history = trait(page, "_history")
    moment = page.get_by_role("slider", name="Position in the film")
    moment.fill("0.5")
    shown = drawn_anew(page, still)
    sun_stands(page, "16.0°")
    assert page.locator(".sw-film-time").text_content() == "30.0 / 60.0 s"
    play = page.get_by_role("button", name="Play the film")
    play.click()
    drawn_anew(page, shown)
    assert play.get_attribute("aria-pressed") == "true"
    play.click()
    assert float(moment.input_value()) > 0.5
    assert trait(page, "sun_elevation") == 4
    assert trait(page, "_history") == history
    # Whoever changes the edit, or closes the panel, wants to see the edit.
    page.evaluate("model.receive({ exposure: 0.5 })")
    sun_stands(page, "4.0°")
    page.evaluate("model.receive({ exposure: 0 })")
    moment.fill("0.9")
    assert page.locator(".sw-film-time").text_content() == "54.0 / 60.0 s"
    page.get_by_role("button", name="Close the export panel").click()
    page.wait_for_function("document.querySelector('.sw-canvas').width === 768")
    for _ in range(100):
        if canvas_of(page).shape == still.shape and (canvas_of(page) == still).all():
            break
        page.wait_for_timeout(50)
    else:
        raise AssertionError("the edit did not come back to the bit")
    assert page.errors == []


def test_what_is_asked_for_how_far_it_is_and_a_name_that_is_taken(
    page, state, choices, screenshots
):
    show(page, state, choices, "Still")
    field(page, "Format").select_option(".tif")
    field(page, "Depth").select_option("16")
    page.get_by_role("switch", name="Layers").click()
    assert not page.get_by_role("switch", name="Light above white").is_visible()
    field(page, "Size").select_option("edge")
    field(page, "Longer side, pixels").fill("400")
    field(page, "Name").fill("evening")
    field(page, "Save to").select_option("folder")
    page.screenshot(path=screenshots / "export-still-light.png", full_page=True)
    page.locator("[type=submit]:visible", has_text="Export").click()
    request = sent(page, "still")
    wanted = {
        "name": "evening",
        "suffix": ".tif",
        "bits": 16,
        "layers": True,
        "long_edge": 400,
        "in_folder": True,
    }
    assert {name: request[name] for name in wanted} == wanted
    progress = {"type": "progress", "id": request["id"], "fraction": 0.4}
    progress["message"] = "rendering · 12 s left"
    page.evaluate("(message) => model.fire('msg:custom', message, [])", progress)
    assert page.get_by_text("rendering · 12 s left").is_visible()
    assert page.locator(".sw-export progress").evaluate("(bar) => bar.value") == 0.4
    page.locator(".sw-export").get_by_role("button", name="Cancel").click()
    assert page.evaluate("model.sent.at(-1)") == {"type": "cancel", "id": request["id"]}
    page.get_by_text("The export was canceled.").wait_for()
    page.get_by_role("button", name="Try again").click()
    answer(page, "still", {"taken": "evening.tif", "free": "evening-2.tif"})
    assert page.get_by_text("evening.tif already exists and was not overwritten.").is_visible()
    page.get_by_role("button", name="Use evening-2.tif").click()
    assert sent(page, "still")["name"] == "evening-2.tif"
    made = {"name": "evening-2.tif", "type": "image/tiff", "bytes": 2_400_000, "files": 1}
    answer(page, "still", {**made, "path": "/there/<b>evening-2.tif"})
    said = page.locator(".sw-export-done").text_content()
    assert said == "evening-2.tif · 2.4 MB · written to /there/<b>evening-2.tif"
    assert field(page, "Name").input_value() == "evening-2"
    assert page.errors == []


def test_a_film_is_made_downloaded_and_shown(page, widget, coast):
    pytest.importorskip("imageio_ffmpeg")
    connect(page, widget)
    page.get_by_role("button", name="Export", exact=True).click()
    page.get_by_role("button", name="Export the still").wait_for()  # named unlike what opened it
    page.get_by_role("tab", name="Film").click()
    page.get_by_role("button", name="Export the film").wait_for()
    field(page, "Seconds").fill("0.5")
    field(page, "Frame rate").select_option("12")
    field(page, "Longer side").select_option("640")
    field(page, "Name").fill("dusk")
    with page.expect_download() as download:
        page.locator("[type=submit]:visible", has_text="Export").click()
    assert download.value.suggested_filename == "dusk.mp4"
    data = download.value.path().read_bytes()
    assert data[4:8] == b"ftyp"
    video = page.locator(".sw-export-done video")
    page.wait_for_function("document.querySelector('.sw-export-done video').readyState >= 2")
    size = video.evaluate("(video) => [video.videoWidth, video.videoHeight]")
    assert max(size) == 640
    assert abs(size[0] / size[1] - coast.camera.width / coast.camera.height) < 0.01
    assert page.errors == []
    assert widget.edit == sw.Edit(sun_elevation=4)
