"""How pictures enter the bundled networks, each of them once."""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import TypeVar
from weakref import WeakKeyDictionary

import numpy as np

from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.networks.onnx_file import bundled_session

STRIDE = 32
"""Width and height of an input are multiples of this (pixels)."""

K = TypeVar("K")
T = TypeVar("T")


def once(find: Callable[[K], T]) -> Callable[[K], T]:
    """Cache a result for as long as its argument lives; a second caller waits for the first."""
    results: WeakKeyDictionary[K, T] = WeakKeyDictionary()
    lock = Lock()

    @functools.wraps(find)
    def find_once(source: K) -> T:
        with lock:
            if source not in results:
                results[source] = find(source)
            return results[source]

    return find_once


def strided(width: int, height: int, scale: float) -> tuple[int, int]:
    """Return the size nearest to ``scale`` times ``width`` and ``height`` that a network takes."""
    columns, rows = (max(2, round(n * scale / STRIDE)) * STRIDE for n in (width, height))
    return columns, rows


def run(
    path: Path, finds: str, outputs: list[str], picture: np.ndarray, size: tuple[int, int]
) -> list[np.ndarray]:
    """Run a bundled network on a picture brought to its input's size.

    Parameters
    ----------
    path : Path
    finds : str
        What it finds, for errors.
    outputs : list of str
        Names of its outputs.
    picture : (h, w, 3)
        Encoded, [0, 1].
    size : (width, height)
        Of the input in pixels.

    Returns
    -------
    list of np.ndarray
        The outputs of the one picture, (c, h, w) where they are maps.

    Raises
    ------
    AnalysisError
        If the file or onnxruntime is missing.
    """
    image = np.clip(resize(picture, *size), 0, 1).transpose(2, 0, 1)[None]
    found = bundled_session(path, finds).run(
        outputs, {"image": np.ascontiguousarray(image, np.float32)}
    )
    return [output[0] for output in found]


def run_twice(
    path: Path,
    finds: str,
    outputs: list[str],
    picture: np.ndarray,
    size: tuple[int, int],
    turn_back: Callable[[dict[str, np.ndarray]], None] | None = None,
) -> list[np.ndarray]:
    """Return the means of what ``run`` finds in a picture and in its mirror image.

    What a network is unsure of differs between the two, so their mean is more often right
    (Krizhevsky et al., "ImageNet classification", 2012, section 4.1).

    Parameters
    ----------
    turn_back : callable, optional
        Exchanges left and right, in place, in the values of the mirror image's outputs by name.
        Maps are mirrored back as maps in any case.
    """
    plain, mirrored = (run(path, finds, outputs, p, size) for p in (picture, picture[:, ::-1]))
    if turn_back is not None:
        turn_back(dict(zip(outputs, mirrored, strict=True)))
    return [
        (one + (other[..., ::-1] if other.ndim == 3 else other)) / 2
        for one, other in zip(plain, mirrored, strict=True)
    ]
