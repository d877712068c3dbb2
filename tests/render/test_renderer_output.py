"""What ``render`` returns: bands, threads, sizes, depths and errors."""

import importlib
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo, known_scene

from sunwidget.edit.table import METHODS, Edit
from sunwidget.errors import EditError
from sunwidget.renderer import graph as graph_module
from sunwidget.renderer import render, render_pass
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.values import states, uniform_value

module = importlib.import_module("sunwidget.renderer.offscreen")
MOVED = Edit(sun_azimuth=-12, sun_elevation=4)


def test_a_context_exists_and_the_picture_is_not_flat():
    assert on_gl_thread(lambda context: context.version_code) >= 330
    assert render(known_scene(), MOVED).std() > 10


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_bands_join_without_a_seam_to_the_bit(monkeypatch, method, dtype):
    scene = known_scene()
    whole = render(scene, MOVED, method=method, dtype=dtype)
    # 12 rows a band do not divide 80: the last band is smaller.
    monkeypatch.setattr(module, "_BAND_PIXELS", 12 * scene.width)
    assert np.array_equal(render(scene, MOVED, method=method, dtype=dtype), whole)


def test_bands_report_progress_up_to_one_and_can_be_cancelled(monkeypatch):
    scene = known_scene()
    whole = render(scene, MOVED)
    monkeypatch.setattr(module, "_BAND_PIXELS", 12 * scene.width)
    seen = []
    render(scene, MOVED, progress=lambda fraction, message: seen.append((fraction, message)))
    fractions = [fraction for fraction, _ in seen]
    assert len(fractions) >= 6
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1
    assert all(message for _, message in seen)

    class CancelledError(Exception):
        pass

    def cancel(fraction, message):
        raise CancelledError

    with pytest.raises(CancelledError):
        render(scene, MOVED, progress=cancel)
    assert np.array_equal(render(scene, MOVED), whole)


def test_several_threads_draw_what_one_does():
    scenes = [known_scene(), known_photo(sun=(-9.0, 7.0), size=(96, 64)).analyze()]
    jobs = [(scene, Edit(sun_elevation=e)) for e in (2, 9, 30) for scene in scenes]
    alone = [render(*job) for job in jobs]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda job: render(*job), jobs * 2))
    assert all(np.array_equal(a, b) for a, b in zip(alone * 2, together, strict=True))


@pytest.mark.parametrize("size", [(60, 40), (131, 77), (240, 160), (1, 1), (1, 9)])
def test_size_is_width_and_height(size):
    picture = render(known_scene(), MOVED, size=size)
    assert picture.shape == (size[1], size[0], 3)
    assert picture.dtype == np.uint8


def test_an_unmoved_sun_at_half_the_size_is_the_photo_averaged_in_light():
    scene = known_scene()
    half = cv2.resize(scene.photo.pixels, (60, 40), interpolation=cv2.INTER_AREA)
    assert np.array_equal(render(scene, size=(60, 40), dtype="float32"), half)


def test_a_smaller_picture_is_the_large_one_shrunk():
    # The edit is nearly linear in light, except at edges of the matte and in the disc.
    scene = known_scene()
    large = render(scene, MOVED, dtype="float32")
    small = render(scene, MOVED, dtype="float32", size=(60, 40))
    shrunk = cv2.resize(large, (60, 40), interpolation=cv2.INTER_AREA)
    assert np.median(np.abs(small - shrunk)) < 0.002


def test_uint8_and_uint16_are_the_encoded_float_picture():
    scene = known_scene()
    light = np.clip(render(scene, MOVED, dtype="float32"), 0, 1)
    code = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    # Half a level of rounding and half a level of dither; half a step for the float32 pow().
    assert np.abs(render(scene, MOVED) - code * 255).max() <= 1.01
    assert np.abs(render(scene, MOVED, dtype="uint16") - code * 65535).max() <= 1.5


def test_dither_is_the_same_at_every_call():
    scene = known_scene()
    first = render(scene, MOVED)
    render(scene, Edit(sun_elevation=40))
    assert np.array_equal(render(scene, MOVED), first)


def test_method_of_the_call_wins_over_that_of_the_edit():
    scene = known_scene()
    edit = MOVED.replace(method="thesis_literal")
    assert np.array_equal(render(scene, edit, method="ratio"), render(scene, MOVED))


def test_an_unknown_dtype_is_an_error_that_names_the_three():
    with pytest.raises(EditError, match="'uint8', 'uint16' or 'float32', not 'float64'"):
        render(known_scene(), dtype="float64")


@pytest.mark.parametrize("size", [(0, 10), (10,), "12", (10, -1), 7, (None, 3), (60.7, 40)])
def test_an_impossible_size_is_an_error(size):
    with pytest.raises(EditError, match="size must be"):
        render(known_scene(), size=size)


def test_an_unknown_method_is_an_error_that_lists_them():
    with pytest.raises(EditError, match="ratio, thesis, thesis_literal"):
        render(known_scene(), method="magic")


def test_an_unknown_pass_is_an_error_that_names_it():
    with pytest.raises(KeyError, match="no_such_pass"):
        render_pass(known_scene(), Edit(), "no_such_pass")


def test_a_pass_of_another_method_is_an_error_that_names_both():
    with pytest.raises(KeyError, match="meter_edit.*thesis"):
        render_pass(known_scene(), Edit(method="thesis"), "meter_edit")


def test_a_texture_beyond_the_limit_is_an_error_that_names_the_limit():
    limit = on_gl_thread(lambda context: context.info["GL_MAX_TEXTURE_SIZE"])

    def task(context):
        image = np.zeros((1, limit + 1, 3), np.uint8)
        graph_module.FrameGraph(graph_module.Programs(context), {"photo": image})

    with pytest.raises(ValueError, match=f"{limit + 1}×1 .* limit of {limit} pixels"):
        on_gl_thread(task)


def test_a_shader_that_does_not_compile_is_named(monkeypatch):
    monkeypatch.setattr(graph_module, "resolve_includes", lambda path: "void main() { oops; }")

    def task(context):
        graph_module.Programs(context).get("broken_pass")

    with pytest.raises(RuntimeError, match=r"'broken_pass' does not compile:[\s\S]*oops"):
        on_gl_thread(task)


def test_a_uniform_without_a_value_is_an_error_that_names_shader_and_uniform():
    with pytest.raises(KeyError, match="'sky' declares uniform 'nonsense'"):
        uniform_value("sky", "nonsense", {"other": 1.0})


def test_source_names_hold_the_found_value_in_either_state():
    tables = states(Edit(sun_elevation=3), known_scene().automatic)
    found = known_scene().automatic["sun_elevation"]
    assert tables["source"]["sun_elevation"] == found
    assert tables["edit"]["sun_elevation"] == 3
    assert tables["source"]["source_sun_elevation"] == found
    assert tables["edit"]["source_sun_elevation"] == found


def test_an_error_on_the_gl_thread_reaches_the_caller_and_leaves_the_thread_working():
    with pytest.raises(ZeroDivisionError):
        on_gl_thread(lambda context: 1 / 0)
    assert on_gl_thread(lambda context: on_gl_thread(lambda inner: inner is context))
