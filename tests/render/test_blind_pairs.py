"""bench/pairs.py: a change is drawn in its pair only, and marks are counted for the right side."""

import numpy as np
import pytest
from relight_scenes import known_photo

from bench.pairs import Changes, chosen, counted
from sunwidget.edit.table import Edit
from sunwidget.renderer import render

GRAY = {
    "shader": "frame/frame_output.glsl",
    "old": "const float kKnee = 0.5;",
    "new": "const float kKnee = 0.1;",
}


def test_a_changed_shader_draws_its_pair_and_nothing_afterwards():
    scene = known_photo(sun=(150.0, 40.0)).analyze(sun=None)
    edit, changes = Edit(sun_azimuth=-8, sun_elevation=6), Changes()
    plain = render(scene, edit)
    once = changes.render(scene, edit, "knee", GRAY)
    assert np.abs(once.astype(int) - plain).max() > 2
    assert np.array_equal(render(scene, edit), plain)
    assert np.array_equal(changes.render(scene, edit, "knee", GRAY), once)
    with_glow = changes.render(scene, edit, "glow", {"parameters": {"glow": 0.2}})
    assert np.array_equal(with_glow, render(scene, edit.replace(glow=0.2)))


def test_text_that_a_shader_does_not_contain_is_told():
    scene = known_photo(sun=(150.0, 40.0)).analyze(sun=None)
    render(scene)
    with pytest.raises(ValueError, match=r"knee: .* does not contain 'kNothing'"):
        Changes().render(scene, Edit(), "knee", {**GRAY, "old": "kNothing"})


def test_marks_count_for_the_side_on_which_the_change_was():
    key = {
        "0": {"photo": "a.jpg", "sun": "view3", "new": "LEFT"},
        "3": {"photo": "b.jpg", "sun": "blue", "new": "RIGHT"},
        "7": {"photo": "c.jpg", "sun": "blue", "new": "LEFT"},
    }
    found = counted(key, "0 LEFT 2 1 - less orange\n3 LEFT 2 0\n7 SAME 1 1\nnothing to mark\n")
    assert found["new, old, same"] == [1, 1, 1]
    assert (found["up"], found["down"]) == (1, 1)
    assert found["pass"] == [1, 1]
    assert found["wrong"] == [0, 1]
    assert found["blue"] == [0, 1, 1]


def test_photos_are_drawn_by_the_seed_and_none_that_was_seen(tmp_path):
    for name in "abcdefgh":
        (tmp_path / f"{name}.jpg").touch()
    seen = {str(tmp_path / "c.jpg")}
    first = chosen([tmp_path], seen, 5, 7)
    assert first == chosen([tmp_path], seen, 5, 7) != chosen([tmp_path], seen, 6, 7)
    assert {path.name for path in first} == {f"{name}.jpg" for name in "abdefgh"}
