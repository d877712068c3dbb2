"""Measured clear skies: 15 scans of Kider et al., and how far the models are from them.

Kider, Knowlton, Newlin, Li & Greenberg, "A Framework for the Experimental Comparison of Solar and
Skydome Illumination" (ACM TOG 33, 2014): spectral radiance in 81 directions, Ithaca NY, on
2013-05-27. The data belong to their authors (Apache-2.0) and are no part of sunwidget:
``download()`` fetches them when asked. Cleaned as Bruneton, "A Qualitative and Quantitative
Evaluation of 8 Clear Sky Models" (2017), did.
"""

from __future__ import annotations

import datetime as dt
import math
import os
import re
import statistics
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.constants import WAVELENGTHS
from sunwidget.atmosphere.measurements_source import (
    FILE_NAME,
    MeasurementsError,
    Progress,
    default_path,
    download,
    read_raw_scans,
)
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.path_tracer import trace
from sunwidget.atmosphere.sky import SkyTable

__all__ = [
    "AIR_OF_THE_DAY",
    "COMPARED_WAVELENGTHS",
    "Comparison",
    "Measurements",
    "MeasurementsError",
    "compare",
    "compare_scans",
    "download",
    "is_available",
    "load",
]

Array = NDArray[np.float64]
Radiance = Callable[[Array, Array, float], Array]

AIR_OF_THE_DAY = Atmosphere(ground_albedo=0.05)
"""``Atmosphere()``, whose aerosol was fitted to this very day, over grass: Bruneton 2017's spectrum
of its albedo has a mean of 0.05 from 360 to 720 nm."""

LATITUDE, LONGITUDE = 42.443449, -76.481962
UTC_OFFSET_HOURS = -4  # of the names of the scans: daylight saving time of Ithaca
COMPARED_WAVELENGTHS: Array = 360 + 11.75 * np.arange(31.0)
"""The samples of Bruneton 2017 up to 720 nm, so that figures can be compared with his."""

# True elevation of the sun by solar.solar_position, so that reading needs no pvlib (a test holds
# them equal). Key: the scan's local time.
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
        Begin of each of the S scans, with its zone. A scan takes 80 s.
    sun_elevation, sun_azimuth : ndarray, shape (S,)
        Degrees; the azimuth, clockwise, is that about which the measured sky is symmetric: the
        instrument's own north is off by 7-17°, more from scan to scan.
    elevation, azimuth : ndarray, shape (81,)
        Directions in degrees, azimuths clockwise in the instrument's frame.
    wavelengths : ndarray, shape (n,)
        Nanometres.
    radiance : ndarray, shape (S, 81, n), float32
        W m⁻² sr⁻¹ nm⁻¹. The sample in the north, spoilt, is the mean of its neighbours.
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
        """Return radiance at other wavelengths, linear between: shape (S, 81, m)."""
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
            ``radiance`` at the shaders' four wavelengths, a mean over 10 nm as the solar
            spectrum's, and ``rgb`` in linear Rec. 709, kcd m⁻².
        """
        near = np.array([self.at(WAVELENGTHS + d)[index] for d in (-5, -2.5, 0, 2.5, 5)])
        four = near.mean(axis=0)
        azimuth = self.azimuth
        return {
            "time": self.times[index].isoformat(),
            "sun_elevation": round(float(self.sun_elevation[index]), 3),
            "sun_azimuth": round(float(_centred(self.sun_azimuth[index])), 3),
            "directions": np.stack([azimuth, self.elevation], axis=1).round(4).tolist(),
            "radiance": four.tolist(),
            "rgb": spectral_to_rec709(four).tolist(),
        }


class Comparison(NamedTuple):
    """How far a model is from the measured skies.

    ``rmse`` in mW m⁻² sr⁻¹ nm⁻¹ over directions and 360-720 nm, quadratic mean over scans;
    ``level`` the model's mean radiance over the measured one, a mean over scans; ``pattern`` the
    rms deviation of the brightness distribution once both have the same mean, the largest of all
    scans.
    """

    model: str
    rmse: float
    level: float
    pattern: float


def is_available(path: Path | str | None = None) -> bool:
    """Return whether ``load`` would find measured skies."""
    return _find(path) is not None


def load(path: Path | str | None = None) -> Measurements:
    """Return the measured skies.

    Parameters
    ----------
    path : path, optional
        An ``.npz`` that ``download`` made, or a folder with one, or with the published ``.7z``
        archives. Default: ``$SUNWIDGET_MEASUREMENTS``, else where ``download`` keeps them.

    Raises
    ------
    MeasurementsError
        When there are none; the message says how to get them.
    """
    found = _find(path)
    if found is None:
        raise MeasurementsError(
            f"No measured skies in {path or default_path().parent}. They belong to their authors "
            "and are not part of sunwidget; sunwidget.atmosphere.measurements.download() fetches "
            "them (21 MB, once)."
        )
    return _load(found, found.stat().st_mtime_ns)


def compare(
    models: Sequence[str] = ("single", "multiple"),
    scan: int | None = None,
    atmosphere: Atmosphere | None = None,
    *,
    data: Measurements | None = None,
    others: Mapping[str, Radiance] | None = None,
    paths: int = 30,
    progress: Progress | None = None,
) -> list[Comparison]:
    """Compare models of the sky with the measured radiance, over one scan or all.

    Parameters
    ----------
    models : sequence of str
        ``"single"`` (Nishita 1993), ``"multiple"`` (all orders), ``"reference"`` (path tracing,
        about a second a scan) and names in ``others``.
    scan : int, optional
        Index of one scan; default all.
    atmosphere : Atmosphere, optional
        What is in the air; default ``AIR_OF_THE_DAY``.
    data : Measurements, optional
        Default ``load()``.
    others : mapping, optional
        Further models by name: ``radiance(elevation, azimuth from the sun, sun elevation)`` of
        shape (81, 4) at the shaders' four wavelengths. They, and path tracing, are carried to
        the whole spectrum by their ratio to ``"multiple"``, which varies little.
    paths : int, default 30
        Paths for each direction and wavelength of ``"reference"``. Their noise, some per cent of
        what is scattered more than once, is small beside the error.
    progress : callable, optional
        ``progress(fraction, message)``; raise in it to cancel.

    Returns
    -------
    list of Comparison
        In the order of ``models``.

    Raises
    ------
    MeasurementsError
        Without data.
    ValueError
        For an unknown model or scan.
    """
    found = compare_scans(
        models,
        scan=scan,
        atmosphere=atmosphere,
        data=data,
        others=others,
        paths=paths,
        progress=progress,
    )
    return [
        Comparison(
            model=model,
            rmse=math.sqrt(statistics.fmean(row.rmse**2 for row in rows)),
            level=statistics.fmean(row.level for row in rows),
            pattern=max(row.pattern for row in rows),
        )
        for model, rows in found.items()
    ]


def compare_scans(
    models: Sequence[str] = ("single", "multiple"),
    scan: int | None = None,
    atmosphere: Atmosphere | None = None,
    *,
    data: Measurements | None = None,
    others: Mapping[str, Radiance] | None = None,
    paths: int = 30,
    progress: Progress | None = None,
) -> dict[str, list[Comparison]]:
    """Compare as ``compare`` does, each scan for itself; see there."""
    data = load() if data is None else data
    air = AIR_OF_THE_DAY if atmosphere is None else atmosphere
    if scan is not None and not 0 <= scan < len(data):
        raise ValueError(f"scan = {scan}: there are scans 0 to {len(data) - 1}.")
    chosen = range(len(data)) if scan is None else [scan]
    known = {"single", "multiple", "reference", *(others or {})}
    for model in models:
        if model not in known:
            raise ValueError(f"There is no model {model!r:.80}. Choose among {', '.join(known)}.")
    skies = _Skies(data, air, others or {}, paths)
    measured = data.at(COMPARED_WAVELENGTHS)
    found: dict[str, list[Comparison]] = {model: [] for model in models}
    for k, (model, i) in enumerate((model, i) for model in models for i in chosen):
        if progress:
            progress(k / len(models) / len(chosen), f"Comparing with the measured skies: {model} …")
        found[model].append(_comparison(model, skies.of(model, i), measured[i]))
    return found


class _Skies:
    """The models' skies in the measured directions, each computed once."""

    def __init__(
        self, data: Measurements, air: Atmosphere, others: Mapping[str, Radiance], paths: int
    ) -> None:
        self.data, self.air, self.others, self.paths = data, air, others, paths
        self._kept: dict[tuple[str, int], Array] = {}
        self._tables: dict[tuple[int, int], SkyTable] = {}

    def of(self, model: str, i: int) -> Array:
        """Return a scan's radiance, shape (81, 31)."""
        if (model, i) not in self._kept:
            if model in ("single", "multiple"):
                sky = self._numpy(model, i, COMPARED_WAVELENGTHS)
            else:
                sky = self._carried(model, i)
            self._kept[model, i] = sky
        return self._kept[model, i]

    def _where(self, i: int) -> tuple[Array, Array, float]:
        data = self.data
        return data.elevation, data.azimuth - data.sun_azimuth[i], float(data.sun_elevation[i])

    def _numpy(self, model: str, i: int, nm: Array) -> Array:
        orders = 1 if model == "single" else 0
        if (orders, len(nm)) not in self._tables:
            self._tables[orders, len(nm)] = SkyTable(self.air, nm, orders=orders)
        return self._tables[orders, len(nm)].radiance(*self._where(i))

    def _carried(self, model: str, i: int) -> Array:
        elevation, azimuth, sun = self._where(i)
        if model == "reference":
            e, a = np.radians([elevation, azimuth])
            level = np.cos(e)
            views = np.stack([level * np.sin(a), np.sin(e), level * np.cos(a)], axis=1)
            four = trace(self.air, views, sun, paths=self.paths)[0]
        else:
            four = self.others[model](elevation, azimuth, sun)
        ratio = four / self._numpy("multiple", i, WAVELENGTHS)
        order = np.argsort(WAVELENGTHS)
        spectrum = [
            np.interp(COMPARED_WAVELENGTHS, WAVELENGTHS[order], row[order]) for row in ratio
        ]
        return self.of("multiple", i) * np.array(spectrum)


def _comparison(model: str, sky: Array, measured: Array) -> Comparison:
    ours, theirs = sky.mean(axis=1), measured.mean(axis=1)
    shares = (ours / ours.mean()) / (theirs / theirs.mean())
    return Comparison(
        model=model,
        rmse=1000 * float(np.sqrt(np.mean((sky - measured) ** 2))),
        level=float(ours.mean() / theirs.mean()),
        pattern=float(np.sqrt(np.mean((shares - 1) ** 2))),
    )


_loaded: dict[tuple[Path, int], Measurements] = {}


def _load(path: Path, stamp: int) -> Measurements:
    if (path, stamp) not in _loaded:
        _loaded[path, stamp] = _measurements(*_read(path))
    return _loaded[path, stamp]


def _find(path: Path | str | None) -> Path | None:
    """Return the file or folder of archives that is meant, if it exists."""
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
            f"{path} holds no measured skies ({error}). Delete it and call "
            "sunwidget.atmosphere.measurements.download()."
        ) from error


def _measurements(
    nm: Array, directions: Array, scans: dict[str, NDArray[np.float32]]
) -> Measurements:
    """Clean the raw scans."""
    times = []
    for name in scans:
        match = _SCAN_NAME.fullmatch(name)
        if match is None:
            raise MeasurementsError(f"{name!r:.80} is no name of a scan (YYYY-MM-DD___hh.mm.ss).")
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
    """Return the azimuth of the sun, 0-360°: that of the plane in which a clear sky mirrors itself.

    Parameters
    ----------
    radiance, elevation, azimuth : ndarray, shape (n,)
        Of directions that lie in rings of equal elevation, evenly spaced.

    Notes
    -----
    Of a ring's Fourier series about that azimuth only the cosines are left. The logarithm of
    the radiance is used, so that the aureole does not outweigh the rest; large rings count more.
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
    # The sky mirrors itself about the far side too; the sun's is the brighter.
    return float(np.degrees(candidates[np.argmax(np.where(brightness > 0, symmetry, -np.inf))]))


def _sun_elevation(time: dt.datetime) -> float:
    known = _SUN_ELEVATION.get(f"{time:%Y-%m-%d %H:%M}")
    if known is not None:
        return known
    from sunwidget.atmosphere.solar import solar_position

    return float(solar_position(time, LATITUDE, LONGITUDE).true_elevation)


def _centred(azimuth: float) -> float:
    return (azimuth + 180) % 360 - 180
