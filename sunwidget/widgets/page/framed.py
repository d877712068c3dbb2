"""A page inside another page: what stays live in an exported notebook."""

from __future__ import annotations

from html import escape
from typing import Any

from sunwidget.widgets.page.html import escaped

# The page tells its height when it is asked, and whenever that changes (js/src/standalone/).
# As an attribute it also runs where a host puts the frame into a page that is there already.
_FOLLOW = (
    "const frame = this; window.addEventListener('message', (event) => {"
    " if (event.source === frame.contentWindow && event.data?.sunwidgetHeight > 0)"
    " frame.style.height = Math.ceil(event.data.sunwidgetHeight) + 'px'; });"
    " frame.contentWindow.postMessage('sunwidget: height?', '*');"
)
# A study's first screen is a form; the page's own policy lets none be sent.
_SANDBOX = "allow-scripts allow-forms allow-downloads"
_HEIGHT = 720  # CSS pixels, until the page has said its own


class StaticPage:
    """A live page as the output of a cell: no kernel, no widget manager, no network.

    Made by ``render_static`` of each widget. The page runs in a frame that may run its own script
    and offer downloads, and sees nothing of the page around it.

    Attributes
    ----------
    html : str
        The page, as ``to_html`` returns it.
    title : str
        Of the frame, for those who do not see it.
    """

    def __init__(self, page: str, title: str) -> None:
        self.html = page
        self.title = title

    def __repr__(self) -> str:
        return f"<StaticPage {self.title!r}, {len(self.html) / 1e6:.1f} MB>"

    def _repr_html_(self) -> str:
        return (
            f'<iframe title="{escaped(self.title)}" sandbox="{_SANDBOX}" '
            f'style="width: 100%; height: {_HEIGHT}px; border: 0" onload="{escape(_FOLLOW)}" '
            f'srcdoc="{escape(self.html)}"></iframe>'
        )

    def _repr_mimebundle_(self, **_kwargs: Any) -> dict[str, str]:
        return {"text/html": self._repr_html_(), "text/plain": repr(self)}
