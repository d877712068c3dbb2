"""An ONNX file of a network that takes a picture: its input, and how to run it."""

from __future__ import annotations

import ast
import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.networks.onnx_runtime import import_onnxruntime
from sunwidget.analysis.networks.segmentation_output import map_of
from sunwidget.errors import AnalysisError

SIDE = 384  # input side for networks of any size, as in the thesis
LARGEST = 4096  # largest input side; a float copy of such a picture is 200 MB
TYPES = {
    "tensor(float)": np.float32,
    "tensor(float16)": np.float16,
    "tensor(double)": np.float64,
    "tensor(uint8)": np.uint8,
}

Scale = tuple[Any, Any]  # mean and deviation, each a number or three

# What a user can pass instead of a network, by what the network finds.
INSTEAD = {
    "sky": "sky=mask, the path of an .onnx file, or sky='skyline'",
    "sun": "sun=(x, y)",
    "depth": "depth=an array of metres, the path of an .onnx file, or depth='network'",
}
# What a network must return, by what it finds.
EXPECTED = {
    "sky": (
        "a map of the sky, of classes' scores or of labels: (1, 1, h, w), (1, classes, h, w), "
        "(1, h, w, classes) or (1, h, w)"
    ),
    "depth": "a map of depth: (1, 1, h, w), (1, h, w) or (1, h, w, 1)",
}


@dataclass(frozen=True, eq=False)
class Opened:
    """An open network file and the properties of its input."""

    path: str
    session: Any
    name: str
    type: Any
    layout: str
    batch: bool
    size: tuple[int, int]
    free: bool = False  # the file does not fix the size
    finds: str = "sky"  # key of INSTEAD

    def with_side(self, side: int | None) -> Opened:
        """Return the same network with a square input of another side; None keeps the size."""
        return self if side is None else dataclasses.replace(self, size=(side, side))

    @classmethod
    def of(
        cls,
        path: str | Path,
        layout: str | None = None,
        size: int | tuple[int, int] | None = None,
        finds: str = "sky",
    ) -> Opened:
        """Open a file and read its input's layout, type and size.

        Parameters
        ----------
        path : str or Path
        layout : {"nchw", "nhwc"}, optional
            If the file does not determine it; default "nchw".
        size : int or (width, height), optional
            Of the input in pixels, if the file does not fix it; default 384.
        finds : {"sky", "depth"}
            Named in errors.

        Raises
        ------
        AnalysisError
            If the file is missing or not an ONNX network, or its input is not one picture.
        """
        path = Path(path)
        if not path.is_file():
            raise AnalysisError(f"No {finds} network at {path}. Pass {INSTEAD[finds]}.")
        opened = session(str(path), _stamp(path), finds)
        entries = opened.get_inputs()
        takes = "; ".join(f"{e.name} {e.type} {e.shape}" for e in entries) or "nothing"
        refused = f"{path} must take one picture, but its inputs are {takes}. "
        if len(entries) != 1:
            raise AnalysisError(f"{refused}Export it with a single input, the picture.")
        entry = entries[0]
        if entry.type not in TYPES:
            raise AnalysisError(f"{refused}Known types: {', '.join(TYPES)}.")
        shape = [n if isinstance(n, int) and n > 0 else None for n in entry.shape]
        batch = len(shape) == 4
        if batch and shape.pop(0) not in (None, 1):
            raise AnalysisError(f"{refused}Export it for batches of 1 or of any size.")
        if len(shape) != 3:
            raise AnalysisError(
                f"{refused}Expected (1, 3, height, width) or (1, height, width, 3)."
            )
        layout = layout or ("nhwc" if shape[2] == 3 and shape[0] != 3 else "nchw")
        if shape[0 if layout == "nchw" else 2] not in (3, None):
            raise AnalysisError(
                f"{refused}Expected 3 channels, (1, 3, height, width) or (1, height, width, 3)."
            )
        height, width = shape[1:] if layout == "nchw" else shape[:2]
        wanted = np.broadcast_to(size or SIDE, 2)
        takes_size = (width or int(wanted[0]), height or int(wanted[1]))
        if size is not None and takes_size != tuple(wanted):
            raise AnalysisError(
                f"{path} takes pictures of {takes_size[0]} × {takes_size[1]} only; leave out size=."
            )
        if max(takes_size) > LARGEST:
            raise AnalysisError(
                f"{path} takes pictures of {takes_size[0]} × {takes_size[1]}; at most {LARGEST} "
                "pixels per side are possible. Export it for a smaller or for any size."
            )
        kind = TYPES[entry.type]
        free = width is None and height is None
        return cls(str(path), opened, entry.name, kind, layout, batch, takes_size, free, finds)

    def class_names(self) -> dict[int, str]:
        """Return the names of the classes by index from the metadata; empty if there are none.

        The metadata hold them as a Python or JSON list or dictionary, or as words separated by
        commas or line ends, under one of the usual keys: names, classes, labels, class_names,
        id2label.
        """
        for key in ("names", "classes", "labels", "class_names", "id2label"):
            value = _literal(self._metadata().get(key, ""))
            if isinstance(value, str):
                value = [word.strip() for word in value.replace("\n", ",").split(",")]
            if isinstance(value, (list, tuple)) and any(value):
                value = dict(enumerate(value))
            try:
                if isinstance(value, Mapping):
                    return {int(index): str(name) for index, name in value.items()}
            except (TypeError, ValueError):  # a dictionary from name to index, or of other content
                continue
        return {}

    def scale(self, mean: Any, std: Any, default: Scale) -> Scale:
        """Return mean and deviation of the input: as given, else the metadata's, else ``default``.

        Raises
        ------
        AnalysisError
            If one is given for a network of bytes, which scales its input itself.
        """
        if self.type is np.uint8:
            if mean is not None or std is not None:
                raise AnalysisError(f"{self.path} takes bytes, 0 to 255; leave out mean= and std=.")
            return 0.0, 1 / 255
        recorded = _scale_from(self._metadata()) or default
        return recorded[0] if mean is None else mean, recorded[1] if std is None else std

    def _metadata(self) -> dict[str, str]:
        """Return the metadata that the exporter wrote into the file."""
        return dict(self.session.get_modelmeta().custom_metadata_map)

    def run(self, picture: np.ndarray, scale: Scale, output: str | None = None) -> np.ndarray:
        """Run on a picture and return one of its outputs as a map (``map_of``).

        Parameters
        ----------
        picture : (h, w, 3) float32
            Encoded, [0, 1], with channels in the network's order.
        scale : (mean, deviation)
            Each one number or three; the network's input is (picture - mean) / deviation.
        output : str, optional
            Name of the output. Default: the first that is a map.

        Raises
        ------
        AnalysisError
            If the network fails, has no such output, or returns no map.
        """
        names = [entry.name for entry in self.session.get_outputs()]
        if output not in (None, *names):
            raise AnalysisError(
                f"{self.path} has no output {output!r:.80}; it has {', '.join(names)}."
            )
        image = resize(picture, *self.size)
        mean, deviation = (np.asarray(part, np.float32) for part in scale)
        image = (image - mean) / deviation
        if self.type is np.uint8:
            image = np.clip(np.round(image), 0, 255)
        image = image.transpose(2, 0, 1) if self.layout == "nchw" else image
        batch = np.ascontiguousarray(image[None] if self.batch else image, self.type)
        try:
            outputs = self.session.run(output and [output], {self.name: batch})
        except Exception as error:  # onnxruntime's exceptions share no public base class
            raise AnalysisError(
                f"The {self.finds} network {self.path} failed on a {self.size[0]} × {self.size[1]} "
                f"picture: {str(error)[:300]}. Give the size and layout it was made for: "
                f"{self.finds}={self.finds.capitalize()}Network(path, size=…, layout=…), or an "
                "array."
            ) from error
        maps = (map_of(output, self.size, self.layout) for output in outputs)
        found = next((values for values in maps if values is not None), None)
        if found is None:
            shapes = ", ".join(str(np.shape(output)) for output in outputs)
            raise AnalysisError(
                f"The {self.finds} network {self.path} returned {shapes}; expected "
                f"{EXPECTED[self.finds]}."
            )
        return found


def _scale_from(metadata: Mapping[str, str]) -> Scale | None:
    """Read mean and deviation of the input, in units of [0, 1], from a file's metadata."""
    for prefix in ("", "image_", "img_"):
        try:
            mean, std = (
                np.broadcast_to(np.asarray(_literal(metadata[prefix + name]), np.float32), 3)
                for name in ("mean", "std")
            )
        except (KeyError, TypeError, ValueError):
            continue
        if np.isfinite([mean, std]).all() and (std > 0).all():
            # Some files use code values: (123.675, 116.28, 103.53), (58.395, 57.12, 57.375).
            unit = 255 if max(mean.max(), std.max()) > 2 else 1
            return mean / unit, std / unit
    return None


def _literal(text: str) -> Any:
    """Return the Python literal that a text contains, or the text."""
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, TypeError, RecursionError, MemoryError):
        return text


@lru_cache(maxsize=8)  # the package bundles three
def session(path: str, _stamp: tuple[int, int], finds: str) -> Any:
    """Open a file once. ``finds`` is named in errors; a key of ``INSTEAD`` adds an alternative.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing or the file is not a network.
    """
    import cv2

    try:
        onnxruntime = import_onnxruntime()
    except ImportError as error:
        without = f" Without it pass {INSTEAD[finds]}." if finds in INSTEAD else ""
        raise AnalysisError(
            f"A {finds} network needs onnxruntime (pip install onnxruntime).{without}"
        ) from error
    options = onnxruntime.SessionOptions()
    # More than two threads are no faster. Batch workers limit OpenCV's threads, so use that limit.
    options.intra_op_num_threads = max(1, min(2, cv2.getNumThreads()))
    options.inter_op_num_threads = 1
    options.log_severity_level = 4
    try:
        return onnxruntime.InferenceSession(
            path, sess_options=options, providers=["CPUExecutionProvider"]
        )
    except Exception as error:  # onnxruntime's exceptions share no public base class
        way_out = f"Pass {INSTEAD[finds]}." if finds in INSTEAD else "Reinstall sunwidget."
        raise AnalysisError(
            f"{path} is not an ONNX network that can be read: {str(error)[:200]}. {way_out}"
        ) from error


def bundled_session(path: Path, finds: str) -> Any:
    """Open a bundled network, once.

    Raises
    ------
    AnalysisError
        If the file or onnxruntime is missing.
    """
    if not path.is_file():
        raise AnalysisError(f"No {finds} network at {path}. Reinstall sunwidget.")
    return session(str(path), _stamp(path), finds)


def _stamp(path: Path) -> tuple[int, int]:
    """Return a key that changes when the file is replaced."""
    stat = path.stat()
    return stat.st_mtime_ns, stat.st_size
