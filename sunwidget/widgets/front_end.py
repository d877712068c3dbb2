"""Where a widget's built front end lies."""

from pathlib import Path

_STATIC = Path(__file__).parents[1] / "static"


def front_end(name: str, widget: str) -> tuple[Path, Path]:
    """Return the script and the style sheet of a widget.

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
    return script, script.with_suffix(".css")
