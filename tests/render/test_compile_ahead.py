"""A first frame whose shaders several processes compile."""

import io
import json
import sys

import numpy as np
import pytest
from relight_scenes import known_scene

from sunwidget import Edit
from sunwidget.renderer import compile_ahead, offscreen
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.values import drawn_for, states

SIZE = (48, 32)
EDIT = Edit(sun_elevation=5)


def frame_of(scene):
    values = states(EDIT, scene.automatic)
    asked = drawn_for("ratio", values["edit"])
    host = offscreen._host_values(SIZE, "uint8")
    return (values, offscreen._scene_values(scene), host, (0, 0, *SIZE), asked)


def graph_of(scene, context):
    return FrameGraph(Programs(context), offscreen.scene_textures(scene, SIZE))


@pytest.fixture
def started(monkeypatch):
    """Take helpers' work instead of starting them, on a machine of four cores."""
    works = []

    class Process:
        killed = False

        def kill(self):
            self.killed = True

        def wait(self):
            assert self.killed

    monkeypatch.setattr(
        compile_ahead, "_start", lambda work: works.append((work, Process())) or works[-1][1]
    )
    monkeypatch.setattr("os.cpu_count", lambda: 4)
    return works


def first_frame():
    scene = known_scene()

    def task(context):
        if "llvmpipe" not in context.info["GL_RENDERER"]:
            pytest.skip("a graphics card draws here")
        graph = graph_of(scene, context)
        for _ in range(2):
            with compile_ahead.helped(graph, frame_of(scene)):
                graph.run(*frame_of(scene))
        return {name: graph.runs[name] for name in ("columns_source", "frame")}

    return on_gl_thread(task)


def test_slow_first_pass_starts_helpers_once_and_ends_them(started, monkeypatch):
    monkeypatch.setattr(compile_ahead, "COMPILED", 0.0)
    assert first_frame() == {"columns_source": 1, "frame": 1}
    assert [(w["part"], w["parts"]) for w, _ in started] == [(0, 3), (1, 3), (2, 3)]
    assert all(process.killed for _, process in started)


@pytest.mark.parametrize("why", ["compiled", "one core"])
def test_no_helper_where_it_would_not_help(why, started, monkeypatch):
    monkeypatch.setattr(compile_ahead, "COMPILED", 60.0 if why == "compiled" else 0.0)
    if why == "one core":
        monkeypatch.setattr("os.cpu_count", lambda: 1)
    assert first_frame() == {"columns_source": 1, "frame": 1}
    assert not started


@pytest.mark.parametrize("fails", ["start", "pipe"])
def test_a_helper_that_fails_is_missed_by_nobody(fails, monkeypatch):
    class Process:
        def __init__(self, *_arguments, **_options):
            if fails == "start":
                raise BlockingIOError("no more processes")
            self.stdin = self

        def write(self, text):
            work = json.loads(text)
            assert work["frame"][1]["photo_key"] == 0.5
            raise BrokenPipeError

        def kill(self):
            pass

        wait = kill

    monkeypatch.setattr(compile_ahead, "COMPILED", 0.0)
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    monkeypatch.setattr("subprocess.Popen", Process)
    known = offscreen._scene_values
    monkeypatch.setattr(
        offscreen, "_scene_values", lambda scene: {**known(scene), "photo_key": np.float32(0.5)}
    )
    assert first_frame() == {"columns_source": 1, "frame": 1}


def test_helpers_draw_every_pass_once_on_black_inputs(started, monkeypatch):
    monkeypatch.setattr(compile_ahead, "COMPILED", 0.0)
    first_frame()
    runs = []
    for work, _ in started:
        monkeypatch.setattr(sys, "stdin", io.StringIO(json.dumps(work, default=list)))
        drawn = []
        monkeypatch.setattr(
            FrameGraph, "_run_pass", lambda _self, row, *_rest, into=drawn: into.append(row["name"])
        )
        compile_ahead.main()
        runs.append(drawn)
    scene = known_scene()
    wanted = on_gl_thread(
        lambda context: [
            row["name"] for row in graph_of(scene, context)._wanted(frame_of(scene)[-1])
        ]
    )
    assert runs[0][0] == "frame"
    assert sorted(name for drawn in runs for name in drawn) == sorted(wanted)


def test_a_picture_is_the_same_after_compiling_backwards():
    scene = known_scene()

    def task(context):
        pictures = []
        for backwards in (False, True):
            graph = graph_of(scene, context)
            if backwards:
                graph.compile(frame_of(scene), 0, 1)
            graph.run(*frame_of(scene))
            pictures.append(graph.targets["frame"].framebuffer.read(components=3))
        return pictures

    straight, after = (np.frombuffer(p, np.uint8) for p in on_gl_thread(task))
    assert np.array_equal(straight, after)
    assert straight.std() > 5
