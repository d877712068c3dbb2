"""The process that decodes untrusted pictures for ``decode_apart.py``, within limits.

It reads requests from standard input and writes responses to standard output until the input ends.
A request is a file's name and bytes. A response is an error message, or a photo as JSON and raw
bytes, so that nothing in it can run code in the parent process.
"""

from __future__ import annotations

import contextlib
import dataclasses
import datetime as dt
import json
import os
import signal
import struct
import sys
import warnings
from dataclasses import fields
from pathlib import Path
from typing import IO, Any

import numpy as np

from sunwidget.errors import PhotoError
from sunwidget.formats.color import SRGB, ColorProfile, ParametricCurve, TableCurve
from sunwidget.formats.exif import CameraFacts
from sunwidget.formats.gain_map import GainMap
from sunwidget.formats.pixels import MAX_PIXELS
from sunwidget.photo.decode import decode_bytes, reason
from sunwidget.photo.decode_heif import DepthMap
from sunwidget.photo.photo import Photo, photo_of

_HEAD = struct.Struct(">Q")
_LONGEST_HEAD = 64_000_000  # contains recipes with many strokes, and a profile's curves
_BYTES = ("icc", "exif", "xmp")
_TIMES = ("time", "clock", "gps_time")
_PLAIN = ("name", "format", "turned", "recorded", "notes", "dpi")


def send(stream: IO[bytes], head: dict[str, Any], *blobs: Any) -> None:
    """Write a message: JSON, then the blobs, whose lengths must be in the head."""
    text = json.dumps(head, default=float).encode()
    stream.write(_HEAD.pack(len(text)) + text)
    stream.writelines(blobs)
    stream.flush()


def receive(stream: IO[bytes]) -> dict[str, Any]:
    """Read the head of a message.

    Raises
    ------
    EOFError
        When the other process has ended.
    ValueError
        When the data is not a message.
    """
    (length,) = _HEAD.unpack(fill(stream, bytearray(_HEAD.size)))
    if length > _LONGEST_HEAD:
        raise ValueError("the message is too long")
    head = json.loads(fill(stream, bytearray(length)))
    if not isinstance(head, dict):
        raise ValueError("the message is not an object")  # noqa: TRY004 - one error for all
    return head


def fill(stream: Any, buffer: Any) -> Any:
    """Read until ``buffer`` is full and return it; EOFError if the other process ends before."""
    view = memoryview(buffer).cast("B")
    while view:
        count = stream.readinto(view)
        if not count:
            raise EOFError("the process ended")
        view = view[count:]
    return buffer


def send_photo(stream: IO[bytes], photo: Photo) -> None:
    """Write a photo: its fields as JSON, its bytes and pixels unchanged."""
    facts = dataclasses.asdict(photo.facts)
    facts |= {name: facts[name] and facts[name].isoformat() for name in _TIMES}
    head = {name: getattr(photo, name) for name in _PLAIN} | {
        "facts": facts,
        "profile": _profile_as_json(photo.profile),
        "shape": photo.encoded.shape,
        "dtype": photo.encoded.dtype.name,
        "alpha": photo.alpha is not None,
        "lengths": [None if (b := getattr(photo, name)) is None else len(b) for name in _BYTES],
    }
    try:
        json.dumps(head["recorded"])
    except (ValueError, TypeError, RecursionError):  # an unreadable recipe
        head["recorded"] = None
    blobs = [blob for name in _BYTES if (blob := getattr(photo, name)) is not None]
    pixels = [photo.encoded] if photo.alpha is None else [photo.encoded, photo.alpha]
    if photo.depth is not None:
        head["depth"] = {"kind": photo.depth.kind, "shape": photo.depth.values.shape}
        pixels.append(photo.depth.values)
    if photo.gain_map is not None:
        values = {field.name: getattr(photo.gain_map, field.name) for field in fields(GainMap)}
        blobs.append(values.pop("jpeg"))
        head["gain_map"] = values | {"length": len(blobs[-1])}
    send(stream, head, *blobs, *(np.ascontiguousarray(array).data for array in pixels))


def receive_photo(stream: IO[bytes], head: dict[str, Any]) -> Photo:
    """Read the rest of a photo after its head.

    Raises
    ------
    EOFError, ValueError, TypeError, KeyError
        When the other process ended, or sent something that is not a photo.
    """
    height, width, channels = (int(n) for n in head["shape"])
    if channels != 3 or min(height, width) < 1 or height * width > MAX_PIXELS:
        raise ValueError("a picture of an impossible size")
    if head["dtype"] not in ("uint8", "uint16", "float32"):
        raise ValueError("a picture of an impossible type")
    found: dict[str, Any] = {}
    for name, length in zip(_BYTES, head["lengths"], strict=True):
        if length is not None and not 0 <= length <= 1 << 31:
            raise ValueError("metadata of an impossible length")
        found[name] = None if length is None else bytes(fill(stream, bytearray(length)))
    gain_map = _receive_gain_map(stream, head)
    encoded = fill(stream, np.empty((height, width, 3), head["dtype"]))
    alpha = fill(stream, np.empty((height, width), np.float32)) if head["alpha"] else None
    depth = _receive_depth(stream, head)
    facts = head["facts"]
    facts |= {name: facts[name] and dt.datetime.fromisoformat(facts[name]) for name in _TIMES}
    facts["stored_size"] = facts["stored_size"] and tuple(facts["stored_size"])
    plain = {name: head[name] for name in _PLAIN}
    plain["notes"] = tuple(str(note) for note in plain["notes"])
    plain["dpi"] = plain["dpi"] and tuple(plain["dpi"])
    return Photo(
        encoded=encoded,
        alpha=alpha,
        gain_map=gain_map,
        depth=depth,
        profile=_profile_of_json(head["profile"]),
        facts=CameraFacts(**facts),
        **plain,
        **found,
    )


def _receive_gain_map(stream: IO[bytes], head: dict[str, Any]) -> GainMap | None:
    values = head.get("gain_map")
    if values is None:
        return None
    length = int(values.pop("length"))
    if not 0 <= length <= 1 << 31:
        raise ValueError("a gain map of an impossible length")
    triples: dict[str, Any] = {
        name: tuple(float(v) for v in value) if isinstance(value, list) else value
        for name, value in values.items()
    }
    return GainMap(jpeg=bytes(fill(stream, bytearray(length))), **triples)


def _receive_depth(stream: IO[bytes], head: dict[str, Any]) -> DepthMap | None:
    depth = head.get("depth")
    if depth is None:
        return None
    height, width = (int(n) for n in depth["shape"])
    if min(height, width) < 1 or height * width > MAX_PIXELS:
        raise ValueError("a depth map of an impossible size")
    return DepthMap(fill(stream, np.empty((height, width), np.float32)), str(depth["kind"]))


def _profile_as_json(profile: ColorProfile) -> dict[str, Any]:
    curves = [
        dataclasses.asdict(curve) if isinstance(curve, ParametricCurve) else curve.samples.tolist()
        for curve in profile.curves
    ]
    matrix = None if profile.matrix is None else profile.matrix.tolist()
    return {"name": profile.name, "matrix": matrix, "curves": curves}


def _profile_of_json(found: dict[str, Any]) -> ColorProfile:
    red, green, blue = (
        ParametricCurve(**curve) if isinstance(curve, dict) else TableCurve(np.array(curve))
        for curve in found["curves"]
    )
    matrix = None if found["matrix"] is None else np.array(found["matrix"], np.float64)
    profile = ColorProfile((red, green, blue), matrix, str(found["name"]))
    return SRGB if profile.is_srgb and profile.name == SRGB.name else profile


def limit_memory(most: int) -> None:
    """Limit memory to ``most`` bytes beyond this process's present use; disable core dumps."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        own = 1 << 30
        with contextlib.suppress(OSError, ValueError):
            pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
            own = pages * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        soft = own + most if hard == resource.RLIM_INFINITY else min(hard, own + most)
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def limit_time(seconds: int) -> None:
    """Limit processor time to ``seconds`` from now on."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        taken = resource.getrusage(resource.RUSAGE_SELF)
        soft = int(taken.ru_utime + taken.ru_stime) + 1 + seconds
        _, hard = resource.getrlimit(resource.RLIMIT_CPU)
        resource.setrlimit(resource.RLIMIT_CPU, (soft, hard))


def serve(memory: int, seconds: int) -> None:
    """Answer requests until standard input ends.

    Parameters
    ----------
    memory : int
        Most bytes for decoding.
    seconds : int
        Most seconds of processor time for a picture.
    """
    with contextlib.suppress(ValueError, OSError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process handles Ctrl-C
    ask = sys.stdin.buffer
    # Output that libraries print must not mix with the responses.
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    limit_memory(memory)
    while True:
        try:
            head = receive(ask)
            data = bytes(fill(ask, bytearray(head["length"])))
        except EOFError:
            return
        limit_time(seconds)
        name = head["name"]
        try:
            photo = photo_of(decode_bytes(data, name), name)
        except PhotoError as error:
            send(answer, {"error": str(error)})
        except MemoryError:
            text = f"There is not enough memory to open {name}. Scale it down."
            send(answer, {"error": text})
        except Exception as error:  # noqa: BLE001 - a bug of a reader fails this file only
            send(answer, {"error": f"{name} cannot be read ({reason(error)}). Copy it again."})
        else:
            send_photo(answer, photo)


if __name__ == "__main__":
    serve(int(sys.argv[1]), int(sys.argv[2]))
