"""Write docs/guide/api.md from the signatures and docstrings of the public names.

usage: python scripts/api_reference.py
"""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from docstring_parser import Docstring, DocstringStyle, parse
from docstring_parser.common import DocstringExample, DocstringMeta, DocstringParam

import sunwidget

PAGE = Path(__file__).resolve().parents[1] / "docs" / "guide" / "api.md"

GROUPS = {
    "Photo and analysis": (
        *("open", "sample", "analyze", "Photo", "Scene", "Camera", "SkyNetwork", "Stroke"),
        "corrected",
        *("analyze_dome", "Dome"),
    ),
    "Edits": ("Edit", "preset", "Place", "Day", "PARAMETERS", "PRESETS"),
    "Pictures, films, pages": (
        *(
            "render",
            "save",
            "sweep",
            "contact_sheet",
            "timelapse",
            "environment_map",
            "to_dome",
            "to_html",
        ),
        *("batch", "BatchReport"),
    ),
    "Other photos' skies and looks": ("replace_sky", "transfer_look"),
    "Widgets": ("SunEditor", "SkyExplorer", "Compare", "Study"),
    "Errors and warnings": (
        *("PhotoError", "PhotoWarning", "AnalysisError", "EditError", "RendererError"),
        "StudyError",
    ),
}

HEAD = """# API reference

`import sunwidget as sw`. All that is listed here is public; what is not may change. Every
[parameter](parameters.md) of `sw.Edit` is also a trait of `sw.SunEditor`, and those of the explorer
are traits of `sw.SkyExplorer`. Images are (H, W, 3), maps (H, W); angles are degrees, distances
metres.

This page is written by `python scripts/api_reference.py` from the docstrings.
"""

DATA = {
    "PARAMETERS": "Every row of the table of parameters, a tuple of `Parameter` (name, kind, "
    "default, minimum, maximum, unit, label, help): what [parameters.md](parameters.md) prints.",
    "PRESETS": "The times of day that `sw.preset` knows, a tuple of `Preset`.",
}

WIDTH = 88  # of a signature in a code block


def page() -> str:
    """Return the whole page."""
    parts = [HEAD]
    for group, names in GROUPS.items():
        links = " · ".join(f"[{name}](#{anchor(heading(name))})" for name in names)
        parts.append(f"**{group}**: {links}\n")
    for group, names in GROUPS.items():
        parts.append(f"## {group}\n")
        for name in names:
            parts.extend(entry(name))
    return "\n".join(parts)


def heading(name: str) -> str:
    """Return what stands above a public name."""
    return f"sw.{name}"


def anchor(text: str) -> str:
    """Return GitHub's anchor of a heading."""
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def entry(name: str) -> Iterator[str]:
    """Yield the Markdown of one public name."""
    value = getattr(sunwidget, name)
    yield f"### {heading(name)}\n"
    if name in DATA:
        yield f"{DATA[name]}\n"
        return
    if inspect.isclass(value) and issubclass(value, Exception):
        yield f"{prose(inspect.getdoc(value) or '')} A kind of `{value.__base__.__name__}`.\n"
        return
    if not (inspect.isclass(value) and made_elsewhere(value)):
        yield signature(f"sw.{name}", value)
    yield from description(value)
    if inspect.isclass(value):
        found = dict(members(value))
        plain = {name: value for name, value in found.items() if not callable_on(value)}
        if plain:
            yield "*Properties*\n"
            yield "\n".join(format_property(name, value) for name, value in plain.items()) + "\n"
        for member, what in found.items():
            if member not in plain:
                yield f"#### {name}.{member}\n"
                yield signature(f"{name}.{member}", unwrapped(what))
                yield from description(unwrapped(what))


def made_elsewhere(kind: type) -> bool:
    """Whether a class is made by a function, and its own signature concerns nobody."""
    return "Made by" in (inspect.getdoc(kind) or "")


def members(kind: type) -> Iterator[tuple[str, Any]]:
    """Yield the public methods and properties of a class that are its own, not its toolkit's."""
    foreign = {
        name
        for base in kind.__mro__
        if not base.__module__.startswith("sunwidget")
        for name in vars(base)
    }
    for name, value in inspect.getmembers_static(kind):
        function = unwrapped(value)
        if name[0] != "_" and name not in foreign and inspect.isfunction(function):
            yield name, value


def unwrapped(value: Any) -> Any:
    """Return the function behind a method, property or class method."""
    value = getattr(value, "fget", None) or getattr(value, "func", None) or value
    return getattr(value, "__func__", value)


def callable_on(value: Any) -> bool:
    """Whether a member is a method, and not a property."""
    return inspect.isfunction(value) or isinstance(value, (classmethod, staticmethod))


def format_property(name: str, value: Any) -> str:
    """Return a property as one entry of a list."""
    text = " ".join((inspect.getdoc(unwrapped(value)) or "").split())
    return f"- `{name}`. {prose(text)}"


def signature(name: str, function: Callable[..., Any]) -> str:
    """Return a code block with the signature, a parameter a line when it is long."""
    found = inspect.signature(function)
    row, keyword_only = [], False
    for p in found.parameters.values():
        if p.name in {"self", "cls"}:
            continue
        if p.kind is p.KEYWORD_ONLY and not keyword_only:
            keyword_only = True
            row.append("*")
        if p.kind is p.VAR_POSITIONAL:
            keyword_only = True
        star = {p.VAR_POSITIONAL: "*", p.VAR_KEYWORD: "**"}.get(p.kind, "")
        kind = "" if p.annotation is p.empty else f": {p.annotation}"
        default = "" if p.default is p.empty else f"{' = ' if kind else '='}{p.default!r}"
        row.append(f"{star}{p.name}{kind}{default}")
    result = found.return_annotation
    shown = isinstance(result, str) and not inspect.isclass(function)
    end = f") -> {result}" if shown else ")"
    text = f"{name}({', '.join(row)}{end}"
    if len(text) > WIDTH:
        text = f"{name}(\n" + "".join(f"    {part},\n" for part in row) + end
    return f"```python\n{text}\n```\n"


def description(value: Any) -> Iterator[str]:
    """Yield a docstring as Markdown: summary, text, and its sections."""
    doc = parse(inspect.getdoc(value) or "", DocstringStyle.NUMPYDOC)
    yield f"{prose(doc.short_description or '')}\n"
    if doc.long_description:
        yield f"{prose(doc.long_description)}\n"
    for title, found in sections(doc):
        yield f"*{title}*\n"
        yield "\n".join(found) + "\n"
    examples = [m for m in doc.meta if isinstance(m, DocstringExample)]
    if examples:
        lines = "\n".join(m.snippet or m.description or "" for m in examples)
        lines = re.sub(r"^(>>>|\.\.\.) ?", "", lines, flags=re.MULTILINE)
        yield f"```python\n{lines.strip()}\n```\n"


def sections(doc: Docstring) -> Iterator[tuple[str, list[str]]]:
    """Yield the sections that a docstring has, as lists."""
    attributes = [p for p in doc.params if p.args[0] == "attribute"]
    parameters = [p for p in doc.params if p not in attributes]
    for title, found in (("Parameters", parameters), ("Attributes", attributes)):
        if found:
            yield title, [bullet(p.arg_name, kind(p), p) for p in found]
    if doc.many_returns:
        yield "Returns", [bullet(r.return_name, r.type_name, r) for r in doc.many_returns]
    if doc.raises:
        yield "Raises", [bullet(r.type_name, None, r) for r in doc.raises]


def kind(parameter: DocstringParam) -> str | None:
    """Return the type of a parameter as its docstring says it."""
    optional = ", optional" if parameter.is_optional and parameter.type_name else ""
    return f"{parameter.type_name}{optional}" if parameter.type_name else None


def bullet(name: str | None, type_name: str | None, meta: DocstringMeta) -> str:
    """Return one line of a list."""
    head = f"`{name}`" if name else ""
    if type_name:
        head += f"{': ' if name else ''}{prose(type_name)}"
    text = prose(meta.description or "")
    return textwrap.indent(f"{head}. {text}" if text else head, "  ").replace("  ", "- ", 1)


def prose(text: str) -> str:
    """Turn reStructuredText as the docstrings use it into Markdown."""
    text = re.sub(r":\w+:`([^`]+)`", r"``\1``", text)
    parts = re.split(r"``(.+?)``", text)
    for index, part in enumerate(parts):
        parts[index] = f"`{part}`" if index % 2 else re.sub(r"([*<]|\b_|_\b)", r"\\\1", part)
    return "".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
