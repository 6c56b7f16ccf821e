"""Progress of a search on standard error."""

from support.hills import SMALL, Hill

from jumpcad.cli.progress import Tally, watching
from jumpcad.search.study.trial import Trial

DESIGN = SMALL.to_design([0.2, 0.2, 0.2])


def trial(number, score=5.0, phase="bo"):
    return Trial(phase, number, 0, DESIGN, Hill()(DESIGN), score, "m", 0.1)


def test_a_quiet_search_says_nothing(capfd):
    with watching(3, quiet=True) as watch:
        watch(trial(0), True)
    assert capfd.readouterr() == ("", "")


def test_a_line_says_what_is_done_and_the_best_of_the_search():
    """What is read from the study counts too, but not for the rate; neighbours of the best are no better ones."""
    tally = Tally(40)
    assert tally.add(trial(1, 5.0), False) == "bo: 1 of 40 evaluations, best 5, 0/s"
    line = tally.add(trial(2, 4.0, "pick"), True)
    assert line.startswith("robust pick: 2 of 40 evaluations, best 5, ")
    assert line.endswith(" left")
