"""How much is measured: everything, less of it, or just enough to see that the pieces run."""

from __future__ import annotations

from typing import NamedTuple


class Effort(NamedTuple):
    """Sizes and counts of a run."""

    runs: int  # of what takes milliseconds
    frame: tuple[int, int]  # pixels of the frame that is dragged
    photo: float  # megapixels of the photo that is opened
    megapixels: tuple[float, ...]  # of the photos that time and memory are plotted against
    film: tuple[int, tuple[int, int]]  # frames, and their size
    editors: int
    effects: int  # at most
    samples: tuple[str, ...]  # bundled photos that refinement is compared on
    table: str  # size of Bruneton's table
    march_pixels: int  # of the march in NumPy


FULL = Effort(
    runs=20,
    frame=(1024, 698),
    photo=12,
    megapixels=(0.2, 0.7, 2, 6, 12, 24),
    film=(120, (1920, 1080)),
    editors=20,
    effects=99,
    samples=("coast", "harbour", "meadow", "mountains"),
    table="small",
    march_pixels=1024 * 698,
)
QUICK = FULL._replace(
    runs=5,
    megapixels=(0.7, 12, 24),
    film=(16, (1920, 1080)),
    samples=("coast",),
    table="tiny",
    march_pixels=256 * 174,
)
TINY = QUICK._replace(
    runs=2,
    frame=(96, 64),
    photo=0.02,
    megapixels=(0.01, 0.02),
    film=(3, (96, 54)),
    editors=2,
    effects=2,
    march_pixels=48 * 32,
)
