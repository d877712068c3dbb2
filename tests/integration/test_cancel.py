"""Work that is cancelled ends at its next step, leaves nothing half-done, and can be retried."""

import base64
import io
import threading
import time

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.widgets import SunEditor
from sunwidget.widgets.kernel.analyst import AnalysisCancelled, Analyst
from sunwidget.widgets.kernel.requests import Requests

STROKE = sw.Stroke("not_sky", ((0.4, 0.3), (0.6, 0.3)), 0.05)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(192))


class Watched(Analyst):
    """An analyst whose reports are kept, and that stops at a fraction until it may go on."""

    def __init__(self, source, at=0.0):
        self.reports, self.scenes = [], []
        self.at, self.reached, self.go_on = at, threading.Event(), threading.Event()
        super().__init__(source, {}, self.scenes.append, self.note)

    def note(self, stage, fraction, message):
        self.reports.append((stage, fraction, message))
        if stage == "analysing" and fraction >= self.at and not self.reached.is_set():
            self.reached.set()
            assert self.go_on.wait(60)

    def cancelled(self, edit=None):
        """Ask, cancel at the fraction, and wait until it has ended."""
        self.ask(edit or sw.Edit())
        assert self.reached.wait(60)
        self.cancel()
        self.go_on.set()
        with pytest.raises(AnalysisCancelled, match="retry"):
            self.wait(60)


@pytest.mark.parametrize("fraction", [0.4, 0.82])
def test_an_analysis_ends_at_its_next_step_and_starts_again(scene, fraction):
    analyst = Watched(scene.photo, fraction)
    analyst.cancelled()
    last = analyst.reports[-1]
    assert last == ("cancelled", 1.0, "The analysis was cancelled.")
    assert analyst.reports[-2][1] == max(f for stage, f, _ in analyst.reports[:-1])
    assert analyst.scenes == []
    assert not analyst.ready
    analyst.ask(sw.Edit())
    assert analyst.wait(120).sky.shape == scene.sky.shape
    assert analyst.reports[-1][0] == "ready"
    assert len(analyst.scenes) == 1


def test_a_cancelled_correction_leaves_the_scene_and_the_next_one_is_whole(scene):
    analyst = Watched(scene, 2.0)
    analyst.ask(sw.Edit())
    assert analyst.wait(60) is scene
    analyst.at = 0.6
    analyst.cancelled(sw.Edit(horizon_hint=((0, 0.6), (1, 0.6)), strokes=(STROKE,)))
    assert analyst.scenes == [scene]
    edit = sw.Edit(strokes=(STROKE,))
    analyst.ask(edit)
    again = analyst.wait(120)
    fresh = correct.corrected(sw.analyze(scene.photo), edit)
    assert (again.sky == fresh.sky).all()


def test_cancelling_when_nothing_runs_changes_nothing(scene):
    analyst = Watched(scene, 2.0)
    analyst.ask(sw.Edit())
    analyst.wait(60)
    analyst.cancel()
    assert analyst.ready
    analyst.ask(sw.Edit())
    assert analyst.wait(60) is scene


def test_a_question_after_the_cancel_is_answered(scene):
    analyst = Watched(scene.photo, 0.4)
    analyst.ask(sw.Edit())
    assert analyst.reached.wait(60)
    analyst.cancel()
    analyst.ask(sw.Edit())
    analyst.go_on.set()
    assert analyst.wait(120).sky.shape == scene.sky.shape
    assert [stage for stage, _, _ in analyst.reports].count("cancelled") == 1


def test_the_stages_of_an_analysis_are_named_and_long_ones_tell_more_than_once(scene):
    told = []
    sw.analyze(scene.photo, progress=lambda fraction, text: told.append((fraction, text)))
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions)
    texts = [text for _, text in told]
    assert {"Finding the sky", "Looking for water"} <= set(texts)
    assert texts.count("Fitting the atmosphere") >= 4
    assert texts.count("Cutting out the sky") >= 2


def test_an_editor_says_that_it_was_cancelled_and_retries(scene):
    editor = SunEditor(scene.photo)
    editor.cancel()
    try:
        editor.wait(120)
    except AnalysisCancelled:
        assert editor._status["stage"] == "cancelled"
        with pytest.raises(sw.AnalysisError, match="retry"):
            editor.render()
    editor.retry()
    assert editor.wait(120)._status["stage"] == "ready"
    assert editor.render(size=(48, 32)).shape == (32, 48, 3)


def test_a_correction_after_the_cancel_starts_the_analysis(scene):
    editor = SunEditor(scene.photo)
    editor.cancel()
    editor.strokes = (STROKE,)
    assert editor.wait(120).scene.hints.strokes == (STROKE,)


@pytest.fixture
def waiting():
    """Requests with one action that tells its progress until it is stopped."""
    sent, started = [], threading.Event()

    def work(_content, progress):
        for i in range(10_000):
            progress(i / 10_000, "working")
            started.set()
            time.sleep(0.005)
        return {}, []

    requests = Requests(lambda content, buffers=(): sent.append(content), {"work": work})
    return requests, sent, started


@pytest.mark.parametrize("message", [{"type": "cancel", "id": "a"}, None])
def test_a_request_is_cancelled_by_its_id_or_with_all(waiting, message):
    requests, sent, started = waiting
    requests(None, {"type": "request", "id": "a", "action": "work"}, [])
    assert started.wait(30)
    if message is None:
        requests.cancel()
    else:
        requests(None, {"type": "cancel", "id": "other"}, [])
        requests(None, message, [])
    for _ in range(400):
        if sent[-1]["type"] == "response":
            break
        time.sleep(0.05)
    assert sent[-1] == {
        "type": "response",
        "id": "a",
        "result": None,
        "error": "Work was cancelled.",
    }
    assert requests._running == {}


def test_an_export_that_is_cancelled_leaves_no_file(scene, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    editor = SunEditor(scene).wait(60)
    sent = []
    requests = Requests(lambda content, buffers=(): sent.append(content), editor._actions())
    content = {"type": "request", "id": "s", "action": "save"}
    requests._cancel_event(content).set()
    requests._answer(content)
    assert sent[-1]["error"] == "Save was cancelled."
    assert list(tmp_path.iterdir()) == []
    requests._answer(content)
    assert sent[-1]["error"] is None


def test_a_snapshot_stays_and_the_display_shows_the_edit(scene):
    editor = SunEditor(scene, sun_elevation=3).wait(60)
    snapshot = editor.snapshot(96)
    editor.sun_elevation = 20
    assert snapshot.edit == sw.Edit(sun_elevation=3)
    assert np.array_equal(
        snapshot.pixels, sw.render(scene, sw.Edit(sun_elevation=3), size=(96, 64))
    )

    def shown(bundle):
        return np.asarray(Image.open(io.BytesIO(base64.b64decode(bundle[0]["image/png"]))))

    bundle = snapshot._repr_mimebundle_()
    assert np.array_equal(shown(bundle), snapshot.pixels)
    assert bundle[1]["image/png"]["alt"] == "array with its sun moved"
    edited = shown(editor._repr_mimebundle_())
    assert np.array_equal(edited, sw.render(scene, editor.edit))
    editor._analyst._busy = True  # still at work: the photo, without waiting
    assert np.array_equal(shown(editor._repr_mimebundle_()), scene.photo.preview(480))


def test_a_snapshot_is_saved_whole_at_its_size(scene, tmp_path):
    editor = SunEditor(scene).wait(60)
    path = editor.snapshot(48).save(tmp_path / "small.png")
    assert sw.open(path).size == (48, 32)
    for size in (0, -1, 2.5, True, "x"):
        with pytest.raises(ValueError, match="whole number above 0"):
            editor.snapshot(size)
