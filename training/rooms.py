"""Views into real rooms, cut from panoramas: photos that hold no sky.

Any folder of equirectangular Radiance pictures (``*.hdr``) of interiors will do; the shipped
network saw 22 of Poly Haven's (CC0), named in the model card. High dynamic range lets every view
be exposed anew, so that windows and lamps burn out as they do in photos.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

Random = np.random.Generator


class Rooms:
    """Panoramas ``(H, 2H, 3)`` float16, linear RGB, median 1."""

    def __init__(self, folder: Path | None) -> None:
        self.panoramas = [] if folder is None else [load(p) for p in sorted(folder.glob("*.hdr"))]

    def __bool__(self) -> bool:
        return bool(self.panoramas)

    def view(self, size: int, random: Random) -> np.ndarray:
        """A view as a camera would take it, squeezed to a square; ``(S, S, 3)`` uint8 sRGB."""
        panorama = self.panoramas[random.integers(len(self.panoramas))]
        width = np.tan(np.radians(random.uniform(35, 105)) / 2)
        height = width * np.exp(random.uniform(-0.6, 0.3))
        yaw, pitch = random.uniform(0, 2 * np.pi), np.radians(random.normal(6, 14))
        roll = np.radians(random.normal(0, 3))
        ramp = (np.arange(size, dtype=np.float32) + 0.5) / size * 2 - 1
        x, y = np.meshgrid(ramp * width, -ramp * height)
        x, y = x * np.cos(roll) - y * np.sin(roll), x * np.sin(roll) + y * np.cos(roll)
        up, forward = y * np.cos(pitch) + np.sin(pitch), np.cos(pitch) - y * np.sin(pitch)
        azimuth = (np.arctan2(x, forward) + yaw) / (2 * np.pi)
        polar = np.arctan2(np.hypot(x, forward), up) / np.pi
        rows, columns = panorama.shape[:2]
        linear = cv2.remap(
            panorama.astype(np.float32),
            ((azimuth * columns) % columns).astype(np.float32),
            (polar * rows).astype(np.float32),
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_WRAP,
        )
        middle = float(np.median(linear)) + 1e-6
        exposed = linear * np.float32(0.18 * np.exp(random.normal(0.4, 0.6)) / middle)
        if random.random() < 0.5:
            exposed = exposed * 1.25 / (1 + 0.25 * exposed)  # a soft shoulder, as many cameras have
        mirrored = exposed[:, ::-1] if random.random() < 0.5 else exposed
        return (np.clip(mirrored, 0, 1) ** np.float32(1 / 2.2) * 255).astype(np.uint8)


def load(path: Path) -> np.ndarray:
    """One panorama, brought to a median of 1 so that half floats hold it."""
    bgr = cv2.imread(str(path), cv2.IMREAD_ANYDEPTH | cv2.IMREAD_COLOR)
    if bgr is None:
        raise SystemExit(f"{path} is no Radiance picture (.hdr) that OpenCV can read")
    rgb = bgr[..., ::-1]
    return np.clip(rgb / max(float(np.median(rgb)), 1e-6), 0, 6e4).astype(np.float16)
