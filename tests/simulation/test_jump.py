"""The result of a simulation as plain data and as a table."""

import json
from dataclasses import replace

import pytest

from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.jump import EnergyBudget, Jump


@pytest.fixture(scope="module")
def jump(kenan: Robot) -> Jump:
    return simulate(kenan, Settings(trajectory=True), "planar")


def test_plain_data_is_json_with_energy_and_findings_but_without_the_trajectory(jump: Jump) -> None:
    data = json.loads(json.dumps(jump.to_dict()))
    assert data["ballistic_range_m"] == jump.ballistic_range_m
    assert data["energy"] == vars(jump.energy)
    assert [finding["name"] for finding in data["findings"]] == [finding.name for finding in jump.findings]
    assert data["energy_account_j"] == jump.energy_account_j
    assert "trajectory" not in data


def test_jumps_with_the_same_motion_are_equal(kenan: Robot, jump: Jump) -> None:
    assert jump.trajectory is not None
    again = simulate(kenan, Settings(trajectory=True), "planar")
    assert again == jump
    assert len({again, jump}) == 1
    later = replace(jump.trajectory, time_s=jump.trajectory.time_s + 1.0)
    assert jump != replace(jump, trajectory=later)
    assert jump != replace(jump, trajectory=None)


def test_the_account_has_every_entry_of_the_budget_once() -> None:
    """Powers of two: each sum tells what is in it."""
    account = EnergyBudget(1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0).account_j
    assert account == {
        "useful": 1.0 + 2.0 + 8.0, "internal": 4.0, "springs": 16.0, "release": 32.0, "pins": 64.0, "slip": 128.0,
        "contact": 256.0,
    }  # fmt: skip
    assert sum(account.values()) == 511.0


def test_the_account_alters_no_entry_and_shown_losses_add_up_less_what_rounding_gained() -> None:
    budget = EnergyBudget(0.05, 0.05, 0.01, 0.01, 0.002, 0.003, 0.004, -0.0001, -0.0003)
    whole = sum(vars(budget).values())
    assert sum(budget.account_j.values()) == pytest.approx(whole)
    assert budget.account_j["useful"] == pytest.approx(0.11)
    assert sum(max(value, 0.0) for value in budget.account_j.values()) - budget.gained_j == pytest.approx(whole)
