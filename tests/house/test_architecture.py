"""How the house is built: who may know whom, how large a file may be, what it says of itself."""

import ast
import graphlib
import importlib
import re
import statistics

import pytest


def imports(path, root):
    """Yield the sunwidget modules that a file imports, wherever in the file."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                is_module = (root / inner.replace(".", "/")).with_suffix(".py").exists()
                yield inner if is_module else node.module


@pytest.fixture(scope="module")
def graph(root):
    """The sunwidget modules that each of them imports."""
    graph = {}
    for path in sorted((root / "sunwidget").rglob("*.py")):
        name = ".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__")
        found = {module for module in imports(path, root) if module.startswith("sunwidget.")}
        graph[name] = found - {name}
    return graph


# Who may know whom. A room that is not named here may be known by all.
FORBIDDEN = {
    "analysis": ("widgets", "explorer", "renderer", "export", "cli", "demo", "doctor"),
    "renderer": ("widgets", "explorer", "photo", "decode", "export", "cli", "demo", "doctor"),
    "atmosphere": (
        "widgets",
        "explorer",
        "renderer",
        "export",
        "cli",
        "analysis",
        "photo",
        "demo",
        "doctor",
    ),
    "dome": ("widgets", "explorer", "renderer", "export", "cli", "demo", "doctor"),
    "camera": ("widgets", "renderer", "export", "cli", "analysis", "demo", "doctor"),
    "edit": ("widgets", "renderer", "export", "cli", "analysis", "photo", "demo", "doctor"),
    "photo": ("widgets", "renderer", "export", "cli", "analysis", "demo", "doctor"),
    "explorer": ("widgets", "export", "cli", "analysis", "photo", "demo", "doctor"),
    "export": ("widgets", "cli", "demo", "doctor"),
    "widgets": ("cli", "demo", "doctor"),
}


def room(module):
    return module.split(".")[1] if "." in module else ""


def type_only(path, target):
    """Tell whether ``target`` is imported under TYPE_CHECKING alone: no run-time dependency."""
    text = path.read_text("utf-8")
    block = re.search(r"^if TYPE_CHECKING:\n((?:[ \t]+.*\n|\n)+)", text, re.MULTILINE)
    outside = text.replace(block.group(0), "") if block else text
    return block is not None and target in block.group(0) and f"from {target} " not in outside


def module_file(root, module):
    path = root / module.replace(".", "/")
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def test_dependencies_point_one_way(graph, root):
    assert len(graph) > 20
    wrong = [
        f"{module} → {target}"
        for module, targets in graph.items()
        for target in targets
        if room(target) in FORBIDDEN.get(room(module), ())
        and not type_only(module_file(root, module), target)
    ]
    assert wrong == []


def test_no_module_imports_itself_in_a_circle(graph, root):
    at_run_time = {
        module: {t for t in targets if not type_only(module_file(root, module), t)}
        for module, targets in graph.items()
    }
    # static_order raises CycleError, which names the circle.
    assert list(graphlib.TopologicalSorter(at_run_time).static_order())


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


@pytest.mark.parametrize("pattern", SOURCES)
def test_files_are_small_enough_to_be_read_at_a_sitting(root, pattern):
    lines = {
        path.relative_to(root).as_posix(): path.read_text("utf-8").count("\n")
        for path in root.glob(pattern)
    }
    assert len(lines) > 20
    # The largest holds the one table of parameters.
    assert {name: count for name, count in lines.items() if count > 600} == {}
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
