"""Draw docs/suns.jpg: a sample as it is, and with its sun moved three times.

usage: python scripts/readme_picture.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import sunwidget as sw

PICTURE = Path(__file__).resolve().parents[1] / "docs" / "suns.jpg"
SIZE = (720, 480)
EDITS = (
    sw.Edit(),
    sw.Edit(sun_azimuth=-8, sun_elevation=7),
    sw.Edit(sun_azimuth=10, sun_elevation=3),
    sw.Edit(sun_azimuth=6, sun_elevation=-3),
)

if __name__ == "__main__":
    scene = sw.analyze(sw.sample("mountains"))
    frames = [sw.render(scene, edit, size=SIZE) for edit in EDITS]
    sheet = np.vstack([np.hstack(frames[:2]), np.hstack(frames[2:])])
    Image.fromarray(sheet).save(PICTURE, quality=82, optimize=True)
    print(PICTURE)
