"""Write docs/guide/parameters.md from the parameter tables of Edit and of SkyExplorer.

usage: python scripts/parameter_page.py
"""

from __future__ import annotations

import itertools
from pathlib import Path

from sunwidget.edit.table import PARAMETERS, RECIPE_VERSION, Parameter
from sunwidget.explorer.table import EXPLORER_PARAMETERS

PAGE = Path(__file__).resolve().parents[1] / "docs" / "guide" / "parameters.md"

HEAD = f"""# Parameters

Every number a person can set, as the one table in `sunwidget/edit/table.py` lists them: the fields
of `sw.Edit`, the traits and sliders of the editor, the flags of the command line
(`--sun-elevation`) and the keys of a recipe (version {RECIPE_VERSION}). *From the photo* is what
the analysis found; an edit that names nothing moves nothing.

This page is written by `python scripts/parameter_page.py`.
"""

EXPLORER = """
# Parameters of SkyExplorer

Traits and keywords of `sw.SkyExplorer`, from `sunwidget/explorer/table.py`; `turbidity` and
`visibility` (metres) are other names of `aerosol_optical_depth`. A switch is `True` or `False`.
"""


def row(p: Parameter) -> str:
    """Return one line of the table."""
    if p.kind == "number":
        span = f"{p.minimum:g} … {p.maximum:g} {p.unit}".strip()
        default = "from the photo" if p.default is None else f"{p.default:g}"
    elif p.kind == "choice":
        span, default = ", ".join(f"`{choice}`" for choice in p.choices), f"`{p.default}`"
    elif p.kind == "switch":
        span, default = "switch", f"`{p.default}`"
    elif p.maximum > p.minimum:
        span, default = f"{p.minimum:g} … {p.maximum:g} {p.unit}".strip(), "none"
    else:
        span, default = ("YYYY-MM-DD" if p.name == "date" else "recipe only"), "none"
    return f"| `{p.name}` | {p.label} | {span} | {default} | {p.help} |"


def tables(parameters: tuple[Parameter, ...], level: str) -> list[str]:
    """Return one table a section, below headings of a level."""
    parts = []
    for section, rows in itertools.groupby(parameters, key=lambda p: p.section):
        parts.append(f"\n{level} {section.capitalize()}\n")
        parts.append("| name | label | range | default | meaning |\n|---|---|---|---|---|")
        parts.extend(row(p) for p in rows)
    return parts


def page() -> str:
    """Return the whole page."""
    parts = [HEAD, *tables(PARAMETERS, "##"), EXPLORER, *tables(EXPLORER_PARAMETERS, "##")]
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
