"""Shaders and the frame graph as text: includes, rows, inputs and the names of uniforms."""

import functools
import re
from importlib.resources import files
from pathlib import Path

import pytest

from sunwidget.edit.table import METHODS, NUMBERS, PARAMETERS
from sunwidget.explorer.table import EXPLORER_PARAMETERS, MODELS
from sunwidget.renderer import shader_source
from sunwidget.renderer.bruneton.precomputation import PASSES
from sunwidget.renderer.shader_source import frame_graph, read_shader, resolve_includes

SCENE_TEXTURES = {
    "photo",
    "layers",
    "surface",
    "backdrop",
    "clear_sky",
    "relief",
    "transfer",
    "lamps",
}
HOST_UNIFORMS = {
    "frame_size",
    "tile_origin",
    "picture_strip",
    "pass_size",
    "canvas_flip",
    "output_transfer",
    "output_levels",
    "output_white",
    "dither",
    "view",
}
GRAPHS = ("graph", "explorer")
ROWS = [row for name in GRAPHS for row in frame_graph(name)["passes"]]


def shaders_of(rows):
    """Fragment shaders, those of parts of a pass too, and the shaders of what pixels share."""
    own = {row[stage] for row in rows for stage in ("shader", "constants") if stage in row}
    parts = [row["parts"] for row in rows if "parts" in row]
    return own | {name for part in parts for name in (part["by"], *part["shaders"])}


SHADERS = sorted(shaders_of(ROWS))
EXPLORERS = shaders_of(frame_graph("explorer")["passes"])
EDITORS = shaders_of(frame_graph()["passes"])
# Bruneton's table is made once for an atmosphere, outside the graphs (renderer/bruneton).
PRECOMPUTED = set(PASSES)
# What a run of the explorer is asked for, beside the models: single terms of the sky.
ASKED = {*MODELS, "orders"}
_DECLARATION = re.compile(r"^\s*uniform\s+(\w+)\s+(\w+)\s*;", re.MULTILINE)


def declared(shader):
    """Type by name of every uniform that the expanded shader declares."""
    return {name: kind for kind, name in _DECLARATION.findall(resolve_includes(f"{shader}.glsl"))}


@pytest.fixture
def folder(monkeypatch):
    """Shaders that a test writes itself."""
    texts = {}

    def read(path):
        if path not in texts:
            raise FileNotFoundError(path)
        return texts[path]

    monkeypatch.setattr(shader_source, "read_shader", read)
    return texts


def test_an_include_is_replaced_by_the_files_text(folder):
    folder.update({"a.glsl": '#include "lib/b.glsl"\nvoid main() {}\n', "lib/b.glsl": "float b;\n"})
    assert resolve_includes("a.glsl") == "float b;\n\nvoid main() {}\n"


def test_a_file_is_expanded_at_its_first_mention_only(folder):
    folder.update({"a.glsl": '#include "b"\n#include "b"\n', "b": "B"})
    assert resolve_includes("a.glsl") == "B\n\n"


def test_nested_includes_come_before_who_needs_them_and_once(folder):
    folder.update(
        {"a": '#include "b"\n#include "c"\nA', "b": '#include "c"\nB', "c": "C"},
    )
    assert resolve_includes("a").split() == ["C", "B", "A"]


def test_files_that_include_each_other_end(folder):
    folder.update({"a": '#include "b"\nA', "b": '#include "a"\nB'})
    assert resolve_includes("a").split() == ["B", "A"]


def test_the_same_file_in_two_shaders_is_expanded_in_both(folder):
    folder.update({"a": '#include "c"\nA', "b": '#include "c"\nB', "c": "C"})
    assert [resolve_includes(name).split() for name in "ab"] == [["C", "A"], ["C", "B"]]


def test_an_include_in_a_comment_is_left_alone(folder):
    folder["a"] = '// #include "nothing"\nA'
    assert resolve_includes("a") == folder["a"]


def test_an_unknown_file_is_an_error_that_names_it(folder):
    folder["a"] = '#include "lib/missing.glsl"\n'
    with pytest.raises(FileNotFoundError, match="lib/missing.glsl"):
        resolve_includes("a")


def test_an_unknown_shader_of_the_package_is_an_error_that_names_it():
    with pytest.raises(FileNotFoundError, match="no_such_pass"):
        read_shader("no_such_pass.glsl")


def test_hosts_prepend_version_and_precision_so_no_shader_names_them():
    for shader in SHADERS:
        text = resolve_includes(f"{shader}.glsl")
        assert "#version" not in text, shader
        assert not re.search(r"^\s*precision\s", text, re.MULTILINE), shader
        assert "#include" not in re.sub("//.*", "", text), shader


def test_sampling_is_texel_fetch_only_so_that_no_filter_state_exists():
    for shader in SHADERS:
        text = re.sub("//.*", "", resolve_includes(f"{shader}.glsl"))
        assert not re.search(r"\btexture(Lod|Grad|Offset|2D)?\s*\(", text), shader


def shader_files():
    """Path in the package and text of every shader file."""
    folder = Path(str(files("sunwidget").joinpath("shaders")))
    return {p.relative_to(folder).as_posix(): p.read_text("utf-8") for p in folder.rglob("*.glsl")}


def test_every_shader_that_draws_is_drawn_by_some_pass():
    drawing = re.compile(r"^void (main|SetConstants)\(\)", re.MULTILINE)
    draws = {name for name, text in shader_files().items() if drawing.search(text)}
    drawn = {f"{name}.glsl" for name in {*SHADERS, *PRECOMPUTED}}
    assert draws <= drawn
    assert drawn <= shader_files().keys()


def test_every_other_file_is_included_by_some_pass():
    used = {f"{name}.glsl" for name in {*SHADERS, *PRECOMPUTED}}
    pending = sorted(used)
    while pending:
        found = re.findall(r'^ *#include "([^"]+)"', read_shader(pending.pop()), re.MULTILINE)
        pending += [name for name in found if name not in used]
        used |= set(found)
    assert used == shader_files().keys()


def test_no_two_shader_files_share_a_name():
    names = [path.rsplit("/", 1)[1] for path in shader_files()]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("method", METHODS)
def test_every_input_is_a_scene_texture_or_drawn_before(method):
    ready = {*SCENE_TEXTURES, "nothing"}
    for row in frame_graph()["passes"]:
        if method in row.get("when", METHODS):
            for names in row["inputs"].values():
                assert ready & ({names} if isinstance(names, str) else set(names)), row["name"]
            assert row["name"] not in ready, f"{row['name']} is drawn twice for {method}"
            ready.add(row["name"])
    assert "frame" in ready


def test_a_row_that_is_not_always_drawn_has_nothing_in_its_place():
    optional = {r["name"] for r in frame_graph()["passes"] if set(r.get("when", ())) - set(METHODS)}
    assert optional == {"soft_sky", "added_layer", "shaft_rings_edit", "shafts_edit"}
    for row in frame_graph()["passes"]:
        if row["name"] in optional:
            continue
        for names in row["inputs"].values():
            read = {names} if isinstance(names, str) else set(names)
            assert not read & optional or names[-1] == "nothing", row["name"]


@pytest.mark.parametrize("asked", sorted(ASKED))
def test_every_input_of_the_explorer_is_loaded_or_drawn_before(asked):
    ready = {"bruneton", "directions"}
    for row in frame_graph("explorer")["passes"]:
        if asked in row.get("when", ASKED):
            for names in row["inputs"].values():
                assert ready & {names} if isinstance(names, str) else ready & set(names), row[
                    "name"
                ]
            assert row["name"] not in ready
            ready.add(row["name"])
    assert "explorer_frame" in ready


def test_only_known_states_formats_methods_and_sizes_occur():
    for row in frame_graph()["passes"]:
        assert row["state"] in ("source", "edit"), row["name"]
        assert row["format"] == ("output" if row["name"] == "frame" else "rgba32f")
        assert set(row.get("when", METHODS)) <= {*METHODS, *(p.name for p in PARAMETERS)}
        assert row["size"] == "frame" or len(row["size"]) == 2
    for row in frame_graph("explorer")["passes"]:
        assert row["state"] in ("edit", "single"), row["name"]
        assert row["format"] == ("output" if row["name"] == "explorer_frame" else "rgba32f")
        assert set(row.get("when", ASKED)) <= ASKED
        named = ("frame", "grid", "shown", "directions")
        assert row["size"] in named or len(row["size"]) == 2


def test_each_pass_hands_every_sampler_its_input_and_no_other():
    for row in ROWS:
        uniforms = {k: v for shader in shaders_of([row]) for k, v in declared(shader).items()}
        samplers = {name for name, kind in uniforms.items() if kind == "sampler2D"}
        own = {"history"} if row.get("history") else set()
        assert samplers == set(row["inputs"]) | own, row["name"]


@pytest.mark.parametrize("shader", SHADERS)
def test_every_uniform_has_a_source_for_its_value(shader):
    parameters = {p.name for p in PARAMETERS if p.kind in ("number", "choice")}
    edits = parameters | {f"source_{name}" for name in parameters}
    edits |= set(frame_graph()["scene_uniforms"]) | HOST_UNIFORMS
    explorers = {p.name for p in EXPLORER_PARAMETERS if p.kind != "data"} | HOST_UNIFORMS
    for name, kind in declared(shader).items():
        if kind != "sampler2D":
            assert shader not in EDITORS or name in edits, f"{shader}: {name}"
            known = explorers | {"sample_index"}
            assert shader not in EXPLORERS or name in known, f"{shader}: {name}"


def test_scene_uniforms_have_the_type_that_the_shaders_declare():
    types = frame_graph()["scene_uniforms"]
    for shader in SHADERS:
        for name, kind in declared(shader).items():
            if name in types:
                assert kind == types[name], f"{shader}: {name}"


def test_every_scene_uniform_is_used_by_some_shader():
    used = set().union(*map(declared, SHADERS))
    assert set(frame_graph()["scene_uniforms"]) <= used


@functools.cache
def code_of_shaders(graph="graph"):
    rows = frame_graph(graph)["passes"]
    shaders = sorted(
        {row[stage] for row in rows for stage in ("shader", "constants") if stage in row}
    )
    return [re.sub("//.*", "", resolve_includes(f"{shader}.glsl")) for shader in shaders]


@pytest.mark.parametrize("name", [p.name for p in NUMBERS])
def test_every_number_of_the_table_takes_part_in_some_shader(name):
    # Mentioned at least twice in one shader: where it is declared, and where it is used. No
    # number is for the analysis alone, so a slider that does nothing cannot exist.
    assert any(len(re.findall(rf"\b{name}\b", text)) >= 2 for text in code_of_shaders())


# The size of the sky's table is the host's affair, and so is what an air without haze is.
HOSTS = {"grid", "show_rayleigh", "show_aerosol", "show_ozone"}


@pytest.mark.parametrize(
    "name", [p.name for p in EXPLORER_PARAMETERS if p.kind != "data" and p.name not in HOSTS]
)
def test_every_parameter_of_the_explorer_takes_part_in_some_shader(name):
    texts = code_of_shaders("explorer")
    assert any(len(re.findall(rf"\b{name}\b", text)) >= 2 for text in texts)
