"""What sunwidget needs of others: nothing undeclared, nothing idle, and a reason for each."""

import ast
import importlib.metadata
import re
import sys
import tomllib

import pytest

# Import names that a distribution does not tell by itself.
TOLD_HERE = {
    "OpenEXR": "openexr",
    "torch": "torch",
    "onnx": "onnx",
    "atheris": "atheris",
    "bpy": "bpy",
    "mathutils": "bpy",
}

# What works without being imported by us, and where it is asked for.
ASKED_FOR_OTHERWISE = {
    "ipywidgets": "anywidget's widgets are its widgets",
    "jupyterlab": "make lab; the browser tests run a server of it",
    "build": "makes the wheel of test_wheel.py and of make wheel",
    "defusedxml": "Pillow's getxmp imports it",
    "hatchling": "the build's backend, hatch_build.py is its hook",
    "notebook": "the browser tests run a server of it",
    "mypy": "scripts/check.sh",
    "ruff": "scripts/check.sh",
    "pytest-cov": "make coverage",
    "pytest-rerunfailures": "marks of tests/browser/conftest.py",
    "onnxscript": "torch.onnx.export imports it",
    "pytest-timeout": "the limit in pyproject.toml",
    "pytest-xdist": "scripts/check.sh runs two workers",
}

CODE = {
    "run": ("sunwidget",),
    "test": ("tests", "bench", "scripts"),
    "train": ("training",),
}


def canonical(name):
    return re.sub(r"[-_.]+", "-", name).lower()


@pytest.fixture(scope="module")
def declared(root):
    """Names of the required distributions by extra; what is always needed is "run"."""
    project = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]
    lists = {"run": project["dependencies"], **project["optional-dependencies"]}
    return {
        extra: {canonical(re.match(r"[\w.-]+", line)[0]) for line in lines} - {"sunwidget"}
        for extra, lines in lists.items()
    }


@pytest.fixture(scope="module")
def imported(root):
    """Names of the distributions that the code of each kind imports, with one file of each."""
    owners = {
        name: {canonical(d) for d in distributions}
        for name, distributions in importlib.metadata.packages_distributions().items()
    }
    # Files and folders of the code beside the package, which it finds by its path.
    ours = {
        path.stem
        for folders in CODE.values()
        for folder in folders
        for path in (root / folder).rglob("*")
        if path.suffix in {".py", ""}
    }
    found = {}
    for kind, folders in CODE.items():
        found[kind] = {}
        for path in (path for folder in folders for path in (root / folder).rglob("*.py")):
            for name in imports(path) - sys.stdlib_module_names - ours - {"sunwidget", "training"}:
                home = {TOLD_HERE[name]} if name in TOLD_HERE else owners.get(name, {name})
                for distribution in home:
                    found[kind].setdefault(distribution, path.relative_to(root).as_posix())
    return found


def imports(path):
    """Return the top-level names that a file imports, wherever in the file."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names.add(node.module.split(".")[0])
        elif isinstance(node, ast.Call) and ast.unparse(node.func) == "pytest.importorskip":
            names.add(node.args[0].value.split(".")[0])
    return names


def test_the_package_imports_nothing_that_it_does_not_declare(declared, imported):
    known = set().union(*(names for extra, names in declared.items() if extra != "train"))
    # colour-science, of the extra for tests, is imported by generate_constants.py alone.
    assert imported["run"].keys() - known == set()


def test_the_tests_import_nothing_that_the_extra_does_not_bring(declared, imported):
    brought = set().union(*(names for extra, names in declared.items() if extra != "train"))
    assert imported["test"].keys() - brought == set()
    assert imported["train"].keys() - declared["run"] - declared["train"] == set()


def test_every_dependency_is_used(declared, imported):
    every = set().union(*declared.values())
    used = set().union(*imported.values())
    assert every - used - ASKED_FOR_OTHERWISE.keys() == set()
    assert ASKED_FOR_OTHERWISE.keys() <= every - used


def test_what_is_always_installed_serves_the_package_itself(declared, imported):
    assert declared["run"] - imported["run"].keys() - {"ipywidgets"} == set()


def test_the_page_gives_a_reason_for_every_dependency_and_no_other(declared, root):
    page = (root / "docs" / "developer" / "dependencies.md").read_text("utf-8")
    listed = re.findall(r"^\| `([\w.-]+)` \|", page, re.MULTILINE)
    assert sorted(map(canonical, listed)) == sorted(set().union(*declared.values()))
