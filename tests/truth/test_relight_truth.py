"""Regression against rendered ground truth: the same scene under other suns, path-traced.

The score is that of the shared tool ``score_relight.py``: linear light after one best gain,
skill = 1 - MSE(edit) / MSE(the photo itself), sky and foreground apart.
"""

import functools
import importlib.util
import json

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw

pytestmark = pytest.mark.shared
SCENE = "coast"
SHORE = 363  # row
SKY_SKILL = 0.85  # 0.944 measured
LAND_SKILL = 0.1  # 0.190 measured: as much as the best gain per channel that knows the truth
FRAMES = ("coast_az+00_el+02.5", "coast_az-12_el+06.0", "coast_az+00_el+22.0")


@pytest.fixture(scope="module")
def scores(shared):
    """Mean score over three moves, by method; ``copy`` is the photo itself."""
    tool, folder = shared / "tools" / "score_relight.py", shared / "truth"
    if not (tool.is_file() and (folder / f"{SCENE}.json").is_file()):
        pytest.skip(f"no {tool.name} or no {SCENE} in {shared}")
    spec = importlib.util.spec_from_file_location("score_relight", tool)
    score = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(score)
    told = json.loads((folder / f"{SCENE}.json").read_text())
    frames = {frame["file"]: frame for frame in told["frames"]}
    source = frames[f"{SCENE}_az+00_el+12.0"]

    def picture(name):
        return np.asarray(Image.open(folder / f"{name}.png").convert("RGB"))

    photo = picture(source["file"])
    matte = np.asarray(Image.open(folder / f"{SCENE}_sky.png").convert("L"))
    water = np.where(matte < 5, 1, 0).astype(np.float32)
    water[SHORE:] = 0
    scene = sw.analyze(
        photo,
        fov=told["fov_v_deg"],
        horizon=told["horizon_row"],
        sun=(source["sun_x"], source["sun_y"]),
        water=water,  # relighting is judged here, and the network does not see this sea
    )

    def compare(edited, name):
        light = [score.linear(image) for image in (edited, picture(name), photo)]
        return score.compare(*light, matte > 250, matte < 5)

    @functools.cache
    def mean(method):
        rows = []
        for name in FRAMES:
            target = frames[name]
            azimuth, elevation = scene.camera.angles(target["sun_x"], target["sun_y"])
            edit = sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation)
            edited = photo if method == "copy" else sw.render(scene, edit, method=method)
            rows.append(compare(edited, name))
        return {key: float(np.mean([row[key] for row in rows])) for key in rows[0]}

    mean.unmoved = sw.render(scene)
    mean.photo = photo
    return mean


def test_the_unmoved_truth_photo_is_unchanged(scores):
    assert np.array_equal(scores.unmoved, scores.photo)


# Floors lie somewhat below what was measured when they were written (in the comments), so that a
# change for the worse is noticed and a change in the noise is not.


def test_the_sky_is_near_the_truth(scores):
    ratio = scores("ratio")  # ΔE 2.3 of 9.3, colour angle 0.5°
    assert ratio["sky_skill"] > SKY_SKILL
    assert ratio["sky_dE"] < 0.5 * ratio["sky_dE_copy"]
    assert ratio["sky_angle"] < 3


def test_the_foreground_is_nearer_the_truth_than_the_photo(scores):
    ratio = scores("ratio")  # ΔE 5.0 of 9.1, 2.8° of 7.7°, 0.18 EV
    assert ratio["fg_skill"] > LAND_SKILL
    assert ratio["fg_dE"] < 0.75 * ratio["fg_dE_copy"]
    assert ratio["fg_angle"] < ratio["fg_angle_copy"]
    assert ratio["fg_ev"] < 0.35


def test_ratio_is_ahead_of_the_thesis(scores):
    ratio, thesis = scores("ratio"), scores("thesis")
    for key in ("sky_skill", "fg_skill"):
        assert ratio[key] > thesis[key], key
    for key in ("sky_dE", "fg_dE"):
        assert ratio[key] < thesis[key], key


def test_the_thesis_is_ahead_of_the_photo_itself_in_the_sky(scores):
    # 0.88, ΔE 5.9 of 9.3. Not in the foreground, where its ΔE is that of copying (9.2 of 9.1).
    thesis = scores("thesis")
    assert thesis["sky_skill"] > 0.4
    assert thesis["sky_dE"] < thesis["sky_dE_copy"]


def test_the_thesis_as_printed_is_no_better_than_corrected(scores):
    literal, right = scores("thesis_literal"), scores("thesis")
    assert literal["fg_skill"] < right["fg_skill"]
    assert literal["fg_dE"] > right["fg_dE"]
