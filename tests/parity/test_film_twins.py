"""A film's path on both sides: the browser's code, run by node, against Python's."""

from types import SimpleNamespace

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.edit.table import NUMBERS
from sunwidget.film import path
from sunwidget.film.path import EASINGS, film_edits
from sunwidget.widgets.editor.key_frames import MOVED, complete_key_frames
from sunwidget.widgets.kernel.payload import parameter_json

SCRIPT = """
import { EASINGS, keyFramePath } from "./src/film/film_path.js";

const { frames, edit, parameters, automatic, count } = asked;
const rows = {};
for (const easing of Object.keys(EASINGS)) {
  const path = keyFramePath(frames, easing, parameters, edit, automatic);
  rows[easing] = Array.from({ length: count }, (_, i) => path(i / (count - 1)));
}
answer(rows);
"""

# Four key frames with automatic values, the azimuth past the camera's back, a value held and one
# that turns round; the first stands after the film's beginning.
FRAMES = (
    (0.5, sw.Edit()),
    (2.0, sw.Edit(sun_azimuth=170, sun_elevation=12, exposure=1)),
    (2.75, sw.Edit(sun_azimuth=-175, sun_elevation=30, exposure=-0.5)),
    (6.0, sw.Edit(sun_azimuth=-100, sun_elevation=3, exposure=-0.5)),
)
# What was said of the photo after the key frames were made.
EDIT = sw.Edit(
    sun_elevation=80,
    method="thesis",
    strokes=(sw.Stroke("sky", ((0.1, 0.2), (0.3, 0.2)), 0.02),),
    horizon_hint=((0.0, 0.5), (1.0, 0.52)),
)


@pytest.fixture(scope="module")
def scene():
    automatic = {p.name: 0.5 * (p.minimum + p.maximum) for p in NUMBERS}
    return SimpleNamespace(automatic=automatic, lit_by_moon=False)


@pytest.fixture(scope="module")
def played(scene, in_node):
    values = {p["name"]: p["default"] for p in parameter_json()} | EDIT.to_dict()
    asked = {
        "frames": [{"seconds": t, "recipe": edit.to_dict()} for t, edit in FRAMES],
        "edit": values,
        "parameters": parameter_json(),
        "automatic": scene.automatic,
        "count": 145,
    }
    return in_node(SCRIPT, asked)


def test_the_browser_knows_the_kernels_easings(played):
    assert set(played) == set(EASINGS)


@pytest.mark.parametrize("easing", sorted(EASINGS))
def test_what_is_played_is_what_is_written(played, scene, easing, monkeypatch):
    monkeypatch.setattr(path, "corrected", lambda scene, _edit: scene)
    written = film_edits(scene, complete_key_frames(FRAMES, EDIT), frames=145, easing=easing)
    moved = 0
    for mine, theirs in zip(written, played[easing], strict=True):
        for name in MOVED:
            value = getattr(mine, name)
            if value is None:
                assert theirs[name] is None, name
            else:
                assert theirs[name] == pytest.approx(value, abs=1e-9), name
        moved += theirs["sun_elevation"] != played[easing][0]["sun_elevation"]
        # Corrections and methods are the present edit's in every frame.
        assert theirs["method"] == mine.method == "thesis"
        assert len(theirs["strokes"]) == len(mine.strokes) == 1
    assert moved > 100
    azimuth = np.array([frame["sun_azimuth"] for frame in played[easing][50:]])
    steps = np.abs((np.diff(azimuth) + 180) % 360 - 180)
    assert steps.max() < 12, "the sun went the long way round"
