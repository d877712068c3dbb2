"""Hostile values and recipe files: an Edit, or one EditError; code of an Edit is only an Edit."""

import ast
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sunwidget as sw
from sunwidget.cli.main import main
from sunwidget.edit.recipe import edit_of, read_recipe
from sunwidget.edit.table import PARAMETERS
from sunwidget.film.path import named_edit
from sunwidget.messages import printable, short_repr

CYCLE = {}
CYCLE["strokes"] = [CYCLE]
CODE = "__import__('os').abort()"


class Impostor(str):
    """Equals a text, and shows another."""

    __slots__ = ()

    def __repr__(self):
        return CODE

    __str__ = __repr__


class Unshowable:
    def __repr__(self):
        raise RuntimeError("no")


class Number(float):
    def __repr__(self):
        return CODE


HOSTILE = [
    CYCLE, [CYCLE], Unshowable(), Impostor("ratio"), Impostor("sky"), Number(0.5), np.str_("sky"),
    np.array([1, 2]), 10**5000, float("nan"), -float("inf"), "\ud800", CODE, b"\0", print, {1: 2},
    {"__class__": "Edit"}, ((0, 0), (1, 1)),
]  # fmt: skip


def code_is_only_an_edit(edit):
    names = {node.id for node in ast.walk(ast.parse(edit.to_code())) if isinstance(node, ast.Name)}
    assert names <= {"sw"}
    assert eval(edit.to_code(), {"sw": sw}) == edit
    assert sw.Edit.from_json(edit.to_json()) == edit


@given(st.dictionaries(st.sampled_from([p.name for p in PARAMETERS]), st.sampled_from(HOSTILE)))
@settings(deadline=None, max_examples=150, derandomize=True)
def test_any_hostile_value_is_an_edit_or_an_edit_error(values):
    for make in (lambda: sw.Edit(**values), lambda: edit_of(values)):
        try:
            edit = make()
        except sw.EditError:
            continue
        code_is_only_an_edit(edit)


@pytest.mark.parametrize("value", HOSTILE, ids=lambda value: type(value).__name__)
@pytest.mark.parametrize("part", ["label", "points", "radius", "date", "latitude"])
def test_any_hostile_part_of_a_stroke_or_place_is_an_edit_or_an_edit_error(part, value):
    stroke = {"label": "sky", "points": [[0, 0]], "radius": 0.1}
    place = {"latitude": 0, "longitude": 0, "date": "2024-06-21", "time": 0}
    (stroke if part in stroke else place)[part] = value
    try:
        edit = sw.Edit(strokes=[stroke], place=place)
    except sw.EditError:
        return
    code_is_only_an_edit(edit)


def test_texts_that_look_like_a_choice_become_the_choice():
    for text in (Impostor("thesis"), np.str_("thesis")):
        edit = sw.Edit(method=text)
        assert type(edit.method) is str
        assert edit.to_code() == "sw.Edit(method='thesis')"


def test_of_a_name_written_twice_the_last_counts():
    assert sw.Edit.from_json('{"exposure": 1, "exposure": 2}') == sw.Edit(exposure=2)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_a_recipe_is_read_as_editors_of_any_system_save_it(tmp_path, encoding):
    path = tmp_path / "r.json"
    path.write_text('{"exposure": 1}', encoding)
    assert read_recipe(path) == sw.Edit(exposure=1)
    assert sw.Edit.from_json("\ufeff" + path.read_text(encoding)) == sw.Edit(exposure=1)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "There is no recipe file"),
        (b"", "not valid JSON"),
        (bytes(range(256)), "not valid JSON"),
        (b"[" * 100_000, "not valid JSON"),
        (b'{"version": 2}', "Update sunwidget"),
        (b'{"exposure": 9}', "outside -4 to 4"),
        (b"null", "JSON object"),
    ],
)
def test_a_recipe_file_that_is_none_is_named_by_all_that_read_recipes(
    tmp_path, content, message, capsys
):
    path = tmp_path / "evening.json"
    if content is not None:
        path.write_bytes(content)
    for read in (
        read_recipe,
        lambda path: sw.batch([], path, tmp_path / "out"),
        named_edit,
    ):
        with pytest.raises(sw.EditError, match=rf"evening\.json.*{message}|{message}.*evening"):
            read(path)
    assert main(["render", "no.jpg", "-o", str(tmp_path / "x.png"), "--recipe", str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "evening.json" in line


def test_a_folder_and_a_file_without_end_are_no_recipes(tmp_path):
    with pytest.raises(sw.EditError, match="cannot be read"):
        read_recipe(tmp_path)
    with pytest.raises(sw.EditError, match="cannot be read|no recipe"):
        read_recipe("\0")


def test_a_photo_or_a_path_is_no_scene():
    photo = sw.open(np.zeros((8, 12, 3), np.uint8))
    for ask in (
        sw.render,
        lambda what: sw.sweep(what, ["noon", "sunset"], "x.gif"),
        lambda what: sw.preset("noon", what),
        lambda what: sw.contact_sheet(what, ["noon", "sunset"]),
    ):
        for what in (photo, "beach.jpg", None):
            with pytest.raises(sw.AnalysisError, match=r"scene = sw\.analyze\(photo\)"):
                ask(what)


@given(st.text() | st.binary())
@settings(max_examples=100, derandomize=True)
def test_what_is_shown_of_a_value_is_short_and_obeyed_by_no_terminal(value):
    assert len(short_repr(value)) <= 80
    assert printable(str(value)).isprintable()
    assert json.dumps(short_repr(value))
