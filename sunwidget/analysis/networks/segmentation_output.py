"""Convert the output of a segmentation network to a map of the sky.

The thesis takes the pixels whose strongest class is "sky" (equations 3.1 and 3.2). ``sky_of``
keeps that border exactly and is soft around it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from sunwidget.errors import AnalysisError

LABELS = {1: 0, 2: 1, 19: 10, 150: 2, 151: 3, None: 2}
"""Index of "sky" by the number of classes: only sky, land and sky, Cityscapes, ADE20K, and ADE20K
with a background class. None stands for a map of labels, ADE20K's as in the thesis."""

_KNOWN = (
    "2 for ADE20K's 150 classes, 3 for its 151 with background, 10 for Cityscapes' 19, "
    "1 for land and sky"
)


def map_of(output: object, size: tuple[int, int], layout: str) -> np.ndarray | None:
    """Return a network's output as a map, or None if it is not one.

    Parameters
    ----------
    output : array
        (h, w), (1, h, w), (h, w, 1), (1, classes, h, w) or (1, h, w, classes), any numeric type.
    size : (width, height)
        Of the network's input, whose aspect ratio the map has.
    layout : {"nchw", "nhwc"}
        Of the network's input; decides if the aspect ratio does not.

    Returns
    -------
    (h, w) of whole numbers, (h, w) float32 or (h, w, classes) float32
        Labels, one value, or class scores per pixel.
    """
    array = np.asarray(output)
    if array.dtype.kind not in "fiub" or 0 in array.shape:
        return None
    if array.ndim == 4 and array.shape[0] == 1:
        array = array[0]
    if array.ndim == 3:
        array = np.moveaxis(array, _class_axis(array.shape, size, layout), -1)
        if array.shape[-1] == 1:
            array = array[..., 0]
    if array.ndim not in (2, 3) or min(array.shape[:2]) < 2:
        return None
    return array if array.ndim == 2 and array.dtype.kind in "iu" else array.astype(np.float32)


def _class_axis(shape: tuple[int, ...], size: tuple[int, int], layout: str) -> int:
    """Return the axis of length 1, else the one whose removal leaves the picture's aspect ratio."""

    def misfit(axis: int) -> tuple[bool, float]:
        height, width = np.delete(shape, axis)
        distortion = abs(float(np.log(width / height * size[1] / size[0])))
        return shape[axis] != 1, round(distortion, 6)

    return min((0, 2) if layout == "nchw" else (2, 0), key=misfit)


def sky_of(values: np.ndarray, label: int) -> np.ndarray:
    """Return the sky (h, w) float32 in [0, 1], above 0.5 exactly where sky is the likeliest class.

    Scores give the odds of sky against the strongest other class: the logistic function of the
    difference of their logits, or p / (p + q) for probabilities. One value per pixel is the
    sky's probability or logit, or a label if its type is an integer or ``label`` is not 0.

    Raises
    ------
    AnalysisError
        If the network returned NaN or infinite values.
    """
    if values.ndim == 2 and (label or values.dtype.kind != "f"):
        return (values == label).astype(np.float32)
    if not np.isfinite(values).all():
        share = 1 - float(np.isfinite(values).mean())
        raise AnalysisError(
            f"The sky network returned NaN or infinite values ({share:.0%} of them): its "
            "normalization is wrong or the file is damaged. Give sky=SkyNetwork(path, mean=…, "
            "std=…), another network or a mask."
        )
    probable = values.min() >= -1e-3 and values.max() <= 1 + 1e-3
    if values.ndim == 2:
        return np.clip(values, 0, 1) if probable else _logistic(values)
    sky = values[..., label]
    other = np.delete(values, label, axis=-1).max(axis=-1)
    if probable:
        return np.clip(sky / np.maximum(sky + other, 1e-9), 0, 1)
    return _logistic(sky - other)


def _logistic(x: np.ndarray) -> np.ndarray:
    return (1 / (1 + np.exp(-np.clip(x, -40, 40)))).astype(np.float32)


def label_of(
    wanted: int | str | None, values: np.ndarray, names: Mapping[int, str], network: str
) -> int:
    """Return the index of the sky's class.

    Parameters
    ----------
    wanted : int, str or None
        Index or name from the caller. None selects the class that the file names "sky", else the
        one in ``LABELS``.
    values : ndarray
        The network's output as a map (``map_of``).
    names : dict
        Names by index from the file; may be empty.
    network : str
        Named in the error.

    Raises
    ------
    AnalysisError
        If there is no such class, or nothing identifies the sky's class.
    """
    classes: int | None = values.shape[-1] if values.ndim == 3 else 1
    if values.ndim == 2 and (values.dtype.kind != "f" or (wanted and _whole(values))):
        classes = None  # labels do not reveal the number of classes
    if isinstance(wanted, int):
        index: int | None = wanted
    else:
        word = "sky" if wanted is None else wanted.strip().lower()
        index = next((i for i, name in names.items() if word in _synonyms(name)), None)
        if wanted is None and (index is None or (classes and index >= classes)):
            index = LABELS.get(classes)
    if index is not None and (classes is None or 0 <= index < classes):
        return index
    if wanted is None:
        problem = f"has {classes} classes and does not say which one is sky"
    elif isinstance(wanted, int) or index is not None:
        problem = f"has no class {index}: it has {classes}, counted from 0"
    else:
        listed = ", ".join(f"{i} {name}" for i, name in list(names.items())[:200])
        named = f"its classes are {listed}" if names else "the file names none"
        problem = f"has no class {wanted!r:.80}: {named}"
    raise AnalysisError(f"{network} {problem}. Pass sky_label=index or name: {_KNOWN}.")


def _whole(values: np.ndarray) -> bool:
    return bool((values == np.round(values)).all())


def _synonyms(name: str) -> list[str]:
    """ADE20K names a class by several words: "sidewalk, pavement" or "sidewalk;pavement"."""
    whole = name.strip().lower()
    return [whole, *re.split(r"\s*[,;]\s*", whole)]
