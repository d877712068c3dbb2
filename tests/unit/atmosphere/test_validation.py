"""The validation's rows are met. Rows 3 and 4 need data: test_atmosphere_measured.py."""

import math

import pytest

from sunwidget.validation import report


def missed(rows):
    return [row for row in rows if not row.met]


@pytest.mark.parametrize(
    ("part", "count"),
    [(report.closed_forms, 7), (report.twilight, 7), (report.sun_chromaticity, 4)],
)
def test_every_figure_of_the_validation_keeps_its_bound(part, count):
    rows = list(part())
    assert len(rows) == count
    assert missed(rows) == []
    assert all(math.isfinite(row.value) and row.source and row.target for row in rows)


def test_the_direct_beam_agrees_with_astm_g173():
    pytest.importorskip("pvlib")
    [row] = report.direct_beam()
    assert row.met
    assert row.number == 2


def test_the_path_tracers_bounds_are_those_of_the_design():
    """The errors themselves are held tighter in test_atmosphere_sky.py."""
    suns = dict(report.PATH_TRACED_SUNS)
    assert {bound for sun, bound in suns.items() if sun >= 30} == {8}
    assert {bound for sun, bound in suns.items() if 2 <= sun <= 10} == {15}
    assert {bound for sun, bound in suns.items() if -4 <= sun <= 0} == {35}


def test_what_is_not_there_is_said_and_is_neither_met_nor_missed(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("SUNWIDGET_MEASUREMENTS", raising=False)
    rows = [
        *report.measured_radiance(),
        *report.other_models(None),
        *report.other_models(tmp_path),
        *report.another_day(),
    ]
    assert len(rows) == 4
    assert all(row.met is None and row.value is None for row in rows)
    assert all(row.note.startswith("needs ") for row in rows)
    assert "download()" in rows[0].note


def test_a_figure_beyond_its_bound_is_missed():
    at = report._At(1, "nobody")
    assert [at.most("a", value, 2).met for value in (1, 2, 3)] == [True, True, False]
    assert [at.least("a", value, 2).met for value in (1, 2, 3)] == [False, True, True]
    assert [at.between("a", value, 1, 2).met for value in (0, 1, 3)] == [False, True, False]
    assert not at.most("a", math.nan, 2).met
    assert at.most("a", 1, 2, "%").target == "≤ 2 %"
