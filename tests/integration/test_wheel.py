"""What is sent out: an sdist, the wheel made from it, and an environment that has it alone."""

import email
import email.message
import gzip
import json
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

# Everything that may lie in the package, beside its Python. A file that fits none is a stray.
KINDS = (
    r".*\.py",
    r"py\.typed",
    r"samples/\w+\.jpg",
    r"shaders/\w+/\w+\.glsl",
    r"shaders/\w+\.json",
    r"atmosphere/constants\.json",
    r"analysis/models/(sky\.onnx|suns\.onnx|land\.onnx|panes\.onnx|MODEL_CARD\.md)",
    r"static/\w+\.(js|css)",
)

# Bytes of each front end, plain and as gzip: a notebook saves it with every widget.
BUDGETS = {
    "sun_editor": (335_000, 105_000),
    "sky_explorer": (300_000, 100_000),
    "compare": (300_000, 100_000),
    "study": (120_000, 40_000),
}


@pytest.fixture(scope="module")
def built(root, tmp_path_factory):
    """The sdist and the wheel that is made from it, as they go to an index."""
    if not any((root / "sunwidget" / "static").glob("*.js")):
        pytest.skip("the front end is not built (make build)")
    folder = tmp_path_factory.mktemp("built")
    subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, root],
        check=True,
        capture_output=True,
    )
    [sdist], [wheel] = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return sdist, wheel


@pytest.fixture(scope="module")
def names(built):
    with zipfile.ZipFile(built[1]) as archive:
        return set(archive.namelist())


@pytest.fixture(scope="module")
def metadata(built) -> email.message.Message:
    with zipfile.ZipFile(built[1]) as archive:
        [name] = [name for name in archive.namelist() if name.endswith(".dist-info/METADATA")]
        return email.message_from_bytes(archive.read(name))


@pytest.fixture(scope="module")
def project(root):
    return tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["project"]


def test_the_wheel_brings_one_package_and_its_record(names, project):
    record = f"sunwidget-{project['version']}.dist-info"
    assert {name.split("/")[0] for name in names} == {"sunwidget", record}
    assert {name for name in names if name.startswith(record)} == {
        f"{record}/{name}"
        for name in ("METADATA", "RECORD", "WHEEL", "entry_points.txt", "licenses/LICENSE")
    }


def test_the_wheel_holds_every_file_of_the_package(names, root):
    here = {
        path.relative_to(root).as_posix()
        for path in (root / "sunwidget").rglob("*")
        # A hidden file is a stamp of make.
        if path.is_file()
        and "__pycache__" not in path.parts
        and not path.name.startswith(".")
        and path.suffix != ".map"  # for who debugs in a checkout
    }
    assert {name for name in names if name.startswith("sunwidget/")} == here


def test_the_wheel_holds_nothing_that_strayed_in(names):
    inside = (name.removeprefix("sunwidget/") for name in names if name.startswith("sunwidget/"))
    assert not [name for name in inside if not any(re.fullmatch(kind, name) for kind in KINDS)]


def test_the_wheel_holds_each_widget_with_its_style(names):
    for bundle in ("sun_editor", "sky_explorer", "compare", "study"):
        assert {f"sunwidget/static/{bundle}.js", f"sunwidget/static/{bundle}.css"} <= names
    assert "sunwidget/static/standalone.js" in names


def test_each_front_end_is_within_its_budget_and_names_no_machine_and_no_map(built, root):
    with zipfile.ZipFile(built[1]) as archive:
        codes = {name: archive.read(f"sunwidget/static/{name}.js") for name in BUDGETS}
    for name, code in codes.items():
        small = gzip.compress(code, 9)
        print(f"{name}: {len(code) / 1000:.1f} kB, gzip {len(small) / 1000:.1f} kB")
        most, most_small = BUDGETS[name]
        assert len(code) <= most
        assert len(small) <= most_small
        assert str(root).encode() not in code
        assert b"sourceMappingURL" not in code  # a notebook has nowhere to fetch it from
    assert b"Leon Sorokin" in codes["sky_explorer"]  # uPlot's licence


def test_the_wheel_is_small_enough_to_install_anywhere(built):
    assert built[1].stat().st_size < 16e6


def test_the_wheel_tells_what_the_project_file_tells(metadata, project):
    assert metadata["Name"] == project["name"]
    assert metadata["Version"] == project["version"]
    assert metadata["Requires-Python"] == project["requires-python"]
    assert metadata["License-Expression"] == project["license"]
    assert metadata.get_all("Classifier") == project["classifiers"]
    assert set(metadata.get_all("Provides-Extra")) == {
        name.replace("_", "-") for name in project["optional-dependencies"]
    }
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert metadata.get_payload().startswith("# sunwidget")


def test_what_the_wheel_needs_without_extras_is_the_list_of_dependencies(metadata, project):
    def parts(requirement):
        return re.match(r"([\w.-]+)(.*)", requirement.replace(" ", "")).groups()

    needed = [r for r in metadata.get_all("Requires-Dist") if "extra ==" not in r]
    assert {parts(r) for r in needed} == {parts(r) for r in project["dependencies"]}


def test_a_classifier_stands_for_every_python_from_the_oldest_on(project):
    versions = [
        tuple(map(int, found[1].split(".")))
        for line in project["classifiers"]
        if (found := re.fullmatch(r"Programming Language :: Python :: (\d+\.\d+)", line))
    ]
    oldest = tuple(map(int, project["requires-python"].removeprefix(">=").split(".")))
    assert versions[0] == oldest
    assert versions == [(3, minor) for minor in range(oldest[1], versions[-1][1] + 1)]
    assert sys.version_info[:2] in versions


def test_the_sdist_holds_what_a_wheel_is_built_and_tested_from(built, root):
    with tarfile.open(built[0]) as archive:
        held = {name.split("/", 1)[1] for name in archive.getnames()}
    assert {
        "pyproject.toml",
        "hatch_build.py",
        "LICENSE",
        "README.md",
        "js/package-lock.json",
        "js/src/editor/index.js",
        "sunwidget/static/sun_editor.js",
        "tests/conftest.py",
    } <= held
    assert not [name for name in held if "node_modules" in name or "__pycache__" in name]


@pytest.fixture(scope="module")
def alone(built, tmp_path_factory):
    """The Python of an environment that has the built wheel, and the dependencies of this one."""
    home = tmp_path_factory.mktemp("alone")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", home], check=True)
    python = home / "bin" / "python"
    subprocess.run(
        [
            *(sys.executable, "-m", "pip", "--python", python),
            *("install", "--quiet", "--no-deps", "--no-index", built[1]),
        ],
        check=True,
    )
    # Folders of a .pth come last and their own .pth files are not read: what is installed here in
    # place of the wheel, the checkout, stays out of sight.
    [packages] = (home / "lib").glob("python*/site-packages")
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n", "utf-8")
    return python


def run_alone(folder, *command):
    surroundings = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        command,
        cwd=folder,
        check=False,
        env=surroundings,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


JOURNEY = """
import json
from pathlib import Path

import sunwidget as sw

scene = sw.analyze(sw.sample("coast").preview(96))
picture = sw.render(scene, sw.Edit(sun_elevation=4))
saved = sw.save((scene, sw.Edit(sun_elevation=4)), "evening.png")
page = sw.to_html(scene, sw.Edit(sun_elevation=4), "page.html")
widgets = [sw.SunEditor(scene), sw.SkyExplorer()]
print(json.dumps({
    "home": sw.__file__,
    "version": sw.__version__,
    "shape": picture.shape,
    "files": sorted(path.name for path in Path().iterdir()),
    "bundles": [len(widget._esm) for widget in widgets],
}))
"""


def test_the_installed_wheel_goes_the_whole_way_without_the_checkout(alone, tmp_path, project):
    told = json.loads(run_alone(tmp_path, alone, "-c", JOURNEY).splitlines()[-1])
    assert Path(told["home"]).is_relative_to(alone.parents[1])
    assert told["version"] == project["version"]
    assert told["shape"][2] == 3
    assert told["files"] == ["evening.png", "page.html"]
    assert min(told["bundles"]) > 10_000


def test_the_installed_command_answers(alone, tmp_path, project):
    command = alone.parent / "sunwidget"
    assert run_alone(tmp_path, command, "--version").strip() == project["version"]
    assert "anywidget" in run_alone(tmp_path, command, "doctor")
