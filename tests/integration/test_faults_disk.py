"""Disks that fill up, folders that close or go, commands that are ended: never half a file.

The limit of a process on the size of its files stands for the disk: the system itself refuses the
byte beyond it, to whichever library writes.
"""

import contextlib
import errno
import os
import shutil
import signal

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.cli.main import main
from sunwidget.export.maps import save_maps
from sunwidget.files import NotWrittenError, folder_target, target
from sunwidget.film.writer import film_target, whole_sequence

resource = pytest.importorskip("resource", reason="only Unix limits the size of files")

ENDS = [sw.Edit(), sw.Edit(sun_elevation=3)]
ROOM = 2000  # bytes: less than any of the files below


def still(name, **options):
    return lambda scene, folder: sw.save((scene, ENDS[1]), folder / name, overwrite=True, **options)


def film(name):
    return lambda scene, folder: sw.sweep(
        scene, ENDS, folder / name, frames=4, quality=100, overwrite=True
    )


def around(name):
    return lambda scene, folder: sw.environment_map(
        scene, None, folder / name, size=(64, 32), overwrite=True
    )


WRITERS = {
    "PNG": still("x.png"),
    "JPEG": still("x.jpg"),
    "TIFF": still("x.tif"),
    "WebP": still("x.webp"),
    "OpenEXR": still("x.exr"),
    "Radiance": still("x.hdr"),
    "layers": still("x.png", layers=True),
    "MP4": film("x.mp4"),
    "GIF": film("x.gif"),
    "moving WebP": film("x.webp"),
    "frames": film("%04d.png"),
    "frames in a new folder": film("new/%04d.png"),
    "page": lambda scene, folder: sw.to_html(scene, None, folder / "x.html", overwrite=True),
    "sheet": lambda scene, folder: sw.contact_sheet(
        scene, ENDS, folder / "x.png", frames=2, overwrite=True
    ),
    "environment as Radiance": around("x.hdr"),
    "environment as OpenEXR": around("x.exr"),
    "maps": lambda scene, folder: save_maps(scene, folder, overwrite=True),
}
THERE = ("x.png", "x.tif", "x.gif", "x.mp4", "x.html", "x.exr", "x.sky.png", "0002.png", "sky.png")


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    noise = np.random.default_rng(0).integers(0, 255, (48, 64, 3), np.uint8)
    scene = sw.analyze(noise)
    # The driver keeps compiled shaders in files, which must have their room.
    sw.render(scene, ENDS[1])
    sw.render(scene, ENDS[1], dtype="float32")
    sw.environment_map(scene, None, tmp_path_factory.mktemp("warm") / "x.hdr", size=(8, 4))
    return scene


@contextlib.contextmanager
def little_room(size=ROOM):
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def contents(folder):
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize("write", WRITERS.values(), ids=WRITERS)
def test_without_room_no_writer_leaves_half_a_file_or_touches_one(scene, tmp_path, write):
    for name in THERE:
        (tmp_path / name).write_bytes(b"mine")
    before = contents(tmp_path)
    said = r"not written|could not write|could not encode .* space"
    with little_room(), pytest.raises((OSError, sw.PhotoError), match=said):
        write(scene, tmp_path)
    assert contents(tmp_path) == before
    assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("name", ["x.gif", "%04d.png"])
def test_a_folder_that_goes_while_a_film_is_made_is_named(scene, tmp_path, name):
    folder = tmp_path / "films"
    folder.mkdir()

    def progress(_fraction, _message):
        shutil.rmtree(folder, ignore_errors=True)

    with pytest.raises(NotWrittenError, match=r"was not written: the folder no longer exists"):
        sw.sweep(scene, ENDS, folder / name, frames=2, progress=progress)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        ("x" * 300 + ".png", "too long"),
        ("a\0b.png", "null"),
        ("\ud800.png", "surrogates"),
        (None, "not NoneType"),
        (3.5, "not float"),
        ("~nobody-of-this-name/x.png", "home"),
    ],
)
def test_what_no_file_can_be_called_is_refused_before_any_work(path, reason):
    for ask in (lambda: target(path, overwrite=True), lambda: sw.save(None, path)):
        with pytest.raises(NotWrittenError, match=rf"No file can have the name .*{reason}"):
            ask()
    with pytest.raises(NotWrittenError, match=reason):
        folder_target(path)


def test_a_folder_that_may_not_be_written_to_is_named_before_any_work(tmp_path, monkeypatch):
    # Whoever runs the tests may be root, for whom every folder is open.
    monkeypatch.setattr("os.access", lambda path, _mode: str(path) != str(tmp_path))
    for ask in (
        lambda: sw.save(None, tmp_path / "x.png"),
        lambda: sw.sweep(None, None, tmp_path / "x.gif"),
        lambda: folder_target(tmp_path / "new"),
    ):
        with pytest.raises(
            (NotWrittenError, sw.AnalysisError), match=r"not writable|no access|Scene"
        ):
            ask()


@pytest.mark.parametrize("ask", [lambda path: target(path, overwrite=True), folder_target])
def test_a_folder_that_may_not_be_entered_is_named_as_a_person_writes_it(
    tmp_path, monkeypatch, ask
):
    def stat(path, **_options):
        raise PermissionError(errno.EACCES, "Permission denied", str(path))

    closed = tmp_path / "closed"
    monkeypatch.setattr("os.access", lambda path, _mode: not str(path).startswith(str(closed)))
    monkeypatch.setattr("pathlib.Path.stat", stat)
    with pytest.raises(NotWrittenError) as refused:
        ask(closed / "inner" / "a.png")
    assert str(refused.value) == (
        f"{closed / 'inner' / 'a.png'} cannot be written: you have no access to the folder "
        f"{closed}. Choose another one."
    )


def test_a_folder_with_the_name_of_a_frame_is_refused_and_kept(tmp_path):
    (tmp_path / "0001.png").mkdir()
    with pytest.raises(IsADirectoryError, match=r"0001\.png is a folder"):
        film_target(tmp_path / "%04d.png", overwrite=True)
    with (
        pytest.raises(IsADirectoryError),
        whole_sequence(tmp_path / "%04d.png", overwrite=True) as unfinished,
    ):
        (unfinished / "1.png").write_bytes(b"frame")
    assert [p.name for p in tmp_path.iterdir()] == ["0001.png"]


@pytest.fixture
def interruptible():
    """Signals as at a terminal: a shell's background and nohup start what they run without some."""
    at_a_terminal = {
        signal.SIGINT: signal.default_int_handler,
        signal.SIGTERM: signal.SIG_DFL,
        signal.SIGHUP: signal.SIG_DFL,
    }
    before = {number: signal.signal(number, at_a_terminal[number]) for number in at_a_terminal}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize(("number", "status"), [("SIGTERM", 143), ("SIGHUP", 129), ("SIGINT", 130)])
@pytest.mark.parametrize("name", ["x.mp4", "new/%04d.png"])
def test_a_command_that_is_ended_leaves_no_film(
    scene, tmp_path, monkeypatch, capsys, number, status, name
):
    def ending(frames, _count, _progress):
        yield next(frames)
        os.kill(os.getpid(), getattr(signal, number))
        yield from frames

    monkeypatch.setattr("sunwidget.cli.sweep.scene_to_draw", lambda _options: scene)
    monkeypatch.setattr("sunwidget.film.sweep.with_progress", ending)
    path = tmp_path / name
    flags = ["--to-sun-elevation", "3", "--frames", "9"]
    assert main(["sweep", "x.jpg", "-o", str(path), *flags]) == status
    assert "no half-written file was left" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
