"""What a scene remembers of the corrections worked out on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

T = TypeVar("T")

_SCENES = 4  # each holds full-size maps
_PAINTINGS = 64  # small copies: undo takes no time


@dataclass(eq=False)
class Memory:
    """Scenes by correction, and paintings by their strokes; the oldest are forgotten."""

    scenes: dict[Any, Any] = field(default_factory=dict)
    paintings: dict[Any, Any] = field(default_factory=dict)

    def scene(self, key: Any, make: Callable[[], T]) -> T:
        """Return the scene of a correction, made when it is not remembered."""
        scene: T = self.scenes.pop(key, None) or make()
        _store(self.scenes, key, scene, _SCENES)
        return scene

    def painting(self, strokes: Any, painting: Any) -> None:
        """Remember what some strokes made of the small copy."""
        _store(self.paintings, strokes, painting, _PAINTINGS)


def _store(memory: dict[Any, Any], key: Any, value: Any, most: int) -> None:
    memory[key] = value
    while len(memory) > most:
        memory.pop(next(iter(memory)), None)
