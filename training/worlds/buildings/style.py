"""How a façade looks, and what is drawn by chance: words, materials, a dwelling's style."""

from __future__ import annotations

from dataclasses import dataclass

from training.worlds.mesh import Random

DETAIL = 3  # 3: sills and hoods, 2: frames, 1: glazing bars, 0: glass only
WALLS, ROOFS = 6, 3  # colors of each


@dataclass(frozen=True)
class Style:
    """How a façade looks; shares are of the cell's width and of the storey's height."""

    wall: str
    ground: str  # of the ground floor
    cell: float = 2.6  # metres from window to window
    share: float = 0.42
    sill: float = 0.32
    head: float = 0.82
    tall: float = 1.0  # the ground floor's height in storeys
    recess: float = 0.15
    frame: float = 0.07
    bars: tuple[int, int] = (1, 1)  # upright and level glazing bars
    curve: str = "flat"
    hood: bool = False
    shutters: str = ""
    balcony: str = ""  # "single", "long" or none
    detail: int = DETAIL


def chance(random: Random, share: float) -> bool:
    """Return True with the given chance."""
    return bool(random.random() < share)


def pick(random: Random, *of: str) -> str:
    """Return one of the words."""
    return of[random.integers(len(of))]


def wall_name(random: Random) -> str:
    """Return a wall's material."""
    return f"wall{random.integers(WALLS)}"


def roof_name(random: Random) -> str:
    """Return a roof's material."""
    return f"roof{random.integers(ROOFS)}"


def dwelling_style(random: Random, detail: int) -> Style:
    """Return how a dwelling looks."""
    wall = wall_name(random)
    tall_windows = chance(random, 0.3)
    curve = pick(random, "flat", "flat", "flat", "segment", "round")
    return Style(
        wall,
        ground=wall if chance(random, 0.7) else pick(random, "stone", wall_name(random)),
        cell=random.uniform(2.0, 3.3),
        share=random.uniform(0.34, 0.6),
        sill=random.uniform(0.08, 0.2) if tall_windows else random.uniform(0.27, 0.36),
        head=random.uniform(0.76, 0.86),
        recess=random.uniform(0.1, 0.26),
        frame=random.uniform(0.05, 0.1),
        bars=(int(random.integers(0, 3)), int(random.integers(0, 3))),
        curve=curve if detail > 1 else "flat",
        hood=chance(random, 0.3),
        detail=detail,
    )
