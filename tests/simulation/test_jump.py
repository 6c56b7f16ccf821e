"""The result of a simulation as plain data and as a table."""

import json
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.design import load_design
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.jump import ACCOUNT, EnergyBudget, Jump, Trajectory


@pytest.fixture(scope="module")
def jump(kenan: Robot) -> Jump:
    return simulate(kenan, Settings(trajectory=True), "planar")


def test_plain_data_is_json_with_energy_and_findings_but_without_the_trajectory(jump: Jump) -> None:
    data = json.loads(json.dumps(jump.to_dict()))
    assert data["ballistic_range_m"] == jump.ballistic_range_m
    assert data["energy"] == vars(jump.energy)
    assert [finding["name"] for finding in data["findings"]] == [finding.name for finding in jump.findings]
    assert "trajectory" not in data


def test_a_jump_is_told_in_one_line(jump: Jump) -> None:
    assert repr(jump).startswith(f"<Jump jump, range {jump.ballistic_range_m:.3f} m, rise {jump.com_rise_m:.3f} m")
    refused = replace(jump, verdict="loop", ballistic_range_m=None, com_rise_m=None, fitness=0.0)
    assert repr(refused).startswith("<Jump loop, fitness 0.000")


def test_jumps_with_the_same_motion_are_equal(kenan: Robot, jump: Jump) -> None:
    assert jump.trajectory is not None
    again = simulate(kenan, Settings(trajectory=True), "planar")
    assert again == jump
    assert len({again, jump}) == 1
    later = replace(jump.trajectory, time_s=jump.trajectory.time_s + 1.0)
    assert jump != replace(jump, trajectory=later)
    assert jump != replace(jump, trajectory=None)


def test_rows_of_a_trajectory_are_its_moments() -> None:
    """Two bodies at two moments; every number is another one."""
    place, turn = np.arange(12.0).reshape(2, 2, 3), 100.0 + np.arange(16.0).reshape(2, 2, 4)
    path = Trajectory(("body", "foot"), np.array([0.0, 0.5]), place, turn, np.zeros(2), np.ones(2), np.full(2, 2.0))
    first, second = path.rows()
    assert (second["time_s"], second["kinetic_j"], second["potential_j"], second["spring_j"]) == (0.5, 0.0, 1.0, 2.0)
    assert [second[f"foot_{axis}_m"] for axis in "xyz"] == [9.0, 10.0, 11.0]
    assert [second[f"foot_q{axis}"] for axis in "xyzw"] == [112.0, 113.0, 114.0, 115.0]
    assert [first[f"body_{axis}_m"] for axis in "xyz"] == [0.0, 1.0, 2.0]
    assert len(first) == 1 + 2 * 7 + 3


def test_the_account_has_every_entry_of_the_budget_once() -> None:
    """Powers of two: each sum tells what is in it."""
    account = EnergyBudget(1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0).account_j
    assert account == {
        "useful": 1.0 + 2.0 + 8.0, "internal": 4.0, "springs": 16.0, "release": 32.0, "pins": 64.0, "slip": 128.0,
        "contact": 256.0,
    }  # fmt: skip
    assert sum(account.values()) == 511.0


def test_each_entry_of_the_account_is_told_in_words_of_its_own() -> None:
    """What it is of: as the budget's attributes are described."""
    told = {
        "useful": "the jump", "internal": "about the centre of mass", "springs": "still in the springs",
        "release": "between cam and roller", "pins": "the joints' friction", "slip": "slipping on the ground",
        "contact": "impacts and rounding",
    }  # fmt: skip
    assert list(ACCOUNT) == list(EnergyBudget(*[0.0] * 9).account_j) == list(told)
    for name, words in ACCOUNT.items():
        assert [other for other, own in told.items() if own in words] == [name]
        assert ("lost" in words) == (name in ("release", "pins", "slip", "contact"))


def test_a_jump_has_the_account_of_its_budget_and_none_without() -> None:
    budget = EnergyBudget(1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0)
    jumped = Jump("jump", "planar", 0.1, 0.2, energy=budget)
    assert jumped.energy_account_j == budget.account_j
    assert Jump("no takeoff", "planar", 0.1, 0.2).energy_account_j is None


def test_what_does_not_jump_has_no_figures_of_a_jump() -> None:
    """Fitness 0, and nothing else: no range, no rise, no energies, no take-off."""
    stays = Jump("no_takeoff", "planar", 0.1, 0.2)
    figures = {name: value for name, value in vars(stays).items() if value is not None}
    assert figures == {
        "verdict": "no_takeoff", "engine": "planar", "mass_kg": 0.1, "spring_energy_j": 0.2, "fitness": 0.0,
        "findings": (),
    }  # fmt: skip


def test_a_jump_in_json_has_its_energy_and_the_account_of_it() -> None:
    jump = simulate(capsule_robot(load_design("kenan-2.0")), engine="planar")
    data = jump.to_dict()
    assert data["energy_account_j"] == jump.energy_account_j
    assert sum(data["energy_account_j"].values()) == pytest.approx(jump.spring_energy_j)
    assert data["energy"]["forward_j"] > 0.0
