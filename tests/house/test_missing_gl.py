"""Without EGL or a driver, sunwidget says what is missing and what to install."""

import importlib
import os
import platform
import subprocess
import sys
import types
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.cli.main import main
from sunwidget.renderer import gl_thread
from sunwidget.renderer.missing_gl import explain

DEBIAN = "apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri"

# Where the loader and Mesa look, led astray: what a machine without them does.
HIDDEN = {
    "loader": ({"GLCONTEXT_LINUX_LIBEGL": "libEGL.so.absent"}, "OpenGL libraries are missing"),
    "driver": ({"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}, "no driver behind it"),
    "version": ({"MESA_GL_VERSION_OVERRIDE": "2.1"}, "less than OpenGL 3.3"),
}


def hiding(what, *arguments):
    """Run Python in a process of its own, from which ``what`` is hidden."""
    return subprocess.run(
        [sys.executable, *arguments],
        env={**os.environ, **HIDDEN[what][0]},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.fixture
def on(monkeypatch):
    """Pretend another system: its os-release, and variables of the environment."""

    def pretend(release=None, **variables):
        for name in ("COLAB_RELEASE_TAG", "KAGGLE_KERNEL_RUN_TYPE", "CONDA_PREFIX"):
            monkeypatch.delenv(name, raising=False)
        for name, value in variables.items():
            monkeypatch.setenv(name, value)

        def about():
            if release is None:
                raise OSError
            return release

        monkeypatch.setattr(platform, "freedesktop_os_release", about)
        monkeypatch.setattr(sys, "platform", "linux")

    return pretend


@pytest.mark.parametrize("hidden", HIDDEN)
def test_a_machine_without_it_is_told_what_to_install(hidden):
    code = "import sunwidget as sw; from sunwidget.renderer.gl_thread import on_gl_thread as run\n"
    code += "try: run(print)\nexcept sw.RendererError as error: print(error)"
    done = hiding(hidden, "-c", code)
    assert HIDDEN[hidden][1] in done.stdout
    assert "nstall as root" in done.stdout
    assert "Traceback" not in done.stderr


def test_the_doctor_names_the_package_and_goes_on_looking():
    done = hiding("driver", "-m", "sunwidget", "doctor")
    lines = done.stdout.splitlines()
    [at] = [i for i, line in enumerate(lines) if line.startswith("MISSING EGL")]
    assert "no driver behind it" in lines[at]
    assert "install" in lines[at + 1]
    assert any(line.startswith("ok      sky network") for line in lines[at:])
    assert done.returncode == 1
    assert not done.stderr


@pytest.mark.parametrize(
    ("release", "command"),
    [
        ({"ID": "debian"}, DEBIAN),
        ({"ID": "linuxmint", "ID_LIKE": "ubuntu debian"}, DEBIAN),
        ({"ID": "fedora"}, "dnf install mesa-libEGL mesa-libGL mesa-dri-drivers"),
        ({"ID": "rocky", "ID_LIKE": "rhel centos fedora"}, "dnf install mesa-libEGL"),
        ({"ID": "alpine"}, "apk add mesa-egl mesa-gl mesa-dri-gallium"),
    ],
)
def test_the_command_is_that_of_the_system(on, release, command):
    on(release)
    said = explain(Exception("libEGL.so not loaded"))
    assert command in said
    assert sum(tool in said for tool in ("apt-get", "dnf", "apk")) == 1


def test_an_unknown_system_is_told_all_of_them(on):
    on({"ID": "plan9"})
    unknown = explain(Exception("libEGL.so not loaded"))
    assert all(tool in unknown for tool in ("apt-get", "dnf", "apk"))
    on(None)  # no os-release at all
    assert explain(Exception("libEGL.so not loaded")) == unknown


@pytest.mark.parametrize("service", ["COLAB_RELEASE_TAG", "KAGGLE_KERNEL_RUN_TYPE"])
def test_a_hosted_notebook_is_told_a_cell(on, service):
    on({"ID": "ubuntu"}, **{service: "x"})
    said = explain(Exception("requested device index 0, but found 0 devices"))
    assert f"!apt-get update && {DEBIAN.replace('install', 'install -y')}" in said


def test_conda_is_told_that_the_driver_is_the_systems(on):
    on({"ID": "ubuntu"}, CONDA_PREFIX="/opt/conda")
    assert "conda's libegl and libgl" in explain(Exception("found 0 devices"))


def test_a_broken_package_is_not_taken_for_a_missing_driver():
    said = explain(ImportError("cannot import name 'egl'"))
    assert "pip install --force-reinstall moderngl" in said
    assert "apt-get" not in said


class ContextError(Exception):
    """glcontext's own are bare."""


class Cards:
    """Stands for moderngl on a machine with several cards, of which some refuse."""

    def __init__(self, *refusals):
        self.refusals = refusals
        self.asked = []
        self.released = []

    def create_context(self, *, device_index=None, **options):
        self.asked.append(device_index)
        if device_index is not None and device_index >= len(self.refusals):
            raise ContextError(
                f"requested device index {device_index}, but found {len(self.refusals)} devices"
            )
        refusal = self.refusals[device_index or 0]
        if refusal:
            raise ContextError(refusal)
        return types.SimpleNamespace(
            device=device_index, options=options, release=lambda: self.released.append(device_index)
        )


@pytest.fixture
def cards(monkeypatch):
    def install(*refusals, poor=()):
        machine = Cards(*refusals)
        monkeypatch.setitem(sys.modules, "moderngl", machine)
        monkeypatch.delenv("GLCONTEXT_DEVICE_INDEX", raising=False)
        monkeypatch.setattr(gl_thread, "_draws_floats", lambda context: context.device not in poor)
        return machine

    return install


def test_a_card_that_refuses_is_passed_over(cards):
    cards("eglInitialize failed (0x3001)", "")
    assert gl_thread._new_context().device == 1


def test_the_first_refusal_is_the_one_that_is_told(cards):
    machine = cards("eglInitialize failed (0x3001)", "eglCreateContext failed (0x3009)")
    with pytest.raises(ContextError, match="0x3001"):
        gl_thread._new_context()
    assert machine.asked == [0, 1, 2]


def test_a_card_that_a_person_chose_is_not_passed_over(cards, monkeypatch):
    machine = cards("eglInitialize failed (0x3001)", "")
    monkeypatch.setenv("GLCONTEXT_DEVICE_INDEX", "0")
    with pytest.raises(ContextError, match="0x3001"):
        gl_thread._new_context()
    assert machine.asked == [0]


def test_a_library_that_lacks_everything_ends_the_search(cards):
    machine = cards(*["eglInitialize not found"] * 100)
    with pytest.raises(ContextError, match="not found"):
        gl_thread._new_context()
    assert len(machine.asked) < 20


def test_elsewhere_than_on_linux_the_systems_own_way_is_taken(cards, monkeypatch):
    cards("")
    monkeypatch.setattr(sys, "platform", "darwin")
    assert "backend" not in gl_thread._new_context().options


def test_a_card_without_float_targets_is_passed_over_and_told(cards):
    machine = cards("", "", poor=(0,))
    assert gl_thread._new_context().device == 1
    assert machine.released == [0]
    cards("", poor=(0,))
    with pytest.raises(RuntimeError, match="no float targets") as caught:
        gl_thread._new_context()
    assert "cannot draw into float textures" in explain(caught.value)
    assert "LIBGL_ALWAYS_SOFTWARE=1" in explain(caught.value)


# --- a driver that fails after it began ------------------------------------------------


@pytest.fixture
def own_thread(monkeypatch):
    """A GL thread of the test's own, so that the others keep their contexts."""
    monkeypatch.setattr(gl_thread, "_worker", None)
    yield
    if gl_thread._worker is not None:
        gl_thread._worker.pool.shutdown()


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(np.random.default_rng(0).integers(0, 255, (24, 36, 3), np.uint8))


def failing(monkeypatch, *codes):
    """Let OpenGL say these after the next tasks, and then nothing."""
    said = iter(codes)
    monkeypatch.setattr(gl_thread, "_error_of", lambda _context: next(said, "GL_NO_ERROR"))


def test_a_lost_context_is_made_anew_within_a_picture(own_thread, scene, monkeypatch):
    render = importlib.import_module("sunwidget.renderer.offscreen")
    monkeypatch.setattr(render, "_BAND_PIXELS", 36 * 8)  # three strips
    edit = sw.Edit(sun_elevation=3)
    whole = sw.render(scene, edit)
    failing(monkeypatch, "GL_NO_ERROR", "GL_NO_ERROR", "GL_UNKNOWN_ERROR")
    assert np.array_equal(sw.render(scene, edit), whole)
    assert len(render._renderers) == 1


def test_an_opengl_that_goes_on_failing_is_an_error_and_the_next_picture_is_whole(
    own_thread, scene, monkeypatch
):
    whole = sw.render(scene)
    failing(monkeypatch, "GL_OUT_OF_MEMORY", "GL_OUT_OF_MEMORY")
    with pytest.raises(
        sw.RendererError, match=r"failed twice while drawing.*OUT_OF_MEMORY.*SOFTWARE"
    ):
        sw.render(scene)
    assert np.array_equal(sw.render(scene), whole)


def test_what_a_task_raises_itself_is_raised_once(own_thread):
    told = []

    def task(_context):
        told.append(1)
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        gl_thread.on_gl_thread(task)
    assert told == [1]


def test_threads_share_one_context(own_thread, scene):
    whole = sw.render(scene)
    with ThreadPoolExecutor(8) as pool:
        pictures = list(pool.map(lambda _: sw.render(scene), range(16)))
    assert all(np.array_equal(picture, whole) for picture in pictures)


@pytest.fixture
def none(monkeypatch, own_thread):
    """No OpenGL at all."""

    def refuse():
        raise ContextError("requested device index 0, but found 0 devices")

    monkeypatch.setattr(gl_thread, "_new_context", refuse)


@pytest.mark.parametrize(
    "command",
    [
        ["render", "sample:coast", "-o", "x.png"],
        ["sweep", "sample:coast", "-o", "x.gif", "--to-sun-elevation", "3"],
        ["timelapse", "a.png", "b.png", "-o", "x.gif"],
        ["demo", "-o", "x"],
    ],
    ids=lambda command: command[0],
)
def test_a_command_that_draws_says_so_before_it_looks_at_a_photo(
    none, tmp_path, monkeypatch, capsys, command
):
    monkeypatch.chdir(tmp_path)
    for name in ("a.png", "b.png"):
        (tmp_path / name).write_bytes(b"never opened")
    monkeypatch.setattr(sw, "analyze", None)
    assert main(command) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "no driver behind it" in line
    assert not (tmp_path / "x").exists()


def test_without_opengl_photos_are_opened_analysed_edited_and_written_as_pages(none, tmp_path):
    scene = sw.analyze(np.full((24, 36, 3), 120, np.uint8))
    editor = sw.SunEditor(scene, sun_elevation=3).wait(60)
    assert editor.edit == sw.Edit(sun_elevation=3)
    assert editor.to_html(tmp_path / "x.html").stat().st_size > 10_000
    with pytest.raises(sw.RendererError, match="doctor"):
        editor.save(tmp_path / "x.png")
    assert [p.name for p in tmp_path.iterdir()] == ["x.html"]


def test_without_moderngl_the_renderer_says_what_to_install(own_thread, scene, monkeypatch):
    monkeypatch.setitem(sys.modules, "moderngl", None)
    with pytest.raises(sw.RendererError, match="pip install --force-reinstall moderngl"):
        sw.render(scene)
