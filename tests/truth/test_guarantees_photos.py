"""The guarantees on photos of the shared folder, small: every third, or all when asked."""

import os

import cv2
import numpy as np
import pytest
from skimage.color import deltaE_ciede2000, rgb2lab

import sunwidget as sw
from sunwidget.edit import Edit
from sunwidget.renderer import render, render_pass

# Fifty photos on two busy cores.
pytestmark = [pytest.mark.shared, pytest.mark.timeout(900)]
SIDE = 160
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


@pytest.fixture(scope="module")
def scenes(shared):
    """Photos as small Scenes, by name; SUNWIDGET_ALL_PHOTOS=1 takes every one (four minutes)."""
    every = 1 if os.environ.get("SUNWIDGET_ALL_PHOTOS") else 3
    paths = sorted((shared / "data" / "photos").glob("*.jpg"))[::every]
    if not paths:
        pytest.skip("no photos in the shared folder")
    return {path.stem: sw.analyze(small(cv2.imread(str(path)))) for path in paths}


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


def failing(scenes, breaks):
    """Return the photos for which ``breaks`` tells what is wrong."""
    return {name: wrong for name, scene in scenes.items() if (wrong := breaks(scene)) is not None}


def test_an_unmoved_sun_changes_no_level_of_any_photo(scenes):
    def breaks(scene):
        found = {key: scene.automatic[key] for key in ("sun_azimuth", "sun_elevation")}
        photo = scene.photo.encoded.astype(int)
        worst = max(abs(render(scene, e).astype(int) - photo).max() for e in (None, Edit(**found)))
        return worst if worst > 1 else None

    assert failing(scenes, breaks) == {}


def test_the_way_does_not_matter_in_any_photo(scenes):
    def breaks(scene):
        direct = render(scene, MOVED)
        render(scene, Edit(sun_azimuth=90, sun_elevation=-5, aerosol_optical_depth=0.3))
        if not np.array_equal(render(scene, MOVED), direct):
            return "another way, another picture"
        back = render(scene).astype(int) - scene.photo.encoded
        return None if abs(back).max() <= 1 else "it does not come back"

    assert failing(scenes, breaks) == {}


def test_every_effect_at_zero_leaves_every_photo_alone(scenes):
    def breaks(scene):
        moved = render(scene, MOVED.replace(**OFF), dtype="float32")
        worst = abs(moved - render(scene, dtype="float32")).max()
        return None if worst == 0 else worst

    assert failing(scenes, breaks) == {}


def test_no_sun_makes_a_number_that_is_none_in_any_photo(scenes):
    def breaks(scene):
        for azimuth, elevation in ((0, -12), (170, 1)):
            light = render(
                scene, Edit(sun_azimuth=azimuth, sun_elevation=elevation), dtype="float32"
            )
            if not np.isfinite(light).all() or light.min() < -1e-6:
                return azimuth, elevation, float(np.nanmin(light))
        return None

    assert failing(scenes, breaks) == {}


def test_a_lower_sun_never_lights_the_land_of_a_photo_more(scenes):
    def breaks(scene):
        # Water mirrors the sky, and that is brighter round a low sun.
        land = (scene.sky < 0.02) & (scene.water < 0.02)
        if land.mean() < 0.02:
            return None
        levels, openings = [], []
        for elevation in (40, 12, 1, -5):
            edit = Edit(sun_elevation=elevation, auto_exposure=0)
            levels.append((render(scene, edit, dtype="float32")[land] @ LUMINANCE).mean())
            openings.append(render_pass(scene, edit, "visibility_edit")[0, 0, 0])
        # A sun that comes out from behind a cloud as it sinks may well light the land more.
        rises = [
            i
            for i in range(len(levels) - 1)
            if openings[i + 1] <= openings[i] + 1e-3 and levels[i + 1] > levels[i] * (1 + 1e-4)
        ]
        return (rises, levels) if rises else None

    assert failing(scenes, breaks) == {}


def test_a_drag_by_one_pixel_makes_no_visible_step_in_any_photo(scenes):
    """By one pixel of a photo of 1024; all but the disc and its mirror image: 99.5 % of pixels."""

    def breaks(scene):
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
        worst -= 25 * abs(openings[1] - openings[0])
        return worst if worst >= 1 else None

    assert failing(scenes, breaks) == {}
