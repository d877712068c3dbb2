import re

import pytest

from sunwidget.progress import time_left_text, with_time_left


class Work:
    """Work that reports to a wrapped progress while a clock is set by hand."""

    def __init__(self):
        self.now = 100.0
        self.said = []
        self.report = with_time_left(
            lambda fraction, message: self.said.append((fraction, message)), clock=lambda: self.now
        )

    def at(self, now, fraction, message="frame"):
        self.now = 100.0 + now
        self.report(fraction, message)
        return self.said[-1][1]


def seconds(message):
    found = re.search(r"· (\d+) s left$", message)
    return int(found[1]) if found else None


def test_steady_work_tells_the_seconds_that_are_left():
    work = Work()
    told = [seconds(work.at(i / 4, i / 80)) for i in range(80)]
    assert told[:4] == [None] * 4  # the first second says nothing
    for i in range(4, 80):
        left = (80 - i) / 4
        assert told[i] is not None
        assert left - 0.01 <= told[i] <= left + 5


def test_below_two_per_cent_and_at_the_end_nothing_is_added():
    work = Work()
    work.at(0, 0)
    assert work.at(5, 0.019) == "frame"
    assert work.at(6, 0.03) != "frame"
    assert work.at(30, 1.0) == "frame"


def test_work_that_slows_down_is_followed():
    work = Work()
    for i in range(50):
        work.at(i * 0.1, i / 100)
    for i in range(50, 75):  # from now on each step takes ten times as long
        last = work.at(5 + (i - 50) * 1.0, i / 100)
    assert 20 <= seconds(last) <= 40


def test_one_slow_first_frame_does_not_frighten():
    work = Work()
    work.at(0, 0)
    work.at(3, 0.01)  # shaders compile
    for i in range(2, 60):
        last = work.at(3 + i * 0.1, i / 100)
    assert seconds(last) <= 8


def test_the_fraction_is_passed_on_and_a_message_may_be_empty():
    work = Work()
    work.at(0, 0.0)
    assert work.at(4, 0.5, "") == "4 s left"
    assert work.said[-1][0] == 0.5


def test_another_piece_of_work_starts_its_own_count():
    work = Work()
    work.at(0, 0.0)
    assert seconds(work.at(10, 0.9)) is not None
    assert work.at(11, 0.1) == "frame"
    assert work.at(11.5, 0.3) == "frame"
    assert seconds(work.at(13, 0.6)) <= 3


def test_what_wraps_work_that_tells_its_time_tells_one_time():
    whole = Work()
    whole.at(0, 0.0, "frame 1 of 9")
    said = whole.at(4, 0.2, "frame 5 of 9 · 2 s left")
    assert said == "frame 5 of 9 · 16 s left"
    assert whole.at(5, 0.25, "3 min left") == "15 s left"


def test_many_reports_at_one_instant_divide_by_nothing():
    work = Work()
    for i in range(10):
        assert work.at(0, i / 10) == "frame"


def test_what_progress_raises_cancels():
    def stop(_fraction, _message):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        with_time_left(stop)(0.5, "")


def test_no_progress_is_a_callable_that_does_nothing():
    with_time_left(None)(0.5, "frame")


@pytest.mark.parametrize(
    ("left", "words"),
    [
        (0, "1 s left"),
        (11.2, "12 s left"),
        (61, "65 s left"),
        (175, "3 min left"),
        (3590, "1 h left"),
        (4790, "1 h 20 min left"),
        (3 * 3600 - 100, "3 h left"),
    ],
)
def test_time_is_told_no_finer_than_it_is_known(left, words):
    assert time_left_text(left) == words
