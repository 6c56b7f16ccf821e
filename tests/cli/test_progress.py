"""Progress of a search on standard error."""

from support.hills import SMALL, Hill

from jumpcad.cli.progress import watching
from jumpcad.search.study.run import FIRST
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


def test_a_quiet_search_says_nothing(capfd):
    clock = Clock()
    with watching(FIRST, True, clock) as watch:
        for number in range(FIRST):
            clock.now += 61.0
            watch(trial(number, None), True)
    assert capfd.readouterr() == ("", "")
