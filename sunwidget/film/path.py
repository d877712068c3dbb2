"""The path of a film: its steps, and the edit of each frame."""

from __future__ import annotations

import itertools
import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget import presets
from sunwidget.analysis.correct import corrected
from sunwidget.edit.recipe import edit_of, is_recipe_file, read_recipe
from sunwidget.edit.table import NUMBERS, PARAMETERS, Edit
from sunwidget.errors import EditError
from sunwidget.film.day import Day
from sunwidget.film.easing import EASINGS
from sunwidget.messages import short_repr

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Step = Edit | Mapping[str, Any] | str | os.PathLike[str]
SunPath = Day | Sequence[Step] | Sequence[tuple[float, Step]]

DEFAULT_SECONDS = 5
# An hour at 24 frames per second; more is probably a typing error.
MOST_FRAMES = 86_400


@dataclass(frozen=True)
class _Stations:
    """Edits and the share of the film (0–1, increasing) at which each is reached."""

    edits: list[Edit]
    shares: list[float]
    seconds: float
    each: bool = False  # one frame each, without frames between


def film_edits(
    scene: Scene,
    path: SunPath,
    *,
    fps: float = 24,
    frames: int | None = None,
    seconds: float | None = None,
    easing: str = "linear",
) -> list[Edit]:
    """Return the edit of each frame of a film.

    Parameters
    ----------
    scene : Scene
        Source of the automatic values.
    path : sequence or Day
        As for ``sunwidget.sweep``.
    fps : float
        Frames per second, 1–120.
    frames, seconds : int and float, optional
        Length of the film, in one of the two.
    easing : str
        A name in ``EASINGS``.

    Raises
    ------
    ValueError
        For an invalid path, length or easing, or edits that cannot be interpolated (EditError).
    """
    check_rate(fps)
    _check_easing(easing)
    if isinstance(path, Day):
        count = frame_count(fps, frames, seconds, DEFAULT_SECONDS)
        ease = EASINGS[easing]
        return path.edits(scene, [ease(i / (count - 1)) for i in range(count)], between)
    stations = _stations(scene, path)
    if stations.each and frames is None and seconds is None:
        if easing != "linear":
            raise ValueError(
                f"A list of edits is one frame each, so easing={easing!r} has no effect. Pass "
                "frames or seconds for a path through them."
            )
        return stations.edits
    count = frame_count(fps, frames, seconds, stations.seconds)
    row = [i / (count - 1) for i in range(count)]
    return _interpolate(stations, row, easing, scene)


def edit_at(scene: Scene, path: SunPath, share: float, easing: str = "linear") -> Edit:
    """Return the Edit at a share (0–1) of a path.

    For films whose frames have different scenes. As ``film_edits``, but a list of edits is always
    a path through them.
    """
    _check_easing(easing)
    if isinstance(path, Day):
        return path.edits(scene, [EASINGS[easing](share)], between)[0]
    return _interpolate(_stations(scene, path), [share], easing, scene)[0]


def between(start: Edit, end: Edit, fraction: float, scene: Scene) -> Edit:
    """Return the Edit at ``fraction`` (0–1) of the straight path from ``start`` to ``end``.

    An automatic parameter takes the value that the analysis found; the azimuth turns the shorter
    way. Methods, strokes and hints cannot be interpolated, so both ends must agree on them. The
    place, which moves nothing, is that of ``start``.

    Raises
    ------
    EditError
        When the ends differ in something that cannot be interpolated.
    """
    return _interpolate(_Stations([start, end], [0.0, 1.0], 1.0), [fraction], "linear", scene)[0]


def step(scene: Scene, what: Step, base: Edit | None = None) -> Edit:
    """Return the Edit that a step of a path names: an Edit, a recipe, its file or a preset.

    A preset starts from ``base``.

    Raises
    ------
    EditError
        For anything else; the message lists what is accepted.
    """
    if isinstance(what, str) and what in presets.NAMES:
        return presets.edit(what, scene, base)
    return named_edit(what)


def named_edit(what: Step) -> Edit:
    """Return the Edit of a step that does not depend on the photo: any but a preset.

    Raises
    ------
    EditError
        For anything else; the message lists what is accepted.
    """
    if isinstance(what, (Edit, Mapping)):
        return edit_of(what)
    if isinstance(what, (str, os.PathLike)):
        if is_recipe_file(what):
            return read_recipe(what)
        raise EditError(
            f"{os.fspath(what)[:80]!r} is neither a recipe file nor a preset "
            f"({', '.join(presets.NAMES)})."
        )
    raise EditError(
        "A step of a path is an Edit, a recipe, a recipe file or the name of a preset, "
        f"not {type(what).__name__}."
    )


def check_rate(fps: float) -> None:
    """Raise ValueError, before any work, for an invalid number of frames per second."""
    if not (isinstance(fps, (int, float)) and 1 <= fps <= 120):
        raise ValueError(f"fps = {short_repr(fps, 40)} is outside 1 to 120 frames per second.")


def _check_easing(easing: str) -> None:
    if not isinstance(easing, str) or easing not in EASINGS:
        raise ValueError(
            f"easing must be one of {', '.join(EASINGS)}, not {short_repr(easing, 40)}."
        )


def _stations(scene: Scene, path: Any) -> _Stations:
    if isinstance(path, (str, bytes, Mapping, Edit)) or not hasattr(path, "__iter__"):
        raise ValueError(
            "A film's path is two or more edits, presets or recipes, key frames "
            f"(seconds, edit), or a sunwidget.Day, not one {type(path).__name__}."
        )
    steps = list(path)
    if len(steps) < 2:
        raise ValueError("A film needs two or more edits, presets, recipes or key frames.")
    timed = [_is_key_frame(item) for item in steps]
    if all(timed):
        starts = [seconds for seconds, _ in steps]
        apart = all(b > a for a, b in itertools.pairwise(starts))
        if not (apart and starts[0] >= 0 and starts[-1] < MOST_FRAMES):
            raise ValueError(
                "The seconds of key frames must increase, from 0 upwards, "
                f"not {short_repr(starts)}."
            )
        times = [float(seconds) for seconds in starts]
        edits = [step(scene, what) for _, what in steps]
        if times[0] > 0:  # the film begins at 0 and holds the first one until then
            times, edits = [0.0, *times], [edits[0], *edits]
        return _Stations(edits, [t / times[-1] for t in times], times[-1])
    if any(timed):
        raise ValueError("Either every step must be a key frame (seconds, edit) or no step.")
    edits = [step(scene, what) for what in steps]
    shares = [i / (len(edits) - 1) for i in range(len(edits))]
    # A list of more than two Edits may hold every frame; a list of names never does.
    each = len(edits) > 2 and all(isinstance(what, Edit) for what in steps)
    return _Stations(edits, shares, DEFAULT_SECONDS, each)


def _is_key_frame(item: Any) -> bool:
    return (
        isinstance(item, (tuple, list))
        and len(item) == 2
        and isinstance(item[0], (int, float))
        and not isinstance(item[0], bool)
    )


def frame_count(fps: float, frames: int | None, seconds: float | None, otherwise: float) -> int:
    """Return the number of frames of a film; raise ValueError for an invalid length."""
    if frames is not None and seconds is not None:
        raise ValueError("Pass the length of a film as frames or as seconds, not both.")
    if frames is None:
        length = otherwise if seconds is None else seconds
        if not (isinstance(length, (int, float)) and 0 < length < MOST_FRAMES):
            raise ValueError(f"seconds must be a number above 0, not {short_repr(seconds, 40)}.")
        frames = max(2, round(length * fps))
    if isinstance(frames, bool) or not isinstance(frames, int) or frames < 2:
        raise ValueError(
            f"frames must be a whole number from 2 upwards, not {short_repr(frames, 40)}."
        )
    if frames > MOST_FRAMES:
        raise ValueError(f"A film has at most {MOST_FRAMES} frames, not {short_repr(frames, 9)}.")
    return frames


def _interpolate(stations: _Stations, row: list[float], easing: str, scene: Scene) -> list[Edit]:
    """Return the edits at the shares ``row`` (0–1) of the path through the stations."""
    # Automatic values depend on the strokes and hints, which all stations share.
    scene = corrected(scene, stations.edits[0])
    edits = _check_agreement(stations.edits, "moon" if scene.lit_by_moon else "sun")
    knots = np.array(stations.shares)
    shares = np.array([_ease(share, knots, EASINGS[easing]) for share in row])
    tracks = {
        p.name: _track(p.name, edits, knots, shares, scene.automatic, smooth=easing == "smooth")
        for p in NUMBERS
        if any(getattr(edit, p.name) != getattr(edits[0], p.name) for edit in edits)
    }
    limits = {p.name: (p.minimum, p.maximum) for p in NUMBERS}
    along = []
    for i, share in enumerate(shares):
        k = int(np.argmin(np.abs(knots - share)))
        if abs(knots[k] - share) < 1e-9:  # at a station: exactly its edit
            along.append(edits[k])
            continue
        j = int(np.searchsorted(knots, share)) - 1
        changes = {}
        for name, track in tracks.items():
            a, b = getattr(edits[j], name), getattr(edits[j + 1], name)
            low, high = limits[name]
            changes[name] = a if a == b else min(max(float(track[i]), low), high)
        along.append(edits[j].replace(**changes))
    return along


def _check_agreement(edits: list[Edit], light: str) -> list[Edit]:
    """Return the edits with one place; raise EditError when more than numbers differ."""
    # "automatic" and the photo's own light source draw the same picture. Presets set the latter.
    if any(edit.light_source != "automatic" for edit in edits):
        edits = [
            edit.replace(light_source=light) if edit.light_source == "automatic" else edit
            for edit in edits
        ]
    first = edits[0]
    for p in PARAMETERS:
        if p.kind == "number" or p.name == "place":
            continue
        odd = next((e for e in edits if getattr(e, p.name) != getattr(first, p.name)), None)
        if odd is not None:
            shown = (
                f", not {json.dumps(getattr(first, p.name))} and "
                f"{json.dumps(getattr(odd, p.name))}: it cannot be interpolated"
                if p.kind == "choice"
                else ": it cannot be interpolated"
            )
            raise EditError(f"All edits of a film need the same {p.name}{shown}.")
    return [edit.replace(place=first.place) for edit in edits]


def _ease(share: float, knots: NDArray[np.float64], ease: Callable[[float], float]) -> float:
    """Ease each segment between two stations, as CSS does for key frames."""
    j = min(max(int(np.searchsorted(knots, share, side="right")) - 1, 0), len(knots) - 2)
    width = knots[j + 1] - knots[j]
    fraction = min(max((share - knots[j]) / width, 0.0), 1.0)
    return float(knots[j] + width * ease(fraction))


def _track(
    name: str,
    edits: list[Edit],
    knots: NDArray[np.float64],
    shares: NDArray[np.float64],
    automatic: Mapping[str, float],
    *,
    smooth: bool,
) -> NDArray[np.float64]:
    """Return a parameter's values at ``shares``, interpolated linearly or smoothly.

    Smooth means the monotone cubic of Fritsch & Butland 1984 (SciPy's PCHIP): no value leaves the
    range of the two stations around it, so that a rising sun never dips.
    """
    values = [
        automatic[name] if value is None else value
        for value in (getattr(edit, name) for edit in edits)
    ]
    if name == "sun_azimuth":
        for i in range(1, len(values)):  # unwrapped: each the shorter turn from the last
            values[i] = values[i - 1] + (values[i] - values[i - 1] + 180) % 360 - 180
    if smooth and len(knots) > 2:
        from scipy.interpolate import PchipInterpolator

        track = np.asarray(PchipInterpolator(knots, values)(shares), float)
    else:
        track = np.interp(shares, knots, values)
    return (track + 180) % 360 - 180 if name == "sun_azimuth" else track


__all__ = [
    "DEFAULT_SECONDS",
    "EASINGS",
    "Day",
    "Step",
    "SunPath",
    "between",
    "check_rate",
    "film_edits",
    "frame_count",
    "named_edit",
    "step",
]
