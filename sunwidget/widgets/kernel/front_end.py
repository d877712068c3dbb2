"""A widget's built front end."""

from pathlib import Path

_STATIC = Path(__file__).parents[2] / "static"


def front_end(name: str, widget: str) -> tuple[str, str]:
    """Return the text of a widget's script and of its style sheet.

    With paths instead of texts, anywidget would watch the files for every widget and thereby keep
    each widget and its scene alive.

    Parameters
    ----------
    name : str
        Name of the files without extension.
    widget : str
        Name of the widget in messages.

    Raises
    ------
    ImportError
        When the files are not built; the message gives the remedy.
    """
    script = _STATIC / f"{name}.js"
    if not script.is_file():
        raise ImportError(
            f"sunwidget's front end is not built, so {widget} is unavailable. In a checkout run "
            "`make build` (Node 20 or newer); an installed package includes it."
        )
    return script.read_text("utf-8"), script.with_suffix(".css").read_text("utf-8")
