"""Measured skies: reading, fetching, cleaning; on made-up files, and on the real ones if there."""

import datetime as dt
import hashlib
import http.server
import sys
import threading

import measured_skies as made_up
import numpy as np
import pytest

from sunwidget.atmosphere.constants import WAVELENGTHS
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.validation import measured_skies, measurements
from sunwidget.validation.download import (
    BASE_URL,
    CHECKSUMS,
    default_path,
    download,
    read_raw_scans,
)
from sunwidget.validation.measured_skies import azimuth_of_symmetry
from sunwidget.validation.measurements import MeasurementsError, load

SCANS = {"2013-05-27___09.30.00": 90.0, "2013-05-27___13.30.00": 181.7}


@pytest.fixture(autouse=True)
def empty_cache(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("SUNWIDGET_MEASUREMENTS", raising=False)


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    """Two archives as published, and their checksums."""
    folder = tmp_path_factory.mktemp("published")
    for name, azimuth in SCANS.items():
        files = made_up.scan_files(name, made_up.sky(azimuth))
        (folder / f"{name}.7z").write_bytes(made_up.archive(files))
    sums = {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())}
    return folder, sums


@pytest.fixture(scope="module")
def address(published):
    """The archives behind a web server of this machine."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *args, **kwargs):
            super().__init__(*args, directory=str(published[0]), **kwargs)

        def log_message(self, *args):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Quiet)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


def test_a_damaged_archive_is_named(published):
    name = next(iter(published[1]))
    data = (published[0] / name).read_bytes()
    middle = len(data) // 2
    broken = data[:middle] + bytes([data[middle] ^ 0x10]) + data[middle + 1 :]
    for damaged in (broken, data[:-1], data[:20], b""):
        with pytest.raises(MeasurementsError, match=f"{name} is not a 7z archive or is damaged"):
            read_raw_scans({name: damaged})


def test_without_py7zr_the_error_names_the_extra(published, monkeypatch):
    monkeypatch.setitem(sys.modules, "py7zr", None)
    with pytest.raises(MeasurementsError, match=r"sunwidget\[measurements\]"):
        read_raw_scans({"a.7z": b""})


def test_archives_are_fetched_checked_and_kept(published, address):
    seen = []
    path = download(base_url=address, checksums=published[1], progress=lambda f, m: seen.append(f))
    assert path == default_path()
    assert seen == sorted(seen)
    assert seen[-1] == 1
    data = load()
    assert len(data) == 2
    assert data.times[0] == dt.datetime.fromisoformat("2013-05-27T09:30-04:00")
    # The same as from the archives themselves, which somebody may have fetched otherwise.
    raw = load(published[0])
    assert np.array_equal(raw.radiance, data.radiance)
    assert raw.radiance[1, 5] == pytest.approx(made_up.sky(181.7)[5], rel=1e-6)


def test_a_folder_on_the_disk_serves_as_well(published, tmp_path):
    path = download(tmp_path / "skies.npz", base_url=published[0].as_uri(), checksums=published[1])
    assert len(load(path)) == len(load(tmp_path / "skies.npz")) == 2


def test_a_file_that_is_not_the_published_one_is_refused_and_nothing_kept(published, address):
    wrong = dict.fromkeys(published[1], "0" * 64)
    with pytest.raises(MeasurementsError, match="not the published file"):
        download(base_url=address, checksums=wrong)
    assert not default_path().exists()
    assert not measurements.is_available()


def test_a_file_that_cannot_be_fetched_is_named(address):
    with pytest.raises(MeasurementsError, match=r"none\.7z cannot be fetched"):
        download(base_url=address, checksums={"none.7z": "0"})
    with pytest.raises(MeasurementsError, match="is not an https, http or file address"):
        download(base_url="ftp://x", checksums={"none.7z": "0"})


def test_cancelling_leaves_nothing_behind(published, address):
    def cancel(_fraction, _message):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        download(base_url=address, checksums=published[1], progress=cancel)
    assert not list(default_path().parent.glob("*")) if default_path().parent.exists() else True


def test_without_data_the_error_says_how_to_get_them(tmp_path):
    for path in (None, tmp_path, tmp_path / "none.npz"):
        with pytest.raises(
            MeasurementsError, match=r"Call sunwidget\.validation\.measurements\.download\(\)"
        ):
            load(path)
    (tmp_path / "bad.npz").write_bytes(b"no array")
    with pytest.raises(MeasurementsError, match="has no measured skies"):
        load(tmp_path / "bad.npz")


def test_only_the_pinned_commit_is_asked_and_every_archive_has_a_checksum():
    assert BASE_URL.startswith("https://raw.githubusercontent.com/spectralskylight/")
    assert len(BASE_URL.split("/")[5]) == 40
    assert len(CHECKSUMS) == len(set(CHECKSUMS.values())) == 15
    assert all(len(bytes.fromhex(value)) == 32 for value in CHECKSUMS.values())


def test_the_known_elevations_are_those_of_the_ephemeris():
    pytest.importorskip("pvlib")
    from sunwidget.geometry.solar import solar_position

    assert len(measured_skies._SUN_ELEVATION) == len(CHECKSUMS)
    for time, elevation in measured_skies._SUN_ELEVATION.items():
        place = measured_skies.LATITUDE, measured_skies.LONGITUDE
        sun = solar_position(f"{time.replace(' ', 'T')}-04:00", *place)
        # Rounded to four digits.
        assert elevation == pytest.approx(sun.true_elevation, abs=6e-5)


@pytest.mark.parametrize("azimuth", [3.0, 91.5, 180.0, 269.3])
def test_the_sun_lies_in_the_plane_of_symmetry(azimuth):
    _, turned, elevation = made_up.directions().T
    found = azimuth_of_symmetry(made_up.sky(azimuth)[:, 100], elevation, -turned % 360)
    # One per cent of noise moves the plane by a few tenths of a degree.
    assert found == pytest.approx(azimuth, abs=0.5)


def test_the_spoilt_sample_in_the_north_is_mended(published):
    data = load(published[0])
    ring = np.flatnonzero(np.isclose(data.elevation, 12.1151))
    north = ring[data.azimuth[ring] == 0]
    beside = ring[np.isin(data.azimuth[ring], (11.25, 348.75))]
    assert data.radiance[:, north[0]] == pytest.approx(data.radiance[:, beside].mean(axis=1))


def test_a_scan_travels_to_the_browser(published):
    data = load(published[0])
    scan = data.scan_json(0)
    assert np.shape(scan["directions"]) == (81, 2)
    assert np.shape(scan["radiance"]) == (81, 4)
    assert np.shape(scan["rgb"]) == (81, 3)
    assert scan["sun_azimuth"] == pytest.approx(90, abs=0.5)
    near = data.at(WAVELENGTHS)[0]
    assert np.array(scan["radiance"]) == pytest.approx(near, rel=1e-3)
    assert [row["index"] for row in data.scans_json()] == [0, 1]


def test_a_comparison_knows_level_pattern_and_error(published):
    data = load(published[0])
    made = measurements.compare(("multiple",), data=data)[0]
    doubled = measured_skies.Measurements(**{**vars(data), "radiance": 2 * data.radiance})
    half = measurements.compare(("multiple",), data=doubled)[0]
    assert half.level == pytest.approx(made.level / 2)
    assert half.pattern == pytest.approx(made.pattern)
    # Another model that says exactly what "multiple" says has its figures.
    table = SkyTable(measurements.AIR_OF_THE_DAY)
    same = measurements.compare(("twin",), data=data, others={"twin": table.radiance})[0]
    assert same[1:] == pytest.approx(made[1:])


def test_unknown_models_and_scans_are_refused(published):
    data = load(published[0])
    with pytest.raises(ValueError, match="no model 'hosek'"):
        measurements.compare(("hosek",), data=data)
    with pytest.raises(ValueError, match="from 0 to 1"):
        measurements.compare(data=data, scan=2)
