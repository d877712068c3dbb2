"""Coarse sky: which pixels are sky, roughly (thesis 3.1.1.1).

``METHODS`` maps a name to a function ``(Working) -> (h, w) float32`` of the sky's probability.
Besides a name, ``analyze(sky=…)`` takes a mask array or the path of an ONNX network.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.errors import AnalysisError
from sunwidget.analysis.working import Working, resize

NETWORK = Path(__file__).parent / "models" / "sky.onnx"
SIDE = 384
ADE20K_SKY = 2  # 0-based index of "sky" among ADE20K's 150 classes


def network(working: Working, path: str | Path = NETWORK) -> np.ndarray:
    """Run a sky network at 384 × 384 and return the sky's probability at the network's size.

    Accepts our own form (output (1, 1, h, w) in [0, 1], or logits) and ADE20K-style networks
    (output (1, classes, h, w): softmax of the class "sky"; or (1, h, w) class labels), as the
    thesis used (equations 3.1 and 3.2).

    Raises
    ------
    AnalysisError
        When the file is missing, is no ONNX network or does not take a 3-channel picture.
    """
    session, name, shape = _session(str(path))
    side = [n if isinstance(n, int) and n > 0 else SIDE for n in shape[2:]]
    image = resize(working.encoded, side[1], side[0])
    batch = np.ascontiguousarray(image.transpose(2, 0, 1)[None], np.float32)
    try:
        output = np.asarray(session.run(None, {name: batch})[0])
    except Exception as error:  # onnxruntime's exceptions share no public base class
        raise AnalysisError(
            f"The sky network {path} failed on a {side[1]} × {side[0]} picture: {error}. "
            "Pass sky=mask, or the path of another network."
        ) from error
    return _probability(output, path)


def _probability(output: np.ndarray, path: str | Path) -> np.ndarray:
    if output.ndim == 3:
        return (output[0] == ADE20K_SKY).astype(np.float32)
    if output.ndim != 4 or 0 in output.shape:
        raise AnalysisError(
            f"The sky network {path} returned shape {output.shape}; "
            "expected (1, 1, h, w), (1, classes, h, w) or (1, h, w)."
        )
    scores = output[0].astype(np.float32)
    if scores.shape[0] == 1:
        scores = scores[0]
        if scores.min() < -1e-3 or scores.max() > 1 + 1e-3:
            scores = 1 / (1 + np.exp(-scores))
        return np.clip(scores, 0, 1)
    sky = ADE20K_SKY if scores.shape[0] > ADE20K_SKY else scores.shape[0] - 1
    exponent = np.exp(scores - scores.max(axis=0))
    return exponent[sky] / exponent.sum(axis=0)


@lru_cache(maxsize=4)
def _session(path: str) -> tuple[Any, str, list[Any]]:
    try:
        import onnxruntime
    except ImportError as error:
        raise AnalysisError(
            "Finding the sky needs onnxruntime (pip install onnxruntime). "
            "Without it pass sky=mask or sky='skyline'."
        ) from error
    if not Path(path).is_file():
        raise AnalysisError(
            f"No sky network at {path}. Pass sky=mask, the path of an .onnx file, "
            f"or one of {', '.join(METHODS)}."
        )
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 2
    options.inter_op_num_threads = 1
    options.log_severity_level = 4
    try:
        session = onnxruntime.InferenceSession(
            path, sess_options=options, providers=["CPUExecutionProvider"]
        )
    except Exception as error:  # onnxruntime's exceptions share no public base class
        raise AnalysisError(
            f"{path} is not an ONNX network that can be read: {str(error)[:200]}. "
            "Pass sky=mask, or the path of another network."
        ) from error
    entry = session.get_inputs()[0]
    if len(entry.shape) != 4 or (entry.shape[1] not in (3, None) and entry.shape[1] != "3"):
        raise AnalysisError(
            f"The network {path} takes {entry.shape}; expected one picture (1, 3, height, width)."
        )
    return session, entry.name, list(entry.shape)


def skyline(working: Working) -> np.ndarray:
    """Find the sky without a network: everything above the first strong edge of each column.

    The edge threshold is the one that makes sky and land most uniform in colour (Shen & Wang,
    "Sky region detection in a single image for autonomous ground robot navigation", 2013,
    equations 1–9). Good for an open horizon; branches, clouds and buildings mislead it.
    """
    import cv2

    width = min(working.width, 240)
    height = max(1, round(working.height * width / working.width))
    image = resize(working.encoded, width, height).astype(np.float32) * 255
    height, width = image.shape[:2]
    grey = cv2.GaussianBlur(image.mean(axis=2), (0, 0), 1.0)
    gradient = np.hypot(cv2.Sobel(grey, cv2.CV_32F, 1, 0), cv2.Sobel(grey, cv2.CV_32F, 0, 1))
    rows = np.arange(height)[:, None]
    best, sky = -np.inf, np.zeros((height, width), bool)
    for threshold in np.linspace(5, 600, 60):
        edge = gradient > threshold
        border = np.where(edge.any(axis=0), edge.argmax(axis=0), height)
        mask = rows < border
        if min(mask.sum(), (~mask).sum()) < 4:
            continue
        spread = [np.linalg.eigvalsh(np.cov(image[m].T)) for m in (mask, ~mask)]
        cost = 2 * (np.prod(spread[0]) + spread[0][-1]) + np.prod(spread[1]) + spread[1][-1]
        if 1 / max(cost, 1e-9) > best:
            best, sky = 1 / max(cost, 1e-9), mask
    return cv2.GaussianBlur(sky.astype(np.float32), (0, 0), 1.0)


METHODS: dict[str, Callable[[Working], np.ndarray]] = {"network": network, "skyline": skyline}


def coarse(working: Working, sky: Any = None, size: tuple[int, int] | None = None) -> np.ndarray:
    """Return the sky's probability (h, w) float32 at whatever size the method works at.

    Parameters
    ----------
    working : Working
        The small photo.
    sky : None, str, Path or array_like
        Name in ``METHODS`` (default "network"), path of an ONNX network or of a picture (white =
        sky), or a mask (any numeric or boolean type; anything above 1 is taken for 8 bits). A
        mask need not have the photo's size.
    size : (width, height), optional
        The photo's size, for the error when a mask has another shape.

    Raises
    ------
    AnalysisError
        For an unknown name, a file that is no network, or an array that is no mask.
    """
    if sky is None:
        return network(working)
    if isinstance(sky, (str, Path)):
        if str(sky) in METHODS:
            return METHODS[str(sky)](working)
        if str(sky).lower().endswith(".onnx"):
            return network(working, sky)
        if Path(sky).suffix.lower() in {".png", ".tif", ".tiff", ".bmp", ".jpg", ".jpeg"}:
            return mask_from(_read_mask(Path(sky)), size)
        raise AnalysisError(
            f"sky={str(sky)!r:.80} is neither a method ({', '.join(METHODS)}), an .onnx file "
            "nor a picture of the mask (.png)."
        )
    return mask_from(sky, size)


def _read_mask(path: Path) -> np.ndarray:
    """Read a picture as grey code values, 8 or 16 bits."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path) as picture:
            wide = picture.mode.startswith("I")
            return np.asarray(picture if wide else picture.convert("L"))
    except FileNotFoundError as error:
        raise AnalysisError(f"No sky mask at {path}. Pass the path of a picture.") from error
    except (OSError, UnidentifiedImageError, ValueError, Image.DecompressionBombError) as error:
        raise AnalysisError(
            f"{path} is no picture that can be read as a sky mask: {error}."
        ) from error


def mask_from(mask: Any, size: tuple[int, int] | None = None) -> np.ndarray:
    """Turn what a caller passes as a mask into (h, w) float32 in [0, 1].

    Raises
    ------
    AnalysisError
        When it is not a two-dimensional numeric array, holds NaN, or has another shape than
        the photo by more than rounding.
    """
    try:
        array = np.asarray(mask)
        if array.ndim == 3:
            array = array[..., 0] if array.shape[2] in (1, 2) else array[..., :3].max(axis=2)
        boolean = array.dtype == bool
        array = array.astype(np.float32)
    except (TypeError, ValueError) as error:
        raise AnalysisError(
            f"sky= takes a mask array, a path or a method, not {mask!r:.80}."
        ) from error
    if array.ndim != 2 or array.size == 0:
        raise AnalysisError(f"A sky mask has shape (height, width), not {array.shape}.")
    if not np.isfinite(array).all():
        raise AnalysisError("The sky mask holds NaN or infinite values; it must lie in 0 to 1.")
    if not boolean and array.max() > 1:
        array = array / (255 if array.max() <= 255 else 65535)
    if size is not None:
        ratio = array.shape[1] / array.shape[0] * size[1] / size[0]
        slack = 1 + 1.5 / min(array.shape) + 1.5 / min(size)
        if not 1 / slack <= ratio <= slack:
            raise AnalysisError(
                f"The sky mask is {array.shape[1]} × {array.shape[0]}, the photo "
                f"{size[0]} × {size[1]}: shapes must agree. Was one of them rotated?"
            )
    return np.clip(array, 0, 1)
