"""Photos whose skies and waters were corrected by eye: what counts as wrong."""

import numpy as np
import pytest

from bench.masks import wrong_share


def test_only_wide_known_mistakes_count():
    mask = np.zeros((300, 480), np.uint8)
    mask[:150] = 255
    sky = (mask > 191).astype(np.float32)
    assert wrong_share(sky, mask) == 0
    hair = sky.copy()
    hair[150:154] = 1  # thinner than an outline is exact
    assert wrong_share(hair, mask) == 0
    patch = sky.copy()
    patch[200:230, 100:148] = 1
    assert wrong_share(patch, mask) == pytest.approx(30 * 48 / (300 * 480), rel=0.02)
    mask[190:240, 90:160] = 128
    assert wrong_share(patch, mask) == 0
    assert wrong_share(np.zeros((75, 120)), mask) == pytest.approx(0.5, rel=0.02)
