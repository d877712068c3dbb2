"""Corrections by hand of the masks of sky."""

import numpy as np
import pytest

from training import sky_corrections
from training.sky_corrections import CORRECTIONS, JUDGED, corrected, judges

FJORD = "landscape-pseudo/fjord.jpg"


@pytest.fixture
def by_hand(tmp_path, monkeypatch):
    """A photo whose upper half is sky but for a rock in it, and a strip that nobody can tell."""
    path = tmp_path / "sky_corrections.csv"
    sky = "0,0 100,0 100,50 0,50|40,10 60,10 60,40 40,40"
    land = "0,80 100,80 100,100 0,100;0,60 20,60 20,70 0,70"
    path.write_text(
        f'file,sky,land,unknown\n{FJORD},"{sky}","{land}","80,0 100,0 100,100 80,100"\n'
    )
    known = sky_corrections.corrections(path)
    monkeypatch.setattr(
        sky_corrections,
        "corrections",
        lambda path=CORRECTIONS: known if path == CORRECTIONS else {},
    )


def test_regions_replace_the_mask_and_leave_the_rest(by_hand):
    mask = np.full((100, 200), 128, np.uint8)
    mask[:, 100:] = 255
    before = mask.copy()
    found = corrected(FJORD, mask)
    assert np.array_equal(mask, before)
    assert (found[20, 20], found[90, 20], found[65, 10]) == (255, 0, 0)
    assert (found[90, 190], found[20, 190]) == (128, 128)  # unknown comes last
    assert (found[55, 20], found[55, 120]) == (128, 255)


def test_a_hole_in_a_region_keeps_its_mask(by_hand):
    assert corrected(FJORD, np.zeros((100, 200), np.uint8))[25, 100] == 0
    assert corrected(FJORD, np.full((100, 200), 128, np.uint8))[25, 100] == 128


def test_other_photos_keep_their_masks(by_hand):
    mask = np.arange(12, dtype=np.uint8).reshape(3, 4)
    assert corrected("landscape-pseudo/other.jpg", mask) is mask


def test_photos_of_the_judged_list_never_train():
    judged = sky_corrections.corrections(JUDGED)
    assert len(judged) == 299
    assert all(map(judges, judged))
    file, regions = next((f, r) for f, r in judged.items() if r)
    found = set(np.unique(corrected(file, np.full((100, 200), 77, np.uint8)))) - {77}
    assert found
    assert found <= {level for level, _ in regions}


def test_a_quarter_of_the_other_corrected_photos_judges_and_no_other_does():
    judged = sky_corrections.corrections(JUDGED)
    found = [f for f in sky_corrections.corrections(CORRECTIONS) if f not in judged]
    assert 0.2 < sum(map(judges, found)) / len(found) < 0.3
    others = [f"landscape-pseudo/other-{i}.jpg" for i in range(100)]
    assert not any(map(judges, others))


def test_the_shipped_corrections_are_regions_within_their_photos():
    found = sky_corrections.corrections(CORRECTIONS)
    assert len(found) > 400
    for regions in found.values():
        assert regions
        for level, region in regions:
            assert level in (0, 128, 255)
            for ring in region:
                assert ring.shape[0] >= 3
                assert ring.min() >= 0
                assert ring.max() <= 1
