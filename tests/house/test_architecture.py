"""How the house is built: who may know whom, how large a file may be, what it says of itself."""

import ast
import graphlib
import importlib
import os
import re
import statistics
from pathlib import Path

import pytest

# A room imports only rooms above it. Imports for type checkers count, too.
ROOMS = [
    "version",
    "errors",
    "messages",
    "progress",
    "cache",
    "files",
    "atmosphere",
    "geometry",
    "formats",
    "edit",
    "photo",
    "samples",
    "analysis",
    "presets",
    "renderer",
    "explorer",
    "validation",
    "study",
    "dome",
    "export",
    "film",
    "transfer",
    "batches",
    "timelapses",
    "widgets",
    "cli",
]

# The same inside analysis/.
STAGES = [
    "images",
    "fit",
    "networks",
    "horizon",
    "sun",
    "segmentation",
    "backdrop",
    "depth",
    "water",
    "clouds",
    "windows",
    "haze",
    "hints",
    "notices",
    "memory",
    "scene",
    "clear_sky",
    "frame_inputs",
    "maps",
    "heading",
    "place_resolver",
    "pipeline",
    "strokes",
    "correct",
    "analyze",
]

FRONT_END = [
    "host",
    "geometry",
    "gl",
    "film",
    "edit",
    "ui",
    "editor",
    "explorer",
    "compare",
    "study",
    "standalone",
]

# Effects include each other both ways (clouds dim the sky, the sky lights clouds), but no pass
# of the editor's frame needs what another picture is made of.
APART = ("thesis", "explorer", "bruneton")


def imports(path, root):
    """Yield the modules of ours that a file imports, wherever in the file."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                file = root / inner.replace(".", "/")
                yield inner if file.with_suffix(".py").exists() or file.is_dir() else node.module


@pytest.fixture(scope="module")
def graph(root):
    """The sunwidget modules that each of them imports."""
    graph = {}
    for path in sorted((root / "sunwidget").rglob("*.py")):
        name = ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")
        found = {module for module in imports(path, root) if module.split(".")[0] == "sunwidget"}
        graph[name] = found - {name}
    return graph


def wrong_way(edges, order):
    """Arrows between two names of ``order`` that do not point upwards in it."""
    return [
        f"{source} → {target}"
        for source, target, a, b in edges
        if a != b and order.index(a) <= order.index(b)
    ]


def test_rooms_import_only_rooms_above_them(graph):
    assert len(graph) > 200
    edges = [
        (source, target, source.split(".")[1], target.split(".")[1])
        for source, targets in graph.items()
        if source not in ("sunwidget", "sunwidget.__main__")
        for target in targets
        if target != "sunwidget"
    ]
    assert wrong_way(edges, ROOMS) == []


def test_no_module_imports_the_whole_package_but_to_find_its_folder(graph):
    knowing = {name for name, targets in graph.items() if "sunwidget" in targets}
    # The command line does what any user does.
    rest = {name for name in knowing if not name.startswith("sunwidget.cli.")}
    assert rest == {"sunwidget.photo.decode_apart", "sunwidget.batches.cluster"}


def test_every_room_is_in_the_list(graph):
    assert {name.split(".")[1] for name in graph if "." in name} - {"__main__"} == set(ROOMS)
    inside = {n.split(".")[2] for n in graph if n.startswith("sunwidget.analysis.")}
    assert inside == set(STAGES)


def test_stages_of_the_analysis_import_only_stages_above_them(graph):
    def stage(module):
        return module.split(".")[2] if module.startswith("sunwidget.analysis.") else None

    edges = [
        (source, target, stage(source), stage(target))
        for source, targets in graph.items()
        for target in targets
        if stage(source) and stage(target)
    ]
    assert len(edges) > 100
    assert wrong_way(edges, STAGES) == []


def test_no_module_imports_itself_in_a_circle(graph):
    # static_order raises CycleError, which names the circle. The top names all that is public.
    rest = {name: targets - {"sunwidget"} for name, targets in graph.items() if "." in name}
    assert list(graphlib.TopologicalSorter(rest).static_order())


JS_IMPORT = re.compile(r"""(?:from|import)\s*\(?\s*["'](\.{1,2}/[^"']+)["']""")


@pytest.fixture(scope="module")
def front_end(root):
    """The files of js/src that each of them imports. JSDoc's import("…") counts as one."""
    source = root / "js" / "src"
    return {
        path.relative_to(source).as_posix(): {
            Path(os.path.normpath(path.parent / target)).relative_to(source).as_posix()
            for target in JS_IMPORT.findall(path.read_text("utf-8"))
        }
        for path in sorted(source.rglob("*.js"))
    }


def test_rooms_of_the_front_end_import_only_rooms_above_them(front_end):
    edges = [
        (source, target, source.split("/")[0], target.split("/")[0])
        for source, targets in front_end.items()
        for target in targets
    ]
    assert len(edges) > 400
    assert wrong_way(edges, FRONT_END) == []


# A list says what each of a widget's parts takes of the view. No other part names the view.
PART_LISTS = {"editor": {"editor/parts.js"}, "explorer": set(), "compare": set()}
FEWEST_FILES = {"editor": 60, "explorer": 25, "compare": 8}


def view_of(room, front_end):
    (view,) = [name for name in front_end if re.fullmatch(rf"{room}/(.+/)?view\.js", name)]
    return view


@pytest.mark.parametrize("room", PART_LISTS)
def test_parts_of_a_widget_know_what_they_need_and_not_its_view(root, front_end, room):
    view = view_of(room, front_end)
    knowing = {name for name, targets in front_end.items() if view in targets}
    assert knowing == {f"{room}/index.js"} | PART_LISTS[room]
    types = [path.read_text("utf-8") for path in (root / "js" / "src" / room).rglob("*.d.ts")]
    assert types
    assert not any("/view.js" in text for text in types)


@pytest.mark.parametrize("room", PART_LISTS)
def test_no_file_of_a_widget_imports_itself_in_a_circle(front_end, room):
    graph = {name: targets for name, targets in front_end.items() if name.startswith(f"{room}/")}
    for name in PART_LISTS[room]:
        graph[name] = graph[name] - {view_of(room, front_end)}
    assert len(graph) > FEWEST_FILES[room]
    assert list(graphlib.TopologicalSorter(graph).static_order())


def test_shaders_of_other_pictures_are_included_by_those_alone(root):
    folder = root / "sunwidget" / "shaders"
    wrong = [
        (path.relative_to(folder).as_posix(), name)
        for path in folder.rglob("*.glsl")
        for name in re.findall(r'^ *#include "([^"]+)"', path.read_text("utf-8"), re.MULTILINE)
        if name.split("/")[0] in APART and path.parent.name != name.split("/")[0]
    ]
    assert wrong == []


def test_every_module_imports_on_its_own(graph):
    for module in graph:
        assert importlib.import_module(module)


def python_files(root):
    return sorted((root / "sunwidget").rglob("*.py"))


def test_every_module_says_what_it_is_for(root):
    silent = [
        path.relative_to(root).as_posix()
        for path in python_files(root)
        if not ast.get_docstring(ast.parse(path.read_text("utf-8")))
    ]
    assert silent == []


SOURCES = ("sunwidget/**/*.py", "js/src/**/*.js", "js/src/**/*.css", "sunwidget/shaders/**/*.glsl")
TABLES = {"sunwidget/edit/table.py"}  # data: one row a parameter


@pytest.mark.parametrize("pattern", SOURCES)
def test_files_are_small_enough_to_be_read_at_a_sitting(root, pattern):
    lines = {
        path.relative_to(root).as_posix(): path.read_text("utf-8").count("\n")
        for path in root.glob(pattern)
    }
    assert len(lines) > 20
    assert {name for name, count in lines.items() if count > 400} - TABLES == set()
    assert statistics.median(lines.values()) <= 150


# A thing that has no better name has no home yet.
HOMELESS = re.compile(r"(^|_)(utils?|helpers?|common|misc|shared|stuff|base)$")


def test_no_file_is_named_after_nothing(root):
    found = [
        path.relative_to(root).as_posix()
        for folder in ("sunwidget", "js/src", "js/test", "tests", "bench", "scripts", "training")
        for path in (root / folder).rglob("*")
        if path.suffix in {".py", ".js", ".glsl"} and HOMELESS.search(path.stem)
    ]
    assert found == []


def test_no_two_test_files_share_a_name(root):
    names = [path.name for path in (root / "tests").rglob("*.py") if path.name != "conftest.py"]
    assert len(names) == len(set(names))
