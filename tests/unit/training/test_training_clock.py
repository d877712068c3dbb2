"""A training spends its minutes, whatever a step takes and however often it is cut short."""

import pytest

from training import clock
from training.clock import Clock


@pytest.fixture
def watch(monkeypatch):
    """A watch that each step moves on."""
    now = [1000.0]
    monkeypatch.setattr(clock.time, "monotonic", lambda: now[0])

    def run(spends, seconds, until=1.0, steps=None):
        shares = []
        for share in spends.shares(until):
            shares.append(share)
            now[0] += seconds
            if len(shares) == steps:
                break
        return shares

    return run


def test_shares_of_the_time_rise_to_the_whole(watch):
    spends = Clock(2, lambda: None, 1e9)
    assert watch(spends, 30) == [0, 0.25, 0.5, 0.75]
    assert spends.spent == 120


def test_time_between_two_goes_is_not_spent(watch):
    first = Clock(2, lambda: None, 1e9)
    watch(first, 30, steps=3)
    again = Clock(2, lambda: None, 1e9)
    again.spent = first.spent
    assert again.spent == 60  # the step that was cut short is not counted
    watch(Clock(2, lambda: None, 1e9), 500, steps=1)
    assert watch(again, 30) == [0.5, 0.75]


def test_stages_follow_each_other_and_a_spent_one_makes_no_step(watch):
    spends = Clock(2, lambda: None, 1e9)
    assert watch(spends, 30, until=0.5) == [0, 0.25]
    assert watch(spends, 30, until=0.5) == []
    assert watch(spends, 30) == [0.5, 0.75]


def test_a_checkpoint_is_written_now_and_then(watch):
    saved = []
    spends = Clock(2, lambda: saved.append(spends.spent), 45)
    watch(spends, 20)
    assert saved == [60, 120]
