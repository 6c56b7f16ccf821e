"""`jumpcad reproduce`: the published figures beside the simulated ones."""

import json
from types import SimpleNamespace

import pytest
from support.commands import Run

from jumpcad.cli import reproduce as module
from jumpcad.cli.output import console
from jumpcad.paper import reproduction
from jumpcad.paper.published import PublishedJump
from jumpcad.simulation import Jump


def test_reproduce_shows_both_worlds(run: Run) -> None:
    code, out, err = run("reproduce")
    assert (code, err) == (0, "")
    for shown in ("Kenan 1.0", "best GA", "best BO", "Kenan 2.0", "0.2571", "0.3212", "0.9047", "1.5", "1.3"):
        assert shown in out  # published figures to the digits of the reference table, and the measured energies
    heads = [line.split() for line in out.splitlines()]
    assert ["robot", "quantity", "published", "again", "measured", "evaluator", "meaning"] in heads
    assert ["hyperparameter", "in", "its", "table", "in", "its", "results"] in heads
    assert all(len(line) <= 80 for line in out.splitlines())


def test_the_json_has_every_robot_hyperparameter_and_reason(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = [SimpleNamespace(to_dict=lambda name=name: {"robot": name}) for name in ("a", "b", "c", "d")]
    monkeypatch.setattr(reproduction, "reproduce", lambda: rows)
    code, out, err = run("reproduce", "--json")
    found = json.loads(out)
    assert (code, err) == (0, "")
    assert [row["robot"] for row in found["robots"]] == ["a", "b", "c", "d"]
    assert [row["name"] for row in found["hyperparameters"]] == [one.name for one in reproduction.HYPERPARAMETERS]
    assert found["why_they_differ"] == list(reproduction.WHY_THEY_DIFFER)


def test_each_figure_stands_under_its_heading(capsys: pytest.CaptureFixture[str]) -> None:
    """Published, simulated again, measured, and the evaluator's in its own quantities; what is not known is blank."""
    there, again = PublishedJump(0.11, 0.12, 0.13), PublishedJump(0.21, 0.22, 0.23)
    measured = reproduction.Measured(0.31, 0.32, 1.33)
    jump = Jump(
        "jump", "planar", 0.1, 0.2, ballistic_range_m=0.41, touchdown_distance_m=0.42, com_rise_m=0.43,
        takeoff_energy_ratio=0.44,
    )  # fmt: skip
    rows = [
        reproduction.Reproduction(reproduction.PublishedResult("Frog", "frog", there, measured), again, jump),
        reproduction.Reproduction(
            reproduction.PublishedResult("Toad", "toad", there), again, Jump("tips", "planar", 0.1, 0.2)
        ),
    ]
    items = (reproduction.Hyperparameter("mass", 0.5, 0.25), reproduction.Hyperparameter("pull", None, 0.75))
    screen = console(highlight=False)
    screen.print(module._results(rows))
    screen.print(module._hyperparameters(items))
    told = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert [line for line in told if line and line[-1] in ("ballistic", "touchdown", "rise", "share")] == [
        ["Frog", "length", "m", "0.11", "0.2100", "0.31", "0.4100", "ballistic"], ["0.4200", "touchdown"],
        ["height", "m", "0.12", "0.2200", "0.32", "0.4300", "rise"],
        ["energy", "J", "0.13", "0.2300", "1.33", "0.4400", "share"],
        ["Toad", "length", "m", "0.11", "0.2100", "none", "ballistic"], ["none", "touchdown"],
        ["height", "m", "0.12", "0.2200", "none", "rise"], ["energy", "J", "0.13", "0.2300", "none", "share"],
    ]  # fmt: skip
    assert ["mass", "0.5", "0.25"] in told
    assert ["pull", "–", "0.75"] in told
