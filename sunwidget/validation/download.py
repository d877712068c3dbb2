"""Download of the measured skies from their authors' repository, and reading of the raw files.

Only a call of ``download`` accesses the network. The checksum of every archive is verified before
it is opened.
"""

from __future__ import annotations

import hashlib
import io
import re
import urllib.error
import urllib.request
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.cache import cache_folder
from sunwidget.files import complete_or_absent
from sunwidget.progress import Progress

Array = NDArray[np.float64]
Raw = tuple[Array, Array, dict[str, NDArray[np.float32]]]

FILE_NAME = "kider2014-2013-05-27.npz"
COMMIT = "f915674fc632593b03edd3068d09902924449bd9"
BASE_URL = (
    "https://raw.githubusercontent.com/spectralskylight/sky-measurements-2014/"
    f"{COMMIT}/data/2013-05-27/RADIANCE/"
)
# fmt: off
CHECKSUMS: dict[str, str] = {
    "2013-05-27___09.30.00.7z":
        "7d14e0e1667a33e956031f1b77eca97938272e7b42c4c15dcdc99aaad53bdd3a",
    "2013-05-27___09.45.00.7z":
        "e950564cd015a48beedc08438ea7322aad3ce37c55f5f2c62373fd0c8962f510",
    "2013-05-27___10.00.00.7z":
        "67f6795db4aeb47929ae4f681efbf9ca041733581a153c1f73bfe9a1e03040c8",
    "2013-05-27___10.15.00.7z":
        "f05f4800981157af91aa9a7f285353a09516e726803bb0297c955bb35a759d27",
    "2013-05-27___10.30.00.7z":
        "d91ab7c575984fba2c571dacfd891f857c8e57b6a62f2828165b09fac6ece894",
    "2013-05-27___10.45.00.7z":
        "ba1c87ca833ce7308f1b32c5174c29efa0b61e3fe08daae4d226604424aafba8",
    "2013-05-27___11.00.00.7z":
        "4045cb93fd1d6595ba8de720f54669b73e456b936b89c51ca2be1a261a628088",
    "2013-05-27___11.15.00.7z":
        "b35bab9e28d08695a313915d3a853d221f60ed90b54e19cbd794c03251673337",
    "2013-05-27___11.30.00.7z":
        "9fe37d2a262753f24d6cd133db779a7e0f8d6b694a5ec030c447dff37aad1fdb",
    "2013-05-27___11.45.00.7z":
        "14a43c74a8a4c33f91030d9726d8ab298055daa9bbe4fd37c02e49bb0513455f",
    "2013-05-27___12.00.00.7z":
        "05ccb29ca34a054cf8018c71cd05a3440e74d2f9620c929987a75642a0bcf378",
    "2013-05-27___12.15.00.7z":
        "3a9e26a5d366c978dca1f94924679b0e3c0101de553d147ce60c7b8647a97543",
    "2013-05-27___12.30.00.7z":
        "627489da4f4941956186f4d3e10f3defbe41408a310f0fe7b312bf5473caa665",
    "2013-05-27___12.45.00.7z":
        "8172248a39f87a6f12c137ac1c0d154575aa58706a303b31ab2d0ca0c0ac4539",
    "2013-05-27___13.30.00.7z":
        "2869ab8abfc2e85aedda095e10f0db24b901b747e1cd13d9e6dea716c72b4cde",
}
"""SHA-256 of the archives at that commit; 13:00 and 13:15 are unpublished."""
# fmt: on

_LARGEST = 64_000_000  # bytes of one archive; the published ones have 1.4-2.3 MB
_LARGEST_MEMBER = 4_000_000  # bytes of one file in it; the published ones have 50 kB
_WAVELENGTHS = np.arange(350.0, 1001.0)  # kept part of 350-2500 nm
_TIMEOUT_S = 60
# "2013-05-27___09.30.00_-_12____135.0___12.1151.asd.rad.txt": scan, index, azimuth counter-
# clockwise, elevation. Files that end in ".asd.txt" hold raw counts.
_RADIANCE_NAME = re.compile(r"(?:.*/)?(.+)_-_(\d+)____([\d.]+)___([\d.]+)\.asd\.rad\.txt")


class MeasurementsError(RuntimeError):
    """Measured skies are missing or unreadable; the message gives the remedy."""


def default_path() -> Path:
    """Return the file in which ``download`` stores the measured skies."""
    return cache_folder() / FILE_NAME


def download(
    path: Path | str | None = None,
    *,
    base_url: str = BASE_URL,
    checksums: Mapping[str, str] = CHECKSUMS,
    progress: Progress | None = None,
) -> Path:
    """Download the measured skies of Kider et al. 2014 (21 MB) and store the used part (3 MB).

    Parameters
    ----------
    path : path, optional
        ``.npz`` to write. Default: in the user's cache folder, where ``load`` finds it.
    base_url : str
        Folder of the archives; ``file://`` works too.
    checksums : mapping
        SHA-256 by file name.
    progress : callable, optional
        ``progress(fraction, message)``; raise in it to cancel.

    Returns
    -------
    Path
        The file, which appears only when it is complete.

    Raises
    ------
    MeasurementsError
        When an archive cannot be fetched, differs from its checksum or cannot be read, and
        without py7zr.
    """
    _py7zr()  # fail before downloading 21 MB
    target = default_path() if path is None else Path(path)
    archives: dict[str, bytes] = {}
    for i, (name, checksum) in enumerate(checksums.items()):
        if progress:
            progress(0.95 * i / len(checksums), f"Fetching {name} …")
        archives[name] = _fetch(base_url.rstrip("/") + "/" + name)
        found = hashlib.sha256(archives[name]).hexdigest()
        if found != checksum:
            raise MeasurementsError(
                f"{name} from {base_url} is not the published file: its SHA-256 is {found}, "
                f"expected {checksum}. Nothing was stored."
            )
    if progress:
        progress(0.95, "Reading the scans …")
    nm, directions, scans = read_raw_scans(archives)
    _write(target, nm, directions, scans)
    if progress:
        progress(1.0, "")
    return target


def read_raw_scans(archives: Mapping[str, bytes]) -> Raw:
    """Return wavelengths, directions and raw scans of published archives.

    Parameters
    ----------
    archives : mapping
        Content of the ``.7z`` files by name.

    Returns
    -------
    wavelengths : ndarray, shape (651,)
        350-1000 nm.
    directions : ndarray, shape (81, 3)
        Index, azimuth in degrees counter-clockwise from north, elevation in degrees.
    scans : dict
        Radiance (81, 651) in W m⁻² sr⁻¹ nm⁻¹ by the scan's name, in order of time.

    Raises
    ------
    MeasurementsError
        For an archive that cannot be read, scans whose directions differ, or without py7zr.
    """
    scans: dict[str, NDArray[np.float32]] = {}
    directions: Array | None = None
    for name in sorted(archives):
        files = _unpack(name, archives[name])
        rows: dict[tuple[float, float, float], Array] = {}
        scan = ""
        for member, content in files.items():
            match = _RADIANCE_NAME.fullmatch(member)
            if match:
                scan = match[1]
                rows[float(match[2]), float(match[3]), float(match[4])] = _spectrum(member, content)
        order = np.array(sorted(rows), float)
        if directions is None:
            directions = order
        if not len(order) or not np.array_equal(order, directions):
            raise MeasurementsError(f"{name} does not have the same directions as the others.")
        scans[scan] = np.array([rows[key] for key in sorted(rows)], np.float32)
    if directions is None:
        raise MeasurementsError("There are no archives with measured skies.")
    return _WAVELENGTHS, directions, scans


def _py7zr() -> Any:
    try:
        import py7zr
        import py7zr.io
    except ImportError as error:
        raise MeasurementsError(
            "Reading the archives of measured skies needs py7zr: "
            "pip install 'sunwidget[measurements]'"
        ) from error
    return py7zr


def _unpack(name: str, archive: bytes) -> dict[str, bytes]:
    """Return the files of a 7z archive by their names."""
    py7zr = _py7zr()
    files = py7zr.io.BytesIOFactory(_LARGEST_MEMBER)
    try:
        with py7zr.SevenZipFile(io.BytesIO(archive)) as opened:
            opened.extractall(factory=files)
    except Exception as error:  # damaged archives raise many kinds of errors
        raise MeasurementsError(f"{name} is not a 7z archive or is damaged ({error}).") from error
    return {member: content.read() for member, content in files.products.items()}


def _spectrum(name: str, content: bytes) -> Array:
    """Read two columns, nanometers and radiance, below a header line."""
    try:
        lines = content.decode("ascii").splitlines()[1:]
        table = np.array([line.split() for line in lines if line.strip()], float)
        first = int(np.flatnonzero(table[:, 0] == _WAVELENGTHS[0])[0])
        table = table[first : first + len(_WAVELENGTHS)]
        if np.array_equal(table[:, 0], _WAVELENGTHS) and np.isfinite(table).all():
            return table[:, 1]
    except (ValueError, IndexError):
        pass
    raise MeasurementsError(f"{name!r:.120} is not a spectrum of 350 to 1000 nm by 1 nm.")


def _fetch(url: str) -> bytes:
    if not url.startswith(("https://", "http://", "file://")):
        raise MeasurementsError(f"{url!r:.120} is not an https, http or file address.")
    try:
        with urllib.request.urlopen(url, timeout=_TIMEOUT_S) as answer:  # noqa: S310 - checked above
            data: bytes = answer.read(_LARGEST + 1)
    except (urllib.error.URLError, OSError) as error:
        raise MeasurementsError(
            f"{url} cannot be fetched ({error}). Check the network connection, or download the "
            "archives in another way and call measurements.load(folder)."
        ) from error
    if len(data) > _LARGEST:
        raise MeasurementsError(f"{url} is larger than any of the published archives.")
    return data


def _write(
    target: Path, nm: Array, directions: Array, scans: Mapping[str, NDArray[np.float32]]
) -> None:
    """Write the ``.npz``; readers never see an incomplete file."""
    target.parent.mkdir(parents=True, exist_ok=True)
    arrays = {f"scan_{name}": values for name, values in scans.items()}
    with complete_or_absent(target, overwrite=True) as unfinished:
        np.savez(unfinished, wavelength_nm=nm, dirs=directions, **arrays)  # type: ignore[arg-type]
