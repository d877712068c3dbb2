"""The hand-labelled photos, and which of them only judge.

Labels are ``labels.csv`` beside this file: file, kind, x, y, r, group. ``x`` and ``y`` are the
centre in fractions of width and height, ``r`` the radius of the bright core in widths. Kinds: disc,
glow (the place is clear, no disc is seen), moon, art (a pasted or painted sun), none, bait (none,
but what a network took for one: lightning, a lamp, wet sand, a flower), drop. Photos
of a group show the same and share their fate; those of the group "photos" are also in the set on
which pictures are judged. The photos are not in this repository.
"""

from __future__ import annotations

import csv
import hashlib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

LABELS = Path(__file__).with_name("labels.csv")


@dataclass
class Photo:
    """One labelled photo."""

    file: str
    kind: str
    x: float
    y: float
    r: float
    group: str

    @property
    def is_sun(self) -> bool:
        """Whether a sun is seen, be it pasted."""
        return self.kind in ("disc", "art")

    @property
    def is_sunless(self) -> bool:
        """Whether there is neither sun, glow nor moon, be there what resembles one."""
        return self.kind in ("none", "bait")

    @property
    def test(self) -> bool:
        """Whether it only judges: half of those with a sun or moon, an eighth of the others."""
        if self.group == "photos":
            return True
        draw = hashlib.sha256(f"sun/{self.group or self.file}".encode()).digest()[0]
        return draw % (8 if self.is_sunless and "landscape" in self.file else 2) == 0


@cache
def judging() -> frozenset[str]:
    """Files whose labels, of suns and of water, only judge."""
    return frozenset(photo.file for photo in labels() if photo.test)


def labels(path: Path = LABELS) -> list[Photo]:
    """Every labelled photo."""
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Photo(r["file"], r["kind"], *(float(r[k] or "nan") for k in "xyr"), r["group"])
            for r in csv.DictReader(file)
        ]
