"""The photo without its sun: detail under little glare, what the network sees under much."""

import numpy as np
import pytest

from sunwidget.analysis.backdrop.erase import erase, erase_nothing
from sunwidget.analysis.images.working_copy import Working, encode
from sunwidget.analysis.networks.sun import LIGHT_FLOOR, SunMaps
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.photo.photo import open_photo

SIZE = (160, 128)  # width, height
SMALL = (32, 40)  # rows, columns of the network's maps


def picture(strength=0.0):
    """A grainy sky with a glow of e to the ``strength`` round the sun's place."""
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    grain = 1 + 0.1 * np.sin(1.9 * columns) * np.sin(1.7 * rows)
    near = np.exp(-np.square(np.hypot(columns - 80, rows - 40) / 16))
    light = (0.1 + LIGHT_FLOOR) * grain * np.exp(strength * near) - LIGHT_FLOOR
    return Working.of(open_photo(encode(light[..., None] * np.array([0.7, 0.85, 1.0]))))


def maps(clean):
    plain = np.zeros(SMALL, np.float32)
    return SunMaps(plain, plain + 0.02, plain, np.asarray(clean, np.float32), plain)


def light(sun_mask):
    return SunObservation(80.0, 40.0, 6.0, 0.0, 20.0, sun_mask, SIZE, True, "detected")


def sky():
    return np.ones(SIZE[::-1], np.float32)


def sun_mask(radius=6):
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
    return (np.hypot(columns - 80, rows - 40) < radius).astype(np.float32)


def test_a_photo_without_a_sun_stays_the_same_object():
    working = picture()
    assert erase_nothing(working).working is working
    assert not erase_nothing(working).mark.any()


def glow(strength):
    """Glare that falls off round the sun's place, over a wide one that is everywhere."""
    rows, columns = np.mgrid[: SMALL[0], : SMALL[1]] + 0.5
    near = np.exp(-np.square(np.hypot(columns - 20, rows - 10) / 4))
    return np.repeat(-0.1 - strength * near[..., None], 3, -1)


def test_little_glare_is_taken_from_the_light_and_leaves_the_detail():
    working = picture(0.25)
    linear = erase(working, maps(glow(0.25)), sky(), light(sun_mask())).working.linear
    box = slice(36, 44), slice(56, 64)  # 20 px beside the sun: e^-1.56 of the strength
    change = np.log((linear[box] + LIGHT_FLOOR) / (working.linear[box] + LIGHT_FLOOR))
    assert change.mean() == pytest.approx(-0.25 * np.exp(-1.56), abs=0.03)
    assert linear[box].std() > 0.7 * working.linear[box].std()


def test_no_more_is_taken_than_the_sky_is_brighter_than_farther_out():
    working = picture()  # without a glow, whatever the network says
    linear = erase(working, maps(glow(0.25)), sky(), light(sun_mask())).working.linear
    assert np.abs(linear - working.linear).mean() < 0.1 * working.linear.std()


def test_far_from_the_sun_the_photo_stays_to_the_bit():
    working = picture(1.5)
    erased = erase(working, maps(glow(1.5)), sky(), light(sun_mask()))
    assert erased.mark[40, 80] == pytest.approx(1)
    far = slice(90, None)
    assert np.array_equal(erased.working.linear[far], working.linear[far])
    assert erased.mark[far].max() == 0


def test_a_core_is_filled_from_around_it():
    code = np.full((SIZE[1], SIZE[0], 3), 80, np.uint8)
    code[sun_mask() > 0] = 255
    working = Working.of(open_photo(code))
    clean = np.zeros((*SMALL, 3))
    clean[5:16, 14:27] = -1.5  # over the core and a little beyond, too strong there
    clean[7:13, 17:24] = -3.0
    filled = erase(working, maps(clean), sky(), light(sun_mask())).working.encoded[40, 80]
    assert np.abs(filled - 80 / 255).max() < 0.25
    assert filled.min() > 0.05


@pytest.mark.parametrize("radius", [6, 1.5])  # of 1.5 it fills no pixel of the network's map
def test_a_sun_that_only_a_person_sees_is_covered_by_its_surroundings(radius):
    code = np.full((SIZE[1], SIZE[0], 3), 80, np.uint8)
    code[sun_mask(radius) > 0] = 255
    working = Working.of(open_photo(code))
    erased = erase(working, maps(np.zeros((*SMALL, 3))), sky(), light(sun_mask(radius)))
    assert erased.mark[40, 80] == pytest.approx(1)
    assert np.abs(erased.working.encoded[40, 80] - 80 / 255).max() < 0.02
    assert erased.mark[100, 20] == 0


def test_of_what_is_burnt_to_white_nothing_is_known_whatever_the_network_says():
    code = np.full((SIZE[1], SIZE[0], 3), 80, np.uint8)
    code[sun_mask() > 0] = 255
    clean = np.zeros((*SMALL, 3))
    clean[7:13, 17:24] = -0.5  # not enough by far
    burnt = erase(Working.of(open_photo(code)), maps(clean), sky(), light(sun_mask()))
    assert np.abs(burnt.working.encoded[40, 80] - 80 / 255).max() < 0.05
    assert burnt.glow[40, 80] == pytest.approx(1)


def test_a_red_glow_before_dark_land_counts_though_it_is_hardly_brighter():
    working, above = hill(glowing=0.0)
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    near = np.exp(-np.square(np.hypot(columns - 80, rows - 66) / 8)) * (rows >= 60)
    linear = working.linear + np.float32([0.3, 0, 0]) * np.float32(near)[..., None]
    working = Working.of(open_photo(linear))
    clean = np.zeros((*SMALL, 3))
    clean[14:20, 14:26, 0] = -2.0
    assert erase(working, maps(clean), above, light(sun_mask())).on_land[66, 80] > 0.4


def test_a_purely_red_glow_before_black_land_counts_where_the_network_sees_none():
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    near = np.exp(-np.square(np.hypot(columns - 80, rows - 66) / 40))
    above = np.broadcast_to(rows < 60, near.shape).astype(np.float32)
    shares = []
    for glow_color in ((1.0, 0.03, 0.01), (1.0, 0.5, 0.3)):
        red = 0.002 + 0.08 * near[..., None] * np.array(glow_color)
        linear = np.where(above[..., None] > 0, 0.3, red)
        working = Working.of(open_photo(linear.astype(np.float32)))
        erased = erase(working, maps(np.zeros((*SMALL, 3))), above, light(0 * sun_mask()))
        shares.append(erased.on_land)
    assert shares[0][80, 80] > 0.7
    assert shares[0][120, 5] < 0.1
    assert shares[1][66:].max() < 0.1  # land of that color is lit


def test_land_that_is_lit_besides_keeps_its_reds():
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    away = np.hypot(columns - 80, rows - 60)
    above = np.broadcast_to(rows < 60, away.shape).astype(np.float32)
    shares = []
    for lit in (0, 30):  # how far from the sun the road is yellow
        color = np.where((away < lit)[..., None], (0.3, 0.2, 0.02), (0.06, 0.004, 0.002))
        color = np.where((away < 45)[..., None], color, (0.002, 0.002, 0.002))
        linear = np.where(above[..., None] > 0, 0.3, color)
        working = Working.of(open_photo(linear.astype(np.float32)))
        erased = erase(working, maps(np.zeros((*SMALL, 3))), above, light(0 * sun_mask()))
        shares.append(erased.on_land[100, 80])
    assert shares[0] > 0.7
    assert shares[1] < 0.05  # or a hole would surround the lit part


def hill(glowing):
    """Dark land from row 60 on, with glare before it below the sun, and the sky's weight."""
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    near = np.exp(-np.square(np.hypot(columns - 80, rows - 60) / 12))
    light = np.where(rows < 60, 0.3, 0.02 + glowing * near)
    above = np.broadcast_to(rows < 60, light.shape).astype(np.float32)
    return Working.of(open_photo(encode(light[..., None] * np.array([1.0, 0.6, 0.3])))), above


def test_the_glare_before_the_land_is_a_share_of_its_light():
    working, above = hill(glowing=0.2)
    clean = np.zeros((*SMALL, 3))
    clean[14:20, 14:26] = -2.0
    share = erase(working, maps(clean), above, light(sun_mask())).on_land
    assert 0.25 < share[70, 80] < 0.9
    assert share[70, 20] < 0.05  # beside it
    assert share[120].max() < 0.05


def test_land_as_bright_as_farther_out_has_no_glare_before_it():
    working, above = hill(glowing=0.0)
    clean = np.full((*SMALL, 3), -2.0)
    share = erase(working, maps(clean), above, light(0 * sun_mask())).on_land
    assert share[66:].max() < 0.1
