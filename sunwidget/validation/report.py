"""Errors of the clear-sky model against measurements, publications and other models.

Each function is a row of the table in atmosphere.md and returns figures with their bounds;
``make validate`` prints them all, the tests assert them. Sources are independent of sunwidget. A
row without its data or package names what it needs and is neither met nor missed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import chromaticity, spectrum_to_xyz
from sunwidget.atmosphere.constants import solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SHADER, SkyTable
from sunwidget.validation import measurements
from sunwidget.validation.bruneton2017 import EVALUATION, Evaluation
from sunwidget.validation.sky_figures import (
    along_a_ray,
    furnace,
    illuminance,
    over_the_sphere,
    path_tracing_error,
    zenith_x,
)

Array = NDArray[np.float64]

AIR = Atmosphere()


class Row(NamedTuple):
    """One figure with its bound.

    ``met`` is None if ``note`` names something that the row needs; ``value`` is in ``unit``.
    """

    number: int
    name: str
    value: float | None
    unit: str
    target: str
    met: bool | None
    source: str
    note: str = ""


class _At:
    """Makes rows of one number and source."""

    def __init__(self, number: int, source: str) -> None:
        self.number, self.source = number, source

    def most(self, name: str, value: float, bound: float, unit: str = "") -> Row:
        target = f"≤ {bound:g} {unit}".rstrip()
        return Row(self.number, name, float(value), unit, target, bool(value <= bound), self.source)

    def least(self, name: str, value: float, bound: float, unit: str = "") -> Row:
        target = f"≥ {bound:g} {unit}".rstrip()
        return Row(self.number, name, float(value), unit, target, bool(value >= bound), self.source)

    def between(self, name: str, value: float, low: float, high: float, unit: str = "") -> Row:
        target, met = f"{low:g} to {high:g} {unit}".rstrip(), bool(low <= value <= high)
        return Row(self.number, name, float(value), unit, target, met, self.source)

    def needs(self, name: str, what: str) -> Row:
        return Row(self.number, name, None, "", "", None, self.source, f"needs {what}")


def closed_forms() -> Iterator[Row]:
    """Compare phase functions, air mass, transmittance and a furnace with closed forms."""
    at = _At(1, "closed forms; air mass: numerical integration of the same exponentials")
    yield at.most(
        "Rayleigh's phase function: integral - 1",
        abs(over_the_sphere(optics.rayleigh_phase) - 1),
        1e-9,
    )
    norm, mean = 0.0, 0.0
    for g in (-0.5, 0.0, 0.3, 0.7, 0.8, 0.95):

        def phase(mu: float, g: float = g) -> Array:
            return optics.cornette_shanks_phase(mu, g)

        closed = 3 * g * (4 + g * g) / (5 * (2 + g * g))
        norm = max(norm, abs(over_the_sphere(phase) - 1))
        mean = max(mean, abs(over_the_sphere(phase, lambda mu: mu) - closed))
    yield at.most("Cornette-Shanks: integral - 1, g up to 0.95", norm, 1e-8)
    yield at.most("Cornette-Shanks: mean cosine, g up to 0.95", mean, 1e-8)
    forward = float(optics.cornette_shanks_phase(1, 0.76)) / 2.83
    back = float(optics.cornette_shanks_phase(-1, 0.76)) / 0.0071760
    error = 100 * max(abs(forward - 1), abs(back - 1))
    yield at.most("Cornette-Shanks forward and back, g 0.76", error, 0.01, "%")
    # Sun at 30, 10, 5 and 0°, for a single exponential of 8.43 km. Our air is thinner above 40 km,
    # which changes the air mass by up to 0.16 % at the horizon.
    expected = [
        [1.992, 1.999, 1.977],
        [5.540, 5.724, 5.153],
        [10.086, 11.21, 8.119],
        [34.442, 91.25, 11.60],
    ]
    mass = optics.relative_air_mass([30, 10, 5, 0])
    yield at.most("air mass of air, haze, ozone", 100 * np.abs(mass / expected - 1).max(), 0.2, "%")
    worst = max(along_a_ray(elevation) for elevation in (90, 30, 5, 1))
    yield at.most("transmittance multiplies along a ray", 100 * worst, 0.01, "%")
    # The error of the series for the late orders, where it carries half of all light.
    yield at.most("furnace: deviation from an even light", 100 * furnace(), 1.5, "%")


def direct_beam() -> Iterator[Row]:
    """Compare the sun through clear air with the standard spectrum."""
    at = _At(2, "ASTM G-173-03 AM1.5 direct, by pvlib")
    name = "direct beam in clear windows 400-775 nm, rms"
    try:
        from pvlib.spectrum import get_reference_spectra
    except ImportError:
        yield at.needs(name, "pvlib: pip install 'sunwidget[solar]'")
        return
    spectrum = get_reference_spectra(standard="ASTM G173-03")
    nm = np.array(spectrum.index, float)
    windows = [(400, 575), (600, 625), (660, 680), (745, 745), (775, 775)]
    clear = np.any([(nm >= low) & (nm <= high) for low, high in windows], axis=0)
    nm, measured = nm[clear], np.array(spectrum["direct"])[clear]
    top = np.array(spectrum["extraterrestrial"])[clear]
    # The standard's AM1.5: AOD 0.084 at 500 nm, alpha 1.14, 343.8 DU of ozone. The sun's spectrum
    # is also the standard's, so that only the air is tested.
    air = Atmosphere(
        aerosol_optical_depth=0.084 * (550 / 500) ** -1.14, angstrom_exponent=1.14, ozone=343.8
    )
    ours = top * optics.direct_irradiance(air, 90 - 48.236, nm) / solar_irradiance(nm)
    yield at.most(name, 100 * _rms(ours / measured - 1), 1.5, "%")


def measured_radiance(data: measurements.Measurements | None = None) -> Iterator[Row]:
    """Compare with measured clear skies, 15 scans of 81 directions from 360 to 720 nm."""
    at = _At(3, "Kider et al. 2014, cleaned as Bruneton 2017 did")
    if data is None:
        try:
            data = measurements.load()
        except measurements.MeasurementsError as error:
            yield at.needs("measured radiance", f"the measured skies: {error}")
            return
    unit = "mW m⁻² sr⁻¹ nm⁻¹"
    scans = measurements.compare_scans(data=data)
    rmse = {name: _quadratic_mean([row.rmse for row in rows]) for name, rows in scans.items()}
    levels = [row.level for row in scans["multiple"]]
    # Bruneton's own, all orders: 11.3. The data's floor is about 11.
    yield at.most("all orders: RMSE", rmse["multiple"], 13, unit)
    yield at.least("all orders: mean level, lowest scan", min(levels), 0.87)
    yield at.most("all orders: mean level, highest scan", max(levels), 1.04)
    pattern = max(row.pattern for row in scans["multiple"])
    yield at.most("all orders: pattern, worst scan, rms", 100 * pattern, 12, "%")
    yield at.least("single scattering alone: RMSE", rmse["single"], 22, unit)


def other_models(folder: Path | None = None) -> Iterator[Row]:
    """Compare with skies that Bruneton's own code computed for this day, without ozone."""
    at = _At(4, "Bruneton 2017, clear-sky-models: outputs of his code")
    if folder is None or not (folder / EVALUATION).is_file():
        yield at.needs("other models' skies", f"a folder with {EVALUATION} and csm_model_outputs/")
        return
    evaluation = Evaluation(folder)
    yield at.most(
        "reading: RMSE of his model less the published 11.34",
        abs(evaluation.rmse(evaluation.model("elek")) - 11.34),
        0.02,
    )
    air = AIR.replace(ozone=0)
    for name, theirs, orders, bound in (
        ("all orders against Bruneton 2008, rms", "elek", 0, 7.0),
        ("single scattering against Nishita 1993, rms", "nishita93", 1, 4.0),
    ):
        ratio = evaluation.ours(air, orders=orders) / evaluation.model(theirs)
        yield at.most(name, 100 * _rms(ratio - 1), bound, "%")


def another_day() -> Iterator[Row]:
    """Return the row of a day that is held back from the development of sunwidget."""
    at = _At(5, "Kider et al. 2014, another day")
    yield at.needs("another day's pattern", "a check from outside: this day is held back")


HAZE = Atmosphere(aerosol_optical_depth=0.3, aerosol_asymmetry=0.75)
# Sun's elevation, bound in per cent: zenith angles 0-60°, 80-88°, 90-94°.
PATH_TRACED_SUNS = ((60.0, 8), (30.0, 8), (10.0, 15), (3.0, 15), (0.0, 35), (-3.0, 35))


def path_tracing(paths: int = 600) -> Iterator[Row]:
    """Compare all orders with path tracing, at the worst of four wavelengths."""
    at = _At(6, f"our path tracer, {paths} paths a direction; noise taken off in quadrature")
    for name, air in (("clear", AIR), ("haze of AOD 0.3", HAZE)):
        for sun, bound in PATH_TRACED_SUNS:
            error, noise = path_tracing_error(air, sun, paths)
            own = np.sqrt(np.maximum(error**2 - noise**2, 0)).max()
            what = f"{name}, sun at {sun:g}°: rms (noise {100 * noise.max():.1f} %)"
            yield at.most(what, 100 * own, bound, "%")


def twilight() -> Iterator[Row]:
    """Return brightness and color of the sky from sunset to the end of nautical twilight."""
    at = _At(7, "American Meteorological Society, Glossary: twilight")
    table = SkyTable(AIR, quality=SHADER)
    # A factor of three: below -9° the light comes from heights where the air is a guess.
    for name, sun, low, high in (
        ("illuminance at sunset (true -0.83°)", -0.83, 410, 585),
        ("illuminance at -6°", -6.0, 2.0, 3.5),
        ("illuminance at -12°", -12.0, 0.008, 0.008),
    ):
        light = float(illuminance(table, sun)[0])
        yield at.between(name, light, float(f"{low / 3:.2g}"), high * 3, "lx")
    fading = illuminance(table, np.arange(4.0, -12.05, -0.1), nodes=6)
    fall = 100 * (1 - fading[1:] / fading[:-1])
    yield at.least("fall in a tenth of a degree, least", fall.min(), 0, "%")
    yield at.most("fall in a tenth of a degree, most", fall.max(), 15, "%")
    blue = _At(7, "ozone makes the blue hour blue: Hulburt 1953; the bounds are ours")
    with_ozone, at_sunset = zenith_x(AIR, -6.0), zenith_x(AIR, 2.0)
    yield blue.most("zenith x at -6° less x at +2°", with_ozone - at_sunset, 0)
    yield blue.least("zenith x at -6° without ozone", zenith_x(AIR.replace(ozone=0), -6.0), 0.29)


# Sun's elevation: x, y.
SUN_CHROMATICITY = {
    60: (0.3368, 0.3478),
    10: (0.3859, 0.3906),
    2: (0.5138, 0.4285),
    0: (0.6165, 0.3772),
}


def sun_chromaticity() -> Iterator[Row]:
    """Return the sun's chromaticity as it sets, with default haze and ozone."""
    at = _At(8, "regression anchors: our own spectra in steps of 5 nm")
    nm = np.arange(380, 781, 5.0)
    for elevation, expected in SUN_CHROMATICITY.items():
        beam = optics.direct_irradiance(AIR, elevation, nm)
        error = np.abs(chromaticity(spectrum_to_xyz(nm, beam)) - expected).max()
        yield at.most(f"sun's x, y at {elevation}°, deviation", error, 0.0015)


def rows(
    folder: Path | None = None,
    data: measurements.Measurements | None = None,
    paths: int = 600,
    progress: Callable[[Row], Any] | None = None,
) -> list[Row]:
    """Return all rows except those of the hosts (9), which ``bench/validate.py`` adds.

    Parameters
    ----------
    folder : path, optional
        With ``kider2014_clear_sky_models_40bins.csv`` and ``csm_model_outputs/``.
    data : Measurements, optional
        Default: ``measurements.load()``, if available.
    paths : int, default 600
        Paths for each direction and wavelength of row 6; 600 take half a minute of CPU time.
    progress : callable, optional
        Called with each row.
    """
    found = []
    for part in (
        closed_forms(),
        direct_beam(),
        measured_radiance(data),
        other_models(folder),
        another_day(),
        path_tracing(paths),
        twilight(),
        sun_chromaticity(),
    ):
        for row in part:
            found.append(row)
            if progress:
                progress(row)
    return found


def _rms(error: ArrayLike) -> float:
    return float(np.sqrt(np.mean(np.square(error))))


def _quadratic_mean(values: list[float]) -> float:
    return _rms(np.array(values))
