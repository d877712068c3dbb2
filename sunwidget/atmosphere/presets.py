"""Atmospheres by name, each from published numbers.

Aerosol types are those of OPAC (Hess, Koepke & Schult, "Optical Properties of Aerosols and
Clouds: The Software Package OPAC", Bull. Am. Meteorol. Soc. 79 (1998), table 4: 550 nm, 80 %
relative humidity). OPAC gives the mean cosine of the phase function; ``aerosol_asymmetry`` is the
Cornette–Shanks parameter of that mean cosine. Its Ångström exponents are 1.1 below and 1.4 above
500 nm for all three continental types; 1.3 replaces both.

Mars is missing: its radius differs, and its dust absorbs blue and scatters red, which an albedo
that is equal at all wavelengths cannot describe.
"""

from __future__ import annotations

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient

PRESETS: dict[str, Atmosphere] = {
    # OPAC "continental clean": optical depth 0.064, albedo 0.972, mean cosine 0.709.
    "clear": Atmosphere(
        aerosol_optical_depth=0.064,
        angstrom_exponent=1.3,
        aerosol_asymmetry=0.65,
        aerosol_albedo=0.97,
    ),
    # OPAC "continental average", 0.925 and 0.703, at twice its depth of 0.151: a hazy summer's day.
    "hazy": Atmosphere(
        aerosol_optical_depth=0.3,
        angstrom_exponent=1.3,
        aerosol_asymmetry=0.64,
        aerosol_albedo=0.93,
    ),
    # OPAC "urban", 0.817 and 0.689: soot absorbs. Its depth of 0.643, cut at the slider's end.
    "polluted": Atmosphere(
        aerosol_optical_depth=0.6,
        angstrom_exponent=1.3,
        aerosol_asymmetry=0.63,
        aerosol_albedo=0.82,
    ),
    # Mauna Loa's height. Of the 0.1 at sea level, 0.018 lie above it, the background that sun
    # photometers see there (about 0.02 at 500 nm; Holben et al., "An emerging ground-based aerosol
    # climatology", J. Geophys. Res. 106, 2001).
    "high_mountain": Atmosphere(
        aerosol_optical_depth=0.1,
        angstrom_exponent=1.3,
        aerosol_asymmetry=0.65,
        aerosol_albedo=0.97,
        aerosol_scale_height=2_000.0,
        ground_albedo=0.2,
        altitude=3_400.0,
    ),
    # Türe (METU 2017), eq. 2.1, after Bruneton & Neyret, "Precomputed Atmospheric Scattering"
    # (2008): 5.8, 13.5 and 33.1e-6 per metre at 680, 550 and 440 nm, 8 km, no ozone. The thesis
    # does not print the aerosol; this one is from Bruneton's code: scattering 4e-6 per metre, nine
    # tenths of the extinction, g 0.8, 1.2 km.
    "thesis": Atmosphere(
        aerosol_optical_depth=4e-6 / 0.9 * 1_200.0,
        angstrom_exponent=0.0,
        aerosol_asymmetry=0.8,
        aerosol_albedo=0.9,
        aerosol_scale_height=1_200.0,
        ozone=0.0,
        air_density=13.5e-6 / float(rayleigh_coefficient(550.0)),
        rayleigh_exponent=4.0,
        rayleigh_scale_height=8_000.0,
    ),
}
"""Atmospheres to start from: clear, hazy, polluted, high_mountain and thesis."""
