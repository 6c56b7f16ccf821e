"""Propagation: indices of functions whose indices are known, and the robot's interval."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import ndtr
from support.built import built
from support.workshops import workshop_with

from jumpcad.errors import CannotBuildError
from jumpcad.robot.robot import Robot
from jumpcad.settings import Draws, Settings, coefficients
from jumpcad.simulation import prior as priors
from jumpcad.simulation import simulate, uncertain
from jumpcad.simulation.uncertain import (
    Uncertainty,
    _first_order,
    changed,
    robust_figures,
    uncertain_jump,
    varied_inputs,
)
from jumpcad.workshop import varied


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


def test_interval_holds_the_jump_and_shrinks_with_a_calibration(robot: Robot) -> None:
    nominal = simulate(robot, Settings(), "planar").touchdown_distance_m
    vague = uncertain_jump(robot, Settings(), "planar", samples=64)
    draws = Draws(spring_efficiency=(0.99, 1.0, 1.01) * 10, pin_friction=(0.24, 0.25, 0.26) * 10)
    sharp = uncertain_jump(robot, Settings(draws=draws), "planar", samples=64)
    widths = []
    for found in (vague, sharp):
        low, _, high = found.quantiles["touchdown_distance_m"]
        assert low < nominal < high
        widths.append(high - low)
        assert (found.jumps, found.jumps_share) == (64, 1.0)
    assert widths[1] < widths[0]
    assert (vague.calibrated, sharp.calibrated) == (False, True)
    share = [found.first_order["calibration"]["touchdown_distance_m"] for found in (vague, sharp)]
    assert share[1] < share[0]


def test_jumps_and_their_resampling_follow_from_the_seed(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    def found(seed: int) -> Uncertainty:
        return uncertain_jump(robot, Settings(), "planar", seed=seed, samples=32)

    one, again, other = (found(seed) for seed in (0, 0, 1))
    assert one == again
    assert one.quantiles != other.quantiles
    monkeypatch.setattr(priors, "sobol", lambda width, count, _: np.random.default_rng(0).random((count, width)))
    one, other = found(0), found(1)
    assert one.quantiles == other.quantiles
    assert one.interval != other.interval
    assert all(low < high for group in one.interval.values() for low, high in group.values())


def test_the_workshop_says_how_much_springs_scatter(robot: Robot) -> None:
    exact = replace(robot, workshop=workshop_with(robot.workshop, safety={"spring_rate_scatter": 0.0}))
    found = uncertain_jump(exact, Settings(), "planar", samples=32)
    assert found.first_order["springs"]["touchdown_distance_m"] == pytest.approx(0.0, abs=1e-9)


def at(robot: Robot, settings: Settings, share: float) -> tuple[Robot, Settings]:
    """Robot and settings with every input at the same share."""
    inputs = varied_inputs(robot, settings, np.full((1, 9), share))
    return changed(robot, settings, {name: values[0] for name, values in inputs.items()})


def test_inputs_are_spread_as_the_workshop_and_the_model_say(robot: Robot) -> None:
    """In the middle of every input the robot is as it was built; one standard deviation up, at a share of 0.8413:

    springs stiffer by half of the scatter, a mass of 1.04 (which acts as weaker springs), a floor of e^0.15 times its
    friction; links are longer or shorter by the tolerance at most.
    """
    shop, rubs, up = robot.workshop, coefficients(robot, Settings()), ndtr(1.0)
    scatter, tolerance = shop.safety.spring_rate_scatter, shop.fits.link_tolerance_mm
    for share, factor, rubber, efficiency in ((0.5, 1.0, 1.0, 0.95), (up, (1.0 + scatter / 2.0) / 1.04, 0.15, 1.0)):
        made, settings = at(robot, Settings(), share)
        assert made.spring.stiffness_nm_per_rad == pytest.approx(factor * robot.spring.stiffness_nm_per_rad)
        raised = (1.0, 1.0) if share == 0.5 else np.exp([rubber, 0.4])
        assert settings.ground_friction == pytest.approx(rubs.ground * raised[0])
        assert (settings.spring_efficiency, settings.pin_friction) == pytest.approx((efficiency, rubs.pin * raised[1]))
    for share, more in ((0.5, 0.0), (1.0 - 1e-9, tolerance), (1e-9, -tolerance)):
        found = at(robot, Settings(), share)[0].design
        for length in ("l2_mm", "l3_mm", "l4_mm"):
            assert getattr(found, length) == pytest.approx(getattr(robot.design, length) + more, abs=1e-6)


def test_what_workshop_and_settings_say_of_lengths_springs_floor_and_pins_is_what_varies(robot: Robot) -> None:
    """Sliding fits of 0.25 mm let links be 0.5 mm off; springs, floor and pins that were measured are the middle."""
    loose = replace(robot, workshop=varied(robot.workshop, {"fits.sliding_mm": 0.25}))
    points = np.array([[0.5, 0.5, 0.0, 1.0, 0.5, 0.0, 0.5, 0.5, 0.5]])
    for efficiency in (0.1, 0.6, 1.1):
        given = Settings(ground_friction=0.5, pin_friction=0.4, spring_efficiency=efficiency)
        inputs = varied_inputs(loose, given, points)
        assert inputs["lengths"][0] == pytest.approx([-0.5, 0.5, 0.0, -0.5])
        assert inputs["floor"][0] == pytest.approx([0.5])
        assert inputs["calibration"][0] == pytest.approx([efficiency, 0.4])


def test_draws_of_a_calibration_are_taken_in_pairs(robot: Robot) -> None:
    """Each as often as the others, the efficiency with the friction that was drawn with it."""
    draws = Draws(spring_efficiency=(0.9, 0.95, 1.0, 0.8), pin_friction=(0.1, 0.2, 0.3, 0.4))
    points = np.full((7, 8), 0.5)
    points[:, 0] = [0.0, 0.2499, 0.25, 0.5, 0.75, 1.0 - 1e-9, 1.0]
    pairs = varied_inputs(robot, Settings(draws=draws), points)["calibration"]
    assert pairs[:, 0].tolist() == [0.9, 0.9, 0.95, 1.0, 0.8, 0.8, 0.8]
    assert pairs[:, 1].tolist() == [0.1, 0.1, 0.2, 0.3, 0.4, 0.4, 0.4]


def test_the_polynomial_is_a_cubic() -> None:
    """Of a normal input, the third Hermite polynomial is explained, the fourth, which no cubic resembles, is not."""
    a = np.random.default_rng(0).standard_normal((4096, 1))
    found = _first_order({"a": a}, np.concatenate([a**3 - 3.0 * a, a**4 - 6.0 * a**2 + 3.0], axis=1), np.arange(4096))
    assert found[0, 0] == pytest.approx(1.0, abs=0.01)
    assert found[0, 1] < 0.3


def test_a_draw_that_cannot_be_built_counts_as_no_jump(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every fourth of 16 is refused: the share falls by a quarter, and the least of each figure is 0."""
    asked: list[str] = []

    def refusing(one: Robot, settings: Settings, engine: str) -> object:
        asked.append(engine)
        if len(asked) % 4 == 0:
            raise CannotBuildError("too long")
        return simulate(one, settings, engine)

    monkeypatch.setattr(uncertain, "simulate", refusing)
    found = uncertain.uncertain_jump(robot, Settings(), "planar", samples=16)
    assert (found.jumps, found.jumps_share) == (16, 0.75)
    assert all(quantiles[0] == 0.0 < quantiles[1] for quantiles in found.quantiles.values())
    assert found.to_dict()["jumps_share"] == 0.75


def test_robust_figures_are_of_robots_that_differ(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without differences they are those of the robot, on slippery floors alone those of the jump there."""
    settings, least = Settings(), robust_figures(robot, Settings(), 0.1)
    for share in (0.0, -1.0):
        points = np.zeros((16, 8))
        points[:, 7] = share
        monkeypatch.setattr(uncertain, "_differences", lambda points=points: points)
        floor = coefficients(robot, settings).ground * math.exp(0.3 * share)
        jump = simulate(robot, settings.model_copy(update={"ground_friction": floor}), "planar")
        found = robust_figures(robot, settings, 0.1)
        assert found["robust_touchdown_m"] == pytest.approx(jump.touchdown_distance_m, rel=1e-6)
        assert found["robust_pitch_deg"] == pytest.approx(abs(jump.touchdown_pitch_deg), abs=1e-3)
        assert least["robust_touchdown_m"] < found["robust_touchdown_m"] or share
        assert least["robust_pitch_deg"] > found["robust_pitch_deg"] or share


def test_a_robot_as_made_that_does_not_jump_has_fallen(robot: Robot) -> None:
    found = robust_figures(robot, Settings(takeoff_clearance_m=0.1), 0.1)
    assert found == {"robust_touchdown_m": 0.0, "robust_pitch_deg": 180.0}
