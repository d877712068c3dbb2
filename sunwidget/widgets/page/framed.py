"""A page in a frame, which stays live in an exported notebook."""

from __future__ import annotations

from html import escape
from typing import Any

from sunwidget.widgets.page.html import escape_text

# The page reports its height on request and on every change (js/src/standalone/). As an
# attribute, this code also runs if a host inserts the frame into an existing page.
_FOLLOW = (
    "const frame = this; window.addEventListener('message', (event) => {"
    " if (event.source === frame.contentWindow && event.data?.sunwidgetHeight > 0)"
    " frame.style.height = Math.ceil(event.data.sunwidgetHeight) + 'px'; });"
    " frame.contentWindow.postMessage('sunwidget: height?', '*');"
)
# A study's first screen is a form; the page's own policy forbids sending it.
_SANDBOX = "allow-scripts allow-forms allow-downloads"
_HEIGHT = 720  # CSS pixels, until the page reports its height


class StaticPage:
    """A live page as the output of a cell: no kernel, no widget manager, no network.

    Each widget's ``render_static`` returns one. The page runs in a frame that may run its own
    script and offer downloads, but cannot access the surrounding page.

    Attributes
    ----------
    html : str
        The page, as ``to_html`` returns it.
    title : str
        Title of the frame, for screen readers.
    """

    def __init__(self, page: str, title: str) -> None:
        self.html = page
        self.title = title

    def __repr__(self) -> str:
        return f"<StaticPage {self.title!r}, {len(self.html) / 1e6:.1f} MB>"

    def _repr_html_(self) -> str:
        return (
            f'<iframe title="{escape_text(self.title)}" sandbox="{_SANDBOX}" '
            f'style="width: 100%; height: {_HEIGHT}px; border: 0" onload="{escape(_FOLLOW)}" '
            f'srcdoc="{escape(self.html)}"></iframe>'
        )

    def _repr_mimebundle_(self, **_kwargs: Any) -> dict[str, str]:
        return {"text/html": self._repr_html_(), "text/plain": repr(self)}
