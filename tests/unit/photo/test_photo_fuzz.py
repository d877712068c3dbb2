"""Whatever bytes or array come in, a Photo or a PhotoError comes out."""

import os
import subprocess
import sys
import warnings

import numpy as np
import photo_corpus as corpus
import pytest
import raw_files
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.photo.photo import open_photo

BASE = corpus.ramp(16, 16)
SEEDS = {
    "jpeg": corpus.jpeg_file(
        BASE,
        exif=corpus.exif_block({0x010F: "Maker"}, {0xA405: 28}, {1: "N", 2: (1.0, 2.0, 3.0)}, 6),
        icc_profile=corpus.DISPLAY_P3,
    ),
    "png": corpus.png_file(BASE, chunks=[corpus.icc_chunk(corpus.ADOBE_RGB)]),
    "png16": corpus.png16_file(corpus.ramp16(16, 16)),
    "tiff": corpus.pillow_file(BASE, "TIFF", compression="tiff_lzw"),
    "tiff16": corpus.tiff_file(corpus.ramp16(16, 16)),
    "tiff_float": corpus.tiff_file((BASE / 255).astype(np.float32), photometric="rgb"),
    "webp": corpus.pillow_file(BASE, "WEBP", lossless=True),
    "gif": corpus.pillow_file(BASE, "GIF"),
    "bmp": corpus.pillow_file(BASE, "BMP"),
    "hdr": corpus.hdr_file(BASE / 255),
    "exr": corpus.exr_file(BASE / 255, np.float16),
    "raw": raw_files.dng(raw_files.ramp(16, 16)),
}
# No deadline: the machine that runs this may be busy.
relaxed = settings(
    deadline=None, max_examples=120, suppress_health_check=[HealthCheck.too_slow], derandomize=True
)


def opens_or_says_why(source):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a library's own warning must not leak either
        warnings.simplefilter("ignore", PhotoWarning)
        try:
            photo = open_photo(source)
        except PhotoError:
            return
        assert photo.encoded.ndim == 3
        assert photo.size[0] * photo.size[1] <= 200_000_000
        if photo.size[0] * photo.size[1] < 1_000_000:
            assert photo.preview(8).dtype == np.uint8
            assert np.isfinite(photo.pixels).all()


@given(st.binary(max_size=400))
@relaxed
def test_random_bytes_open_or_say_why_not(data):
    opens_or_says_why(data)


@given(st.sampled_from([b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n", b"II*\0", b"MM\0*", b"GIF89a"]))
@relaxed
def test_a_magic_number_alone_says_why_it_does_not_open(head):
    opens_or_says_why(head)


@pytest.mark.parametrize("kind", SEEDS)
@given(data=st.data())
@relaxed
def test_a_file_with_changed_bytes_opens_or_says_why_not(kind, data):
    seed = bytearray(SEEDS[kind])
    # Headers are where the offsets and sizes are: mutate them more often than the rest.
    reach = data.draw(st.sampled_from([64, 256, len(seed)]))
    for _ in range(data.draw(st.integers(1, 6))):
        where = data.draw(st.integers(0, min(reach, len(seed)) - 1))
        seed[where] = data.draw(st.sampled_from([0, 1, 2, 0x7F, 0x80, 0xFE, 0xFF, 42]))
    opens_or_says_why(bytes(seed))


@pytest.mark.parametrize("kind", SEEDS)
def test_files_cut_at_every_length(kind):
    seed = SEEDS[kind]
    for length in range(0, len(seed), max(1, len(seed) // 100)):
        opens_or_says_why(seed[:length])


KINDS = ["?", "u1", "i1", "<u2", ">u2", "i4", "u8", "<f2", "<f4", ">f4", "<f8", "g", "c8", "M8[s]"]
SHAPES = st.one_of(
    arrays.array_shapes(min_dims=0, max_dims=5, min_side=0, max_side=6),
    st.tuples(st.integers(1, 6), st.integers(1, 6), st.integers(1, 5)),
)
ARRAYS = SHAPES.flatmap(
    lambda shape: st.sampled_from(KINDS).flatmap(lambda kind: arrays.arrays(kind, shape))
)


@given(ARRAYS, st.sampled_from(["C", "F", "mirrored", "read-only"]))
@settings(relaxed, max_examples=300)
def test_arrays_of_any_type_shape_order_and_value(array, order):
    if order == "F":
        array = np.asfortranarray(array)
    elif order == "mirrored":
        array = array[tuple(slice(None, None, -1) for _ in array.shape)]
    elif order == "read-only":
        array.flags.writeable = False
    opens_or_says_why(array)


def test_what_guided_mutation_finds_opens_or_says_why(root, tmp_path):
    pytest.importorskip("atheris", reason="no wheel for this system")
    # Always the same files, unless the machine is so busy that the clock ends it before.
    bounds = ("-seed=1", "-runs=1500", "-max_total_time=10")
    looking = [sys.executable, root / "tests/fuzz/photo_readers.py", tmp_path / "learned", *bounds]
    # Through a shell: a process begins with the highest memory that its parent ever had.
    done = subprocess.run(
        ["sh", "-c", '"$@"; exit $?', "sh", *looking],
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(root)},
    )
    assert done.returncode == 0, done.stderr[-3000:]
    assert "Done " in done.stderr
