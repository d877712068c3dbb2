"""The README says what works: its cells run, its commands parse."""

import re

import pytest
from pages import blocks, commands
from PIL import Image

import sunwidget as sw
from sunwidget.cli import main


@pytest.fixture(scope="module")
def readme(root):
    return (root / "README.md").read_text("utf-8")


def test_the_cells_run(readme, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sunwidget.film.path.DEFAULT_SECONDS", 0.5)
    small = Image.fromarray(sw.sample("coast").preview(long_edge=192))
    small.save("beach.jpg", quality=95)
    sw.to_dome(sw.analyze("beach.jpg"), sw.Edit(), "park.hdr", width=512)
    (tmp_path / "park.json").unlink()  # a map from elsewhere has none
    cells = blocks(readme, "python")
    assert len(cells) >= 4
    names = {}
    for cell in cells:
        exec(compile(cell, "README.md", "exec"), names)
    written = {path.name for path in tmp_path.iterdir()}
    assert written >= {"evening.png", "blue.tif", "sunset.mp4", "park.exr", "evening.html"}


def test_the_commands_parse(readme):
    assert len(commands(readme)) >= 4
    for arguments in commands(readme):
        assert main._parser().parse_args(arguments).run


def test_the_make_targets_exist(readme, root):
    makefile = (root / "Makefile").read_text("utf-8")
    for document in (readme, (root / "CONTRIBUTING.md").read_text("utf-8")):
        targets = set(re.findall(r"\bmake ([a-z]+)\b(?=[ `\n])", "\n".join(blocks(document, "sh"))))
        assert targets
        assert all(re.search(rf"^{target}:", makefile, re.MULTILINE) for target in targets)


def test_the_wheel_in_the_instructions_is_this_version(readme):
    assert f"sunwidget-{sw.__version__}-py3-none-any.whl" in readme


def test_the_picture_at_the_top_moves_and_is_small_enough_to_load(readme, root):
    name = re.search(r"!\[[^\]]+\]\(([^)]+)\)", readme).group(1)
    path = root / name
    assert path.stat().st_size <= 2.5e6
    with Image.open(path) as picture:
        assert picture.n_frames >= 24
