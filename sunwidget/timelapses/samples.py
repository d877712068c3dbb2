"""The few frames of a time-lapse that are looked at closely, and what they tell about all."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sunwidget.analysis.fit.fit import fit_sky
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.pipeline import clouds_by_colour
from sunwidget.errors import PhotoError
from sunwidget.geometry.place import Place
from sunwidget.photo.photo import Photo
from sunwidget.photo.place import from_photo
from sunwidget.progress import Progress
from sunwidget.timelapses.fits import Film, key_of
from sunwidget.timelapses.fixed_camera import FixedCamera
from sunwidget.timelapses.frames import Clock, name_of, read_frame
from sunwidget.timelapses.sun import (
    Direction,
    Sample,
    SunTrack,
    middle_direction,
    seen_sun,
    track_of,
)

_SIDE = 640  # pixels of the longer side at which they are looked at
_SEARCH_SIDE = 384
_MOST_BYTES = 400_000_000  # of the whole photos that a median picture is made from


def open_samples(
    sources: list[Any], wanted: int, long_edge: int | None, clock: Clock, progress: Progress
) -> tuple[list[Sample], list[Photo | None]]:
    """Open frames spread over the film; one that is broken gives its place to the next."""
    chosen = np.unique(np.linspace(0, len(sources) - 1, min(wanted, len(sources))).astype(int))
    samples: list[Sample] = []
    photos: list[Photo | None] = []
    size, every = None, 1
    reason = ""
    ends = [*chosen[1:], len(sources)]
    for done, (first, end) in enumerate(zip(chosen, ends, strict=True)):
        progress(0.2 * done / len(chosen), "opening frames")
        for number in range(int(first), min(int(end), int(first) + 4)):
            try:
                photo = read_frame(sources[number], long_edge, size)
            except PhotoError as error:
                reason = f"{name_of(sources[number], number)}: {error}"
                continue
            moment = clock(number, sources[number], photo)
            samples.append(Sample(number, Working.of(photo, _SIDE), moment, None))
            if size is None:
                size = photo.size
                every = math.ceil(len(chosen) * photo.encoded.nbytes / _MOST_BYTES)
            photos.append(photo if done % every == 0 or not any(photos) else None)
            break
    if not photos:
        raise PhotoError(f"No frame could be used. {reason}")
    return samples, photos


def track_and_film(
    samples: list[Sample],
    fixed: FixedCamera,
    place: Place | None,
    told: Direction | None,
    progress: Progress,
) -> tuple[SunTrack, Film]:
    """Return the sun's way through the frames and what suits all of them together.

    ``told`` is where a person says the sun is.
    """
    progress(0.45, "Following the sun")
    shared = fixed.scene
    size = samples[0].working.width, samples[0].working.height
    sky = np.asarray(resize(shared.sky, *size), np.float32)
    samples = [
        s._replace(seen=seen_sun(s.working, sky, shared.camera, shared.hints)) for s in samples
    ]
    lit = [s for s, ok in zip(samples, fixed.lit, strict=True) if ok] or samples
    track = track_of(samples, place, told, shared.assumed_sun)
    if track.source == "assumed":
        searched = []
        for s in lit[:: max(1, len(lit) // 4)]:
            small = s.working.shrunk(_SEARCH_SIDE)
            size = small.width, small.height
            cover = resize(clouds_by_colour(s.working, sky, shared.hints, None)[0].opacity, *size)
            expected = look_at_land(s.working).sun
            searched.append(
                fit_sky(small, resize(sky, *size), cover, shared.camera, None, expected)
            )
        suns = [fit.sun for fit in searched]
        guess = middle_direction(suns, [0.1 + fit.sun_confidence for fit in searched])
        track = track_of(samples, place, told, guess)
    keys = []
    for done, s in enumerate(lit):
        progress(0.45 + 0.15 * done / len(lit), "fitting the air")
        keys.append(key_of(s, shared, track.at(s.number, s.moment), track.source))
    return track, Film.of(keys)


def place_of(photos: list[Photo | None], place: Place | None) -> Place | None:
    """Return the place that was given, else the first that a photo's file tells."""
    if place is not None:
        return place
    told = (from_photo(photo).place for photo in photos if photo is not None)
    return next((found for found in told if found is not None), None)
