"""The sampled frames of a time-lapse, analyzed in detail, and what follows for all frames."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sunwidget.analysis.fit.fit import fit_sky
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.pipeline import clouds_by_color
from sunwidget.errors import PhotoError
from sunwidget.geometry.place import Place
from sunwidget.photo.photo import Photo
from sunwidget.photo.place import from_photo
from sunwidget.progress import Progress
from sunwidget.timelapses.fits import Film, fit_key
from sunwidget.timelapses.fixed_camera import FixedCamera
from sunwidget.timelapses.frames import Clock, name_of, read_frame
from sunwidget.timelapses.sun import (
    Direction,
    Sample,
    SunTrack,
    find_seen_sun,
    middle_direction,
    track_sun,
)

_SIDE = 640  # pixels on the longer side of an analyzed sample
_SEARCH_SIDE = 384
_MOST_BYTES = 400_000_000  # total of the photos behind a median picture


def open_samples(
    sources: list[Any], wanted: int, long_edge: int | None, clock: Clock, progress: Progress
) -> tuple[list[Sample], list[Photo | None]]:
    """Open frames spread over the film; the next frame replaces a broken one."""
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
    hinted: Direction | None,
    progress: Progress,
) -> tuple[SunTrack, Film]:
    """Return the sun's track through the frames, and the air and response shared by all.

    ``hinted`` is the sun's direction as set by a hint.
    """
    progress(0.45, "Following the sun")
    shared = fixed.scene
    size = samples[0].working.width, samples[0].working.height
    sky = np.asarray(resize(shared.sky, *size), np.float32)
    samples = [
        s._replace(seen=find_seen_sun(s.working, sky, shared.camera, shared.hints)) for s in samples
    ]
    lit = [s for s, ok in zip(samples, fixed.lit, strict=True) if ok] or samples
    track = track_sun(samples, place, hinted, shared.assumed_sun)
    if track.source == "assumed":
        searched = []
        for s in lit[:: max(1, len(lit) // 4)]:
            small = s.working.shrunk(_SEARCH_SIDE)
            size = small.width, small.height
            cover = resize(clouds_by_color(s.working, sky, shared.hints, None)[0].opacity, *size)
            expected = look_at_land(s.working).sun
            searched.append(
                fit_sky(small, resize(sky, *size), cover, shared.camera, None, expected)
            )
        suns = [fit.sun for fit in searched]
        guess = middle_direction(suns, [0.1 + fit.sun_confidence for fit in searched])
        track = track_sun(samples, place, hinted, guess)
    keys = []
    for done, s in enumerate(lit):
        progress(0.45 + 0.15 * done / len(lit), "fitting the air")
        keys.append(fit_key(s, shared, track.at(s.number, s.moment), track.source))
    return track, Film.of(keys)


def find_place(photos: list[Photo | None], place: Place | None) -> Place | None:
    """Return ``place`` if it is set, otherwise the first place in a photo's metadata."""
    if place is not None:
        return place
    recorded = (from_photo(photo).place for photo in photos if photo is not None)
    return next((found for found in recorded if found is not None), None)
