"""What worlds there are: each family puts its things on its ground, otherwise by chance.

Where a family stands in ``TRAINING | TEST`` is part of its worlds' seeds: keep the order.
"""

from __future__ import annotations

from collections.abc import Callable

from training.worlds.families.country import field_, orchard, road, ruin
from training.worlds.families.towns import city, park, square, street, village
from training.worlds.families.waters import coast, fjord, harbour, lake
from training.worlds.families.wilds import dunes, mountains, snow, woods
from training.worlds.families.world import World
from training.worlds.mesh import Random

TRAINING: dict[str, Callable[[Random], World]] = {
    "coast": coast, "lake": lake, "field": field_, "woods": woods, "dunes": dunes, "snow": snow,
    "mountains": mountains, "village": village, "street": street, "road": road,
    "harbour": harbour, "park": park, "city": city,
}  # fmt: skip
TEST: dict[str, Callable[[Random], World]] = {
    "square": square, "fjord": fjord, "orchard": orchard, "ruin": ruin,
}  # fmt: skip
