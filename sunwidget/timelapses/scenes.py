"""Scenes of the frames of one camera: the shared scene, completed for each frame.

``FrameScenes.of`` analyzes a few frames in detail and measures every frame. Iterating opens each
frame once more and yields its scene. Only a few frames are in memory at any time.
"""

from __future__ import annotations

import dataclasses
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from sunwidget.analysis.backdrop.backdrop import behind_sun
from sunwidget.analysis.clouds.cover import unmix_clouds
from sunwidget.analysis.clouds.unmix import cloud_gain
from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.pipeline import clouds_by_color, erased_for
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError
from sunwidget.formats.pixels import size_within
from sunwidget.geometry.place import Place
from sunwidget.photo.photo import Photo
from sunwidget.progress import Progress
from sunwidget.timelapses.fits import Film, Meter, Reading, likeness, steady
from sunwidget.timelapses.fixed_camera import FixedCamera, Offset
from sunwidget.timelapses.frames import Clock, name_of, read_frame
from sunwidget.timelapses.samples import find_place, open_samples, track_and_film
from sunwidget.timelapses.sun import Direction, SunTrack, observation

SAMPLES = 9
_AROUND = 2  # frames before and after over which the old sun's glare is averaged


class Trouble(NamedTuple):
    """An unusable frame and the reason."""

    number: int
    name: str
    reason: str


@dataclass(frozen=True, eq=False)
class FrameScenes:
    """The scenes of a time-lapse.

    Attributes
    ----------
    sources : list
        A source for ``sunwidget.open`` per frame.
    fixed : FixedCamera
    track : SunTrack
    film : Film
    fits : tuple of SkyFit or None
        The fit of each frame; None if it is unusable.
    offsets : tuple of Offset
    alike : (n, 17) float64
        How likely each frame and the eight before and after it are of one take.
    daylight : tuple of float
        Share of sunlight, as opposed to lamps or the moon, in each frame: 0 at night, 1 by day.
    troubles : tuple of Trouble
        The unusable frames.
    size : (width, height)
        Size of every frame's scene in pixels.
    """

    sources: list[Any]
    fixed: FixedCamera
    track: SunTrack
    film: Film
    fits: tuple[SkyFit | None, ...]
    offsets: tuple[Offset, ...]
    alike: np.ndarray
    daylight: tuple[float, ...]
    troubles: tuple[Trouble, ...]
    size: tuple[int, int]

    @classmethod
    def of(
        cls,
        sources: Sequence[Any],
        *,
        long_edge: int | None,
        corrections: Edit,
        place: Place | None,
        clock: Clock,
        hints: dict[str, Any],
        progress: Progress,
    ) -> FrameScenes:
        """Analyze the frames.

        Parameters
        ----------
        sources : sequence
        long_edge : int or None
            Limit of the longer side in pixels; larger frames are shrunk.
        corrections : Edit
            Strokes and hints, in fractions of the picture, for every frame.
        place : Place or None
            Position of the camera; None reads it from the files.
        clock : Clock
        hints : dict
            Arguments of ``analyze``, except the sun.
        progress : callable
            Called with (fraction, message). An exception from it cancels.

        Raises
        ------
        PhotoError
            When fewer than two frames are usable, or the camera moved.
        """
        sources = list(sources)
        samples, photos = open_samples(sources, SAMPLES, long_edge, clock, progress)
        size = next(photo.size for photo in photos if photo is not None)
        place = find_place(photos, place)
        progress(0.2, "Finding what all frames share")
        fixed = FixedCamera.of([s.working for s in samples], photos, corrections, hints)
        del photos
        hinted = fixed.scene.sun if fixed.scene.hints.sun is not None else None
        track, film = track_and_film(
            samples,
            fixed,
            place,
            None if hinted is None else (hinted.azimuth, hinted.elevation),
            progress,
        )
        return cls.survey(sources, fixed, track, film, clock, size, progress)

    @classmethod
    def survey(
        cls,
        sources: list[Any],
        fixed: FixedCamera,
        track: SunTrack,
        film: Film,
        clock: Clock,
        size: tuple[int, int],
        progress: Progress,
    ) -> FrameScenes:
        """Measure the light, time and offset of every frame."""
        meter = Meter(fixed.scene, film)
        readings: list[Reading | None] = []
        suns: list[Direction | None] = []
        offsets: list[Offset] = []
        troubles: list[Trouble] = []
        for number, source in enumerate(sources):
            progress(0.6 + 0.4 * number / len(sources), f"looking at frame {number + 1}")
            try:
                photo = read_frame(source, None, like=size_within(size, 1024))
            except PhotoError as error:
                troubles.append(Trouble(number, name_of(source, number), str(error)))
                offsets.append(Offset(0.0, 0.0, sure=False))
                readings.append(None)
                suns.append(None)
                continue
            moment = clock(number, source, photo)
            suns.append(track.at(number, moment))
            offsets.append(fixed.offset(photo))
            if offsets[-1].far:
                raise PhotoError(_moved_message(name_of(source, number), offsets[-1]))
            readings.append(meter.read(Working.of(photo, 256), track.at(number, moment)))
        _refuse_too_few(readings, troubles)
        log_gain, exposure = steady(readings, suns)
        fits = tuple(
            None if sun is None or reading is None else film.fit(i, sun, log_gain[i])
            for i, (sun, reading) in enumerate(zip(suns, readings, strict=True))
        )
        return cls(
            sources,
            fixed,
            track,
            film,
            fits,
            tuple(offsets),
            likeness(exposure, suns),
            tuple(_daylight(track, *both) for both in zip(readings, suns, strict=True)),
            tuple(troubles),
            size,
        )

    def __len__(self) -> int:
        return len(self.sources)

    def __iter__(self) -> Iterator[Scene | Trouble]:
        """Yield the scene of every frame in turn, or its Trouble if it is unusable."""
        waiting: deque[tuple[int, Scene | Trouble]] = deque()
        marks: dict[int, np.ndarray] = {}
        following = iter(range(len(self.sources)))
        for number in range(len(self.sources)):
            while not waiting or waiting[-1][0] < min(number + _AROUND, len(self.sources) - 1):
                i = next(following)
                scene = self._scene(i)
                waiting.append((i, scene))
                if isinstance(scene, Scene):
                    marks[i] = scene.glare
            _, scene = waiting.popleft()
            if isinstance(scene, Scene):
                scene = dataclasses.replace(
                    scene, glare=self._steady_mark(number, marks), memory=Memory()
                )
            marks.pop(number - _AROUND, None)
            yield scene

    def _steady_mark(self, number: int, marks: dict[int, np.ndarray]) -> np.ndarray:
        """Average the old sun's glare map over frames of the same take."""
        reach = self.alike.shape[1] // 2
        total, mean = 0.0, np.zeros_like(marks[number])
        for i, mark in marks.items():
            step = i - number
            if abs(step) > _AROUND:
                continue
            weight = float(self.alike[number, reach + step]) * np.exp(-0.5 * (step / 1.2) ** 2)
            total += weight
            mean += weight * mark
        return np.asarray(mean / total, np.float32)

    def _scene(self, number: int) -> Scene | Trouble:
        fit = self.fits[number]
        if fit is None:
            return next(trouble for trouble in self.troubles if trouble.number == number)
        photo = read_frame(self.sources[number], max(self.size), like=self.size)
        return scene_of_frame(
            photo, self.fixed.shifted(self.offsets[number]), fit, self.track.source
        )


def scene_of_frame(photo: Photo, shared: Scene, fit: SkyFit, source: str) -> Scene:
    """Return the scene of a frame: the shared maps with its own clouds, sun and light.

    Parameters
    ----------
    photo : Photo
        The frame, in the size of ``shared``.
    shared : Scene
        The frames' shared scene.
    fit : SkyFit
        The frame's air, gain and sun.
    source : str
        Source of that sun's direction (``SunTrack.source``).
    """
    working = Working.of(photo)
    size = _size_of(working)
    sky = np.asarray(resize(shared.sky, *size), np.float32)
    seen = observation(fit.sun, working, sky, shared.camera, shared.hints, source)
    erased = erased_for(working, look_for_sun(working), sky, seen)
    mask = seen.blot if seen.visible else None
    covers = clouds_by_color(erased.working, sky, shared.hints, mask)
    behind = behind_sun(working, erased, sky, shared.camera, fit)
    if shared.hints.method("clouds") == "unmix":
        covers = unmix_clouds(erased, sky, shared.camera, fit, covers, sun_seen=seen.visible)
    cover, everywhere = covers
    return dataclasses.replace(
        shared,
        photo=photo,
        working=working,
        cloud_map=cover.opacity,
        softness_map=cover.softness,
        shade=cover.shade,
        everywhere=everywhere,
        # An assumed sun is not an observation.
        sun=None if source == "assumed" else seen,
        moon=None,
        assumed_sun=fit.sun,
        atmosphere=fit.atmosphere,
        fitted=fit,
        response=shared.response
        | {
            "response_shoulder": fit.response.shoulder,
            "response_contrast": fit.response.contrast,
            "sky_gain": fit.gain,
            "cloud_gain": cloud_gain(fit),
            "glare_profile": fit.glare,
            "sun_mask_share": min(1.0, float(seen.blot.sum()) / max(float(sky.sum()), 1.0)),
        },
        backdrop=behind.field,
        glare=behind.glare,
        erased=erased,
        memory=Memory(),
    )


def _daylight(track: SunTrack, reading: Reading | None, sun: Direction | None) -> float:
    """Return the sun's share of a frame's light, from the clock or from the sky's brightness."""
    if reading is None or sun is None:
        return 0.0
    if track.source == "clock":
        return float(smoothstep(-11.0, -5.0, sun[1]))
    return float(smoothstep(0.33, 0.5, reading.sky_light))


def _refuse_too_few(readings: list[Reading | None], troubles: list[Trouble]) -> None:
    if sum(reading is not None for reading in readings) < 2:
        worst = troubles[0]
        raise PhotoError(
            f"Fewer than two of {len(readings)} frames are usable; {worst.name}: {worst.reason}"
        )


def _moved_message(name: str, offset: Offset) -> str:
    share = max(abs(offset.x), abs(offset.y))
    return (
        f"The camera has moved by {share:.0%} of the picture at {name}. A time-lapse needs a "
        "fixed view: split the frames there and make two films."
    )


def _size_of(working: Working) -> tuple[int, int]:
    return working.width, working.height
