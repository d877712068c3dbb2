"""Measured clear skies: 15 scans of Kider et al., read and cleaned.

Kider, Knowlton, Newlin, Li & Greenberg, "A Framework for the Experimental Comparison of Solar and
Skydome Illumination" (ACM TOG 33, 2014): spectral radiance in 81 directions, Ithaca NY, on
2013-05-27. The data belong to their authors (Apache-2.0) and are not part of sunwidget;
``measurements.download()`` fetches them. They are cleaned as in Bruneton, "A Qualitative and
Quantitative Evaluation of 8 Clear Sky Models" (2017).
"""

from __future__ import annotations

import datetime as dt
import os
import re
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.constants import WAVELENGTHS
from sunwidget.geometry.place import wrap_angle
from sunwidget.validation.download import FILE_NAME, MeasurementsError, default_path, read_raw_scans

Array = NDArray[np.float64]

LATITUDE, LONGITUDE = 42.443449, -76.481962
UTC_OFFSET_HOURS = -4  # of the scans' names: daylight saving time of Ithaca

# True elevation of the sun by solar.solar_position, stored so that reading needs no pvlib (a test
# compares them). Key: the scan's local time.
_SUN_ELEVATION = {
    "2013-05-27 09:30": 41.0665,
    "2013-05-27 09:45": 43.7955,
    "2013-05-27 10:00": 46.4962,
    "2013-05-27 10:15": 49.1582,
    "2013-05-27 10:30": 51.7689,
    "2013-05-27 10:45": 54.3127,
    "2013-05-27 11:00": 56.7704,
    "2013-05-27 11:15": 59.1174,
    "2013-05-27 11:30": 61.3229,
    "2013-05-27 11:45": 63.3487,
    "2013-05-27 12:00": 65.1478,
    "2013-05-27 12:15": 66.6651,
    "2013-05-27 12:30": 67.8406,
    "2013-05-27 12:45": 68.6162,
    "2013-05-27 13:30": 68.2181,
}
_SCAN_NAME = re.compile(r"(\d{4}-\d\d-\d\d)___(\d\d)\.(\d\d)\.(\d\d)")


@dataclass(frozen=True, eq=False)
class Measurements:
    """Measured sky radiance of one day.

    Parameters
    ----------
    times : tuple of datetime
        Start of each of the S scans, with its time zone. A scan takes 80 s.
    sun_elevation, sun_azimuth : ndarray, shape (S,)
        Degrees. The azimuth, clockwise, is that about which the measured sky is symmetric: the
        instrument's north is off by 7-17°, increasing from scan to scan.
    elevation, azimuth : ndarray, shape (81,)
        Directions in degrees, azimuths clockwise in the instrument's frame.
    wavelengths : ndarray, shape (n,)
        Nanometers.
    radiance : ndarray, shape (S, 81, n), float32
        W m⁻² sr⁻¹ nm⁻¹. The faulty sample in the north is replaced by the mean of its neighbors.
    """

    times: tuple[dt.datetime, ...]
    sun_elevation: Array
    sun_azimuth: Array
    elevation: Array
    azimuth: Array
    wavelengths: Array
    radiance: NDArray[np.float32]

    def __len__(self) -> int:
        return len(self.times)

    def at(self, wavelengths: Array) -> Array:
        """Return radiance at other wavelengths, interpolated linearly: shape (S, 81, m)."""
        place = np.interp(wavelengths, self.wavelengths, np.arange(len(self.wavelengths)))
        low = np.minimum(place.astype(int), len(self.wavelengths) - 2)
        part = place - low
        return np.asarray(
            self.radiance[..., low] * (1 - part) + self.radiance[..., low + 1] * part, float
        )

    def scans_json(self) -> list[dict[str, Any]]:
        """Return the list of scans as plain JSON types: index, label, sun_elevation."""
        return [
            {"index": i, "label": f"{time:%Y-%m-%d %H:%M}", "sun_elevation": round(sun, 2)}
            for i, (time, sun) in enumerate(
                zip(self.times, self.sun_elevation.tolist(), strict=True)
            )
        ]

    def scan_json(self, index: int) -> dict[str, Any]:
        """Return one scan for the browser.

        Returns
        -------
        dict
            ``time``, ``sun_elevation``, ``sun_azimuth``, ``directions`` [[azimuth, elevation] …],
            ``radiance`` at the shaders' four wavelengths, averaged over 10 nm like the solar
            spectrum, and ``rgb`` in linear Rec. 709, kcd m⁻².
        """
        near = np.array([self.at(WAVELENGTHS + d)[index] for d in (-5, -2.5, 0, 2.5, 5)])
        four = near.mean(axis=0)
        azimuth = self.azimuth
        return {
            "time": self.times[index].isoformat(),
            "sun_elevation": round(float(self.sun_elevation[index]), 3),
            "sun_azimuth": round(float(wrap_angle(self.sun_azimuth[index])), 3),
            "directions": np.stack([azimuth, self.elevation], axis=1).round(4).tolist(),
            "radiance": four.tolist(),
            "rgb": spectral_to_rec709(four).tolist(),
        }


def is_available(path: Path | str | None = None) -> bool:
    """Return whether ``load`` would find measured skies."""
    return _find(path) is not None


def load(path: Path | str | None = None) -> Measurements:
    """Return the measured skies.

    Parameters
    ----------
    path : path, optional
        An ``.npz`` written by ``download``, or a folder with one or with the published ``.7z``
        archives. Default: ``$SUNWIDGET_MEASUREMENTS``, else the file of ``download``.

    Raises
    ------
    MeasurementsError
        When there are no data; the message gives the remedy.
    """
    found = _find(path)
    if found is None:
        raise MeasurementsError(
            f"No measured skies in {path or default_path().parent}. They belong to their authors "
            "and are not part of sunwidget. Call sunwidget.validation.measurements.download() "
            "(21 MB, once)."
        )
    return _load(found, found.stat().st_mtime_ns)


_loaded: dict[tuple[Path, int], Measurements] = {}


def _load(path: Path, stamp: int) -> Measurements:
    if (path, stamp) not in _loaded:
        _loaded[path, stamp] = _measurements(*_read(path))
    return _loaded[path, stamp]


def _find(path: Path | str | None) -> Path | None:
    """Return the file, or the folder of archives, if it exists."""
    if path is None:
        path = os.environ.get("SUNWIDGET_MEASUREMENTS") or default_path()
    path = Path(path)
    if path.is_dir():
        for name in (FILE_NAME, "kider2014_radiance_350_1000nm.npz"):
            if (path / name).is_file():
                return path / name
        return path if any(path.glob("2013-05-27___*.7z")) else None
    return path if path.is_file() else None


def _read(path: Path) -> tuple[Array, Array, dict[str, NDArray[np.float32]]]:
    """Return wavelengths, directions and raw scans by name."""
    if path.is_dir():
        return read_raw_scans({p.name: p.read_bytes() for p in path.glob("2013-05-27___*.7z")})
    try:
        with np.load(path, allow_pickle=False) as file:
            scans = {
                name.removeprefix("scan_"): file[name].astype(np.float32)
                for name in sorted(file.files)
                if name.startswith("scan_")
            }
            return file["wavelength_nm"].astype(float), file["dirs"].astype(float), scans
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise MeasurementsError(
            f"{path} has no measured skies ({error}). Delete it and call "
            "sunwidget.validation.measurements.download()."
        ) from error


def _measurements(
    nm: Array, directions: Array, scans: dict[str, NDArray[np.float32]]
) -> Measurements:
    """Clean the raw scans."""
    times = []
    for name in scans:
        match = _SCAN_NAME.fullmatch(name)
        if match is None:
            raise MeasurementsError(f"{name!r:.80} is not a scan's name (YYYY-MM-DD___hh.mm.ss).")
        zone = dt.timezone(dt.timedelta(hours=UTC_OFFSET_HOURS))
        day, *clock = match.groups()
        times.append(
            dt.datetime.combine(
                dt.date.fromisoformat(day), dt.time.fromisoformat(":".join(clock)), zone
            )
        )
    elevation, azimuth = directions[:, 2], -directions[:, 1] % 360
    radiance = np.stack(list(scans.values()))
    _mend_north(radiance, elevation, azimuth)
    visible = (nm >= 450) & (nm <= 700)
    return Measurements(
        times=tuple(times),
        sun_elevation=np.array([_sun_elevation(time) for time in times]),
        sun_azimuth=np.array(
            [
                azimuth_of_symmetry(sky[:, visible].mean(axis=1), elevation, azimuth)
                for sky in radiance
            ]
        ),
        elevation=elevation,
        azimuth=azimuth,
        wavelengths=nm,
        radiance=radiance,
    )


def _mend_north(radiance: NDArray[np.float32], elevation: Array, azimuth: Array) -> None:
    """Replace the lowest sample in the north by the mean of its neighbours (Bruneton 2017)."""
    ring = np.flatnonzero(elevation == elevation.min())
    ring = ring[np.argsort(azimuth[ring])]
    if azimuth[ring[0]] == 0:
        radiance[:, ring[0]] = 0.5 * (radiance[:, ring[1]] + radiance[:, ring[-1]])


def azimuth_of_symmetry(radiance: Array, elevation: Array, azimuth: Array) -> float:
    """Return the azimuth of the sun, 0-360°, from the plane of symmetry of a clear sky.

    Parameters
    ----------
    radiance, elevation, azimuth : ndarray, shape (n,)
        For directions in rings of equal elevation, evenly spaced.

    Notes
    -----
    About that azimuth, a ring's Fourier series has only cosines. The logarithm of the radiance
    keeps the aureole from dominating; rings are weighted by their number of directions.
    """
    candidates = np.radians(np.arange(0, 360, 0.1))
    symmetry, brightness = np.zeros_like(candidates), np.zeros_like(candidates)
    for level in np.unique(elevation):
        of = elevation == level
        count = np.count_nonzero(of)
        if count < 8:
            continue
        k = np.arange(1, count // 2)[:, None]
        series = np.exp(-1j * k * np.radians(azimuth[of])) @ np.log(radiance[of]) / count
        turned = np.angle(series)[:, None] + k * candidates
        symmetry += count * (np.abs(series) ** 2 @ np.cos(2 * turned))
        brightness += np.abs(series[0]) * np.cos(turned[0])
    # The plane has two sides; the sun is on the brighter one.
    return float(np.degrees(candidates[np.argmax(np.where(brightness > 0, symmetry, -np.inf))]))


def _sun_elevation(time: dt.datetime) -> float:
    known = _SUN_ELEVATION.get(f"{time:%Y-%m-%d %H:%M}")
    if known is not None:
        return known
    from sunwidget.geometry.solar import solar_position

    return float(solar_position(time, LATITUDE, LONGITUDE).true_elevation)
