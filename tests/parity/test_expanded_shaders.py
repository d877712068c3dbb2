"""Both hosts read the same text: the include resolvers of Python and JavaScript agree."""

import json
import shutil
import subprocess

import pytest

from sunwidget.renderer.shader_source import frame_graph, part_shaders, resolve_includes


@pytest.fixture(scope="module")
def in_javascript(root):
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node.js to run the browser's resolver with")
    if not (root / "js" / "node_modules" / "esbuild").is_dir():
        pytest.skip("js/node_modules is missing: run `make build`")
    done = subprocess.run(
        [node, "test/expand.js"], cwd=root / "js", capture_output=True, check=True, timeout=120
    )
    return json.loads(done.stdout)


def test_every_pass_expands_to_the_same_text_on_both_hosts(in_javascript):
    graphs = [frame_graph(), frame_graph("explorer")]
    rows = [row for graph in graphs for row in graph["passes"]]
    names = {name for row in rows for name in part_shaders(row)}
    names |= {row["parts"]["by"] for row in rows if "parts" in row}
    shaders = {f"{name}.glsl" for name in names}
    assert shaders <= in_javascript.keys()
    for name in sorted(shaders):
        assert in_javascript[name] == resolve_includes(name), name
