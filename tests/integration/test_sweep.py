import importlib
import subprocess
import threading
from types import SimpleNamespace

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image, ImageSequence

from sunwidget.analysis.hints import Hints
from sunwidget.edit.table import Edit
from sunwidget.film import sweep as module
from sunwidget.film.sweep import sweep
from sunwidget.film.writer import film_size

UNMIXED = Hints(methods=(("clouds", "unmix"),))

# The package names a function of the same name.
RENDERER = importlib.import_module("sunwidget.renderer.offscreen")


@pytest.fixture
def scene(monkeypatch):
    """A scene whose frames are flat greys that follow the sun's elevation."""

    def flat(_scene, edit, size):
        rendered.append(edit.sun_elevation)
        level = int(np.clip(edit.sun_elevation * 4, 0, 255))
        return np.full((size[1], size[0], 3), level, np.uint8)

    rendered = []
    monkeypatch.setattr(RENDERER, "render", flat)
    return SimpleNamespace(
        automatic={"sun_azimuth": 10.0, "sun_elevation": 20.0},
        camera=SimpleNamespace(width=65, height=43),
        lit_by_moon=False,
        hints=UNMIXED,
        rendered=rendered,
    )


ENDS = [Edit(sun_elevation=60), Edit(sun_elevation=0)]


def probe(path):
    return subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(path)],
        check=False,
        capture_output=True,
        text=True,
    ).stderr


def test_mp4_is_h264_yuv420p_bt709_with_even_sides(scene, tmp_path):
    path = sweep(scene, ENDS, tmp_path / "film.mp4", frames=6, fps=12)
    words = probe(path)
    assert "Video: h264" in words
    assert "yuv420p(tv, bt709, progressive)" in words  # one name: matrix, primaries, transfer
    assert "64x42" in words
    assert "12 fps" in words


def test_another_program_reads_the_same_of_an_mp4(scene, tmp_path):
    media = pytest.importorskip("pymediainfo").MediaInfo
    if not media.can_parse():
        pytest.skip("MediaInfo's library is not on this machine")
    path = sweep(scene, ENDS, tmp_path / "film.mp4", seconds=0.5)
    track = media.parse(path).video_tracks[0]
    assert (track.format, track.chroma_subsampling, track.bit_depth) == ("AVC", "4:2:0", 8)
    assert (track.width, track.height, track.frame_count) == (64, 42, "12")
    assert float(track.frame_rate) == 24
    for tag in (track.matrix_coefficients, track.color_primaries, track.transfer_characteristics):
        assert tag == "BT.709"
    assert track.color_range == "Limited"
    # Players begin before all of it is there: the index stands before the frames.
    data = path.read_bytes()
    assert data.index(b"moov") < data.index(b"mdat")


def test_mp4_frames_keep_their_levels(scene, tmp_path):
    path = sweep(scene, ENDS, tmp_path / "film.mp4", frames=4)
    reader = imageio_ffmpeg.read_frames(str(path))
    next(reader)
    levels = [np.frombuffer(frame, np.uint8).mean() for frame in reader]
    # x264 at crf 18 and 8-bit limited-range YUV: two levels of 255.
    assert levels == pytest.approx([240, 160, 80, 0], abs=2)


def levels_of(path):
    with Image.open(path) as film:
        return [
            np.asarray(frame.convert("RGB")).mean() for frame in ImageSequence.Iterator(film)
        ], film.info


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_gif_and_webp_hold_every_frame_at_the_asked_size(scene, tmp_path, suffix):
    path = sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=5, fps=10, size=(31, 17))
    with Image.open(path) as film:
        film.load()
        assert film.size == (31, 17)
        assert film.n_frames == 5
        assert film.info["duration"] == 100
        assert film.info["loop"] == 0
    assert levels_of(path)[0] == pytest.approx([240, 180, 120, 60, 0], abs=2)


@pytest.mark.parametrize(("suffix", "once"), [(".gif", None), (".webp", 1)])
def test_a_film_can_stop_at_its_end(scene, tmp_path, suffix, once):
    path = sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=3, loop="once")
    with Image.open(path) as film:
        assert film.info.get("loop") == once


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_there_and_back_doubles_no_end_and_renders_no_frame_twice(scene, tmp_path, suffix):
    path = sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=4, loop="there_and_back")
    assert levels_of(path)[0] == pytest.approx([240, 160, 80, 0, 80, 160], abs=2)
    assert len(scene.rendered) == 4


def test_the_way_back_is_rendered_again_where_it_does_not_fit(scene, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_KEPT_BYTES", 65 * 43 * 3)
    path = sweep(scene, ENDS, tmp_path / "film.webp", frames=4, loop="there_and_back")
    assert levels_of(path)[0] == pytest.approx([240, 160, 80, 0, 80, 160], abs=2)
    assert len(scene.rendered) == 5


@pytest.mark.parametrize(("suffix", "unit"), [(".gif", 10), (".webp", 1)])
def test_no_frame_drifts_off_its_time(scene, tmp_path, suffix, unit):
    path = sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=25, fps=24, size=(8, 8))
    with Image.open(path) as film:
        spans = []
        for i in range(film.n_frames):
            film.seek(i)
            film.load()
            spans.append(film.info["duration"])
    assert abs(sum(spans) - 25000 / 24) <= unit
    assert max(spans) - min(spans) == unit


def test_frames_one_by_one_are_lossless_and_numbered_from_one(scene, tmp_path):
    folder = sweep(scene, ENDS, tmp_path / "frames" / "sun-%03d.png", frames=4)
    assert folder == tmp_path / "frames"
    names = sorted(path.name for path in folder.iterdir())
    assert names == ["sun-001.png", "sun-002.png", "sun-003.png", "sun-004.png"]
    assert [np.asarray(Image.open(folder / name)).mean() for name in names] == [240, 160, 80, 0]
    assert list(tmp_path.iterdir()) == [folder]


def test_a_sequence_is_replaced_as_a_whole_and_only_when_asked(scene, tmp_path):
    pattern = tmp_path / "%04d.png"
    sweep(scene, ENDS, pattern, frames=5)
    (tmp_path / "mine.png").write_bytes(b"mine")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(FileExistsError, match="0001.png exists already"):
        sweep(scene, ENDS[::-1], pattern, frames=3)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    sweep(scene, ENDS[::-1], pattern, frames=3, overwrite=True)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["0001.png", "0002.png", "0003.png", "mine.png"]
    assert np.asarray(Image.open(tmp_path / "0001.png")).max() == 0


def test_an_existing_film_is_kept_unless_overwrite_is_asked(scene, tmp_path):
    path = tmp_path / "film.gif"
    path.write_bytes(b"mine")
    with pytest.raises(FileExistsError, match="overwrite=True"):
        sweep(scene, ENDS, path, frames=2)
    assert path.read_bytes() == b"mine"
    sweep(scene, ENDS, path, frames=2, overwrite=True)
    assert path.read_bytes()[:3] == b"GIF"


@pytest.mark.parametrize("name", ["film.mp4", "film.gif", "film.webp", "film/%d.png"])
def test_cancelling_leaves_no_file_thread_or_process(scene, tmp_path, name, monkeypatch):
    def cancel(fraction, _message):
        if fraction > 0.5:
            raise KeyboardInterrupt

    before = {thread.name for thread in threading.enumerate()}
    encoders = []

    class Encoder(subprocess.Popen):
        def __init__(self, *arguments, **options):
            super().__init__(*arguments, **options)
            encoders.append(self)

    monkeypatch.setattr(subprocess, "Popen", Encoder)
    with pytest.raises(KeyboardInterrupt):
        sweep(scene, ENDS, tmp_path / name, frames=40, progress=cancel)
    assert list(tmp_path.iterdir()) == []
    assert len(scene.rendered) < 40
    assert {thread.name for thread in threading.enumerate()} <= before
    assert len(encoders) == (name == "film.mp4")
    assert all(encoder.poll() is not None for encoder in encoders)


@pytest.mark.parametrize("name", ["film.mp4", "film.gif", "film.webp", "film/%d.png"])
def test_a_frame_that_fails_is_that_error_and_leaves_no_file(scene, tmp_path, name, monkeypatch):
    good = RENDERER.render

    def render(scene, edit, size):
        if len(scene.rendered) == 5:
            raise RuntimeError("the context is lost")
        return good(scene, edit, size)

    monkeypatch.setattr(RENDERER, "render", render)
    with pytest.raises(RuntimeError, match="context is lost"):
        sweep(scene, ENDS, tmp_path / name, frames=8)
    assert list(tmp_path.iterdir()) == []


def test_progress_counts_the_frames_in_order_on_the_callers_thread(scene, tmp_path):
    told = []

    def progress(fraction, message):
        told.append((fraction, message, threading.current_thread()))

    sweep(scene, ENDS, tmp_path / "film.gif", frames=4, progress=progress)
    assert [fraction for fraction, _, _ in told] == [0.25, 0.5, 0.75, 1]
    assert told[1][1].startswith("frame 2 of 4")
    assert {thread for _, _, thread in told} == {threading.current_thread()}


def test_a_failing_encoder_is_an_error_and_leaves_no_file(scene, tmp_path, monkeypatch):
    broken = tmp_path / "ffmpeg"
    broken.write_text("#!/bin/sh\ncat >/dev/null\necho 'No space left on device' >&2\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setattr(imageio_ffmpeg, "get_ffmpeg_exe", lambda: str(broken))
    with pytest.raises(OSError, match="film.mp4 was not written: the disk is full"):
        sweep(scene, ENDS, tmp_path / "film.mp4", frames=3)
    assert list(tmp_path.iterdir()) == [broken]


def test_a_film_has_the_permissions_of_any_new_file(scene, tmp_path):
    plain = tmp_path / "plain"
    plain.touch()
    film = sweep(scene, ENDS, tmp_path / "film.gif", frames=2)
    assert film.stat().st_mode == plain.stat().st_mode


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"path": "film.avi"}, "must end in .mp4"),
        ({"path": "film"}, "must end in .mp4"),
        ({"fps": 0}, "fps"),
        ({"frames": 1}, "whole number"),
        ({"frames": 10, "seconds": 1}, "not both"),
        ({"seconds": 0}, "above 0"),
        ({"seconds": float("inf")}, "above 0"),
        ({"seconds": float("nan")}, "above 0"),
        ({"frames": 10**7}, "at most"),
        ({"size": (1, 100)}, "2 to 8192 pixels per side"),
        ({"size": "big"}, "width, height"),
        ({"edits": [Edit()]}, "two or more"),
        ({"edits": Edit()}, "not one Edit"),
        ({"easing": "bounce"}, "easing must be one of"),
        ({"loop": "sometimes"}, "loop must be one of"),
        ({"quality": 0}, "quality"),
        ({"path": "%d-%d.png"}, "Name single frames like"),
        ({"path": "%04d.jpg"}, "Name single frames like"),
    ],
)
def test_an_impossible_film_is_refused_before_rendering(scene, tmp_path, arguments, message):
    path = tmp_path / arguments.pop("path", "film.gif")
    edits = arguments.pop("edits", ENDS)
    with pytest.raises(ValueError, match=message):
        sweep(scene, edits, path, **arguments)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_named(scene, tmp_path):
    with pytest.raises(FileNotFoundError, match="no folder"):
        sweep(scene, ENDS, tmp_path / "nowhere" / "film.gif", frames=2)


def test_a_large_photo_makes_a_film_of_at_most_1920():
    assert film_size((6000, 4000), None) == (1920, 1280)
    assert film_size((1024, 698), None) == (1024, 698)


def test_a_gif_of_a_large_photo_is_small(scene, tmp_path):
    scene.camera = SimpleNamespace(width=1536, height=1024)
    with Image.open(sweep(scene, ENDS, tmp_path / "film.gif", frames=2)) as film:
        assert film.size == (720, 480)
