"""The response surface against the engine, and why three coordinates are enough."""

from dataclasses import replace

import numpy as np
import pytest

from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import DT_S, Surface
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.simulation import simulate


def test_it_is_the_engine_at_its_nodes(surface: Surface, subject: Subject) -> None:
    settings = Settings(dt_s=DT_S, pin_friction=0.3, ground_friction=0.5)
    for energy in (1.0, 1.6):
        jump = simulate(with_spring_factor(subject.robot, energy), settings, "planar")
        found = surface.at(np.array([energy]), np.array([0.3]), np.array([0.5]))
        assert jump.ballistic_range_m is not None
        # The surface is linear between even points, which are not the nodes.
        assert found.range_m[0] == pytest.approx(jump.ballistic_range_m, rel=5e-3)
        assert found.rise_m[0] == pytest.approx(jump.com_rise_m, rel=5e-3)
        assert found.speed_m_s[0] == pytest.approx(jump.takeoff_speed_m_s, rel=5e-3)
        assert found.angle_deg[0] == pytest.approx(jump.takeoff_angle_deg, rel=5e-3)


def test_its_error_is_said(surface: Surface) -> None:
    """A coarse grid: within 1 % where the foot sticks, within 5 % where it begins to slip."""
    assert 0.0 < surface.error < 0.01
    assert surface.errors.max() < 0.05


def test_weaker_springs_are_a_heavier_robot(subject: Subject) -> None:
    """Newton: with all masses and the stiffness k times as large, every path is the same."""
    robot, factor = subject.robot, 1.3
    bodies = {
        name: replace(body, mass_kg=factor * body.mass_kg, inertia_kg_m2=factor * body.inertia_kg_m2)
        for name, body in robot.bodies.items()
    }
    weak = with_spring_factor(robot, 1.0 / factor)
    heavy = replace(robot, bodies=bodies, roller_off=weak.roller_off)
    one, other = (simulate(each, Settings(), "planar") for each in (heavy, weak))
    assert one.ballistic_range_m == pytest.approx(other.ballistic_range_m, rel=1e-5)
    assert one.com_rise_m == pytest.approx(other.com_rise_m, rel=1e-5)


def test_no_jump_is_no_number(surface: Surface) -> None:
    found = surface.at(np.array([0.2, 3.0, 1.0]), np.full(3, 0.25), np.full(3, 0.8))
    assert np.isnan(found.range_m).tolist() == [True, True, False]
