"""A scene's cache of corrections applied to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

T = TypeVar("T")

_SCENES = 4  # each has full-size maps
_PAINTINGS = 64  # small copies, so that undo is instant


@dataclass(eq=False)
class Memory:
    """Scenes by correction, and paintings by their strokes; the oldest are dropped."""

    scenes: dict[Any, Any] = field(default_factory=dict)
    paintings: dict[Any, Any] = field(default_factory=dict)

    def scene(self, key: Any, make: Callable[[], T]) -> T:
        """Return the scene of a correction, from the cache or from ``make``."""
        scene: T = self.scenes.pop(key, None) or make()
        _store(self.scenes, key, scene, _SCENES)
        return scene

    def painting(self, strokes: Any, painting: Any) -> None:
        """Store the painting of some strokes on the small copy."""
        _store(self.paintings, strokes, painting, _PAINTINGS)


def _store(memory: dict[Any, Any], key: Any, value: Any, most: int) -> None:
    memory[key] = value
    while len(memory) > most:
        memory.pop(next(iter(memory)), None)
