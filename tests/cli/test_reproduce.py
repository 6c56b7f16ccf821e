"""`jumpcad reproduce`: the published figures beside the simulated ones."""

import json
from types import SimpleNamespace

import pytest
from support.commands import Run

from jumpcad.paper import reproduction


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
