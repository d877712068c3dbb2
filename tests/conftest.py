"""Fixtures that every room of the tests may ask for."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


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
