"""Write docs/parameters.md from the one parameter table.

usage: python scripts/parameter_page.py
"""

from __future__ import annotations

import itertools
from pathlib import Path

from sunwidget.edit import PARAMETERS, RECIPE_VERSION, Parameter

PAGE = Path(__file__).resolve().parents[1] / "docs" / "parameters.md"

HEAD = f"""# Parameters

Every number a person can set, as the one table in `sunwidget/edit.py` lists them: the fields of
`sw.Edit`, the traits and sliders of the editor, the flags of the command line (`--sun-elevation`)
and the keys of a recipe (version {RECIPE_VERSION}). *From the photo* is what the analysis found;
an edit that names nothing moves nothing.

This page is written by `python scripts/parameter_page.py`.
"""


def row(p: Parameter) -> str:
    """Return one line of the table."""
    if p.kind == "number":
        span = f"{p.minimum:g} … {p.maximum:g} {p.unit}".strip()
        default = "from the photo" if p.default is None else f"{p.default:g}"
    elif p.kind == "choice":
        span, default = ", ".join(f"`{choice}`" for choice in p.choices), f"`{p.default}`"
    else:
        span, default = "recipe only", "none"
    return f"| `{p.name}` | {p.label} | {span} | {default} | {p.help} |"


def page() -> str:
    """Return the whole page."""
    parts = [HEAD]
    for section, rows in itertools.groupby(PARAMETERS, key=lambda p: p.section):
        parts.append(f"\n## {section.capitalize()}\n")
        parts.append("| name | label | range | default | meaning |\n|---|---|---|---|---|")
        parts.extend(row(p) for p in rows)
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
