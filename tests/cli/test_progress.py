"""Progress of a search on standard error."""

from io import StringIO

import pytest
from rich.progress import Progress
from support.hills import SMALL, Hill

from jumpcad.cli.progress import Tally, duration, watching
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import FIRST, run_study
from jumpcad.search.study.trial import Trial

DESIGN = SMALL.to_design([0.2, 0.2, 0.2])


def trial(number, score=5.0, phase="bo"):
    return Trial(phase, number, 0, DESIGN, Hill()(DESIGN), score, "m", 0.1)


class Clock:
    """A clock that stands still until it is moved."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


def test_what_is_read_does_not_count_for_the_rate():
    clock = Clock()
    tally = Tally(100, clock)
    for number in range(40):  # read from the study file, in no time
        tally.add(trial(number), computed=False)
    clock.now = 3.0
    tally.add(trial(40), computed=False)
    for number in range(41, 51):
        clock.now += 2.0
        tally.add(trial(number, score=number / 10), computed=True)
    assert tally.per_second == pytest.approx(0.5)
    assert tally.left_s == pytest.approx((100 - 51) / 0.5)
    assert tally.line() == "bo: 51 of 100 evaluations, best 5, 0.5/s, about 2 min left"
    tally.add(trial(51), computed=False)  # one that was there already: the clock goes on
    assert tally.per_second == pytest.approx(0.5)


def test_neighbours_of_the_best_count_and_are_not_the_best():
    tally = Tally(3, Clock())
    tally.add(trial(0), computed=True)
    tally.add(trial(0, score=7.0, phase="robust"), computed=True)
    assert (tally.done, tally.best, tally.phase) == (2, 5.0, "robust pick")


@pytest.mark.parametrize(("seconds", "text"), [(59.6, "60 s"), (600, "10 min"), (9000, "2.5 h")])
def test_durations_in_the_unit_that_suits(seconds, text):
    assert duration(seconds) == text


def test_one_line_a_minute_where_there_is_no_terminal(capfd):
    clock = Clock()
    with watching(30, False, clock) as watch:
        for number in range(30):
            clock.now += 7.0
            watch(trial(number), True)
        clock.now += 70.0
        watch(trial(30), False)  # read from the study file
    lines = capfd.readouterr().err.splitlines()
    assert len(lines) == 3  # 210 s
    assert lines[0].startswith("jumpcad: bo: 9 of 30 evaluations, best 5, 0.14/s, about 2 min left")


def test_a_bar_on_a_terminal_is_as_long_as_the_share_that_is_done(monkeypatch):
    """Also where the robust pick takes more than was asked for; what is done is told beside it."""
    ended, stop, screen = [], Progress.stop, StringIO()
    screen.isatty = lambda: True
    monkeypatch.setattr("sys.stderr", screen)
    monkeypatch.setattr(Progress, "stop", lambda bar: ended.extend(bar.tasks) or stop(bar))
    for total, share in ((40, 25.0), (8, 100.0)):
        with watching(total, False, Clock()) as watch:
            for number in range(10):
                watch(trial(number), True)
        task = ended.pop()
        assert (task.percentage, task.total, task.description) == (share, max(total, 10), "bo")
        assert task.fields["line"].startswith(f"10 of {max(total, 10)} evaluations, best 5")


def test_a_quiet_search_says_nothing(capfd):
    clock = Clock()
    with watching(FIRST, True, clock) as watch:
        for number in range(FIRST):
            clock.now += 61.0
            watch(trial(number, None), True)
    assert capfd.readouterr() == ("", "")


class Never(Hill):
    """A hill on which nothing jumps."""

    def __call__(self, design):
        return Hill.__call__(self, design.model_copy(update={"compression_ratio": 0.75}))


def test_bounds_without_a_robot_are_told_after_the_first_designs(capfd):
    with watching(70, False) as watch, local_pool(0) as pool:
        result = run_study(Request(SMALL, Never(), method="bo", evaluations=70), None, pool, watch)
    said = f"none of the first {FIRST} designs jumps (loop {FIRST}): there may be no robot within these bounds"
    assert f"jumpcad: {said}\n" in capfd.readouterr().err
    assert result.notes == [said]


def test_one_that_jumps_among_the_first_is_enough():
    with local_pool(0) as pool:
        assert run_study(Request(SMALL, Hill(), method="bo", evaluations=70), None, pool).notes == []
