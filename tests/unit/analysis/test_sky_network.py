"""Foreign networks: what a file holds is read, the rest is an argument, or an error names it."""

import numpy as np
import onnx_files as onnx
import pytest

import sunwidget as sw
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.segmentation_output import map_of, sky_of
from sunwidget.analysis.networks.sky import BUNDLED
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.analysis.segmentation.sky_network import SkyNetwork
from sunwidget.errors import AnalysisError
from sunwidget.photo.photo import open_photo

F4 = np.float32
IMAGENET = ((0.485, 0.456, 0.406), (0.229, 0.224, 0.225))


def picture() -> np.ndarray:
    """Draw blue over orange-brown: 160 × 120, sky above row 70."""
    image = np.empty((120, 160, 3), np.uint8)
    image[:70] = (90, 140, 220)
    image[70:] = (120, 90, 50)
    return image


def found(network, **options) -> np.ndarray:
    return coarse_sky.coarse(Working.of(open_photo(picture())), network, (160, 120), **options)


def is_the_sky(probability: np.ndarray) -> bool:
    """Tell whether the map is sky exactly above row 70 of 120."""
    edge = 70 / 120 * len(probability)
    sure = probability[: int(edge) - 1].min() > 0.5 > probability[int(edge) + 2 :].max()
    return bool(sure and probability.dtype == F4)


def blueness(tmp_path, classes=150, label=2, size=(48, 64), layout="nchw", **options):
    """Write a network whose class ``label`` wins where blue exceeds red in 0-to-1 values."""
    dtype = options.get("dtype", F4)
    weight = np.zeros((classes, 3, 1, 1), F4)
    weight[label, :, 0, 0] = (-8, 0, 8)
    bias = np.full(classes, -4, F4)
    bias[label], bias[label - 1] = 0, 0
    constants = {"w": weight * options.get("gain", 1), "b": bias, "scale": np.array(1 / 255, F4)}
    shape = (1, 3, *size) if layout == "nchw" else (1, *size, 3)
    nodes = [onnx.node("Cast", ["image"], ["wide"], to=1)]
    last = "wide"
    if dtype == np.uint8:
        nodes.append(onnx.node("Mul", [last, "scale"], ["scaled"]))
        last = "scaled"
    if layout == "nhwc":
        nodes.append(onnx.node("Transpose", [last], ["turned"], perm=(0, 3, 1, 2)))
        last = "turned"
    nodes.append(onnx.node("Conv", [last, "w", "b"], ["scores"]))
    nodes += options.get("tail", [])
    result = options.get("result", ("scores", F4, (1, classes, *size)))
    path = tmp_path / "foreign.onnx"
    entries = [("image", dtype, options.get("shape", shape))]
    return onnx.write(path, nodes, constants, entries, [result], options.get("metadata"))


@pytest.mark.parametrize("layout", ["nchw", "nhwc"])
@pytest.mark.parametrize("dtype", [F4, np.float16, np.float64, np.uint8])
def test_every_input_type_and_layout(tmp_path, layout, dtype):
    path = blueness(tmp_path, layout=layout, dtype=dtype)
    probability = found(path)
    assert probability.shape == (48, 64)
    assert is_the_sky(probability)


@pytest.mark.parametrize(("classes", "label"), [(2, 1), (19, 10), (150, 2), (151, 3)])
def test_well_known_numbers_of_classes_need_no_label(tmp_path, classes, label):
    assert is_the_sky(found(blueness(tmp_path, classes, label)))


def test_a_label_that_is_given_wins_over_the_number_of_classes(tmp_path):
    path = blueness(tmp_path, 150, 7)
    assert is_the_sky(found(path, label=7))
    assert is_the_sky(found(SkyNetwork(path, label=7)))
    assert not is_the_sky(found(path))


@pytest.mark.parametrize("layout", ["nchw", "nhwc"])
@pytest.mark.parametrize("sigmoid", [True, False])
def test_a_plain_map_of_the_sky_needs_no_arguments(tmp_path, layout, sigmoid):
    tail = [onnx.node("Sigmoid", ["scores"], ["map"])] if sigmoid else []
    name = "map" if sigmoid else "scores"
    axes = (0, 2, 3, 1) if layout == "nhwc" else (0, 1, 2, 3)
    tail += [onnx.node("Transpose", [name], ["sky"], perm=axes)]
    shape = (1, 48, 64, 1) if layout == "nhwc" else (1, 1, 48, 64)
    path = blueness(tmp_path, 1, 0, layout=layout, tail=tail, result=("sky", F4, shape))
    assert is_the_sky(found(str(path)))


def test_the_fifth_class_of_nine_must_be_said(tmp_path):
    path = blueness(tmp_path, 9, 5)
    with pytest.raises(AnalysisError, match=r"9 classes.*which one is sky.*sky_label=.*ADE20K"):
        found(path)
    assert is_the_sky(found(path, label=5))


@pytest.mark.parametrize(
    "names", ['{"0": "land", "5": "sky"}', "{5: 'Sky;firmament'}", "a,b,c,d,e,sky,f", '["sea"]']
)
def test_names_in_the_metadata_tell_the_label(tmp_path, names):
    path = blueness(tmp_path, 9, 5, metadata={"names": names})
    if "sea" in names:
        with pytest.raises(AnalysisError, match="0 sea"):
            found(path, label="sky")
        return
    assert is_the_sky(found(path))
    assert is_the_sky(found(path, label="SKY"))


def test_a_label_that_is_not_there_is_refused(tmp_path):
    path = blueness(tmp_path, 19, 10)
    with pytest.raises(AnalysisError, match="no class 42: it has 19"):
        found(path, label=42)
    with pytest.raises(AnalysisError, match="no class 'sky': the file names none"):
        found(path, label="sky")
    with pytest.raises(AnalysisError, match="no class 42: it has 19"):
        found(SkyNetwork(path, label=42, mean=0, std=1))


def test_a_label_without_a_network_is_refused():
    for source in (None, "skyline", np.ones((120, 160))):
        with pytest.raises(AnalysisError, match="sky_label=2 names a class of an ONNX network"):
            found(source, label=2)


@pytest.mark.parametrize("dtype", [np.int64, np.int32, np.uint8, F4])
@pytest.mark.parametrize("keep", [0, 1])
def test_a_map_of_labels_is_read_as_sky_or_not(tmp_path, dtype, keep):
    tail = [
        onnx.node("ArgMax", ["scores"], ["best"], axis=1, keepdims=keep),
        onnx.node("Cast", ["best"], ["labels"], to=onnx.TYPES[np.dtype(dtype)]),
    ]
    shape = (1, 1, 48, 64) if keep else (1, 48, 64)
    path = blueness(tmp_path, tail=tail, result=("labels", dtype, shape))
    # Floats may as well be probabilities: that they are labels must be said.
    probability = found(path, label=2 if dtype == F4 else None)
    assert is_the_sky(probability)
    assert set(np.unique(probability)) == {0, 1}
    if dtype == F4:
        assert not is_the_sky(found(path))


def test_a_map_of_the_sky_has_no_second_class():
    with pytest.raises(AnalysisError, match="no class 2: it has 1"):
        found(BUNDLED, label=2)


def test_channels_last_and_probabilities(tmp_path):
    tail = [
        onnx.node("Softmax", ["scores"], ["share"], axis=1),
        onnx.node("Transpose", ["share"], ["last"], perm=(0, 2, 3, 1)),
    ]
    path = blueness(tmp_path, tail=tail, result=("last", F4, (1, 48, 64, 150)))
    assert is_the_sky(found(path))
    logits = found(blueness(tmp_path))
    assert np.allclose(found(path), logits, atol=1e-3)


@pytest.mark.parametrize("scale", [(0, 1), (0.5, 0.5), (0, 1 / 255), IMAGENET])
@pytest.mark.parametrize("told", ["argument", "metadata"])
def test_a_network_gets_the_scale_that_is_told(tmp_path, scale, told):
    """Our own network behind nodes that undo a normalisation."""
    mean, std = (np.broadcast_to(np.asarray(v, F4), 3) for v in scale)
    nodes = [
        onnx.node("Mul", ["pixels", "std_"], ["wide_"]),
        onnx.node("Add", ["wide_", "mean_"], [SkyNetwork(BUNDLED).open().name]),
    ]
    constants = {"mean_": mean.reshape(3, 1, 1), "std_": std.reshape(3, 1, 1)}
    entries = ("pixels", F4, (1, 3, 384, 384))
    fields = {"mean": scale[0], "std": scale[1]}
    metadata = {name: str(value) for name, value in fields.items() if told == "metadata"}
    path = onnx.wrap(BUNDLED, tmp_path / "ours.onnx", nodes, constants, entries, metadata)
    network = SkyNetwork(path, **({} if metadata else fields))
    working = Working.of(sw.sample("harbour"))
    assert np.allclose(network(working), SkyNetwork(BUNDLED)(working), atol=2e-3)


def test_the_scale_is_the_given_one_the_metadata_s_or_0_to_1(tmp_path):
    metadata = {"mean": "[123.675, 116.28, 103.53]", "std": "[58.395, 57.12, 57.375]"}
    opened = SkyNetwork(blueness(tmp_path, metadata=metadata)).open()
    assert np.allclose(opened.scale(None, None, (0, 1)), IMAGENET)
    mean, std = opened.scale(0.25, None, (0, 1))
    assert mean == 0.25
    assert np.allclose(std, IMAGENET[1])
    for metadata in ({}, {"mean": "0.5"}, {"mean": "grey", "std": "1"}, {"mean": "0", "std": "0"}):
        opened = SkyNetwork(blueness(tmp_path, metadata=metadata)).open()
        assert opened.scale(None, None, (0, 1)) == (0, 1)
    takes_bytes = blueness(tmp_path, dtype=np.uint8)
    with pytest.raises(AnalysisError, match="takes bytes.*leave out mean="):
        found(SkyNetwork(takes_bytes, mean=0.5))


def test_a_network_that_wants_blue_green_red_gets_it(tmp_path):
    path = blueness(tmp_path)
    assert is_the_sky(1 - found(SkyNetwork(path, channels="bgr", mean=0, std=1)))


def test_size_is_the_file_s_or_the_given_one_or_384(tmp_path):
    path = blueness(tmp_path, shape=(1, 3, "h", "w"), result=("scores", F4, ("n", 150, "y", "x")))
    assert found(path).shape == (384, 384)
    assert found(SkyNetwork(path, size=(80, 40))).shape == (40, 80)
    assert found(SkyNetwork(path, size=64)).shape == (64, 64)
    fixed = blueness(tmp_path)
    with pytest.raises(AnalysisError, match="64 × 48 only"):
        found(SkyNetwork(fixed, size=100))


def test_an_open_layout_is_given(tmp_path):
    shape = ("n", "a", "b", "c")
    result = ("scores", F4, ("n", 150, "y", "x"))
    path = blueness(tmp_path, layout="nhwc", shape=shape, result=result)
    with pytest.raises(AnalysisError, match="layout="):
        found(path)
    assert is_the_sky(found(SkyNetwork(path, layout="nhwc")))


def test_of_several_outputs_the_first_map_or_the_named_one_is_taken(tmp_path):
    entries = [("image", F4, (1, 3, 48, 64))]
    weight = np.zeros((150, 3, 1, 1), F4)
    weight[2, :, 0, 0] = (-8, 0, 8)
    nodes = [
        onnx.node("GlobalAveragePool", ["image"], ["pooled"]),
        onnx.node("Conv", ["image", "few"], ["features"]),
        onnx.node("Conv", ["image", "w"], ["scores"]),
    ]
    outputs = [("pooled", F4, (1, 3, 1, 1)), ("features", F4, (1, 2, 48, 64))]
    outputs += [("scores", F4, (1, 150, 48, 64))]
    constants = {"w": weight, "few": np.zeros((2, 3, 1, 1), F4)}
    path = onnx.write(tmp_path / "many.onnx", nodes, constants, entries, outputs)
    with pytest.raises(AnalysisError, match="no class 2: it has 2"):
        found(path, label=2)
    assert is_the_sky(found(SkyNetwork(path, output="scores")))
    with pytest.raises(AnalysisError, match="no output 'sky'; it has pooled, features, scores"):
        found(SkyNetwork(path, output="sky"))


def test_above_one_half_is_where_sky_is_the_strongest_class():
    generator = np.random.default_rng(0)
    scores = generator.normal(0, 2, (1, 5, 12, 16)).astype(F4)
    shares = np.exp(scores) / np.exp(scores).sum(axis=1, keepdims=True)
    for values in (scores, shares):
        probability = sky_of(map_of(values, (16, 12), "nchw"), 3)
        assert np.array_equal(probability > 0.5, scores[0].argmax(axis=0) == 3)
    assert probability.std() > 0.1  # and it is soft


@pytest.mark.parametrize("layout", ["nchw", "nhwc"])
@pytest.mark.parametrize("shape", [(1, 30, 40, 20), (1, 20, 30, 40), (30, 40, 20)])
def test_the_picture_s_proportions_tell_rows_columns_and_classes_apart(shape, layout):
    assert map_of(np.zeros(shape, F4), (160, 120), layout).shape == (30, 40, 20)


@pytest.mark.parametrize("layout", ["nchw", "nhwc"])
def test_the_layout_tells_where_proportions_do_not(layout):
    scores = np.zeros((8, 8, 8), F4)
    scores[(3, ...) if layout == "nchw" else (..., 3)] = 1
    assert (map_of(scores, (8, 8), layout).argmax(-1) == 3).all()


def test_one_map_of_the_sky_may_be_probabilities_or_logits():
    logits = np.linspace(-6, 6, 48, dtype=F4).reshape(6, 8)
    for values in (logits, 1 / (1 + np.exp(-logits))):
        for shape in ((1, 1, 6, 8), (1, 6, 8), (6, 8), (1, 6, 8, 1)):
            probability = sky_of(map_of(values.reshape(shape), (8, 6), "nchw"), 0)
            assert np.allclose(probability, 1 / (1 + np.exp(-logits)), atol=1e-6)


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ([("a", F4, (1, 3, 8, 8)), ("b", F4, (1, 3, 8, 8))], "single input"),
        ([("a", F4, (1, 4, 8, 8))], "3 channels"),
        ([("a", F4, (1, 8, 8, 1))], "3 channels"),
        ([("a", np.int64, (1, 3, 8, 8))], r"int64.*Known types: tensor\(float\)"),
        ([("a", F4, (4, 3, 8, 8))], "batches of 1"),
        ([("a", F4, (8, 8))], r"Expected \(1, 3, height, width\)"),
    ],
)
def test_a_network_of_something_else_says_what_it_takes(tmp_path, entries, words):
    nodes = [onnx.node("Identity", ["a"], ["out"])]
    outputs = [("out", *entries[0][1:])]
    path = onnx.write(tmp_path / "other.onnx", nodes, {}, entries, outputs)
    with pytest.raises(
        AnalysisError, match=f"must take one picture, but its inputs are a .*{words}"
    ):
        found(path)


def test_a_network_without_a_map_says_what_it_returned(tmp_path):
    nodes = [onnx.node("GlobalAveragePool", ["image"], ["pooled"])]
    entries, outputs = [("image", F4, (1, 3, 48, 64))], [("pooled", F4, (1, 3, 1, 1))]
    path = onnx.write(tmp_path / "pool.onnx", nodes, {}, entries, outputs)
    with pytest.raises(AnalysisError, match=r"returned \(1, 3, 1, 1\); expected a map"):
        found(path)


def test_a_network_of_enormous_pictures_is_refused_before_one_is_made(tmp_path):
    nodes = [onnx.node("Identity", ["a"], ["out"])]
    entries, outputs = [("a", F4, (1, 3, 200_000, 200_000))], [("out", F4, ("b", "c", "h", "w"))]
    path = onnx.write(tmp_path / "enormous.onnx", nodes, {}, entries, outputs)
    with pytest.raises(AnalysisError, match="at most 4096 pixels per side"):
        found(path)


def test_a_network_of_nan_is_an_error_in_words(tmp_path):
    path = blueness(tmp_path, gain=np.nan)
    with pytest.raises(AnalysisError, match="NaN or infinite values"):
        found(path)


@pytest.mark.parametrize("keep", [0, 10, 0.5, 0.99])
def test_a_cut_or_damaged_file_is_an_error_in_words(tmp_path, keep):
    data = BUNDLED.read_bytes()
    path = tmp_path / "cut.onnx"
    path.write_bytes(data[: int(len(data) * keep) if keep < 1 else keep])
    with pytest.raises(AnalysisError, match="not an ONNX network"):
        found(path)


def test_another_file_under_the_same_name_is_read_anew(tmp_path):
    assert is_the_sky(found(blueness(tmp_path, 150, 2)))
    assert is_the_sky(found(blueness(tmp_path, 9, 5), label=5))


@pytest.mark.parametrize(
    "fields",
    [
        {"label": -1},
        {"label": True},
        {"label": 2.5},
        {"layout": "chw"},
        {"channels": "gbr"},
        {"mean": "imagenet"},
        {"mean": (0, 1)},
        {"std": 0},
        {"std": (1, np.nan, 1)},
        {"size": 0},
        {"size": (1, 2, 3)},
    ],
)
def test_a_field_that_cannot_be_used_is_refused(fields):
    name = next(iter(fields))
    with pytest.raises(AnalysisError, match=f"{name} must be"):
        SkyNetwork("x.onnx", **fields)


def test_numpy_numbers_and_lists_are_fields():
    network = SkyNetwork("x.onnx", label=np.int64(2), mean=[0, 0, 0], std=np.ones(3), size=[8, 6])
    assert network == SkyNetwork("x.onnx", label=2, mean=(0, 0, 0), std=(1, 1, 1), size=(8, 6))
    assert hash(network) is not None


@pytest.mark.parametrize("shape", [(1, 1), (1, 5000), (5000, 1), (3, 3), (120, 160)])
@pytest.mark.parametrize("source", ["network", "skyline", "foreign"])
def test_photos_of_any_shape_and_without_colour(tmp_path, shape, source):
    grey = np.random.default_rng(0).integers(0, 256, shape).astype(np.uint8)
    network = blueness(tmp_path) if source == "foreign" else source
    probability = coarse_sky.coarse(Working.of(open_photo(grey)), network, shape[::-1])
    assert probability.ndim == 2
    assert np.isfinite(probability).all()
    assert 0 <= probability.min() <= probability.max() <= 1


def test_analyze_and_the_editor_take_a_network_and_its_label(tmp_path):
    path = blueness(tmp_path, 150, 7)
    scene = sw.analyze(picture(), sky=str(path), sky_label=7, refine="none")
    assert is_the_sky(scene.sky_coarse)
    editor = sw.SunEditor(picture(), sky=sw.SkyNetwork(path, label=7), refine="none")
    assert np.array_equal(editor.scene.sky_coarse, scene.sky_coarse)
    with pytest.raises(AnalysisError, match="sky_label must be"):
        sw.analyze(picture(), sky=path, sky_label=-7)
