"""A browser, an analysed sample, and a folder for screenshots."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from chromium import chromium, open_page

import sunwidget as sw


def pytest_collection_modifyitems(items):
    """Run a browser test that fails once more: hosts start slowly on a shared machine.

    The summary counts and names every such rerun; a test that fails twice has failed.
    """
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.flaky(reruns=1))


# Not for the session: while Playwright's loop runs, no other test of this process can start
# one, nor use asyncio as the notebook tests do.
@pytest.fixture(scope="module")
def browser():
    with chromium() as instance:
        yield instance


@pytest.fixture
def page(browser):
    context = browser.new_context(viewport={"width": 1180, "height": 860})
    yield open_page(context)
    context.close()


@pytest.fixture(scope="session")
def coast():
    """A photo-like picture of 768 × 512, small enough for a slow machine."""
    return sw.analyze(sw.sample("coast").preview(768))


@pytest.fixture(scope="session")
def screenshots(root):
    folder = root / "build" / "screenshots"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
