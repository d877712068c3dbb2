"""Recipes cross from Python to the browser and back, as JSON and as Python."""

import contextlib
import json

import pytest

import sunwidget as sw
from sunwidget.edit.recipe import read_code
from sunwidget.edit.table import PARAMETERS, RECIPE_VERSION, plain
from sunwidget.widgets.editor.history import HISTORY_BYTES, HISTORY_LENGTH, NAME_LENGTH, VERSIONS
from sunwidget.widgets.kernel.payload import parameter_json

STROKES = (
    sw.Stroke("sky", ((0.1, 0.2), (0.30000000000000004, -1.0)), radius=0.02),
    sw.Stroke("not_water", ((1e-7, 0.5),)),
)
EDITS = {
    "a sun that is not there": sw.Edit(sun_hint="outside"),
    "empty": sw.Edit(),
    "sun": sw.Edit(sun_azimuth=-4.0, sun_elevation=2.5),
    "every row": sw.Edit(
        **{p.name: p.maximum for p in PARAMETERS if p.kind == "number"},
        **{p.name: p.choices[-1] for p in PARAMETERS if p.kind == "choice"},
        strokes=STROKES,
        sun_hint=(0.5, 0.25),
        horizon_hint=((0.0, 0.5), (1.0, 0.4)),
        fov_hint=38.0,
        place=sw.Place(latitude=41.0, longitude=29.0, date="2024-06-21", time=17.5, heading=280.0),
    ),
    "half known place": sw.Edit(place=sw.Place(-33.9, 151.2, "2024-12-21", 9)),
}
SCRIPT = """
import { checkRecipe } from "./src/edit/recipe/check.js";
import { toJson, toPython } from "./src/edit/recipe/write.js";
const { parameters, recipes } = asked;
answer(recipes.map((recipe) => {
  const { values, problems } = checkRecipe(parameters, JSON.parse(recipe));
  return { json: toJson(values), python: toPython(values), problems };
}));
"""


@pytest.fixture(scope="module")
def browser(in_node):
    """``browser(texts)`` reads recipes as the front end does and writes them again."""

    def ask(texts):
        return in_node(SCRIPT, {"parameters": parameter_json(), "recipes": texts})

    return ask


def test_what_python_writes_comes_back_from_the_browser_in_both_forms(browser):
    answers = browser([edit.to_json() for edit in EDITS.values()])
    for (name, edit), answer in zip(EDITS.items(), answers, strict=True):
        assert answer["problems"] == [], name
        assert sw.Edit.from_json(answer["json"]) == edit, name
        space = {}
        exec(answer["python"], space)
        assert space["edit"] == edit, name
        assert read_code(answer["python"]) == read_code(edit.to_code()) == edit, name


def test_python_is_read_as_people_write_it():
    text = """
        # an evening
        edit = sunwidget.Edit(sun_elevation = 3, exposure=-.5,  # darker
            strokes=(sw.Stroke('sky', ((0.1, 0.2), (1_0e-1, 1.)), radius=2e-2),), method='thesis',
            sun_hint=None, place=sw.Place(41.0, longitude=29.0, date='2024-06-21', time=5.0))
        editor.edit = edit"""
    assert read_code(text) == sw.Edit(
        sun_elevation=3,
        exposure=-0.5,
        strokes=(sw.Stroke("sky", ((0.1, 0.2), (1.0, 1.0)), 0.02),),
        method="thesis",
        place=sw.Place(41.0, 29.0, "2024-06-21", 5.0),
    )
    assert read_code("Edit()") == sw.Edit()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sw.Edit(exposure=9)", "exposure = 9 is outside -4 to 4 EV"),
        ("sw.Edit(exposur=1)", "Did you mean 'exposure'"),
        ("sw.Edit(**{'exposure': 1})", "Unknown parameter 'None'"),
        ("sw.Edit(\n  exposure=1+1)", "Line 2 of the recipe: '1 + 1' is not a plain value"),
        ("sw.Edit(exposure=f(1))", "'f(1)' is not a plain value"),
        ("sw.Edit(strokes=[*x])", "is not a plain value"),
        ("sw.Edit(1)", "by name"),
        ("sw.Edit(version=99)", "Update sunwidget"),
        ("sw.Edit(exposure=1", "never closed"),
        ("sw.Edit(strokes=[sw.Stroke('sky')])", "missing 1 required positional argument"),
        ("sw.Edit(place=sw.Place(41, 29, 'soon', 1))", "soon"),
        ("sw.Edit(place=sw.Edit())", "is not a plain value"),
        ("exposure = 1", "There is no sw.Edit"),
        ("", "There is no sw.Edit"),
        ("\0", "cannot be read"),
    ],
)
def test_what_is_no_edit_is_refused_with_what_is_wrong(text, said):
    with pytest.raises(sw.EditError) as refused:
        read_code(text)
    assert said in str(refused.value)


@pytest.mark.parametrize("deep", ["[", "-", "not ", "a.", "f(", "{1:", "1+", "a[", "lambda:", "**"])
def test_python_however_deep_is_refused(deep):
    with pytest.raises(sw.EditError):
        read_code(f"sw.Edit(exposure={deep * 100_000}1")
    with pytest.raises(sw.EditError):
        read_code(f"sw.Edit(exposure={deep * 150}x)")


def test_nothing_in_python_is_run(tmp_path):
    path = tmp_path / "ran"
    act = f"open({str(path)!r}, 'w')"
    for text in (f"sw.Edit(exposure={act})", f"{act}\nsw.Edit()", f"sw.Edit(sun_hint=[{act}, 1])"):
        with contextlib.suppress(sw.EditError):
            read_code(text)
    assert not path.exists()


def test_copied_python_names_only_what_differs(browser):
    (answer,) = browser(['{"version": 1, "exposure": 0.5}'])
    assert answer["python"] == "import sunwidget as sw\n\nedit = sw.Edit(\n    exposure=0.5,\n)\n"


def test_every_row_is_checked_in_the_browser_as_in_python(browser):
    wrong = {"number": [1e9, "1", [], True], "choice": ["magic", 1], "data": [3.5e9, "x"]}
    refused = [json.dumps({p.name: value}) for p in PARAMETERS for value in wrong[p.kind]]
    numbers = [p for p in PARAMETERS if p.kind == "number"]
    taken = [json.dumps({p.name: edge}) for p in numbers for edge in (p.minimum, p.maximum)]
    answers = browser([*refused, *taken])
    for text, answer in zip([*refused, *taken], answers, strict=True):
        assert bool(answer["problems"]) == (text in refused), text
    for text in refused:
        with pytest.raises(sw.EditError):
            sw.Edit.from_json(text)


def test_a_value_in_the_browser_is_pythons(browser):
    edit = EDITS["every row"]
    (answer,) = browser([edit.to_json()])
    values = json.loads(answer["json"])
    assert values == {"version": RECIPE_VERSION} | {
        name: plain(value) for name, value in edit.changed().items()
    }


def test_browser_and_kernel_keep_as_many_steps_and_versions(root):
    steps = (root / "js/src/edit/history_limit.js").read_text("utf-8")
    versions = (root / "js/src/editor/recipe/versions.js").read_text("utf-8")
    assert f"HISTORY_LENGTH = {HISTORY_LENGTH};" in steps
    assert f"HISTORY_BYTES = {HISTORY_BYTES:_};" in steps
    assert f"MOST = {VERSIONS};" in versions
    assert f"NAME_LENGTH = {NAME_LENGTH};" in versions
