"""What one more effect adds to a frame: each switched off, or on, in turn with the default."""

from __future__ import annotations

import statistics

import sunwidget as sw

from .effort import Effort
from .pictures import analysed
from .rows import Row, Rows
from .timing import timed

KEYS = ("one more effect",)
# An effect and the values of an edit without it; those that the default leaves out, with it.
WITHOUT: dict[str, dict[str, float]] = {
    name: {name: 0.0}
    for name in (
        "shading",
        "gloss",
        "cast_shadows",
        "cloud_shadows",
        "aerial_perspective",
        "water_strength",
        "glitter",
        "glow",
        "light_shafts",
        "silver_lining",
        "grain",
    )
}
WITH: dict[str, dict[str, float]] = {
    "lens_flare": {"lens_flare": 0.5},
    "added_clouds": {"added_clouds": 0.4},
}


def rows(effort: Effort) -> Rows:
    width, height = effort.frame
    scene = analysed(width, height)
    found: dict[str, float] = {}
    for name, values in [*WITHOUT.items(), *WITH.items()][: effort.effects]:

        def frame(i: int, values: dict[str, float]) -> None:
            sw.render(scene, sw.Edit(sun_elevation=1 + 0.7 * i % 17, **values))

        default: list[float] = []
        other: list[float] = []
        for block in range(max(1, effort.runs // 4)):
            for kept, chosen in ((default, {}), (other, values)):
                # Not counted is the first: it draws what does not follow the sun.
                kept += timed(lambda i, b=block, c=chosen: frame(4 * b + i, c), 3).processor
        more, less = (other, default) if name in WITH else (default, other)
        found[name] = statistics.median(more) / statistics.median(less)
        yield Row(f"effect {name}", f"frame with {name} over one without", found[name], "×")
    worst = max(found, key=lambda name: found[name])
    yield Row(
        "one more effect",
        f"frame {width}×{height} with the dearest effect over one without",
        found[worst],
        "×",
        note=f"{worst}; processor time",
    )
