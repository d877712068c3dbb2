import copy
import itertools
import json
import math
import pickle
import string

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sunwidget as sw
from sunwidget.edit.table import (
    METHODS,
    NUMBERS,
    PARAMETERS,
    STROKE_LABELS,
    Edit,
    Stroke,
    parameter,
)
from sunwidget.errors import EditError

# Too long for str(), so pytest must not make its name of it.
HUGE = pytest.param(10**5000, id="huge")

relaxed = settings(deadline=None, max_examples=200, derandomize=True)

FULL = Edit(
    sun_azimuth=4.0,
    sun_elevation=-2.5,
    exposure=0.3,
    method="thesis",
    strokes=(Stroke("sky", ((0.1, 0.2), (0.3, 0.4)), 0.02), Stroke("not_sky", ((0.5, 0.5),))),
    sun_hint=(0.25, -0.5),
    horizon_hint=((0.0, 0.5), (1.0, 0.52)),
    fov_hint=42.0,
)


@st.composite
def edits(draw):
    """Draw any valid edit, by the table itself."""
    values = {}
    for p in draw(st.lists(st.sampled_from(NUMBERS), unique=True, max_size=8)):
        values[p.name] = draw(st.floats(p.minimum, p.maximum))
    values["method"] = draw(st.sampled_from(METHODS))
    fraction = st.floats(0, 1)
    stroke = st.builds(
        Stroke,
        st.sampled_from(STROKE_LABELS),
        st.lists(st.tuples(fraction, fraction), min_size=1, max_size=5).map(tuple),
        st.floats(0.0005, 0.5),
    )
    values["strokes"] = tuple(draw(st.lists(stroke, max_size=3)))
    point = st.tuples(fraction, fraction)
    values["sun_hint"] = draw(st.none() | st.just("outside") | point)
    ends = st.tuples(st.just(0.1234567890123456), fraction), st.tuples(st.floats(0.5, 1), fraction)
    values["horizon_hint"] = draw(st.none() | st.tuples(*ends))
    return Edit(**values)


# --- the table -------------------------------------------------------------------------


def test_an_empty_edit_changes_nothing():
    assert Edit().changed() == {}
    assert Edit().to_dict() == {"version": 1}


def test_every_parameter_has_a_label_a_section_and_a_sentence():
    for p in PARAMETERS:
        assert p.label
        assert p.section
        assert p.help.endswith("."), p.name


def test_the_sections_are_the_panel_s_in_its_order():
    sections = [p.section for p in PARAMETERS if p.kind != "data"]
    # Each section's rows stand together: the panel and the page of parameters read them in turn.
    assert [name for name, _ in itertools.groupby(sections)] == [
        "sun", "sky", "clouds", "land", "water", "effects", "camera", "match", "advanced",
    ]  # fmt: skip


def test_no_two_rows_of_a_section_share_a_label():
    labels = [(p.section, p.label) for p in PARAMETERS]
    assert len(set(labels)) == len(labels)


def test_every_number_has_a_default_inside_a_real_range_and_a_step_that_fits():
    for p in NUMBERS:
        assert math.isfinite(p.minimum)
        assert p.minimum < p.maximum, p.name
        assert 0 < p.step <= p.maximum - p.minimum, p.name
        assert p.default is None or p.minimum <= p.default <= p.maximum, p.name


def test_names_are_unique_and_are_the_fields_of_an_edit():
    names = [p.name for p in PARAMETERS]
    assert len(set(names)) == len(names)
    for name in names:
        assert parameter(name).name == name
        assert hasattr(Edit(), name)


@pytest.mark.parametrize("p", NUMBERS, ids=lambda p: p.name)
def test_both_ends_of_every_range_are_allowed_and_nothing_beyond(p):
    assert getattr(Edit(**{p.name: p.minimum}), p.name) == p.minimum
    assert getattr(Edit(**{p.name: p.maximum}), p.name) == p.maximum
    for outside in (p.minimum - p.step, p.maximum + p.step):
        with pytest.raises(EditError, match=p.name):
            Edit(**{p.name: outside})


@pytest.mark.parametrize("p", NUMBERS, ids=lambda p: p.name)
@pytest.mark.parametrize(
    "value", [math.nan, math.inf, -math.inf, "3", b"3", True, [1], {}, 1j, object(), HUGE]
)
def test_what_is_no_number_is_refused_by_name(p, value):
    with pytest.raises(EditError, match=p.name):
        Edit(**{p.name: value})


def test_only_automatic_parameters_take_none():
    for p in NUMBERS:
        if p.default is None:
            assert getattr(Edit(**{p.name: None}), p.name) is None
        else:
            with pytest.raises(EditError, match=p.name):
                Edit(**{p.name: None})


@pytest.mark.parametrize("value", [np.float32(3), np.float64(3), np.int64(3), np.array(3.0), 3])
def test_numbers_of_any_kind_become_plain_floats(value):
    edit = Edit(sun_elevation=value)
    assert type(edit.sun_elevation) is float
    assert edit == Edit(sun_elevation=3.0)


@pytest.mark.parametrize("value", ["Ratio", "", None, 1, ["ratio"], np.array([1, 2])])
def test_an_unknown_method_lists_the_known_ones(value):
    with pytest.raises(EditError, match="ratio, thesis, thesis_literal"):
        Edit(method=value)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Edit(sun_elevatoin=3),
        lambda: Edit().replace(sun_elevatoin=3),
        lambda: Edit.from_dict({"sun_elevatoin": 3}),
        lambda: parameter("sun_elevatoin"),
    ],
)
def test_an_unknown_name_suggests_the_nearest(make):
    with pytest.raises(EditError, match="Did you mean 'sun_elevation'"):
        make()


def test_an_unknown_keyword_is_a_type_error_too_as_in_any_call():
    with pytest.raises(TypeError, match="Did you mean 'exposure'"):
        Edit(exposur=1)


def test_a_name_like_no_other_points_to_the_table():
    with pytest.raises(EditError, match="PARAMETERS"):
        Edit().replace(zzzzzzzz=1)


def test_an_edit_is_frozen_hashable_and_copyable():
    with pytest.raises(AttributeError):
        FULL.exposure = 1
    assert {FULL: 1}[FULL.replace()] == 1
    assert copy.deepcopy(FULL) == FULL
    assert copy.copy(FULL) == FULL
    assert pickle.loads(pickle.dumps(FULL)) == FULL


def test_replace_leaves_the_original_alone():
    other = FULL.replace(exposure=-1)
    assert FULL.exposure == 0.3
    assert other.changed() == {**FULL.changed(), "exposure": -1.0}


# --- strokes and hints -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("strokes", "message"),
    [
        (3, "list of strokes"),
        ("sky", "list of strokes"),
        ([3], "label and points"),
        ([{"label": "sky"}], "label and points"),
        ([{"label": "cloud", "points": [[0, 0]]}], "one of sky, not_sky, water, not_water"),
        ([{"label": ["sky"], "points": [[0, 0]]}], "one of sky, not_sky, water, not_water"),
        ([{"label": "sky", "points": []}], "pairs"),
        ([{"label": "sky", "points": 7}], "pairs"),
        ([{"label": "sky", "points": [[0]]}], "pair"),
        ([{"label": "sky", "points": [[0, math.nan]]}], "stroke y"),
        ([{"label": "sky", "points": [["0", 0]]}], "stroke x"),
        ([{"label": "sky", "points": [[0, 99]]}], "stroke y"),
        ([{"label": "sky", "points": [[0, 0]], "radius": 0}], "radius"),
        ([{"label": "sky", "points": [[0, 0]], "radius": None}], "radius"),
        ([{"label": "sky", "points": [[0, 0]], "color": "red"}], "no 'color'"),
        ([Stroke("cloud", ((0.0, 0.0),))], "one of sky, not_sky, water, not_water"),
    ],
)
def test_a_senseless_stroke_is_refused(strokes, message):
    with pytest.raises(EditError, match=message):
        Edit(strokes=strokes)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("sun_hint", 3),
        ("sun_hint", (1, 2, 3)),
        ("sun_hint", (math.nan, 0)),
        ("sun_hint", "ab"),
        ("sun_hint", "inside"),
        ("sun_hint", ("outside",)),
        ("horizon_hint", ((0, 0.5),)),
        ("horizon_hint", ((0.5, 0.5), (0.5, 0.6))),
        ("horizon_hint", ((0, 0.5), (1, "x"))),
        ("fov_hint", 0),
        ("fov_hint", 179),
        ("fov_hint", "wide"),
    ],
)
def test_a_senseless_hint_is_refused_by_name(name, value):
    with pytest.raises(EditError, match=name):
        Edit(**{name: value})


def test_a_refused_hint_of_the_sun_names_both_that_are_taken():
    with pytest.raises(EditError, match=r"pair \(x, y\) or 'outside', not 'Outside'"):
        Edit(sun_hint="Outside")


# --- recipes ---------------------------------------------------------------------------


@given(edits())
@relaxed
def test_a_recipe_comes_back_bit_for_bit(edit):
    assert Edit.from_dict(edit.to_dict()) == edit
    assert Edit.from_json(edit.to_json()) == edit
    assert Edit.from_dict(json.loads(json.dumps(edit.to_dict()))) == edit


@given(edits())
@relaxed
def test_code_builds_the_same_edit(edit):
    assert eval(edit.to_code(), {"sw": sw}) == edit
    assert eval(repr(edit), vars(sw).copy()) == edit


def test_an_edit_shows_only_what_it_changes():
    assert repr(Edit()) == "Edit()"
    assert repr(Edit(sun_elevation=3, exposure=-0.5)) == "Edit(sun_elevation=3, exposure=-0.5)"
    assert Edit(sun_elevation=3).to_code() == "sw.Edit(sun_elevation=3)"


def test_a_recipe_is_plain_json_and_names_only_what_changed():
    assert json.loads(Edit(exposure=1).to_json()) == {"version": 1, "exposure": 1.0}
    assert next(iter(FULL.to_dict())) == "version"


def test_an_old_recipe_without_a_version_is_read():
    assert Edit.from_dict({"exposure": 1}) == Edit(exposure=1)


@pytest.mark.parametrize("version", [2, 99, HUGE])
def test_a_recipe_of_a_newer_version_asks_for_an_update(version):
    with pytest.raises(EditError, match="Update sunwidget"):
        Edit.from_dict({"version": version, "teleport": 1})


@pytest.mark.parametrize(
    "version", [0, -1, 1.5, "1", None, True, [], pytest.param(-(10**5000), id="deep")]
)
def test_a_senseless_version_is_refused(version):
    with pytest.raises(EditError, match=r"[Vv]ersion"):
        Edit.from_dict({"version": version})


@pytest.mark.parametrize("recipe", [None, 3, "x", [], [("exposure", 1)], Edit()])
def test_what_is_no_recipe_is_refused(recipe):
    with pytest.raises(EditError, match="JSON object"):
        Edit.from_dict(recipe)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "null",
        "[]",
        '{"exposure": NaN}',
        '{"exposure": Infinity}',
        '{"exposure": 1e999}',
        '{"exposure": ' + "9" * 5000 + "}",
        '{"version": ' + "9" * 5000 + "}",
        "[" * 100_000,
        '{"strokes": ' + "[" * 900 + "]" * 900 + "}",
        '{"__class__": "os.system", "exposure": 1}',
        '{"exposure": {"__reduce__": "x"}}',
        '{"strokes": [{"label": "sky", "points": [[0, 0]], "__init__": 1}]}',
        "{1: 2}",
        b"\xff\xfe",
        None,
        3,
    ],
)
def test_hostile_json_is_an_edit_error_and_nothing_else(text):
    with pytest.raises(EditError):
        Edit.from_json(text)


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(string.printable, max_size=9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)
names = st.sampled_from([p.name for p in PARAMETERS] + ["version"]) | st.text(max_size=8)


@given(st.dictionaries(names, json_values, max_size=5))
@relaxed
def test_any_json_object_is_an_edit_or_an_edit_error(recipe):
    try:
        edit = Edit.from_dict(recipe)
    except EditError:
        return
    assert Edit.from_dict(edit.to_dict()) == edit


def test_a_huge_value_does_not_make_a_huge_message():
    with pytest.raises(EditError) as caught:
        Edit(method="x" * 1_000_000)
    assert len(str(caught.value)) < 300
    with pytest.raises(EditError) as caught:
        Edit.from_dict({"x" * 1_000_000: 1})
    assert len(str(caught.value)) < 300
