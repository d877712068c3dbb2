"""``make bench``: every goal is somebody's to measure, and its pieces run."""

import json
import math
import sys

import pytest

pytest.importorskip("moderngl")


@pytest.fixture(scope="module")
def speed(root):
    sys.path.insert(0, str(root / "bench"))
    import speed
    import speed.groups
    import speed.peer_thesis  # a test replaces what it measures
    import speed.plots
    import speed.table

    yield speed
    sys.path.remove(str(root / "bench"))


def test_every_goal_is_promised_by_one_group(speed):
    promised = [key for name in speed.groups.GROUPS for key in speed.groups.keys(name)]
    assert len(promised) == len(set(promised))
    assert set(speed.rows.GOALS) <= set(promised)


# What starts browsers and other interpreters is left to `make bench`.
@pytest.mark.parametrize("name", ["kernel", "effects", "film", "thesis", "grabcut", "march"])
def test_a_group_measures_what_it_promises(speed, name):
    found, seconds = speed.groups.measure(name, speed.effort.TINY, lambda _row: None)
    assert {row.key: row.error for row in found if row.error} == {}
    assert set(speed.groups.keys(name)) <= {row.key for row in found}
    assert all(math.isfinite(row.value) and row.value > 0 for row in found)
    assert seconds > 0


def test_what_cannot_be_measured_says_why_and_the_rest_goes_on(speed, monkeypatch):
    def broken(_effort):
        yield speed.rows.Row("film", "a film", 20.0, "frames/s")
        raise OSError("no encoder here")

    monkeypatch.setattr(speed.peer_thesis, "rows", broken)
    shown = []
    found, _ = speed.groups.measure("thesis", speed.effort.TINY, shown.append)
    assert [row.error for row in found] == ["", "OSError: no encoder here"]
    assert shown == found
    assert found[0].met
    assert found[1].met is None
    assert json.loads(json.dumps(found[1].as_json(), allow_nan=False))["value"] is None


def test_a_goal_is_met_up_to_its_limit(speed):
    at_most, at_least = speed.rows.Goal(2), speed.rows.Goal(2, more=True)
    assert [at_most.met(x) for x in (1, 2, 3)] == [True, True, False]
    assert [at_least.met(x) for x in (1, 2, 3)] == [False, True, True]
    assert at_most.share(3) == at_least.share(4 / 3) == 1.5


def test_growth_is_the_power_of_the_pixel_count(speed):
    import speed.sizes

    found = [{"pixels": p, "cost": 3 * p**1.5} for p in (2, 6, 24)]
    assert speed.sizes.exponent(found, lambda row: row["cost"]) == pytest.approx(1.5)


def test_the_page_shows_goals_peers_and_what_was_missed(speed):
    rows = [
        speed.rows.Row("film", "a film", 3.0, "frames/s"),
        speed.rows.Row("other", "a peer", 2.0, "ms", peer=8.0, ratio=4.0, note="IoU 0.9"),
        speed.rows.not_measured("stroke", "no stroke here"),
    ]
    facts = dict.fromkeys(("cores", "processor", "renderer", "python", "load_average", "time"), "x")
    text = speed.table.markdown(rows, facts)
    assert "| a film | 3 frames/s |  | ≥ 12 | **missed** |" in text
    assert "| a peer | 2 ms | 8 ms | 4× | IoU 0.9 |" in text
    assert "not measured: no stroke here" in text


def test_time_and_memory_are_drawn_against_pixels(speed, tmp_path):
    pytest.importorskip("matplotlib")
    rows = [
        speed.rows.Row(f"{name} {size} MP", "", float(size), "s")
        for name in speed.plots.NAMES
        for size in (2, 12, 24)
    ]
    assert speed.plots.against_pixels(rows, tmp_path / "plot.svg")
    assert (tmp_path / "plot.svg").read_text("utf-8").count("clip-path") > 4
    assert not speed.plots.against_pixels([], tmp_path / "none.svg")


def test_the_page_has_a_place_for_the_table(root):
    page = (root / "docs" / "developer" / "speed.md").read_text("utf-8")
    source = (root / "bench" / "bench.py").read_text("utf-8")
    marks = [line for line in page.splitlines() if line.startswith("<!--")]
    assert len(marks) == 2
    assert all(mark in source for mark in marks)


def bench_table(**rows):
    """A bench.json of rows (value, processor time)."""
    told = [
        {"key": key, "what": key, "unit": "ms", "value": v, "processor": p, "error": ""}
        for key, (v, p) in rows.items()
    ]
    return {"rows": told}


def test_two_trees_are_compared_turn_by_turn(speed):
    from speed.against import changes

    # The machine is twice as busy in the second turn; the third is an outlier.
    pairs = [
        (bench_table(frame=(10, 8), size=(5, None)), bench_table(frame=(20, 16), size=(10, None))),
        (bench_table(frame=(20, 16), size=(5, None)), bench_table(frame=(40, 32), size=(10, None))),
        (bench_table(frame=(90, 90), size=(5, None)), bench_table(frame=(20, 16), size=(10, None))),
    ]
    frame, size = changes(pairs)
    assert (frame.what, frame.by_processor, frame.then, frame.now) == ("frame", True, 16, 16)
    assert frame.ratio == pytest.approx(0.5)
    assert (size.by_processor, size.ratio) == (False, pytest.approx(0.5))


def test_rows_that_one_tree_lacks_are_left_out(speed):
    from speed.against import changes

    new, old = bench_table(frame=(1, 1), hdr=(1, 1)), bench_table(frame=(2, 2))
    assert [change.what for change in changes([(new, old)])] == ["frame"]


def test_an_unknown_revision_is_named(speed, root):
    from speed.against import checked_out

    with pytest.raises(SystemExit, match="git knows no revision 'no-such-thing'"):
        checked_out("no-such-thing", root)
