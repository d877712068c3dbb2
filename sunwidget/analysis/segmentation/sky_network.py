"""Any segmentation network in an ONNX file as the source of the coarse sky (thesis 3.1.1.1).

A file says how its input is laid out and what type it has. What it seldom says, the scale of its
input, is found by trying: see ``calibrate``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks import segmentation_output
from sunwidget.analysis.networks.onnx_file import SIDE, Opened, Scale
from sunwidget.errors import AnalysisError

BUNDLED = Path(__file__).parents[1] / "models" / "sky.onnx"
# Mean and deviation in use, in units of [0, 1]; the first of equally good ones is taken.
NORMALISATIONS: tuple[tuple[Any, Any], ...] = (
    (0.0, 1.0),  # 0 to 1
    ((0.485, 0.456, 0.406), (0.229, 0.224, 0.225)),  # ImageNet's
    (0.5, 0.5),  # -1 to 1
    (0.0, 1 / 255),  # 0 to 255: the network scales its input itself
)
SAMPLES = ("coast", "meadow")  # on which the scale is tried


@dataclass(frozen=True)
class SkyNetwork:
    """A network that finds the sky, for ``analyze(sky=…)``; whatever is None is detected.

    Parameters
    ----------
    path : str or Path
        The .onnx file. It takes one picture and returns class scores, class labels or a map
        of the sky, in any of the usual layouts.
    label : int or str, optional
        The sky's class, as index from 0 or as one of the names in the file's metadata. Needed
        unless the file names a class "sky", or has 1 (sky), 2 (land and sky), 150 or 151
        (ADE20K: 2 or 3) or 19 (Cityscapes: 10) classes, or returns labels (ADE20K: 2).
    layout : {"nchw", "nhwc"}, optional
        Of the input; needed only when the file leaves every dimension open.
    channels : {"rgb", "bgr"}
        Order of the colours.
    mean, std : float or (r, g, b), optional
        The network sees (value - mean) / std of encoded values in [0, 1], in the order of
        ``channels``. std=1/255 stands for code values 0 to 255.
    size : int or (width, height), optional
        Of the picture that the network sees, in pixels, where the file leaves it open;
        default 384.

    Raises
    ------
    AnalysisError
        For a field that cannot be used.
    """

    path: str | Path
    label: int | str | None = None
    layout: Literal["nchw", "nhwc"] | None = None
    channels: Literal["rgb", "bgr"] = "rgb"
    mean: float | tuple[float, float, float] | None = None
    std: float | tuple[float, float, float] | None = None
    size: int | tuple[int, int] | None = None

    def __post_init__(self) -> None:
        whole = isinstance(self.label, (int, np.integer)) and not isinstance(self.label, bool)
        if not (self.label is None or isinstance(self.label, str) or (whole and self.label >= 0)):
            raise AnalysisError(
                f"sky_label must be a class's index from 0 or its name, not {self.label!r:.80}."
            )
        if self.layout not in (None, "nchw", "nhwc"):
            raise AnalysisError(f"layout must be 'nchw' or 'nhwc', not {self.layout!r:.80}.")
        if self.channels not in ("rgb", "bgr"):
            raise AnalysisError(f"channels must be 'rgb' or 'bgr', not {self.channels!r:.80}.")
        for name, lowest in (("mean", -np.inf), ("std", 0.0)):
            value = getattr(self, name)
            if value is not None and not _numbers(value, (1, 3), lowest):
                raise AnalysisError(
                    f"{name} must be one number or three, in units of [0, 1], "
                    f"{'above 0, ' if name == 'std' else ''}not {value!r:.80}."
                )
        if self.size is not None and not _numbers(self.size, (1, 2), 0):
            raise AnalysisError(
                f"size must be pixels or (width, height), above 0, not {self.size!r:.80}."
            )
        # Hashable and plain, whatever sequence or NumPy number was given.
        if whole:
            object.__setattr__(self, "label", int(self.label))  # type: ignore[arg-type]
        for name, kind in (("mean", float), ("std", float), ("size", int)):
            value = getattr(self, name)
            if value is not None and np.ndim(value):
                object.__setattr__(self, name, tuple(kind(v) for v in value))

    def __call__(self, working: Working) -> np.ndarray:
        """Return the sky's probability (h, w) float32 at the network's own size.

        Above 0.5 exactly where sky is the strongest class (thesis, equations 3.1 and 3.2).

        Raises
        ------
        AnalysisError
            When the file is missing or no network, its input is no picture, it does not say
            which class is sky, it has no such class, or it fails on the picture.
        """
        opened = self.open()
        label, scale = calibrate(self, opened.stamp)
        output = opened.run(self.arrange(working.encoded), scale, label)
        # Is there such a class?
        segmentation_output.label_of(label, output.classes, {}, str(self.path))
        return segmentation_output.sky_of(output, label)

    def open(self) -> Opened:
        """Return the opened file, with what its input is."""
        return Opened.of(self.path, self.layout, self.size)

    def arrange(self, picture: np.ndarray) -> np.ndarray:
        """Return a ``picture`` (h, w, 3) with its channels in the network's order."""
        return picture if self.channels == "rgb" else picture[..., ::-1]


@lru_cache(maxsize=16)
def calibrate(network: SkyNetwork, _stamp: tuple[int, int] = (0, 0)) -> tuple[int, Scale]:
    """Return the sky's class, and the mean and deviation of the input.

    The scale is the given one, code values for a network of bytes, the one in the file's
    metadata, or else the one of ``NORMALISATIONS`` with which the network agrees best with the
    bundled network on the bundled samples. Not the one with which it is most confident: values
    too large by 255 make most networks very sure. So the scale is a property of the network and
    never changes from photo to photo.

    Raises
    ------
    AnalysisError
        When the sky's class is not known (see ``SkyNetwork``), or nothing comes out.
    """
    opened = network.open()
    scales = _scales(network, opened)
    if len(scales) == 1 and isinstance(network.label, int):
        return network.label, scales[0]
    pictures = [(network.arrange(picture), sky) for picture, sky in _samples()]
    wanted = network.label if isinstance(network.label, int) else None
    first = opened.run(pictures[0][0], scales[0], wanted)
    names = segmentation_output.names_from(opened.metadata)
    label = segmentation_output.label_of(network.label, first.classes, names, str(network.path))
    if label is None:
        raise _which_label(opened, scales, pictures)
    if len(scales) == 1:
        return label, scales[0]
    agreements = []
    failure = None
    for scale in scales:
        try:
            agreements.append(_agreement(opened, scale, label, pictures))
        except AnalysisError as error:  # this scale overflows: another one may not
            failure = error
            agreements.append(-1.0)
    if failure is not None and max(agreements) < 0:
        raise failure
    return label, scales[int(np.argmax(agreements))]


Pictures = Sequence[tuple[np.ndarray, np.ndarray]]


def _agreement(opened: Opened, scale: Scale, label: int, pictures: Pictures) -> float:
    """Overlap of the network's skies with the known ones, 0 to 1 (soft intersection over union)."""
    overlaps = []
    for picture, truth in pictures:
        sky = segmentation_output.sky_of(opened.run(picture, scale, label), label)
        known = resize(truth, *sky.shape[::-1])
        overlaps.append(np.minimum(sky, known).sum() / max(np.maximum(sky, known).sum(), 1.0))
    return float(np.mean(overlaps))


def _scales(network: SkyNetwork, opened: Opened) -> Sequence[Scale]:
    """Return the scales of the input that come into question."""
    given = network.mean is not None or network.std is not None
    if opened.type is np.uint8:
        if given:
            raise AnalysisError(f"{network.path} takes bytes, 0 to 255; leave out mean= and std=.")
        return ((0.0, 1 / 255),)
    if given:
        return ((network.mean or 0.0, network.std or 1.0),)
    found = segmentation_output.normalisation_from(opened.metadata)
    if found is not None:
        return (found,)
    if network.channels == "rgb":
        return NORMALISATIONS
    return tuple((np.flip(mean), np.flip(deviation)) for mean, deviation in NORMALISATIONS)


def _which_label(opened: Opened, scales: Sequence[Scale], pictures: Pictures) -> AnalysisError:
    """Return the error that asks for the class, naming the one that fits the samples best."""
    best, classes = (0, 0.0), 0
    for scale in scales:
        shared, united = np.zeros(1), np.ones(1)
        for picture, sky in pictures:
            values = opened.run(picture, scale, None).values
            classes = values.shape[-1]
            known = resize(sky, *values.shape[1::-1]).reshape(-1) > 0.5
            strongest = values.argmax(axis=-1).reshape(-1)
            inside = np.bincount(strongest[known], minlength=classes)
            shared = shared + inside
            united = united + np.bincount(strongest, minlength=classes) + known.sum() - inside
        overlap = shared / united
        fits = int(np.argmax(overlap))
        best = max(best, (fits, float(overlap[fits])), key=lambda pair: pair[1])
    return segmentation_output.which_label(opened.path, classes, best)


@lru_cache(maxsize=1)
def _samples() -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    """Return the samples, encoded, and their skies as the bundled network sees them."""
    from sunwidget.samples import sample

    small = [Working.of(sample(name), SIDE) for name in SAMPLES]
    return tuple((working.encoded, bundled()(working)) for working in small)


def bundled() -> SkyNetwork:
    """Return the network that comes with the package."""
    return SkyNetwork(BUNDLED, label=0, mean=0.0, std=1.0)


def _numbers(value: Any, counts: tuple[int, ...], lowest: float) -> bool:
    try:
        array = np.asarray(value, float).reshape(-1)
    except (TypeError, ValueError):
        return False
    return array.size in counts and bool(np.isfinite(array).all() and (array > lowest).all())
