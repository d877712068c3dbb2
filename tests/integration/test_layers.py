"""Layers of a picture: laid over each other they are the picture, in every format."""

from types import SimpleNamespace

import numpy as np
import pytest
import tifffile

from sunwidget.analysis.hints import Hints
from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError
from sunwidget.export.layers import LAYERS, layers_of
from sunwidget.export.stills import save
from sunwidget.photo.photo import open_photo

UNMIXED = Hints(methods=(("clouds", "unmix"),))

HEIGHT, WIDTH = 60, 90


def drawn_scene(edit):
    """A blue sky with one cloud over dark hills: maps, the picture, and it without the cloud."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] / HEIGHT
    matte = np.clip((0.6 + 0.1 * np.sin(9 * x) - y) * 12, 0, 1)
    opacity = np.clip(1.2 - 8 * np.hypot(x - 0.5, y - 0.25), 0, 1)
    sky = np.stack([0.2 + 0.3 * y, 0.4 + 0.3 * y, 0.9 - 0.1 * y], -1)
    land = np.stack([0.2 * x, 0.1 + 0 * x, 0.05 + 0.2 * y], -1)
    clouded = sky + opacity[..., None] * (np.array([0.95, 0.9, 0.85]) - sky)
    over = matte[..., None]
    picture, clear = (np.float32(over * s + (1 - over) * land) for s in (clouded, sky))
    maps = {"sky": np.float32(matte), "clouds": np.float32(matte * opacity)}
    scene = SimpleNamespace(**maps, automatic={}, hints=UNMIXED)
    return scene, picture, clear


def composite(layers):
    """Plain "over" with straight alpha, from the bottom."""
    top = 1.0 if layers["sky"].dtype.kind == "f" else np.iinfo(layers["sky"].dtype).max
    out = layers["sky"] / top
    for name in ("clouds", "land"):
        alpha = layers[name][..., 3:] / top
        out = out * (1 - alpha) + layers[name][..., :3] / top * alpha
    return out * top


@pytest.mark.parametrize(("dtype", "most"), [(np.uint8, 1.6), (np.uint16, 1.6), (np.float32, 2e-4)])
def test_layers_make_the_picture(dtype, most):
    scene, picture, clear = drawn_scene(Edit())
    top = 1 if dtype == np.float32 else np.iinfo(dtype).max
    codes, plain = (np.rint(p * top).astype(dtype) if top > 1 else p for p in (picture, clear))
    asked = []

    def draw(edit):
        asked.append(edit)
        return plain

    layers = layers_of(scene, Edit(sun_elevation=3), codes, draw)
    assert asked == [Edit(sun_elevation=3, cloud_opacity=0)]
    assert [layers[name].shape[2] for name in LAYERS] == [3, 4, 4, 1]
    assert {layer.dtype for layer in layers.values()} == {np.dtype(dtype)}
    assert np.abs(composite(layers) - codes).max() <= most
    # Each holds what is its own: the sky no cloud, the clouds no clear sky, the land no sky.
    share = {name: layers[name][..., -1] / top for name in ("clouds", "land", "matte")}
    inside = scene.sky == 1
    np.testing.assert_allclose(layers["sky"][inside] / top, clear[inside], atol=2 / 255)
    assert share["clouds"][inside & (scene.clouds == 0)].max() < 0.02
    assert share["clouds"][inside & (scene.clouds == 1)].min() > 0.98
    assert share["land"][inside].max() < 0.02
    assert share["land"][scene.sky == 0].min() > 0.99
    np.testing.assert_allclose(share["matte"], scene.sky, atol=1 / 255)
    # Behind the land the sky goes on: no hole, and no land in it.
    hidden = layers["sky"][scene.sky == 0] / top
    assert (hidden[:, 2] > 0.7).all()


def test_a_picture_without_sky_is_all_land():
    _, picture, _ = drawn_scene(Edit())
    nothing = np.zeros((HEIGHT, WIDTH), np.float32)
    scene = SimpleNamespace(sky=nothing, clouds=nothing, automatic={}, hints=UNMIXED)
    layers = layers_of(scene, Edit(), picture, lambda edit: picture)
    assert np.array_equal(layers["land"][..., :3], picture)
    assert (layers["land"][..., 3] == 1).all()


@pytest.fixture(scope="module")
def scene():
    import cv2

    import sunwidget as sw

    small = cv2.resize(sw.sample("coast").encoded, (96, 64), interpolation=cv2.INTER_AREA)
    scene = sw.analyze(small)
    try:
        sw.render(scene)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")
    return scene


EDIT = Edit(sun_elevation=4, cloud_opacity=0.5)


def test_tiff_holds_layers_as_named_pages(tmp_path, scene):
    path = save((scene, EDIT), tmp_path / "out.tif", layers=True, bit_depth=16)
    with tifffile.TiffFile(path) as file:
        names = [page.tags[285].value for page in file.pages]
        picture, *pages = [page.asarray() for page in file.pages]
    assert names == ["picture", *LAYERS]
    assert np.abs(composite(dict(zip(LAYERS, pages, strict=True))) - picture).max() <= 1.6
    with pytest.warns(UserWarning, match="only the first is used"):
        again = open_photo(path)
    assert np.array_equal(again.encoded, picture)
    assert again.recipe == EDIT


def test_a_layer_of_floats_that_only_brightens_is_not_lost_where_it_is_clear():
    scene, picture, clear = drawn_scene(Edit())
    scene.clouds = scene.clouds * 0
    bright = picture + np.float32(0.3)
    layers = layers_of(scene, Edit(sun_elevation=3), bright, lambda edit: clear)
    assert np.abs(composite(layers) - bright).max() <= 2e-4


def test_exr_holds_layers_as_channels(tmp_path, scene):
    OpenEXR = pytest.importorskip("OpenEXR")
    path = save((scene, EDIT), tmp_path / "out.exr", layers=True, bit_depth=32)
    found = OpenEXR.File(str(path), separate_channels=True).channels()
    planes = {name: channel.pixels for name, channel in found.items()}

    def color(prefix):
        return np.stack([planes[f"{prefix}{c}"] for c in "RGB"], -1)

    out = color("sky.")
    for name in ("clouds.", "land."):  # multiplied by alpha, as OpenEXR has it
        out = out * (1 - planes[f"{name}A"][..., None]) + color(name)
    np.testing.assert_allclose(out, color(""), atol=2e-4)
    assert planes["matte.Y"].shape == (64, 96)
    assert np.array_equal(open_photo(path).pixels, color(""))


def test_png_and_webp_have_layers_beside_them(tmp_path, scene):
    path = save((scene, EDIT), tmp_path / "out.png", layers=True)
    beside = {name: tmp_path / f"out.{name}.png" for name in LAYERS}
    assert sorted(tmp_path.iterdir()) == sorted([path, *beside.values()])
    opened = {name: open_photo(file) for name, file in beside.items()}
    assert opened["sky"].alpha is None
    assert opened["land"].alpha is not None
    layers = {
        name: photo.encoded
        if photo.alpha is None
        else np.dstack([photo.encoded, np.rint(photo.alpha * 255).astype(np.uint8)])
        for name, photo in opened.items()
    }
    assert np.abs(composite(layers) - open_photo(path).encoded).max() <= 1.6
    save((scene, EDIT), tmp_path / "out.webp", layers=True, quality=100)
    assert (tmp_path / "out.clouds.webp").is_file()


def test_a_layer_is_never_overwritten_and_nothing_is_drawn_before_that_is_known(tmp_path):
    (tmp_path / "out.land.png").write_bytes(b"precious")
    with pytest.raises(FileExistsError, match="out.land.png"):
        save(object(), tmp_path / "out.png", layers=True)
    assert [file.name for file in tmp_path.iterdir()] == ["out.land.png"]


@pytest.mark.parametrize("ending", [".jpg", ".hdr"])
def test_formats_without_transparency_refuse_layers(tmp_path, ending):
    with pytest.raises(PhotoError, match=r"no transparency.*\.tif, \.exr"):
        save(object(), tmp_path / f"out{ending}", layers=True)


def test_only_scenes_have_layers(tmp_path):
    with pytest.raises(PhotoError, match="size and layers apply to a rendered scene"):
        save(np.zeros((4, 4, 3), np.uint8), tmp_path / "out.tif", layers=True)


def test_a_cancelled_export_leaves_no_layer(tmp_path, scene):
    def cancel(fraction, message):
        if fraction > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save((scene, EDIT), tmp_path / "out.png", layers=True, progress=cancel)
    assert list(tmp_path.iterdir()) == []
