"""Fixtures that every room of the tests may ask for."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parents[1]

# Mesa keeps compiled shaders in the person's cache folder. Processes that a test gives another
# home use the same, or each would compile them anew: ten seconds of a core.
_CACHE = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
os.environ.setdefault("MESA_SHADER_CACHE_DIR", _CACHE)

# A shared machine is slow at times, which says nothing about the code; and what fails here must
# fail again for whoever looks.
settings.register_profile("sunwidget", deadline=None, derandomize=True)
settings.load_profile("sunwidget")


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of shared pictures and truth: SUNWIDGET_SHARED, else ../shared."""
    folder = Path(os.environ.get("SUNWIDGET_SHARED", ROOT.parent / "shared"))
    if not folder.is_dir():
        pytest.skip(f"no shared data: {folder} is no folder (set SUNWIDGET_SHARED)")
    return folder


@pytest.fixture(scope="session")
def in_node(root):
    """Run the browser's own modules: ``in_node(script, asked)`` returns what the script answers.

    ``script`` is a module that lies in ``js``, has ``asked`` as it came through JSON, and exports
    nothing: it calls ``answer(value)``.
    """
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed, so the browser's code cannot be run here")
    begin = """
    import { readFileSync } from "node:fs";
    const asked = JSON.parse(readFileSync(0, "utf-8"));
    const answer = (value) => console.log(JSON.stringify(value));
    """

    def run(script, asked=None):
        done = subprocess.run(
            [node, "--input-type=module", "--eval", begin + script],
            input=json.dumps(asked),
            capture_output=True,
            text=True,
            cwd=root / "js",
            timeout=60,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run
