"""Labels of suns, and what is drawn for their network."""

import numpy as np

from training.suns.decoys import lightning
from training.suns.labels import labels

KINDS = {"disc", "glow", "moon", "art", "none", "bait", "drop"}


def test_every_label_has_the_place_that_its_kind_needs():
    for photo in labels():
        assert photo.kind in KINDS, photo.file
        placed = photo.kind in ("disc", "glow", "moon", "art")
        assert np.isfinite([photo.x, photo.y]).all() == placed, photo.file
        if photo.is_sun:
            assert 0 < photo.r < 0.5, photo.file
            assert -0.1 < photo.x < 1.1, photo.file
            assert -0.1 < photo.y < 1.1, photo.file


def test_photos_of_a_group_share_their_fate_and_baits_are_on_both_sides():
    fates = {}
    for photo in labels():
        if photo.group and not photo.is_sunless:
            fates.setdefault(photo.group, set()).add(photo.test)
    assert all(len(fate) == 1 for fate in fates.values())
    assert {photo.test for photo in labels() if photo.kind == "bait"} == {True, False}


def test_lightning_lights_a_darkened_sky_and_nothing_else():
    random = np.random.default_rng(1)
    scene = random.uniform(0.2, 0.4, (96, 128, 3)).astype(np.float32)
    sky = (np.arange(96)[:, None] < 60) * np.ones((1, 128), np.float32)
    for _ in range(5):
        lit = lightning(scene, sky, random)
        assert lit.dtype == np.float32
        assert lit.shape == scene.shape
        darkened = lit[60:] / scene[60:]
        assert np.ptp(darkened) < 1e-5
        assert darkened.max() < 0.6
        gained = (lit / (scene * darkened.mean())).mean(-1)[:60]
        assert gained.max() > 3
        assert gained.min() > 0.999
    assert np.array_equal(lightning(scene, np.zeros_like(sky), random), scene)
