"""The README says what works: its cells run, its commands parse, its files exist."""

import re
import shlex

import pytest
from PIL import Image

import sunwidget as sw
from sunwidget import cli


@pytest.fixture(scope="module")
def readme(root):
    return (root / "README.md").read_text("utf-8")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def test_the_cells_run(readme, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sunwidget.export.sun_path.DEFAULT_SECONDS", 0.5)
    small = Image.fromarray(sw.sample("coast").preview(long_edge=192))
    small.save("beach.jpg", quality=95)
    cells = blocks(readme, "python")
    assert len(cells) >= 2
    names = {}
    for cell in cells:
        exec(compile(cell, "README.md", "exec"), names)
    assert {path.name for path in tmp_path.iterdir()} >= {"evening.png", "sunset.mp4"}


def test_the_commands_parse(readme):
    commands = [
        shlex.split(line, comments=True)
        for block in blocks(readme, "sh")
        for line in block.splitlines()
        if line.startswith("sunwidget ")
    ]
    assert len(commands) >= 4
    for _, *arguments in commands:
        assert cli._parser().parse_args(arguments).run


def test_the_make_targets_exist(readme, root):
    makefile = (root / "Makefile").read_text("utf-8")
    for document in (readme, (root / "CONTRIBUTING.md").read_text("utf-8")):
        targets = set(re.findall(r"\bmake ([a-z]+)\b(?=[ `\n])", "\n".join(blocks(document, "sh"))))
        assert targets
        assert all(re.search(rf"^{target}:", makefile, re.MULTILINE) for target in targets)


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"])
def test_links_lead_somewhere(root, name):
    links = re.findall(r"\]\(([^)#]+)\)", (root / name).read_text("utf-8"))
    assert links
    for link in links:
        assert link.startswith("https://") or (root / link).exists(), link


def test_the_wheel_in_the_instructions_is_this_version(readme):
    assert f"sunwidget-{sw.__version__}-py3-none-any.whl" in readme
