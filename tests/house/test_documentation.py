"""The pages hold together: every link leads somewhere, every code block is code."""

import ast
import hashlib
import json
import re
import subprocess

import pytest
from pages import anchors, blocks, commands, links

import sunwidget as sw
from sunwidget.analysis.pipeline import METHODS
from sunwidget.cli import main
from sunwidget.edit.table import METHODS as RENDER_METHODS


@pytest.fixture(scope="module")
def pages(root):
    """Text of every Markdown file in the checkout, and of notebooks their prose."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md", "*.ipynb"],
        cwd=root,
        capture_output=True,
        text=True,
        check=False,
    ).stdout.split()
    paths = [root / name for name in listed] or [*root.glob("*.md"), *root.glob("docs/**/*.md")]
    pages = {path: path.read_text("utf-8") for path in paths if path.is_file()}
    for path, text in pages.items():
        if path.suffix == ".ipynb":
            cells = [c for c in json.loads(text)["cells"] if c["cell_type"] == "markdown"]
            pages[path] = "\n\n".join("".join(cell["source"]) for cell in cells)
    assert len(pages) > 20
    return pages


@pytest.fixture(scope="module")
def docs(pages, root):
    return {path: text for path, text in pages.items() if path.is_relative_to(root / "docs")}


def test_every_relative_link_leads_to_a_file(pages):
    lost = [
        f"{path.name}: {link}"
        for path, text in pages.items()
        for link in links(text)
        if not re.match(r"https://|mailto:|#", link)
        and not (path.parent / link.partition("#")[0]).exists()
    ]
    assert lost == []


def test_every_anchor_is_a_heading(pages):
    lost = []
    for path, text in pages.items():
        for link in links(text):
            name, _, anchor = link.partition("#")
            target = (path.parent / name).resolve() if name else path
            if anchor and target in pages and anchor not in anchors(pages[target]):
                lost.append(f"{path.name}: {link}")
    assert lost == []


def test_every_page_is_in_the_index(docs, root):
    index = root / "docs" / "README.md"
    listed = {(index.parent / link.partition("#")[0]).resolve() for link in links(docs[index])}
    assert set(docs) - {index} <= listed


def test_every_notebook_is_in_the_index(root):
    text = (root / "docs" / "README.md").read_text("utf-8")
    for path in (root / "notebooks").glob("*.ipynb"):
        assert f"../notebooks/{path.name}" in text


# Files that a person has, or that are written.
NOT_OURS = {"evening.json", "sunset.json", "scene.json", "script.py"}


def test_files_of_the_source_that_the_pages_name_exist(pages, root):
    folders = ("sunwidget", "js", "tests", "bench", "scripts", "training")
    ours = [
        f"/{path.relative_to(root).as_posix()}"
        for folder in folders
        for path in (root / folder).rglob("*.*")
        if "node_modules" not in path.parts
    ]
    named = re.compile(r"`([\w./]+\.(?:py|glsl|js|mjs|css|json))`")
    lost = {
        f"{path.name}: {name}"
        for path, text in pages.items()
        for name in named.findall(text)
        if name not in NOT_OURS
        and not name.startswith("build/")
        and not any(own.endswith(f"/{name}") for own in ours)
    }
    assert lost == set()


def test_python_in_the_pages_compiles(pages):
    for path, text in pages.items():
        if path.name != "api.md":  # signatures are no statements
            for block in blocks(text, "python"):
                ast.parse(block, filename=path.name)


def test_names_that_the_pages_use_exist(pages):
    for path, text in pages.items():
        for block in blocks(text, "python"):
            for name in re.findall(r"\bsw\.([A-Za-z_]\w*)", block):
                assert hasattr(sw, name) or name in ("analysis", "__version__"), (path.name, name)


def test_commands_in_the_pages_parse(docs):
    found = {path: commands(text) for path, text in docs.items()}
    assert sum(map(len, found.values())) > 10
    for path, lines in found.items():
        for arguments in lines:
            assert main._parser().parse_args(arguments).run, (path.name, arguments)


@pytest.mark.parametrize("stage", METHODS)
def test_every_method_of_the_analysis_is_told_in_a_page(docs, root, stage):
    index = (root / "docs" / "README.md").read_text("utf-8")
    everything = "\n".join(text for path, text in docs.items() if path.name != "api.md")
    for name in METHODS[stage]:
        assert f"`{name}`" in index
        assert f"`{name}`" in everything.replace(index, "")


def test_every_method_of_the_frame_is_told_in_a_page(docs, root):
    index = (root / "docs" / "README.md").read_text("utf-8")
    assert all(f"`{name}`" in index for name in RENDER_METHODS)


@pytest.mark.parametrize("name", ["sky.onnx", "suns.onnx", "land.onnx", "panes.onnx"])
def test_the_model_card_is_of_the_networks_that_ship(root, name):
    folder = root / "sunwidget" / "analysis" / "models"
    network = (folder / name).read_bytes()
    card = (folder / "MODEL_CARD.md").read_text("utf-8")
    assert hashlib.sha256(network).hexdigest() in card
    assert f"{len(network) / 1e6:.1f} MB" in card
