"""`jumpcad reproduce`: the published figures beside the simulated ones."""

from support import needs
from support.commands import Run


def test_reproduce_shows_both_worlds(run: Run) -> None:
    needs.package("pybullet")
    code, out, err = run("reproduce")
    assert (code, err) == (0, "")
    for shown in ("Kenan 1.0", "best GA", "best BO", "Kenan 2.0", "0.2571", "0.3212", "0.9047", "1.5", "1.3"):
        assert shown in out  # published figures to the digits of the reference table, and the measured energies
    heads = [line.split() for line in out.splitlines()]
    assert ["robot", "quantity", "published", "again", "measured", "evaluator", "meaning"] in heads
    assert ["hyperparameter", "in", "its", "table", "in", "its", "results"] in heads
    assert all(len(line) <= 80 for line in out.splitlines())
