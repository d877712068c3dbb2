"""A widget's built front end."""

from pathlib import Path

_STATIC = Path(__file__).parents[2] / "static"


def front_end(name: str, widget: str) -> tuple[str, str]:
    """Return the texts of the script and the style sheet of a widget.

    The texts, not the paths: anywidget watches a file for every widget made with it, and so keeps
    each of them, scene and all, for ever.

    Parameters
    ----------
    name : str
        Of the files, without what follows the dot.
    widget : str
        As people call it.

    Raises
    ------
    ImportError
        When they are not built; the message says how to.
    """
    script = _STATIC / f"{name}.js"
    if not script.is_file():
        raise ImportError(
            f"sunwidget's front end is not built, so there is no {widget}. In a checkout run "
            "`make build` (Node 20 or newer); an installed package brings it along."
        )
    return script.read_text("utf-8"), script.with_suffix(".css").read_text("utf-8")
