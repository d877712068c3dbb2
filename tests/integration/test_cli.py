import contextlib
import inspect
import io
import json
import re
import subprocess
import sys
import types

import numpy as np
import onnx_files as onnx
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis import notices
from sunwidget.cli import main as cli
from sunwidget.cli.edit_options import edit_of_flags
from sunwidget.cli.main import main
from sunwidget.cli.photo_options import flag, methods_of_stages, scene_of
from sunwidget.edit.table import NUMBERS, PARAMETERS, Edit


@pytest.fixture(scope="module")
def photo(tmp_path_factory):
    """A small copy of a sample, so that every command takes a second."""
    path = tmp_path_factory.mktemp("photo") / "coast.png"
    Image.fromarray(sw.sample("coast").preview(long_edge=240)).save(path)
    return str(path)


def fails(capsys, *arguments):
    """Run a command that must fail; return the one line it says."""
    try:
        status = main(list(arguments))
    except SystemExit as stop:
        status = stop.code
    said = capsys.readouterr().err
    assert status == 2
    assert "Traceback" not in said
    assert said.count("\n") == 1
    return said


def parse(*arguments):
    return cli._parser().parse_args(arguments)


def test_every_parameter_has_a_flag():
    for p in PARAMETERS:
        if p.kind == "number":
            options = parse("render", "x.jpg", "-o", "y.png", flag(p.name), str(p.maximum))
            assert getattr(edit_of_flags(options), p.name) == p.maximum
        elif p.kind == "choice":
            for choice in p.choices:
                options = parse("render", "x.jpg", "-o", "y.png", flag(p.name), choice)
                assert getattr(edit_of_flags(options), p.name) == choice


def test_the_command_alone_shows_its_help(capsys):
    assert main([]) == 2
    said = capsys.readouterr()
    assert "timelapse" in said.err
    assert said.out == ""


def test_what_the_command_line_warns_of_names_its_own_flags(photo, tmp_path, capsys):
    assert main(["analyze", photo, "-o", str(tmp_path / "maps"), "--sun", "outside"]) == 0
    said = capsys.readouterr().err
    assert "--sun X,Y in pixels" in said
    assert "--fov DEG" in said
    assert not re.search(r"\w=|[Cc]lick|Drag|stroke", said)


def test_every_flag_in_a_warning_is_one():
    known = parse_flags("render") | parse_flags("analyze")
    named = set(re.findall(r"--[a-z][a-z-]+", inspect.getsource(notices)))
    assert named >= {"--sun", "--horizon", "--fov", "--sky"}
    assert named <= known


def parse_flags(command):
    with contextlib.redirect_stdout(io.StringIO()) as said, contextlib.suppress(SystemExit):
        main([command, "--help"])
    return set(re.findall(r"--[a-z][a-z-]+", said.getvalue()))


def test_render_and_batch_say_when_nothing_moves(photo, tmp_path, capsys):
    for command, output in (("render", "out.png"), ("batch", "folder")):
        words = [command, photo, "-o", str(tmp_path / output)]
        assert main([*words, *(["--workers", "0"] if command == "batch" else [])]) == 0
        assert "Nothing moves" in capsys.readouterr().err
    assert main(["render", photo, "-o", str(tmp_path / "moved.png"), "--exposure", "1"]) == 0
    assert "Nothing moves" not in capsys.readouterr().err


def test_every_number_has_an_end_in_a_sweep():
    for p in NUMBERS:
        options = parse("sweep", "x", "-o", "y.gif", flag("to_" + p.name), str(p.minimum))
        assert getattr(edit_of_flags(options, "to_", Edit()), p.name) == p.minimum


def test_help_names_every_parameter(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["render", "--help"])
    assert stop.value.code == 0
    said = capsys.readouterr().out
    assert all(flag(p.name) in said for p in PARAMETERS if p.kind != "data")


def test_no_flag_is_an_unmoved_edit():
    assert edit_of_flags(parse("render", "x.jpg", "-o", "y.png")) == Edit()


def test_negative_values_need_no_equals_sign():
    options = parse("render", "x", "-o", "y", "--sun", "-300,-2.5", "--sun-elevation", "-3")
    assert options.sun == (-300, -2.5)
    assert options.sun_elevation == -3


def test_the_sun_may_be_said_to_be_outside_the_picture():
    assert parse("render", "x", "-o", "y", "--sun", "outside").sun == "outside"


def test_flags_win_over_the_recipe(tmp_path):
    recipe = tmp_path / "recipe.json"
    recipe.write_text(Edit(sun_elevation=3, exposure=1).to_json())
    options = parse("render", "x", "-o", "y", "--recipe", str(recipe), "--exposure", "-1")
    assert edit_of_flags(options) == Edit(sun_elevation=3, exposure=-1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["render"], "required"),
        (["render", "x.jpg", "-o", "y.png", "--sun-elevation", "high"], "invalid float"),
        (["render", "x.jpg", "-o", "y.png", "--sun-elevation", "91"], "outside -12 to 90"),
        (["render", "x.jpg", "-o", "y.png", "--sun-elevation", "nan"], "must be a number"),
        (["render", "x.jpg", "-o", "y.png", "--sun-elev", "3"], "unrecognized"),
        (["render", "x.jpg", "-o", "y.png", "--method", "magic"], "invalid choice"),
        (["render", "x.jpg", "-o", "y.png", "--size", "big"], "1920x1080"),
        (["render", "x.jpg", "-o", "y.png", "--sun", "3"], "comma-separated numbers"),
        (["render", "x.jpg", "-o", "y.png", "--sun", "inside"], "comma-separated numbers"),
        (["render", "no-such-photo.jpg", "-o", "y.png"], "no file"),
        (["render", "x.jpg", "--sun-elevaton", "3"], "Did you mean --sun-elevation?"),
        (["render", "x.jpg", "-o", "y.png", "--horizn=3"], "Did you mean --horizon?"),
        (["sweep", "x.jpg", "--to-sun-elevaton", "3"], "Did you mean --to-sun-elevation?"),
        (["render", "x.jpg", "-o", "y.png", "--cloud-method", "unmixx"], "Did you mean unmix?"),
        (["--verson"], "Did you mean --version?"),
        (["rendr", "x.jpg"], "Did you mean render?"),
        (["render", "a.jpg", "b.jpg"], "for many: sunwidget batch PHOTO … -o FOLDER"),
        (["render", "-o", "y.png", "a.jpg", "b.jpg"], "for many: sunwidget batch"),
        (["analyze", "-o", "maps", "a.jpg", "b.jpg"], "takes one photo. Too many: b.jpg"),
        (["render", "sample:beach", "-o", "y.png"], "no sample"),
        (["render", "x.jpg", "-o", "y.png", "--recipe", "no-such.json"], "no-such.json"),
        (["sweep", "x.jpg", "-o", "y.gif"], "Nothing moves"),
        (["bake", "x.jpg"], "invalid choice"),
        (["analyze", "x.jpg", "-o", "maps", "--refine", "magic"], "'dense_crf'"),
        (["analyze", "sample:coast", "-o", "maps", "--sky-label", "2"], "ONNX network"),
    ],
)
def test_a_mistake_is_one_line_and_status_2(capsys, arguments, message):
    assert message in fails(capsys, *arguments)


def test_a_broken_recipe_is_one_line(capsys, tmp_path):
    recipe = tmp_path / "recipe.json"
    recipe.write_text('{"sun_elevatoin": 3}')
    said = fails(capsys, "render", "x.jpg", "-o", "y.png", "--recipe", str(recipe))
    assert "Did you mean 'sun_elevation'" in said


def test_a_broken_photo_is_one_line(capsys, tmp_path):
    broken = tmp_path / "broken.jpg"
    broken.write_bytes(b"\xff\xd8\xff\xe0 no picture")
    assert "broken.jpg" in fails(capsys, "render", str(broken), "-o", str(tmp_path / "y.png"))


def test_an_existing_picture_is_refused_before_any_work(capsys, tmp_path):
    output = tmp_path / "out.png"
    output.write_bytes(b"mine")
    assert "--overwrite" in fails(capsys, "render", "no-such-photo.jpg", "-o", str(output))
    assert output.read_bytes() == b"mine"


def test_render_writes_the_moved_picture(photo, tmp_path):
    output = tmp_path / "out.png"
    assert main(["render", photo, "--sun-elevation", "1", "-o", str(output)]) == 0
    before, after = (np.asarray(Image.open(p).convert("RGB"), float) for p in (photo, output))
    assert after.shape == before.shape
    assert np.abs(after - before).mean() > 3


def test_html_writes_a_page_with_the_edit_and_keeps_what_exists(photo, tmp_path, capsys):
    out = tmp_path / "evening.html"
    wanted = ["html", photo, "--sun-elevation", "3", "--title", "Evening <1>", "-o", str(out)]
    assert main(wanted) == 0
    assert re.search(r"evening\.html  \(\d\.\d MB\)", capsys.readouterr().out)
    text = out.read_text("utf-8")
    assert "<title>Evening &lt;1&gt;</title>" in text
    assert '"sun_elevation":3.0' in text
    assert "--overwrite" in fails(capsys, *wanted)
    assert out.read_text("utf-8") == text


def test_render_of_an_unmoved_sun_changes_no_pixel(photo, tmp_path):
    output = tmp_path / "out.png"
    assert main(["render", photo, "-o", str(output)]) == 0
    before, after = (np.asarray(Image.open(p).convert("RGB"), int) for p in (photo, output))
    assert np.abs(after - before).max() <= 1


def test_render_scales_to_the_asked_size(photo, tmp_path):
    output = tmp_path / "out.png"
    assert main(["render", photo, "--size", "90x60", "-o", str(output)]) == 0
    assert Image.open(output).size == (90, 60)


def test_render_writes_layers_and_the_sky_around(photo, tmp_path, capsys):
    output, sky = tmp_path / "out.png", tmp_path / "sky.hdr"
    flags = ["--layers", "--bit-depth", "16", "--environment", str(sky)]
    assert main(["render", photo, "--sun-elevation", "3", *flags, "-o", str(output)]) == 0
    said = capsys.readouterr().out
    assert "out.png" in said
    assert "sky.hdr" in said
    assert {path.name for path in tmp_path.glob("out.*.png")} == {
        f"out.{name}.png" for name in ("sky", "clouds", "land", "matte")
    }
    assert sw.open(output).bit_depth == 16
    assert sw.open(sky).size == (2048, 1024)


def test_render_says_what_a_format_cannot_hold_before_the_photo_is_read(tmp_path, capsys):
    for flags, message in (
        (["-o", str(tmp_path / "x.jpg"), "--layers"], "no transparency"),
        (["-o", str(tmp_path / "x.webp"), "--bit-depth", "16"], "holds 8 bits"),
        (["-o", str(tmp_path / "x.png"), "--environment", str(tmp_path / "x.jpg")], ".hdr or .exr"),
        (["-o", str(tmp_path / "x.png"), "--quality", "101"], "invalid choice"),
    ):
        assert message in fails(capsys, "render", "no-such-photo.jpg", *flags)


def test_analyze_writes_maps_and_facts_and_obeys_hints(photo, tmp_path, capsys):
    folder = tmp_path / "maps"
    hints = ["--horizon", "100", "--fov", "40", "--sun", "120,30"]
    assert main(["analyze", photo, "-o", str(folder), *hints]) == 0
    said = capsys.readouterr().out.split()
    assert {path.name for path in folder.iterdir()} == {line.rsplit("/", 1)[1] for line in said}
    facts = json.loads((folder / "scene.json").read_text())
    assert facts["camera"]["fov_vertical_deg"] == pytest.approx(40)
    assert facts["horizon"]["row"] == pytest.approx(100)
    assert facts["sun"]["x"] == pytest.approx(120, abs=3)
    sky = np.asarray(Image.open(folder / "sky.png"))
    assert sky.shape == (160, 240)
    assert sky[:20].mean() > 200
    assert sky[-20:].mean() < 50


def test_every_method_of_every_stage_is_a_choice_of_analyze():
    named = {name for name, (choices, _) in methods_of_stages().items() for _ in choices}
    assert named >= {"refine", "clouds", "horizon_method", "sun_method"}
    for name, (choices, default) in methods_of_stages().items():
        assert default in choices
        for choice in choices:
            options = parse("analyze", "x.jpg", "-o", "maps", flag(name), choice)
            assert getattr(options, name) == choice
    assert parse("analyze", "x.jpg", "-o", "maps").refine is None


def test_the_methods_reach_the_analysis(monkeypatch):
    asked = {}

    def analyze(photo, **options):
        asked.update(options)
        return types.SimpleNamespace(warnings=())

    monkeypatch.setattr(sw, "analyze", analyze)
    flags = ["--refine", "dense_crf", "--horizon-method", "row_argmax", "--sky-label", "10"]
    scene_of(parse("analyze", "sample:coast", "-o", "maps", "--sky", "city.onnx", *flags))
    del asked["progress"]
    expected = {"refine": "dense_crf", "horizon_method": "row_argmax"}
    assert asked == expected | {"sky": "city.onnx", "sky_label": 10}
    scene_of(parse("render", "sample:coast", "-o", "x.png", "--sky-label", "sky"))
    assert asked["sky_label"] == "sky"


def test_a_foreign_network_and_its_class_are_flags(photo, tmp_path, capsys):
    weight = np.zeros((9, 3, 1, 1), np.float32)
    weight[5, :, 0, 0] = (-8, 0, 8)
    scores = [onnx.node("Conv", ["image", "w"], ["scores"])]
    entry = ("image", np.float32, (1, 3, 64, 96))
    result = ("scores", np.float32, (1, 9, 64, 96))
    path, scale = tmp_path / "blue.onnx", {"mean": "0", "std": "1"}
    network = str(onnx.write(path, scores, {"w": weight}, [entry], [result], scale))
    common = ["analyze", photo, "-o", str(tmp_path / "maps"), "--sky", network]
    assert "sky_label" in fails(capsys, *common)
    assert "no class 9" in fails(capsys, *common, "--sky-label", "9")
    assert "names none" in fails(capsys, *common, "--sky-label", "sky")
    assert main([*common, "--sky-label", "5", "--refine", "none"]) == 0
    sky = np.asarray(Image.open(tmp_path / "maps" / "sky_coarse.png"))
    picture = np.asarray(Image.open(photo).convert("RGB"), float)
    bluer = picture[..., 2] - picture[..., 0]
    assert (sky > 127)[bluer > 25].mean() > 0.98
    assert (sky > 127)[bluer < -25].mean() < 0.02


def test_analyze_takes_a_mask_for_the_sky(photo, tmp_path):
    mask = np.zeros((160, 240), np.uint8)
    mask[:70] = 255
    path = tmp_path / "mask.png"
    Image.fromarray(mask).save(path)
    assert main(["analyze", photo, "-o", str(tmp_path / "maps"), "--sky", str(path)]) == 0
    sky = np.asarray(Image.open(tmp_path / "maps" / "sky.png"))
    assert sky[:60].min() > 250
    assert sky[80:].max() < 5


def test_replace_sky_and_transfer_look_write_what_python_makes(photo, tmp_path):
    out = tmp_path / "sky.png"
    donor = tmp_path / "donor.png"
    Image.fromarray(sw.sample("mountains").preview(long_edge=240)).save(donor)
    assert main(["replace-sky", photo, "--sky", str(donor), "--turn", "5", "-o", str(out)]) == 0
    assert np.array_equal(sw.open(out).encoded, sw.replace_sky(photo, donor, turn=5).encoded)
    look = tmp_path / "look.png"
    pair = ["--before", photo, "--after", str(out), "--strength", "0.5"]
    assert main(["transfer-look", str(donor), *pair, "-o", str(look)]) == 0
    wanted = sw.transfer_look(donor, photo, out, strength=0.5).encoded
    assert np.array_equal(sw.open(look).encoded, wanted)


def test_neither_replaces_a_file_unasked(photo, tmp_path, capsys):
    out = tmp_path / "mine.png"
    out.write_bytes(b"mine")
    for command in (
        ["replace-sky", photo, "--sky", photo],
        ["transfer-look", photo, "--before", photo, "--after", photo],
    ):
        assert "--overwrite" in fails(capsys, *command, "-o", str(out))
    assert out.read_bytes() == b"mine"


def test_sweep_writes_a_film(photo, tmp_path):
    film = tmp_path / "sunset.webp"
    ends = ["--sun-elevation", "10", "--to-sun-elevation", "-2", "--frames", "3"]
    assert main(["sweep", photo, "-o", str(film), *ends]) == 0
    with Image.open(film) as frames:
        assert frames.n_frames == 3
        assert frames.size == (240, 160)


def test_demo_writes_what_it_names(tmp_path, monkeypatch, capsys):
    import sunwidget.cli.demo

    monkeypatch.setattr(sunwidget.cli.demo, "FILM_SIZE", (96, 64))
    monkeypatch.setattr("sunwidget.film.path.DEFAULT_SECONDS", 0.5)
    assert main(["demo", "-o", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    for name in ("maps", "still.png", "recipe.json", "page.html", "sunset.mp4"):
        assert (tmp_path / name).exists()
        assert f"{tmp_path / name}  " in said
    assert np.asarray(Image.open(tmp_path / "still.png")).shape == (1024, 1536, 3)


def test_doctor_finds_everything_essential(capsys):
    assert main(["doctor"]) == 0
    said = capsys.readouterr().out
    assert "MISSING" not in said
    assert re.search(r"^ok +EGL +\S+.*OpenGL [34]\.", said, re.MULTILINE)
    assert re.search(r"^ok +sky network +[\d.]+ MB", said, re.MULTILINE)


def test_doctor_fails_and_says_what_to_install_without_contrib(capsys, monkeypatch):
    import cv2

    monkeypatch.delattr(cv2, "ximgproc")
    assert main(["doctor"]) == 1
    said = capsys.readouterr().out
    assert re.search(r"^MISSING OpenCV", said, re.MULTILINE)
    assert "opencv-contrib-python-headless" in said


def test_doctor_reports_a_broken_check_instead_of_breaking(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    assert main(["doctor"]) == 1
    assert re.search(r"^MISSING sky network +\w*Error", capsys.readouterr().out, re.MULTILINE)


def test_the_command_is_installed():
    done = subprocess.run(
        [sys.executable, "-m", "sunwidget", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == sw.__version__
