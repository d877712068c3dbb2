import subprocess
from types import SimpleNamespace

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

from sunwidget.edit import Edit, EditError
from sunwidget.export import sweep as module
from sunwidget.export.sweep import between, film_edits, film_size, sweep

AUTOMATIC = {"sun_azimuth": 10.0, "sun_elevation": 20.0}


@pytest.fixture
def scene(monkeypatch):
    """A scene whose frames are flat greys that follow the sun's elevation."""

    def flat_frames(_scene, edits, size, progress):
        for done, edit in enumerate(edits, start=1):
            level = int(np.clip(edit.sun_elevation * 4, 0, 255))
            yield np.full((size[1], size[0], 3), level, np.uint8)
            if progress:
                progress(done / len(edits), "")

    monkeypatch.setattr(module, "_render", flat_frames)
    return SimpleNamespace(automatic=AUTOMATIC, camera=SimpleNamespace(width=65, height=43))


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
    assert "yuv420p(tv, bt709" in words
    assert "64x42" in words
    assert "12 fps" in words


def test_mp4_frames_keep_their_levels(scene, tmp_path):
    path = sweep(scene, ENDS, tmp_path / "film.mp4", frames=4)
    reader = imageio_ffmpeg.read_frames(str(path))
    next(reader)
    levels = [np.frombuffer(frame, np.uint8).mean() for frame in reader]
    # x264 at crf 18 and 8-bit limited-range YUV: two levels of 255.
    assert levels == pytest.approx([240, 160, 80, 0], abs=2)


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_gif_and_webp_hold_every_frame_at_the_asked_size(scene, tmp_path, suffix):
    path = sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=5, fps=10, size=(31, 17))
    with Image.open(path) as film:
        film.load()
        assert film.size == (31, 17)
        assert film.n_frames == 5
        assert film.info["duration"] == 100


def test_an_existing_film_is_kept_unless_overwrite_is_asked(scene, tmp_path):
    path = tmp_path / "film.gif"
    path.write_bytes(b"mine")
    with pytest.raises(FileExistsError, match="overwrite=True"):
        sweep(scene, ENDS, path, frames=2)
    assert path.read_bytes() == b"mine"
    sweep(scene, ENDS, path, frames=2, overwrite=True)
    assert path.read_bytes()[:3] == b"GIF"


@pytest.mark.parametrize("suffix", [".mp4", ".gif", ".webp"])
def test_cancelling_leaves_no_file(scene, tmp_path, suffix):
    def cancel(fraction, _message):
        if fraction > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(scene, ENDS, tmp_path / f"film{suffix}", frames=8, progress=cancel)
    assert list(tmp_path.iterdir()) == []


def test_a_failing_encoder_is_an_error_and_leaves_no_file(scene, tmp_path, monkeypatch):
    broken = tmp_path / "ffmpeg"
    broken.write_text("#!/bin/sh\ncat >/dev/null\necho 'No space left on device' >&2\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setattr(imageio_ffmpeg, "get_ffmpeg_exe", lambda: str(broken))
    with pytest.raises(OSError, match="No space left"):
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
        ({"path": "film.avi"}, "ends in .mp4"),
        ({"path": "film"}, "ends in .mp4"),
        ({"fps": 0}, "fps"),
        ({"frames": 1}, "whole number"),
        ({"size": (1, 100)}, "not possible"),
        ({"edits": [Edit()]}, "two or more"),
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


def test_a_path_visits_every_edit_and_keeps_its_ends():
    corners = [Edit(sun_elevation=10), Edit(sun_elevation=40), Edit(sun_elevation=0)]
    row = [edit.sun_elevation for edit in film_edits(corners, 5, 24, AUTOMATIC)]
    assert row == [10, 25, 40, 20, 0]


def test_a_list_of_edits_is_one_frame_each():
    corners = [Edit(sun_elevation=e) for e in (10, 40, 0)]
    assert film_edits(corners, None, 24, AUTOMATIC) == corners


def test_two_edits_become_five_seconds():
    assert len(film_edits(ENDS, None, 24, AUTOMATIC)) == 120


def test_an_automatic_end_stands_for_what_the_analysis_found():
    half = between(Edit(), Edit(sun_elevation=0), 0.5, AUTOMATIC)
    assert half.sun_elevation == 10
    assert half.sun_azimuth is None


def test_azimuth_takes_the_shorter_way_round():
    half = between(Edit(sun_azimuth=170), Edit(sun_azimuth=-160), 0.5, AUTOMATIC)
    assert half.sun_azimuth == pytest.approx(-175)


def test_ends_with_two_methods_are_refused():
    with pytest.raises(EditError, match="same method"):
        between(Edit(), Edit(method="thesis"), 0.5, AUTOMATIC)


def test_a_large_photo_makes_a_film_of_at_most_1920():
    assert film_size((6000, 4000), None) == (1920, 1280)
    assert film_size((1024, 698), None) == (1024, 698)
