import frames_of_a_camera
import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.timelapses import timelapse as module
from sunwidget.timelapses.scenes import Trouble
from sunwidget.timelapses.timelapse import timelapse

MOVED = Edit(sun_elevation=4, sun_azimuth=-8)


@pytest.fixture
def frames(tmp_path, monkeypatch):
    """A folder with four PNG frames, the second of them broken; they are not analysed again."""
    folder = tmp_path / "frames"
    folder.mkdir()
    looked = frames_of_a_camera.film()
    for i, picture in enumerate(looked.frames[:4]):
        Image.fromarray(picture).save(folder / f"f{i}.png", dpi=(300, 300))
    (folder / "f1.png").write_bytes(b"no picture")

    def known(sources, **_options):
        trouble = Trouble(1, "f1.png", "it is no picture.")
        row = [trouble if i == 1 else looked.row[i] for i in range(len(sources))]

        class Known(list):
            size, troubles = looked.scenes.size, (trouble,)
            daylight = (1.0,) * len(sources)

        return Known(row)

    monkeypatch.setattr(module.FrameScenes, "of", known)
    return folder


def decoded(path):
    reader = imageio_ffmpeg.read_frames(str(path))
    width, height = next(reader)["size"]
    return [np.frombuffer(f, np.uint8).reshape(height, width, 3).astype(int) for f in reader]


def test_a_film_holds_a_broken_frame_and_tells(frames, tmp_path):
    seen = []
    with pytest.warns(PhotoWarning, match=r"1 of 4 frames .*f1\.png.*repeats the frame before it"):
        path = timelapse(
            frames, MOVED, tmp_path / "a.mp4", fps=5, progress=lambda f, _message: seen.append(f)
        )
    film = decoded(path)
    assert len(film) == 4
    assert film[0].shape == (128, 192, 3)
    assert np.abs(film[0] - film[1]).mean() < 1 < np.abs(film[0] - film[3]).mean()
    assert seen == sorted(seen)
    assert seen[-1] == 1


def test_a_broken_frame_can_be_left_out_or_stop_it(frames, tmp_path):
    with pytest.warns(PhotoWarning, match="left out"):
        path = timelapse(frames, MOVED, tmp_path / "a.webp", broken="skip", size=(96, 64))
    with Image.open(path) as film:
        assert (film.n_frames, film.size) == (3, (96, 64))
    with pytest.raises(PhotoError, match="f1.png.*broken='skip'"):
        timelapse(frames, MOVED, tmp_path / "b.mp4", broken="stop")
    assert not (tmp_path / "b.mp4").exists()


def test_stills_keep_names_metadata_and_where_nothing_moves_every_bit(frames, tmp_path):
    out = tmp_path / "stills"
    with pytest.warns(PhotoWarning, match="left out"):
        assert timelapse(frames, [Edit(), MOVED], out) == out
    assert sorted(path.name for path in out.iterdir()) == ["f0.png", "f2.png", "f3.png"]
    first, last = sw.open(out / "f0.png"), sw.open(out / "f3.png")
    assert np.array_equal(first.encoded, sw.open(frames / "f0.png").encoded)
    assert np.abs(last.encoded.astype(int) - sw.open(frames / "f3.png").encoded).mean() > 3
    assert last.recipe == MOVED
    # Two thirds of the way from the frame's own sun to the asked one.
    own = frames_of_a_camera.film().row[2].automatic["sun_elevation"]
    recipe = sw.open(out / "f2.png").recipe
    assert recipe.sun_elevation == pytest.approx(own + (4 - own) * 2 / 3, abs=0.01)
    with pytest.raises(FileExistsError, match="f0.png exists already"):
        timelapse(frames, MOVED, out)


def test_cancelling_leaves_nothing(frames, tmp_path):
    def stop(fraction, _message):
        if fraction > 0.5:
            raise KeyboardInterrupt

    with pytest.warns(PhotoWarning), pytest.raises(KeyboardInterrupt):
        timelapse(frames, MOVED, tmp_path / "a.mp4", progress=stop)
    assert [path.name for path in tmp_path.iterdir()] == ["frames"]


def test_at_night_the_sun_stays_where_it_is(frames, tmp_path, monkeypatch):
    of = module.FrameScenes.of

    def dark(sources, **options):
        scenes = of(sources, **options)
        type(scenes).daylight = (1.0, 1.0, 0.5, 0.0)
        return scenes

    monkeypatch.setattr(module.FrameScenes, "of", dark)
    with pytest.warns(PhotoWarning):
        out = timelapse(frames, MOVED, tmp_path / "stills")
    assert np.array_equal(sw.open(out / "f3.png").encoded, sw.open(frames / "f3.png").encoded)
    own = frames_of_a_camera.film().row[2].automatic["sun_elevation"]
    assert sw.open(out / "f2.png").recipe.sun_elevation == pytest.approx((own + 4) / 2, abs=0.01)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"fps": 0}, "fps"),
        ({"loop": "back"}, "loop"),
        ({"quality": 0}, "quality"),
        ({"broken": "mend"}, "broken"),
        ({"out": "a.avi"}, r"\.mp4"),
        ({"out": "stills", "format": "doc"}, "format="),
        ({"edit": "dusk_at_noon"}, "neither a recipe file nor a preset"),
        ({"edit": [Edit()]}, "two or more"),
        ({"easing": "bounce"}, "easing"),
        ({"times": "%Y"}, "does not match the pattern"),
    ],
)
def test_what_cannot_be_is_refused_before_any_work(tmp_path, options, words):
    for i in range(2):
        Image.fromarray(frames_of_a_camera.frame(i)).save(tmp_path / f"f{i}.png")
    called = []

    def counted(fraction, _message):
        called.append(fraction)

    options = {"edit": MOVED, "out": "a.gif"} | options
    edit, out = options.pop("edit"), tmp_path / options.pop("out")
    with pytest.raises(ValueError, match=words):
        timelapse(tmp_path, edit, out, progress=counted, **options)
    assert max(called, default=0) == 0
    assert len(list(tmp_path.iterdir())) == 2


def test_an_unknown_option_is_named_with_its_likeness(tmp_path):
    with pytest.raises(TypeError, match="no 'horizn'. Did you mean 'horizon'"):
        timelapse(tmp_path, MOVED, tmp_path / "a.gif", horizn=3)


@pytest.mark.filterwarnings("default")  # as outside of the tests
def test_the_command_line_makes_the_same_film(frames, tmp_path, capsys):
    from sunwidget.cli.main import main

    files = sorted(map(str, frames.iterdir()), reverse=True)
    out = tmp_path / "cli.gif"
    words = ["timelapse", *files, "-o", str(out), "--sun-elevation", "4", "--sun-azimuth", "-8"]
    assert main(words) == 0
    assert "f1.png" in capsys.readouterr().err
    with pytest.warns(PhotoWarning):
        same = timelapse(frames, MOVED, tmp_path / "same.gif")
    assert out.read_bytes() == same.read_bytes()
    assert main([*words, "--heading", "30"]) == 2
    assert "--place" in capsys.readouterr().err


@pytest.mark.filterwarnings("default")  # as outside of the tests
@pytest.mark.parametrize(("lost", "status"), [(2, 0), (3, 1)])
def test_the_command_line_fails_when_most_frames_cannot_be_used(
    frames, tmp_path, capsys, monkeypatch, lost, status
):
    from sunwidget.cli.main import main

    of = module.FrameScenes.of

    def broken(sources, **options):
        scenes = of(sources, **options)
        type(scenes).troubles *= lost
        return scenes

    monkeypatch.setattr(module.FrameScenes, "of", broken)
    out = tmp_path / "a.gif"
    words = ["timelapse", str(frames), "-o", str(out), "--sun-elevation", "4"]
    assert main(words) == status
    assert out.exists()
    said = capsys.readouterr().err
    assert f"{lost} of 4 frames cannot be used" in said
    assert (f"Most frames ({lost} of 4) could not be used" in said) == bool(status)
