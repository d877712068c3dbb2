"""Any segmentation network in an ONNX file as the source of the coarse sky (thesis 3.1.1.1).

The file specifies layout, type and size of its input. The scale of the input and the sky's class,
which the file may lack, are arguments of ``SkyNetwork`` with defaults.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.onnx_file import Opened
from sunwidget.analysis.networks.segmentation_output import label_of, sky_of
from sunwidget.errors import AnalysisError


@dataclass(frozen=True)
class SkyNetwork:
    """A network that finds the sky, for ``analyze(sky=…)``.

    Parameters
    ----------
    path : str or Path
        The .onnx file. The network takes one picture and returns class scores, class labels or a
        map of the sky, in any of the usual layouts.
    label : int or str, optional
        The sky's class, as index from 0 or as one of the names in the file's metadata. Default:
        the class that the metadata name "sky", else by the number of classes: 0 of 1, 1 of 2
        (land and sky), 2 of 150 and 3 of 151 (ADE20K), 10 of 19 (Cityscapes), 2 in a map of
        labels. Required for any other number, and for a map of labels stored as floats.
    layout : {"nchw", "nhwc"}, optional
        Layout of the input. Default: inferred from the axis with 3 channels, else "nchw".
    channels : {"rgb", "bgr"}
        Order of the color channels.
    mean, std : float or (r, g, b), optional
        The network's input is (value - mean) / std of encoded values in [0, 1], in the order of
        ``channels``. std=1/255 gives code values 0 to 255. Default: the entries of these names in
        the file's metadata, else 0 and 1.
    size : int or (width, height), optional
        Of the network's input in pixels, if the file does not fix it; default 384.
    output : str, optional
        Name of the output. Default: the first that is a map.

    Raises
    ------
    AnalysisError
        For an invalid field.

    Examples
    --------
    >>> imagenet = {"mean": (0.485, 0.456, 0.406), "std": (0.229, 0.224, 0.225)}
    >>> network = sw.SkyNetwork("city.onnx", label=10, **imagenet)
    """

    path: str | Path
    label: int | str | None = None
    layout: Literal["nchw", "nhwc"] | None = None
    channels: Literal["rgb", "bgr"] = "rgb"
    mean: float | tuple[float, float, float] | None = None
    std: float | tuple[float, float, float] | None = None
    size: int | tuple[int, int] | None = None
    output: str | None = None

    def __post_init__(self) -> None:
        whole = isinstance(self.label, (int, np.integer)) and not isinstance(self.label, bool)
        if not (self.label is None or isinstance(self.label, str) or (whole and self.label >= 0)):
            raise AnalysisError(
                f"sky_label must be a class's index from 0 or its name, not {self.label!r:.80}."
            )
        for name, choices in (("layout", (None, "nchw", "nhwc")), ("channels", ("rgb", "bgr"))):
            if getattr(self, name) not in choices:
                raise AnalysisError(
                    f"{name} must be {choices[-2]!r} or {choices[-1]!r}, "
                    f"not {getattr(self, name)!r:.80}."
                )
        for name, most, lowest, takes in (
            ("mean", 3, -np.inf, "one number or three, in units of [0, 1]"),
            ("std", 3, 0.0, "one number or three, in units of [0, 1], above 0"),
            ("size", 2, 0.0, "pixels or (width, height), above 0"),
        ):
            value = getattr(self, name)
            if value is not None and not _numbers(value, (1, most), lowest):
                raise AnalysisError(f"{name} must be {takes}, not {value!r:.80}.")
        # Convert sequences and NumPy numbers to hashable plain values.
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
            If the file is missing or not a network, its input is not a picture, the sky's class is
            unknown or missing, or the network fails on the picture.
        """
        opened = self.open()
        scale = opened.scale(self.mean, self.std, (0.0, 1.0))
        values = opened.run(self.arrange(working.encoded), scale, self.output)
        return sky_of(values, label_of(self.label, values, opened.class_names(), str(self.path)))

    def open(self) -> Opened:
        """Return the opened file with the properties of its input."""
        return Opened.of(self.path, self.layout, self.size)

    def arrange(self, picture: np.ndarray) -> np.ndarray:
        """Return ``picture`` (h, w, 3) with its channels in the network's order."""
        return picture if self.channels == "rgb" else picture[..., ::-1]


def _numbers(value: Any, counts: tuple[int, ...], lowest: float) -> bool:
    try:
        array = np.asarray(value, float).reshape(-1)
    except (TypeError, ValueError):
        return False
    return array.size in counts and bool(np.isfinite(array).all() and (array > lowest).all())
