"""Made-up skies in the files that Kider et al. publish: archives of spectra, 81 directions each."""

import io

import numpy as np
import py7zr

# Elevations and numbers of azimuths of the instrument's rings.
RINGS = ((12.1151, 32), (33.749, 24), (53.3665, 16), (71.9187, 8), (90.0, 1))


def directions():
    """Index, azimuth counter-clockwise from north, elevation."""
    rows = [(360 * i / n, e) for e, n in RINGS for i in range(n)]
    return np.array([(i, a, e) for i, (a, e) in enumerate(rows)])


def sky(sun_azimuth, sun_elevation=40.0, seed=0):
    """Radiance (81, 651) of a sky that is symmetric about the sun, a little noisy."""
    _, azimuth, elevation = directions().T
    a, e, s = np.radians([-azimuth - sun_azimuth, elevation, np.full(81, sun_elevation)])
    nu = np.sin(e) * np.sin(s) + np.cos(e) * np.cos(s) * np.cos(a)
    shape = (1 + nu**2 + np.exp(4 * (nu - 1))) / np.sin(e)
    noise = 1 + 0.01 * np.random.default_rng(seed).standard_normal(81)
    return (shape * noise)[:, None] * 0.05 * (np.arange(350, 1001) / 450) ** -3.0


def archive(files):
    """A 7z archive of files by name."""
    data = io.BytesIO()
    with py7zr.SevenZipFile(data, "w") as opened:
        for name, content in files.items():
            opened.writestr(content, name)
    return data.getvalue()


def scan_files(name, radiance):
    """The text files of one scan, with raw counts beside each as some archives have them."""
    files = {}
    for (index, azimuth, elevation), spectrum in zip(directions(), radiance, strict=True):
        stem = f"{name}/{name}_-_{index:.0f}____{azimuth}___{elevation}.asd"
        lines = [
            f"{nm}\t {value:.9E} " for nm, value in zip(range(350, 1001), spectrum, strict=True)
        ]
        files[f"{stem}.rad.txt"] = "\n".join(["Wavelength\tname", *lines, "1001\t 0.1 "]).encode()
        files[f"{stem}.txt"] = b"counts"
    return files
