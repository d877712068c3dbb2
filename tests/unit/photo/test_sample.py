import pytest

import sunwidget as sw
from sunwidget.errors import PhotoError
from sunwidget.samples import NAMES


@pytest.mark.parametrize("name", NAMES)
def test_every_sample_opens_with_camera_place_and_time(name):
    photo = sw.sample(name)
    assert photo.size == (1536, 1024)
    assert photo.field_of_view.source == "exif"
    assert 15 < photo.field_of_view.vertical < 80
    assert photo.latitude is not None
    assert photo.longitude is not None
    assert photo.heading is not None
    assert photo.time is not None
    assert photo.time.tzinfo is not None


@pytest.mark.parametrize("name", NAMES)
def test_every_sample_says_that_it_is_a_render(name):
    assert b"omputer-generated" in (sw.sample(name).exif or b"")


def test_coast_is_the_default_and_has_the_field_of_view_it_was_rendered_with():
    photo = sw.sample()
    assert photo.name == "coast.jpg"
    # 42° by its maker; EXIF stores the 35 mm equivalent as a whole number (31 for 31.26).
    assert photo.field_of_view.vertical == pytest.approx(42.0, abs=0.4)


def test_an_unknown_sample_suggests_the_nearest_name():
    with pytest.raises(PhotoError, match="Did you mean 'harbour'"):
        sw.sample("harbor")
    with pytest.raises(PhotoError, match="coast, mountains, meadow, harbour"):
        sw.sample("zzzzz")


def test_sample_stays_a_function_after_its_module_was_imported():
    import sunwidget.samples  # noqa: F401

    assert callable(sw.sample)
