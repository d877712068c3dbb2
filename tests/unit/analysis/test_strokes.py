"""Strokes on the small copy: how far they reach, and what resists them."""

import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.strokes.sky import Painting
from sunwidget.edit.table import Stroke
from sunwidget.photo.photo import open_photo

HEIGHT, WIDTH = 160, 240


def working(picture: np.ndarray) -> Working:
    grain = np.random.default_rng(1).normal(0, 1.5, picture.shape)
    return Working.of(open_photo(np.clip(picture + grain, 0, 255).astype(np.uint8)))


def flat(level: float = 200.0) -> np.ndarray:
    return np.full((HEIGHT, WIDTH, 3), level)


def line(label: str, x0: float, x1: float, y: float, radius: float = 0.015) -> Stroke:
    return Stroke(label, ((x0 / WIDTH, y / HEIGHT), (x1 / WIDTH, y / HEIGHT)), radius)


def test_an_island_is_flipped_as_a_whole_whatever_its_colours():
    picture = flat(60)
    picture[60:80, 100:120], picture[60:80, 120:140] = 210, (40, 90, 200)
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:30], sky[60:80, 100:140] = 1, 1
    photo = working(picture)
    after = Painting.begin(sky, photo).stroke(line("not_sky", 104, 116, 70, 0.02), photo).sky
    assert not after[60:80, 100:140].any()
    assert after[:28].all(), "the mainland stays"


def test_what_the_network_is_sure_of_resists_a_stroke_on_the_same_colour():
    # A white wall against a white sky: only the network sees a difference.
    photo = working(flat())
    sky = np.ones((HEIGHT, WIDTH), np.float32)
    network = np.ones((HEIGHT, WIDTH), np.float32)
    network[90:, :] = 0.7
    wall = line("not_sky", 60, 180, 120, 0.03)
    doubted = Painting.begin(sky, photo, network).stroke(wall, photo).sky
    assert not doubted[110:130, 60:180].any()
    assert doubted[:84].all()
    blind = Painting.begin(sky, photo).stroke(wall, photo).sky
    assert np.count_nonzero(~blind) > 1.5 * np.count_nonzero(~doubted)


def test_a_fine_brush_reaches_less_far_than_a_broad_one():
    photo = working(flat())
    begin = Painting.begin(np.ones((HEIGHT, WIDTH), np.float32), photo)
    fine = ~begin.stroke(line("not_sky", 60, 180, 80, 0.004), photo).sky
    broad = ~begin.stroke(line("not_sky", 60, 180, 80, 0.02), photo).sky
    rows_fine, rows_broad = (np.flatnonzero(m[:, WIDTH // 2]) for m in (fine, broad))
    assert np.ptp(rows_fine) < 0.6 * np.ptp(rows_broad)


def test_what_an_earlier_stroke_said_keeps_a_later_one_away():
    picture = flat()
    picture[80:] = 198
    photo = working(picture)
    begin = Painting.begin(np.zeros((HEIGHT, WIDTH), np.float32), photo)
    upper = line("sky", 40, 200, 60, 0.03)
    free = begin.stroke(upper, photo).sky
    held = begin.stroke(line("not_sky", 40, 200, 100, 0.03), photo).stroke(upper, photo).sky
    assert np.count_nonzero(held[84:]) < np.count_nonzero(free[84:])
    assert not held[96:104, 40:200].any()
    assert held[56:64, 40:200].all()


def test_a_painting_counts_strokes_and_when_the_sky_is_to_be_looked_at_again():
    photo = working(flat())
    begin = Painting.begin(np.ones((HEIGHT, WIDTH), np.float32), photo)
    dab = begin.stroke(line("not_sky", 100, 101, 80, 0.006), photo)
    assert (dab.count, dab.fits) == (1, 0)
    wide = dab.stroke(line("not_sky", 20, 220, 120, 0.06), photo)
    assert (wide.count, wide.fits) == (2, 2)
    again = wide.stroke(line("not_sky", 100, 101, 20, 0.006), photo)
    assert (again.count, again.fits) == (3, 2)


@pytest.mark.parametrize("size", [(1, 1), (2, 300), (300, 2), (5, 7)])
def test_strokes_on_tiny_pictures_do_what_they_say(size):
    photo = Working.of(open_photo(np.full((*size, 3), 120, np.uint8)))
    begin = Painting.begin(np.ones(size, np.float32), photo)
    after = begin.stroke(Stroke("not_sky", ((0.5, 0.5),), 0.3), photo).sky
    assert not after[size[0] // 2, size[1] // 2]
