"""The guarantees on photos of the shared folder, small: every third, or all when asked.

Photo by photo: to draw another scene costs the renderer ten times what another sun does.
"""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest
from skimage.color import deltaE_ciede2000, rgb2lab

import sunwidget as sw
from sunwidget.edit.table import Edit
from sunwidget.renderer import render, render_pass

pytestmark = pytest.mark.shared
SIDE = 160
# SUNWIDGET_ALL_PHOTOS=1 takes every one (four minutes).
EVERY = 1 if os.environ.get("SUNWIDGET_ALL_PHOTOS") else 3
SHARED = Path(os.environ.get("SUNWIDGET_SHARED", Path(__file__).parents[3] / "shared"))
PHOTOS = sorted((SHARED / "data" / "photos").glob("*.jpg"))[::EVERY]
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
MOVED = Edit(sun_azimuth=-20, sun_elevation=6)
# Whatever is added to the picture or multiplies it.
OFF = {
    "sky_strength": 0,
    "land_strength": 0,
    "glow": 0,
    "light_shafts": 0,
    "lens_flare": 0,
    "glitter": 0,
    "grain": 0,
    "aerial_perspective": 0,
}


@pytest.fixture(scope="module", params=PHOTOS or [None], ids=lambda path: path and path.stem)
def scene(request):
    """A photo as a small Scene."""
    if request.param is None:
        pytest.skip(f"no photos in {SHARED / 'data' / 'photos'}")
    return sw.analyze(small(cv2.imread(str(request.param))))


def small(bgr):
    zoom = SIDE / max(bgr.shape[:2])
    size = (max(1, round(bgr.shape[1] * zoom)), max(1, round(bgr.shape[0] * zoom)))
    return np.ascontiguousarray(cv2.resize(bgr, size, interpolation=cv2.INTER_AREA)[..., ::-1])


def encode(light):
    x = np.clip(light, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def glinting(scene, edit):
    """Where the water mirrors the moved sun itself."""
    glints = render_pass(scene, edit, "mirror_ratio")[..., 3]
    size = scene.sky.shape[::-1]
    glints = cv2.resize(glints, size, interpolation=cv2.INTER_LINEAR)
    return (scene.water > 0.02) & (glints > 0.002)


def test_an_unmoved_sun_changes_no_level_of_any_photo(scene):
    found = {key: scene.automatic[key] for key in ("sun_azimuth", "sun_elevation")}
    photo = scene.photo.encoded.astype(int)
    for edit in (None, Edit(**found)):
        assert abs(render(scene, edit).astype(int) - photo).max() <= 1


def test_the_way_does_not_matter_in_any_photo(scene):
    direct = render(scene, MOVED)
    render(scene, Edit(sun_azimuth=90, sun_elevation=-5, aerosol_optical_depth=0.3))
    assert np.array_equal(render(scene, MOVED), direct), "another way, another picture"
    assert abs(render(scene).astype(int) - scene.photo.encoded).max() <= 1, "it does not come back"


def test_every_effect_at_zero_leaves_every_photo_alone(scene):
    moved = render(scene, MOVED.replace(**OFF), dtype="float32")
    assert np.array_equal(moved, render(scene, dtype="float32"))


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, -12), (170, 1)])
def test_no_sun_makes_a_number_that_is_none_in_any_photo(scene, azimuth, elevation):
    edit = Edit(sun_azimuth=azimuth, sun_elevation=elevation)
    light = render(scene, edit, dtype="float32")
    assert np.isfinite(light).all()
    assert light.min() >= -1e-6


def test_a_lower_sun_never_lights_the_land_of_a_photo_more(scene):
    # Water mirrors the sky, and that is brighter round a low sun.
    land = (scene.sky < 0.02) & (scene.water < 0.02)
    if land.mean() < 0.02:
        return
    levels, openings = [], []
    for elevation in (40, 12, 1, -5):
        # Glare and air lie before the land, and a low sun is near them; slopes that face it gain by
        # it, and so may land that comes out of a shadow.
        before = ("glow", "aerial_perspective", "light_shafts", "shading")
        off = dict.fromkeys(("auto_exposure", *before, "cast_shadows", "cloud_shadows"), 0)
        edit = Edit(sun_elevation=elevation, **off)
        levels.append((render(scene, edit, dtype="float32")[land] @ LUMINANCE).mean())
        openings.append(render_pass(scene, edit, "visibility_edit")[0, 0, 0])
    # A sun that comes out from behind a cloud as it sinks may well light the land more.
    rises = [
        i
        for i in range(len(levels) - 1)
        if openings[i + 1] <= openings[i] + 1e-3 and levels[i + 1] > levels[i] * (1 + 1e-4)
    ]
    assert rises == [], levels


def test_a_drag_by_one_pixel_makes_no_visible_step_in_any_photo(scene):
    """By one pixel of a photo of 1024; all but the disc and its mirror image: 99.5 % of pixels."""
    pixel = scene.camera.fov_vertical_deg / scene.camera.height * scene.camera.width / 1024
    labs, openings = [], []
    keep = np.ones(scene.sky.shape, bool)
    for k in (0, 1):
        edit = MOVED.replace(sun_azimuth=MOVED.sun_azimuth + k * pixel)
        labs.append(rgb2lab(encode(render(scene, edit, dtype="float32"))))
        openings.append(render_pass(scene, edit, "visibility_edit")[0, 0, 0])
        keep &= ~glinting(scene, edit)
    worst = float(np.percentile(deltaE_ciede2000(*labs)[keep], 99.5))
    # A roof hides the disc within ten pixels, and the land darkens as fast.
    assert worst - 25 * abs(openings[1] - openings[0]) < 1
