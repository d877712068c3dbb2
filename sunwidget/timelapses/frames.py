"""The frames of one camera: their files, order, size and times."""

from __future__ import annotations

import dataclasses
import datetime as dt
import glob
import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.errors import PhotoError
from sunwidget.formats.color import SRGB
from sunwidget.photo.decode_apart import open_apart
from sunwidget.photo.photo import Photo

# Extensions searched for in a folder; a glob or a list may name any file.
PICTURES = frozenset(
    f".{ending}"
    for group in (
        ("jpg", "jpeg", "jpe", "png", "tif", "tiff", "webp", "bmp", "jp2", "avif", "heic", "heif"),
        ("dng", "nef", "cr2", "cr3", "arw", "orf", "rw2", "raf", "pef", "srw"),
    )
    for ending in group
)
_SAME_SHAPE = 0.01  # relative difference of the aspect ratios due to rounding

Times = str | tuple[dt.datetime, float] | Sequence[dt.datetime] | None


def frame_sources(frames: Any) -> list[Any]:
    """Return the sources of the frames in the order of the film.

    Parameters
    ----------
    frames : path or sequence
        A folder (its pictures) or a glob such as ``"frames/*.jpg"``, both in natural order:
        ``img2`` before ``img10``. Or a sequence of sources for ``sunwidget.open``.

    Raises
    ------
    FileNotFoundError
        When there are fewer than two frames.
    ValueError
        For a single picture.
    """
    if isinstance(frames, (str, os.PathLike)):
        return _in_natural_order(Path(os.fspath(frames)).expanduser())
    try:
        row = list(frames)
    except TypeError:
        row = []
    if len(row) < 2:
        raise ValueError(
            f"A time-lapse needs a folder, a glob or a sequence of two or more frames, not "
            f"{frames!r:.80}."
        )
    return row


def natural_key(path: Path) -> tuple[Any, ...]:
    """Sort by the numbers in a name as numbers: img2 before img10."""
    parts = re.split(r"(\d+)", str(path).casefold())
    numbers = tuple((0, int(p), "") if p.isdecimal() else (1, 0, p) for p in parts)
    return numbers, str(path)


def _in_natural_order(path: Path) -> list[Any]:
    if path.is_file():
        raise ValueError(
            f"{path} is one picture. A time-lapse takes a folder or a glob such as "
            f"{path.parent / '*'}{path.suffix}."
        )
    if path.is_dir():
        found = [p for p in path.iterdir() if p.suffix.lower() in PICTURES]
        what = f"The folder {path} holds"
    else:
        # Path.glob does not accept absolute patterns.
        found = [Path(p) for p in glob.glob(str(path))]  # noqa: PTH207
        what = f"{path} names"
    found = sorted((p for p in found if p.is_file() and p.name[0] != "."), key=natural_key)
    if len(found) < 2:
        number = "no picture" if not found else "one picture"
        raise FileNotFoundError(f"{what} {number}; a time-lapse needs two or more frames.")
    return found


def name_of(source: Any, index: int) -> str:
    """Return the name of a frame in messages and files."""
    if isinstance(source, Photo) and source.name != "array":
        return source.name
    if isinstance(source, (str, os.PathLike)):
        return Path(os.fspath(source)).name
    return f"frame {index + 1}"


def read_frame(source: Any, long_edge: int | None, like: tuple[int, int] | None = None) -> Photo:
    """Open a frame in a separate process, shrunk to at most ``long_edge``; never enlarged.

    Parameters
    ----------
    source
        Any source for ``sunwidget.open``.
    long_edge : int or None
        Pixels; None keeps the photo's size.
    like : (width, height), optional
        Size of the other frames. A frame with the same aspect ratio is resized to it.

    Raises
    ------
    PhotoError
        When the frame cannot be opened or its aspect ratio differs from that of ``like``.
    """
    photo = open_apart(source)
    edge = long_edge if like is None else max(like)
    size = photo.size if edge is None else photo.size_within(edge)
    if like is not None:
        ratio = photo.width / photo.height * like[1] / like[0]
        if abs(ratio - 1) > _SAME_SHAPE + 2 / min(like):
            raise PhotoError(
                f"it is {photo.width}×{photo.height}, but the frames before it have the "
                f"aspect ratio of {like[0]}×{like[1]}"
            )
        size = like
    return photo if size == photo.size else resized(photo, size)


def resized(photo: Photo, size: tuple[int, int]) -> Photo:
    """Return the photo at another size, averaged in linear light, with its metadata."""
    import cv2

    if size == photo.size_within(max(size)) and photo.bit_depth == 8:
        codes: np.ndarray = photo.preview(max(size))
    else:
        smaller = size[0] < photo.width
        filter_ = cv2.INTER_AREA if smaller else cv2.INTER_LINEAR
        codes = cv2.resize(np.asarray(photo.pixels, np.float32), size, interpolation=filter_)
        if photo.bit_depth == 8:
            codes = SRGB.encode(codes)
    return dataclasses.replace(
        photo, encoded=codes, profile=SRGB, icc=None, alpha=None, gain_map=None
    )


class Clock:
    """The times of the frames in UTC, as far as they are known.

    Parameters
    ----------
    times : None, str, (datetime, seconds) or sequence of datetime
        None reads each file's EXIF. A ``datetime.strptime`` pattern ("%Y%m%d_%H%M%S") reads the
        file's name without its extension. A pair is the first frame's time and the seconds between
        frames. A sequence has one time per frame. Times without a zone are UTC.
    count : int
        Number of frames.
    longitude : float, optional
        Degrees east, to guess the zone of EXIF times without one.

    Raises
    ------
    ValueError
        For any other value of ``times``.
    """

    def __init__(self, times: Times, count: int, longitude: float | None = None) -> None:
        self.pattern = times if isinstance(times, str) else None
        self.longitude = longitude
        self.row: list[dt.datetime] | None = None
        if times is None or self.pattern is not None:
            return
        row: list[Any] = list(times)
        if len(row) == 2 and isinstance(row[1], (int, float)) and row[1] > 0:
            first, step = row
            row = [first + dt.timedelta(seconds=step * i) for i in range(count)]
        if len(row) != count or not all(isinstance(moment, dt.datetime) for moment in row):
            raise ValueError(
                f"times= takes (first time, seconds between frames), a pattern of the file names "
                f"such as '%Y%m%d_%H%M%S', or one datetime for each of the {count} frames."
            )
        self.row = [_utc(moment) for moment in row]

    def __call__(self, index: int, source: Any, photo: Photo) -> dt.datetime | None:
        """Return the time of a frame; None if it is unknown."""
        if self.row is not None:
            return self.row[index]
        if self.pattern is None:
            from sunwidget.photo.place import from_photo

            return from_photo(photo, self.longitude).moment
        name = Path(name_of(source, index)).stem
        try:
            return _utc(dt.datetime.strptime(name, self.pattern))  # noqa: DTZ007 - UTC by _utc
        except ValueError as error:
            raise ValueError(
                f"The name {name!r} does not match the pattern {self.pattern!r} of times=."
            ) from error


def _utc(moment: dt.datetime) -> dt.datetime:
    return moment.replace(tzinfo=moment.tzinfo or dt.UTC).astimezone(dt.UTC)
