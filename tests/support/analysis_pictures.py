"""Small drawn pictures that the tests of the analysis share."""

import numpy as np


def seascape(width=240, height=160, horizon=0.6, disc=(0.7021, 0.3531)):
    """Blue sky, paler downwards, a sun with its aureole, dark sea: (height, width, 3) uint8."""
    rows, columns = np.mgrid[:height, :width] + 0.5
    share = np.clip(rows / (horizon * height), 0, 1)[..., None]
    code = (1 - share) * np.array([70, 120, 200]) / 255 + share * np.array([170, 195, 220]) / 255
    if disc is not None:
        distance = np.hypot(columns - disc[0] * width, rows - disc[1] * height) / width
        code += (0.6 * np.exp(-distance / 0.12))[..., None] * (1 - code)
        code = np.where((distance < 0.0135)[..., None], 1.0, code)
    grain = np.random.default_rng(3).normal(0, 0.02, (height, width, 1))
    sea = np.array([40, 60, 70]) / 255 + grain
    code = np.where(rows[..., None] > horizon * height, sea, code + 0.1 * grain)
    return np.round(np.clip(code, 0, 1) * 255).astype(np.uint8)
