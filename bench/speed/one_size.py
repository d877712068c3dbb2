"""Open, analyse and draw one photo; seconds and peak memory as JSON on stdout.

usage: python -m speed.one_size PHOTO
"""

from __future__ import annotations

import json
import resource
import sys
from pathlib import Path
from typing import Any

import sunwidget as sw

from .timing import Times, clock, timed

FRAMES = 3


def peak() -> float:
    """Return the most memory that this process has held, in GB."""
    status = Path("/proc/self/status")
    if status.exists():
        # Not ru_maxrss: that is the parent's where the parent was larger.
        facts = dict(line.split(":", 1) for line in status.read_text().splitlines())
        return int(facts["VmHWM"].split()[0]) * 1024 / 1e9
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9


def main(path: str) -> None:
    found: dict[str, Any] = {"begin memory": peak()}

    def keep(step: str, times: Times) -> None:
        found[step], found[f"{step} processor"] = times
        found[f"{step} memory"] = peak()

    times = Times([], [])
    with clock(times):
        photo = sw.open(path)
        photo.preview(2048)
    keep("open", times)
    times = Times([], [])
    with clock(times):
        scene = sw.analyze(photo)
    keep("analyse", times)
    keep("frame", timed(lambda i: sw.render(scene, sw.Edit(sun_elevation=2 + i)), FRAMES))
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1])
