"""Fixtures that every room of the tests may ask for."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# Mesa keeps compiled shaders in the person's cache folder. Processes that a test gives another
# home use the same, or each would compile them anew: ten seconds of a core.
_CACHE = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
os.environ.setdefault("MESA_SHADER_CACHE_DIR", _CACHE)


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
