"""From what a segmentation network returns to a map of the sky, whatever its form.

The thesis takes the pixels whose strongest class is "sky" (equations 3.1 and 3.2). ``sky_of``
keeps that border exactly and stays soft around it.
"""

from __future__ import annotations

import ast
import json
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from sunwidget.errors import AnalysisError

LABELS = {1: 0, 2: 1, 19: 10, 150: 2, 151: 3}
"""Index of "sky" by the number of classes: sky alone, land and sky, Cityscapes, ADE20K, and
ADE20K with its background class."""
LABEL_MAP = 2  # a map of labels does not say how many there are: ADE20K's, as in the thesis
_MOST_CLASSES = 65_536  # larger numbers are scores, whole as they may be

_KNOWN = (
    "2 for ADE20K's 150 classes, 3 for its 151 with background, 10 for Cityscapes' 19, "
    "1 for land and sky"
)


class Output(NamedTuple):
    """One output of a network, understood.

    ``kind`` is "sky" (h, w), probability or logit; "labels" (h, w), class indices; or "scores"
    (h, w, classes), logits or probabilities.
    """

    kind: str
    values: np.ndarray

    @property
    def classes(self) -> int | None:
        """Number of classes; None when a map of labels does not tell."""
        return {"sky": 1, "labels": None}.get(self.kind, self.values.shape[-1])


def understand(
    output: object, size: tuple[int, int], layout: str, label: int | None = None
) -> Output | None:
    """Tell which axes of an output are rows, columns and classes; None when it is no map.

    Parameters
    ----------
    output : array
        (h, w), (1, h, w), (h, w, 1), (1, classes, h, w) or (1, h, w, classes), any number type.
    size : (width, height)
        Of the network's input: the map's axes have its proportions.
    layout : {"nchw", "nhwc"}
        Of the network's input: decides where the proportions do not.
    label : int, optional
        Class asked for; a map without it does not fit.
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
    if array.ndim == 2:
        if _whole_numbers(array, label):
            return Output("labels", array.astype(np.int64))
        fits = label in (None, 0)
        return Output("sky", array.astype(np.float32)) if fits else None
    if array.dtype.kind != "f" or (label is not None and label >= array.shape[-1]):
        return None
    return Output("scores", array.astype(np.float32))


def _class_axis(shape: tuple[int, ...], size: tuple[int, int], layout: str) -> int:
    """Axis of the classes: the one without which the rest has the picture's proportions."""

    def distortion(height: int, width: int) -> float:
        return abs(float(np.log(width / height * size[1] / size[0])))

    if 1 in (shape[0], shape[2]):
        return 0 if shape[0] == 1 else 2
    first, last = distortion(shape[1], shape[2]), distortion(shape[0], shape[1])
    if abs(first - last) < 1e-6:
        return 0 if layout == "nchw" else 2
    return 0 if first < last else 2


def _whole_numbers(array: np.ndarray, label: int | None) -> bool:
    """Tell a map of labels, which some exports return as floats, from a map of the sky."""
    if array.dtype.kind == "b":
        return False
    if array.dtype.kind != "f":
        return True
    if not np.isfinite(array).all() or array.min() < 0 or array.max() > _MOST_CLASSES:
        return False
    if np.any(array != np.round(array)):
        return False
    return bool(array.max() > 1) or label not in (None, 0)


def sky_of(output: Output, label: int) -> np.ndarray:
    """Return the sky (h, w) float32 in [0, 1], above 0.5 exactly where sky is the likeliest.

    For scores that is the odds of sky against the strongest other class: the logistic function
    of the difference of their logits, or p / (p + q) for probabilities.

    Raises
    ------
    AnalysisError
        When the network returned NaN or infinite values.
    """
    values = output.values
    if output.kind == "labels":
        return (values == label).astype(np.float32)
    if not np.isfinite(values).all():
        share = 1 - float(np.isfinite(values).mean())
        raise AnalysisError(
            f"The sky network returned NaN or infinite values ({share:.0%} of them): its "
            "normalisation is wrong or the file is damaged. Give sky=SkyNetwork(path, mean=…, "
            "std=…), another network or a mask."
        )
    probable = values.min() >= -1e-3 and values.max() <= 1 + 1e-3
    if output.kind == "sky":
        return np.clip(values, 0, 1) if probable else _logistic(values)
    sky = values[..., label]
    other = np.delete(values, label, axis=-1).max(axis=-1)
    if probable:
        return np.clip(sky / np.maximum(sky + other, 1e-9), 0, 1)
    return _logistic(sky - other)


def _logistic(x: np.ndarray) -> np.ndarray:
    return (1 / (1 + np.exp(-np.clip(x, -40, 40)))).astype(np.float32)


def label_of(
    wanted: int | str | None, classes: int | None, names: Mapping[int, str], network: str
) -> int | None:
    """Return the index of the sky's class, or None when nothing says which one it is.

    Parameters
    ----------
    wanted : int, str or None
        Index or name that the caller gave.
    classes : int or None
        How many the network has; None for a map of labels.
    names : dict
        Index to name, as the file gives them; may be empty.
    network : str
        For the error.

    Raises
    ------
    AnalysisError
        When there is no such class.
    """
    if isinstance(wanted, str):
        indices = [i for i, name in names.items() if wanted.strip().lower() in _synonyms(name)]
        if not indices:
            listed = ", ".join(f"{i} {n}" for i, n in list(names.items())[:200])
            told = f"its classes are {listed}" if names else "the file names none"
            raise AnalysisError(
                f"{network} has no class {wanted!r:.80}: {told}. Pass the index: {_KNOWN}."
            )
        wanted = indices[0]
    if wanted is not None:
        if classes is not None and not 0 <= wanted < classes:
            raise AnalysisError(
                f"{network} has no class {wanted}: it has {classes}, counted from 0. Known "
                f"indices of the sky: {_KNOWN}."
            )
        return wanted
    for index, name in names.items():
        if "sky" in _synonyms(name) and (classes is None or index < classes):
            return index
    return LABEL_MAP if classes is None else LABELS.get(classes)


def _synonyms(name: str) -> set[str]:
    """ADE20K names a class by several words: "sidewalk, pavement" or "sidewalk;pavement"."""
    words = name.lower().replace(";", ",").split(",")
    return {word.strip() for word in words} | {name.lower()}


def which_label(network: str, classes: int | None, best: tuple[int, float]) -> AnalysisError:
    """Return the error that asks for ``sky_label``; ``best`` is a class and its overlap."""
    guess = (
        f"Class {best[0]} lies over the sample pictures' sky best (IoU {best[1]:.2f}): pass "
        f"sky_label={best[0]} if that is it."
        if best[1] > 0.3
        else "None of them lies over the sample pictures' sky."
    )
    return AnalysisError(
        f"{network} has {classes} classes and does not say which one is sky. Pass "
        f"sky_label=index or name ({_KNOWN}). {guess}"
    )


def names_from(metadata: Mapping[str, str]) -> dict[int, str]:
    """Read the names of the classes from a file's metadata; empty when it has none.

    Takes a JSON or Python list or dictionary, or words between commas or line ends, under one
    of the keys in use: names, classes, labels, class_names, id2label.
    """
    for key in ("names", "classes", "labels", "class_names", "id2label"):
        if not metadata.get(key):
            continue
        value = _literal(metadata[key])
        if isinstance(value, str):
            value = [word.strip() for word in value.replace("\n", ",").split(",")]
        try:
            if isinstance(value, Mapping):
                return {int(index): str(name) for index, name in value.items()}
            if isinstance(value, Sequence):
                return {index: str(name) for index, name in enumerate(value)}
        except ValueError:  # a dictionary the other way round, or of something else
            continue
    return {}


def normalisation_from(metadata: Mapping[str, str]) -> tuple[np.ndarray, np.ndarray] | None:
    """Read mean and deviation of the input, in units of [0, 1], from a file's metadata."""
    found = []
    for what in ("mean", "std"):
        values = [metadata[k] for k in (what, "image_" + what, "img_" + what) if k in metadata]
        try:
            numbers = np.asarray(_literal(values[0]), np.float32).reshape(-1) if values else None
        except (TypeError, ValueError):
            numbers = None
        if numbers is None or numbers.size not in (1, 3) or not np.isfinite(numbers).all():
            return None
        found.append(numbers)
    mean, std = found
    if not (std > 0).all():
        return None
    # In units of code values, as (123.675, 116.28, 103.53) and (58.395, 57.12, 57.375).
    return (mean / 255, std / 255) if max(mean.max(), std.max()) > 2 else (mean, std)


def _literal(text: str) -> object:
    for parse in (json.loads, ast.literal_eval):
        try:
            return parse(text)
        except (ValueError, SyntaxError, RecursionError, MemoryError):
            continue
    return text
