"""The template best-jumper does what its name says: it lands upright, rights itself, and jumps again."""

import numpy as np
import pytest

import jumpcad
from jumpcad.checks import check
from jumpcad.evaluation import evaluate
from jumpcad.findings import errors
from jumpcad.landing.landing import land, share_righted
from jumpcad.landing.series import jumps
from jumpcad.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.prior import floors
from jumpcad.workshop import DEFAULT, load_workshop, own_workshop, varied

NAME = "best-jumper"


@pytest.fixture(scope="module")
def robot() -> Robot:
    return jumpcad.build(jumpcad.load_design(NAME), load_workshop(own_workshop(NAME)))


def test_only_a_template_with_a_workshop_of_its_name_has_one() -> None:
    assert [own_workshop(name) for name in (NAME, "kenan-2.0", "light", "no-such.toml")] == [NAME, *[DEFAULT] * 3]


def test_it_keeps_all_limits_with_both_kits(robot: Robot) -> None:
    for kit in ("light-1s", "strong-2s"):
        found = evaluate(robot.design, varied(robot.workshop, {"bought.kit": kit}))
        assert found.verdict == "jump", kit
        assert not errors(found.findings), kit
        assert found.rights_itself > 0.9, kit


def test_it_touches_down_upright_on_all_floors_of_its_workshop(robot: Robot) -> None:
    pitches = [simulate(robot, one, "planar").touchdown_pitch_deg for one in (Settings(), *floors(robot, Settings()))]
    assert all(pitch is not None and abs(pitch) <= 30.5 for pitch in pitches), pitches


def test_it_jumps_ten_times_from_its_feet(robot: Robot) -> None:
    pytest.importorskip("mujoco")
    series = jumps(robot, 10)
    assert series.stood == 10
    assert series.way_m > 5.0


@pytest.mark.thorough
def test_it_rights_itself(robot: Robot) -> None:
    """Of 200 drops in any attitude 98 %, of 40 own landings 95 %, and in ten jumps on each of three floors."""
    pytest.importorskip("mujoco")
    assert not errors(check(robot))
    assert share_righted(robot, 200, np.random.default_rng(0)) >= 0.98
    assert land(robot, 40).share_righted >= 0.95
    assert [jumps(robot, 10, seed).stood for seed in (0, 1, 2)] == [10, 10, 10]
