"""One HTML file with a widget's front end and its state, without a kernel or network.

The page's Content-Security-Policy allows only the starter script, identified by its hash, and the
script that the starter creates from the state; nothing may be fetched or sent. Text from users
(the photo's name, the title, a recipe) is escaped and only ever read as text.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_STARTER = Path(__file__).parents[2] / "static" / "standalone.js"
_TYPES = {b"\x89PNG": "image/png", b"\xff\xd8\xff\xe0": "image/jpeg", b"RIFF": "image/webp"}

# Light or dark as the system is set; the widget has its own colors.
_STYLE = """
:root { color-scheme: light dark; }
body {
  margin: 0;
  padding: 14px 16px 20px;
  background: light-dark(#f1f2f4, #17181a);
  color: light-dark(#202124, #e6e7e9);
  font: 13px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
header, footer, main { max-width: 1600px; margin: 0 auto; }
h1 { margin: 0 0 10px; font-size: 16px; font-weight: 600; overflow-wrap: anywhere; }
footer { padding-top: 10px; color: light-dark(#5b6065, #a2a7ad); }
footer p { margin: 0; }
figure { margin: 0; }
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; border-radius: 8px; }
figcaption, #problem { padding: 8px 0; }
#problem { font-weight: 600; }
[hidden] { display: none !important; }
@media (max-width: 600px) { body { padding: 10px 8px 16px; } }
@media print { body { padding: 0; background: none; } footer { display: none; } }
"""


@dataclass(frozen=True)
class Still:
    """The picture of a page while its widget does not run: before it starts, or if it cannot.

    Attributes
    ----------
    data : bytes
        PNG, JPEG or WebP.
    size : (width, height)
        Pixels.
    description : str
        Alternative text of the picture.
    """

    data: bytes
    size: tuple[int, int]
    description: str


def page(
    embedded: dict[str, Any], still: Still | None, *, title: str, notes: tuple[str, ...] = ()
) -> str:
    """Return a self-contained HTML page that shows a widget.

    Parameters
    ----------
    embedded : dict
        ``state``: the traits by name, with the front end in ``_esm`` and ``_css``;
        ``buffers``: the binary ones as ``{path, encoding: "base64", data}``, Jupyter's format for
        embedded widgets.
    still : Still or None
        Shown until the widget runs, and if it cannot.
    title : str
        Title of the page; plain text.
    notes : tuple of str
        Sentences under the widget; plain text.

    Returns
    -------
    str
        HTML 5. Text from users can neither end an element nor begin a script.

    Raises
    ------
    ImportError
        If the front end is not built.
    ValueError
        For state that JSON cannot hold, such as NaN.
    """
    if not _STARTER.is_file():
        raise ImportError(
            "sunwidget's front end is not built, so no page can be written. In a checkout run "
            "`make build` (Node 20 or newer); an installed package includes it."
        )
    starter = _checked_code("script", _STARTER.read_text("utf-8"))
    state = dict(embedded["state"])
    style = _checked_code("style", _STYLE + state.pop("_css", ""))
    policy = "; ".join(
        [
            "default-src 'none'",
            # The front end is imported from a blob that the starter creates.
            f"script-src {_hash(starter)} blob:",
            f"style-src-elem {_hash(style)}",
            "style-src-attr 'unsafe-inline'",
            "img-src data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
            # Nothing in the page, including the front end, may read text as HTML or code.
            "require-trusted-types-for 'script'",
            "trusted-types 'none'",
        ]
    )
    content = {"state": state, "buffers": embedded.get("buffers", [])}
    name = escape_text(title)
    paragraphs = "".join(f"\n<p>{escape_text(note)}</p>" for note in notes)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="referrer" content="no-referrer">
<meta name="generator" content="sunwidget {_version()}">
<title>{name}</title>
<style>{style}</style>
</head>
<body>
<header><h1>{name}</h1></header>
<main>
<div id="widget"></div>
<figure id="still">{"" if still is None else _image(still)}
<figcaption id="problem" role="alert" hidden></figcaption>
</figure>
<noscript><p>The picture can be edited here once JavaScript is allowed for this file.</p></noscript>
</main>
<footer id="notes">{paragraphs}
</footer>
<script type="application/json" id="content">{_json(content)}</script>
<script type="module">{starter}</script>
</body>
</html>
"""


def _image(still: Still) -> str:
    (width, height), text = still.size, escape_text(still.description)
    return f'<img src="{_data_url(still.data)}" width="{width}" height="{height}" alt="{text}">'


def escape_text(value: Any) -> str:
    """Return a user's text for an element or an attribute, on one line."""
    # Not printable: control characters, half surrogates of file names, U+2028.
    line = "".join(c if c.isprintable() else " " for c in str(value))
    return html.escape(" ".join(line.split()))


def _json(value: Any) -> str:
    """Return JSON without characters that have a meaning in HTML."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _checked_code(tag: str, text: str) -> str:
    """Return code for an element; raises ValueError if the code would end that element."""
    text = text.strip().replace("\r\n", "\n")
    if f"</{tag}" in text.lower() or "<!--" in text:
        raise ValueError(f"The built front end holds </{tag} or <!--, which HTML would misread.")
    return text


def _hash(code: str) -> str:
    digest = hashlib.sha256(code.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


def _data_url(data: bytes) -> str:
    kind = next((kind for start, kind in _TYPES.items() if data.startswith(start)), "image/jpeg")
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


def _version() -> str:
    from sunwidget.version import __version__

    return __version__
