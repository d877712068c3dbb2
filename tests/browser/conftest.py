"""A browser, an analysed sample, and a folder for screenshots."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from chromium import VIEWPORT, chromium, open_page, start_anew

import sunwidget as sw

FAILED = pytest.StashKey[bool]()


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


def pytest_runtest_makereport(item, call):
    if call.excinfo is not None:
        item.stash[FAILED] = True


@pytest.fixture
def fresh_page(browser):
    """A page of its own, for a test that changes the browser's own functions."""
    context = browser.new_context(viewport=VIEWPORT)
    yield open_page(context)
    context.close()


@pytest.fixture(scope="module")
def used_pages(browser):
    """The page that the tests of a file use one after the other; none before the first."""
    pages = []
    yield pages
    for page in pages:
        page.context.close()


@pytest.fixture
def page(request, browser, used_pages):
    """A page without a view. A new one for every test would be half of what a test costs."""
    if not used_pages:
        used_pages.append(open_page(browser.new_context(viewport=VIEWPORT)))
    start_anew(used_pages[0])
    yield used_pages[0]
    if request.node.stash.get(FAILED, False):
        used_pages.pop().context.close()


@pytest.fixture(scope="session")
def coast():
    """A photo-like picture of 768 × 512, small enough for a slow machine."""
    return sw.analyze(sw.sample("coast").preview(768))


@pytest.fixture(scope="session")
def screenshots(root):
    folder = root / "build" / "screenshots"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
