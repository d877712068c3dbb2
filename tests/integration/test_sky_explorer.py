"""SkyExplorer without a browser: table, traits, sun, code, requests."""

import base64
import io
import json
import sys
import threading

import numpy as np
import pytest
from PIL import Image
from traitlets import TraitError

import sunwidget as sw
from sunwidget.atmosphere.parameters import RANGES, Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.edit.table import PARAMETERS
from sunwidget.errors import EditError
from sunwidget.explorer.table import EXPLORER_PARAMETERS, GRIDS, MODELS, checked, parameter
from sunwidget.explorer.values import effective_values
from sunwidget.validation import measurements
from sunwidget.widgets.explorer.sky_explorer import SkyExplorer
from sunwidget.widgets.kernel.requests import Requests

ITHACA = {"latitude": 42.443449, "longitude": -76.481962, "date": "2013-05-27"}


@pytest.fixture
def explorer():
    return SkyExplorer()


@pytest.fixture(autouse=True)
def nothing_measured(monkeypatch, tmp_path):
    """Whatever this machine keeps, the tests see an empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("SUNWIDGET_MEASUREMENTS", raising=False)


@pytest.fixture
def sent(explorer, monkeypatch):
    messages = []
    monkeypatch.setattr(
        explorer, "send", lambda content, buffers=None: messages.append((content, buffers))
    )
    return messages


def defaults(**changes):
    return {p.name: p.default for p in EXPLORER_PARAMETERS} | changes


def answer(explorer, sent, action, **content):
    request = {"type": "request", "id": "r", "action": action, **content}
    Requests(explorer.send, explorer._actions())._answer(request)
    response, buffers = sent[-1]
    assert response["id"] == "r"
    return response, buffers


def test_sun_and_air_are_the_edits_own_rows_with_the_default_air():
    edit = {p.name: p for p in PARAMETERS}
    for name in RANGES:
        row = parameter(name)
        assert (row.minimum, row.maximum, row.label) == (
            edit[name].minimum,
            edit[name].maximum,
            edit[name].label,
        )
        assert row.default == getattr(Atmosphere(), name)


@pytest.mark.parametrize("row", EXPLORER_PARAMETERS, ids=lambda row: row.name)
def test_every_row_has_a_usable_default_and_refuses_nonsense(row):
    assert checked(row, row.default) == row.default
    assert row.help.endswith(".")
    for bad in ("nonsense", float("nan"), [1], 1e9):
        with pytest.raises(EditError, match=row.name):
            checked(row, bad)


def test_values_are_numbers_a_choices_index_and_a_switchs_0_or_1():
    values = effective_values(defaults(model="reference", grid=GRIDS[2], show_single=False))
    assert set(values) == {"edit", "single"}
    edit = values["edit"]
    assert all(isinstance(value, float) for value in edit.values())
    assert edit["model"] == MODELS.index("reference")
    assert edit["grid"] == 2
    assert (edit["show_single"], edit["show_multiple"]) == (0, 1)
    assert not {"date", "time", "latitude", "longitude", "scan"} & set(edit)


@pytest.mark.parametrize(
    ("switch", "name"),
    [
        ("show_rayleigh", "air_density"),
        ("show_aerosol", "aerosol_optical_depth"),
        ("show_ozone", "ozone"),
    ],
)
def test_a_switch_takes_its_part_out_of_the_air(explorer, switch, name):
    before = explorer.values()["edit"]
    setattr(explorer, switch, False)
    after = explorer.values()["edit"]
    assert after == before | {switch: 0.0, name: 0.0}
    assert getattr(explorer.atmosphere, name) == 0
    # The slider stays where it was.
    assert getattr(explorer, name) == before[name] > 0


def test_the_single_state_is_the_edit_with_one_order():
    values = effective_values(defaults(scattering_orders=4.0))
    assert values["single"] == values["edit"] | {"scattering_orders": 1.0}
    alone = effective_values(defaults(model="single"))
    assert alone["edit"]["scattering_orders"] == 1
    # Beside another model, the state "edit" is that model's.
    beside = effective_values(defaults(model="single", compare="multiple"))
    assert beside["edit"]["scattering_orders"] == 0


def test_every_row_is_a_synced_trait(explorer):
    for row in EXPLORER_PARAMETERS:
        assert getattr(explorer, row.name) == row.default
        assert explorer.trait_metadata(row.name, "sync")


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("sun_elevation", 300, "outside -12 to 90"),
        ("sun_elevation", None, "must be a number"),
        ("show_ozone", "no", "True or False"),
        ("show_ozone", 0.5, "True or False"),
        ("model", "hosek", "must be one of multiple, single"),
        ("date", "27 May", "YYYY-MM-DD"),
        ("latitude", 91, "outside -90 to 90"),
        ("scan", 0, r"measurements\.download\(\)"),
        ("scan", 1.5, "index"),
        ("turbidity", 50, "turbidity = 50"),
        ("visibility", 10, "visibility = 10"),
        ("visibility", 1e9, "visibility"),
    ],
)
def test_a_refused_value_says_why_and_changes_nothing(explorer, name, value, says):
    before = explorer.parameters()
    with pytest.raises(TraitError, match=says):
        setattr(explorer, name, value)
    assert explorer.parameters() == before


def test_an_unknown_keyword_gets_the_nearest_spelling():
    with pytest.raises(TypeError, match="Did you mean 'sun_elevation'"):
        SkyExplorer(sun_elevaton=3)
    with pytest.raises(TypeError, match="Did you mean 'turbidity'"):
        SkyExplorer(turbidty=3)


def test_turbidity_and_visibility_are_names_of_the_haze(explorer):
    for name, value in (("turbidity", 3.0), ("visibility", 20_000.0)):
        by_keyword = SkyExplorer(**{name: value})
        setattr(explorer, name, value)
        assert getattr(explorer, name) == pytest.approx(value)
        assert getattr(explorer.atmosphere, name) == pytest.approx(value)
        assert by_keyword.aerosol_optical_depth == explorer.aerosol_optical_depth
    with pytest.raises(TypeError, match="three names of one quantity"):
        SkyExplorer(turbidity=2, visibility=9000)


def test_the_browser_can_compute_turbidity_and_visibility_itself(explorer):
    """The formulas of js/src/explorer/haze.js, with what the kernel sends."""
    explorer.preset("polluted")
    explorer.air_density, explorer.rayleigh_scale_height = 1.3, 7000
    clean, air = explorer._aliases, explorer.atmosphere

    def column(height):
        top = np.exp(-clean["mesosphere_altitude"] / height)
        return height * (1 - (1 - clean["mesosphere_share"]) * top)

    molecules = clean["air_extinction_550"] * air.air_density
    depth = molecules * column(air.rayleigh_scale_height)
    assert explorer.turbidity == pytest.approx(1 + air.aerosol_optical_depth / depth)
    haze = air.aerosol_optical_depth / air.aerosol_scale_height
    assert explorer.visibility == pytest.approx(clean["koschmieder"] / (molecules + haze))


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_sets_the_air_and_nothing_else(explorer, name):
    explorer.sun_elevation = 3
    explorer.preset(name)
    assert explorer.atmosphere.parameters() == PRESETS[name].parameters()
    assert explorer._presets[name] == PRESETS[name].parameters()
    assert explorer.sun_elevation == 3


def test_an_unknown_preset_is_answered_with_the_names(explorer):
    with pytest.raises(ValueError, match="clear, hazy"):
        explorer.preset("foggy")


def test_an_atmosphere_can_be_given_and_taken(explorer):
    air = Atmosphere(aerosol_optical_depth=0.2, ozone=100)
    assert SkyExplorer(atmosphere=air, ozone=50).atmosphere == air.replace(ozone=50)
    explorer.atmosphere = air
    assert explorer.atmosphere == air


def test_a_place_and_a_day_give_the_suns_path(explorer):
    assert explorer._day == []
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    assert np.shape(explorer._day) == (289, 4)
    json.dumps(explorer._day)
    explorer.latitude = None
    assert explorer._day == []


def test_without_pvlib_the_extra_is_named_and_no_old_path_stays(explorer, sent, monkeypatch):
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    monkeypatch.setitem(sys.modules, "pvlib", None)
    with pytest.raises(ImportError, match=r"sunwidget\[solar\]"):
        explorer.latitude = 10
    assert explorer._day == []
    explorer.set_state({"latitude": 11.0})
    assert "sunwidget[solar]" in sent[-1][0]["error"]


def test_time_moves_the_sun_along_the_path(explorer):
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    explorer.time = 13.5  # 9:30 of the first measured scan
    # measurements: zenith distance 48.94° true; 0.02° of refraction.
    assert explorer.sun_elevation == pytest.approx(90 - 48.94 + 0.02, abs=0.02)
    assert explorer.sun_azimuth == pytest.approx(98.15, abs=0.02)
    explorer.time = 4.9  # midnight, the azimuth through north, far below the table
    assert explorer.sun_elevation == -12
    assert abs(explorer.sun_azimuth) < 5
    explorer.longitude = 100
    assert explorer.sun_elevation > 50


def test_moving_the_sun_by_hand_leaves_its_path(explorer):
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    explorer.time = 13.5
    explorer.sun_elevation = 10
    assert explorer.time is None
    assert explorer.sun_elevation == 10


def test_the_browsers_sun_is_not_moved_again(explorer):
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    explorer.set_state({"time": 13.5, "sun_elevation": 41.0, "sun_azimuth": 98.0})
    assert (explorer.time, explorer.sun_elevation, explorer.sun_azimuth) == (13.5, 41, 98)
    # A place that the browser sets needs the kernel's path, and the sun follows it.
    explorer.set_state({"longitude": 100.0})
    assert explorer.sun_elevation < 10


def test_a_value_that_is_refused_from_the_browser_is_answered(explorer, sent, monkeypatch):
    monkeypatch.setattr(explorer, "send_state", lambda key=None: sent.append((key, None)))
    explorer.set_state({"sun_elevation": 300})
    assert explorer.sun_elevation == 20
    assert "outside" in sent[0][0]["error"]
    assert sent[1][0] == ["sun_elevation"]


def test_handlers_run_on_any_thread(explorer):
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    state = {"time": 13.5, "sun_elevation": 41.0, "sun_azimuth": 98.0}
    thread = threading.Thread(target=explorer.set_state, args=(state,))
    thread.start()
    thread.join()
    assert explorer.time == 13.5


@pytest.mark.parametrize(
    "parameters",
    [
        {},
        {"sun_elevation": 2.5, "model": "single", "compare": "reference", "show_ozone": False},
        {"turbidity": 3, "projection": "camera", "fov": 80, "exposure": -1.5},
        {**ITHACA, "time": 10.123},
        {**ITHACA, "sun_elevation": 20.0, "view_azimuth": -90},
        {**ITHACA, "time": 10.123, "sun_elevation": 20.0},
    ],
)
def test_code_runs_and_gives_the_same_explorer(parameters):
    explorer = SkyExplorer(**parameters)
    again = eval(explorer.code(), {"sw": sw})
    assert isinstance(again, sw.SkyExplorer)
    assert again.parameters() == explorer.parameters()
    assert again.values() == explorer.values()
    if not parameters:
        assert explorer.code() == "sw.SkyExplorer()"


def test_the_table_travels_as_json(explorer):
    rows = json.loads(json.dumps(explorer._parameters))
    assert [row["name"] for row in rows] == [p.name for p in EXPLORER_PARAMETERS]
    assert {row["kind"] for row in rows} == {"number", "choice", "switch", "data"}
    json.dumps(explorer.get_state(["_aliases", "_presets", "_scans"]))


def test_the_browser_gets_code(explorer, sent):
    explorer.ozone = 0
    response, _ = answer(explorer, sent, "code")
    assert response["result"] == {"code": "sw.SkyExplorer(ozone=0.0)"}


def test_without_measured_skies_the_browser_reads_how_to_get_them(explorer, sent):
    assert explorer._scans == []
    response, _ = answer(explorer, sent, "rmse", scan=None)
    assert "measurements.download()" in response["error"]
    with pytest.raises(measurements.MeasurementsError, match=r"download\(\)"):
        explorer.compare_measured()


@pytest.fixture(scope="module")
def egl():
    from sunwidget.errors import RendererError
    from sunwidget.renderer.gl_thread import on_gl_thread

    try:
        on_gl_thread(lambda context: context.info)
    except RendererError as error:
        pytest.skip(str(error).splitlines()[0])


def test_the_picture_has_the_asked_size_and_follows_the_sun(explorer, egl):
    east = SkyExplorer(projection="panorama", sun_azimuth=90).render(size=(180, 50))
    west = SkyExplorer(projection="panorama", sun_azimuth=-90).render(size=(180, 50))
    assert east.shape == (50, 180, 3)
    assert east.dtype == np.uint8
    assert np.ptp(east) > 100
    # To the right of north is east.
    assert east[:, 90:].mean() > 1.1 * east[:, :90].mean()
    # The mirror image, but for the dither and a fraction of a pixel.
    assert np.abs(west[:, ::-1].astype(int) - east).mean() < 1.5


@pytest.mark.parametrize("switch", ["show_rayleigh", "show_ozone", "show_aerosol"])
def test_the_picture_shows_what_a_switch_takes_away(explorer, egl, switch):
    explorer.sun_elevation = 2
    before = explorer.render(size=(64, 48)).astype(int)
    setattr(explorer, switch, False)
    assert np.abs(explorer.render(size=(64, 48)) - before).mean() > 1


def test_a_curve_is_drawn_for_the_present_state(explorer, egl):
    clear = explorer.curve("transmittance")
    explorer.turbidity = 4
    hazy = explorer.curve("transmittance")
    assert clear.shape == (64, 4)
    assert np.all(hazy[:, 2] < clear[:, 2])
    assert np.array_equal(hazy[:, 1], clear[:, 1])
    with pytest.raises(EditError, match="no curve"):
        explorer.curve("moon")


def test_an_explorer_prints_as_the_call_that_makes_it():
    assert repr(SkyExplorer(ozone=0)) == "<SkyExplorer(ozone=0.0)>"


def test_viewers_without_widgets_get_a_picture(explorer, egl):
    bundle, _ = explorer._repr_mimebundle_()
    with Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))) as picture:
        assert picture.size == (480, 320)
        assert np.ptp(np.asarray(picture)) > 100


def test_without_egl_the_widget_is_shown_all_the_same(explorer, monkeypatch):
    from sunwidget.errors import RendererError
    from sunwidget.explorer import draw

    def no_context(*_args, **_kwargs):
        raise RendererError("no EGL")

    monkeypatch.setattr(draw, "draw", no_context)
    bundle, _ = explorer._repr_mimebundle_()
    assert "image/png" not in bundle
    assert "application/vnd.jupyter.widget-view+json" in bundle


def test_the_browser_gets_a_snapshot(explorer, sent, egl):
    response, buffers = answer(explorer, sent, "snapshot", size=[120, 80])
    assert response["result"]["type"] == "image/png"
    assert Image.open(io.BytesIO(buffers[0])).size == (120, 80)


@pytest.fixture(scope="module")
def two_scans(tmp_path_factory):
    """A folder of two made-up scans, as Kider et al. publish theirs."""
    from measured_skies import archive, scan_files, sky

    folder = tmp_path_factory.mktemp("scans")
    for name, azimuth in (("2013-05-27___09.30.00", 90.0), ("2013-05-27___13.30.00", 181.0)):
        data = archive(scan_files(name, sky(azimuth)))
        (folder / f"{name}.7z").write_bytes(data)
    return folder


@pytest.fixture
def measured(two_scans, monkeypatch):
    """The made-up scans where the widget looks for them."""
    monkeypatch.setenv("SUNWIDGET_MEASUREMENTS", str(two_scans))


def test_a_scan_brings_its_sun_and_its_directions(measured):
    explorer = SkyExplorer(scan=1)
    assert [row["index"] for row in explorer._scans] == [0, 1]
    assert explorer.sun_azimuth == pytest.approx(-179, abs=0.5)
    assert explorer.sun_elevation == pytest.approx(68.22, abs=0.01)
    assert len(explorer._measured["directions"]) == 81
    json.dumps(explorer._measured)
    assert eval(explorer.code(), {"sw": sw}).parameters() == explorer.parameters()
    assert "sun_elevation" not in explorer.code()
    # A hand moves the sun; the scan stays to be seen.
    explorer.sun_elevation = 7
    assert explorer.scan == 1
    assert eval(explorer.code(), {"sw": sw}).parameters() == explorer.parameters()
    # Time moves it too, and comes before the scan.
    explorer.set_place(ITHACA["latitude"], ITHACA["longitude"], ITHACA["date"])
    explorer.time = 15
    assert eval(explorer.code(), {"sw": sw}).parameters() == explorer.parameters()
    explorer.scan = 0
    assert explorer.time is None
    assert explorer.sun_azimuth == pytest.approx(90, abs=0.5)
    explorer.scan = None
    assert explorer._measured is None
    with pytest.raises(TraitError, match="scans 0 to 1"):
        explorer.scan = 2


def test_the_browser_gets_the_errors_against_the_measured_skies(measured, monkeypatch):
    explorer, messages = SkyExplorer(), []
    monkeypatch.setattr(
        explorer, "send", lambda content, buffers=None: messages.append((content, buffers))
    )
    response, _ = answer(explorer, messages, "rmse", scan=0, models=["single", "multiple"])
    assert response["error"] is None
    single, multiple = response["result"]["rows"]
    assert (single["model"], multiple["model"]) == ("single", "multiple")
    assert single["level"] < multiple["level"]
    assert single.keys() == {"model", "rmse", "level", "pattern"}


def test_without_egl_the_other_models_are_compared_all_the_same(measured, monkeypatch):
    from sunwidget.errors import RendererError
    from sunwidget.renderer.bruneton import precomputed_sky

    def no_context(*_args, **_kwargs):
        raise RendererError("no EGL")

    monkeypatch.setattr(precomputed_sky, "bruneton_table", no_context)
    explorer, messages = SkyExplorer(), []
    monkeypatch.setattr(
        explorer, "send", lambda content, buffers=None: messages.append((content, buffers))
    )
    response, _ = answer(explorer, messages, "rmse", scan=0)
    assert [row["model"] for row in response["result"]["rows"]] == [
        "multiple",
        "single",
        "reference",
    ]
    response, _ = answer(explorer, messages, "rmse", scan=0, models=["bruneton"])
    assert response["error"] == "no EGL"


def test_measured_skies_are_fetched_only_when_asked(explorer, sent, monkeypatch, measured):
    asked = []

    def download(*, progress):
        asked.append(progress)

    monkeypatch.setattr(measurements, "download", download)
    assert not asked
    response, _ = answer(explorer, sent, "download_measurements")
    assert len(asked) == 1
    assert [row["index"] for row in response["result"]["scans"]] == [0, 1]


def test_the_browser_gets_brunetons_table_and_what_it_will_cost(explorer, sent, egl, monkeypatch):
    from sunwidget.renderer.bruneton import precomputed_sky

    whole = precomputed_sky.bruneton_table

    def tiny(air, orders=0, progress=None):
        return whole(air, orders, "tiny", progress)

    monkeypatch.setattr(precomputed_sky, "bruneton_table", tiny)
    response, _ = answer(explorer, sent, "bruneton_cost", parameters={"ozone": 100})
    assert response["result"]["cached"] is False
    assert response["result"]["seconds"] > 0.1
    response, buffers = answer(
        explorer, sent, "bruneton", parameters={"ozone": 100, "scattering_orders": 2}
    )
    result = response["result"]
    texture = np.frombuffer(buffers[0], np.float32).reshape(result["rows"], result["cols"], 4)
    expected = tiny(Atmosphere(ozone=100), 2).slice()
    # The second comes from the disk, where a table is kept as 16-bit logarithms (0.034 %).
    assert texture == pytest.approx(expected, rel=4e-4)
    assert any(message["type"] == "progress" for message, _ in sent)
    response, _ = answer(explorer, sent, "bruneton", parameters={"ozone": 9999})
    assert "ozone = 9999 is outside" in response["error"]
