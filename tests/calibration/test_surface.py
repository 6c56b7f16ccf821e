"""The response surface against the engine, and why three coordinates are enough."""

from dataclasses import replace

import numpy as np
import pytest

from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import DT_S, FINE, NODES, Surface, _lines, surface_of
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.jump import Jump


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


def test_a_line_on_log_energy_pins_and_floor_is_met_everywhere(surface: Surface) -> None:
    """Of figures that are linear in each coordinate; a friction beyond the nodes is that of the nearest."""
    axes = [np.linspace(low, high, count) for (low, high), count in
            zip(((np.log(0.3), np.log(3.0)), (0.0, 0.9), (0.2, 1.3)), FINE, strict=True)]  # fmt: skip
    grid = np.meshgrid(*axes, indexing="ij")
    values = np.stack([*grid, grid[0] + 2.0 * grid[1]])
    straight = replace(surface, nodes=NODES, values=values)
    rng = np.random.default_rng(4)
    energy, pins, floor = rng.uniform(0.31, 2.9, 20), rng.uniform(0.0, 0.9, 20), rng.uniform(0.2, 1.3, 20)
    found = straight.at(energy, pins, floor)
    assert found.range_m == pytest.approx(np.log(energy))
    assert found.rise_m == pytest.approx(pins)
    assert found.forward_m_s == pytest.approx(floor)
    assert found.speed_m_s == pytest.approx(np.hypot(found.forward_m_s, found.up_m_s))
    assert np.tan(np.radians(found.angle_deg)) == pytest.approx(found.up_m_s / found.forward_m_s)
    beyond = straight.at(np.ones(2), np.array([-1.0, 2.0]), np.array([0.1, 5.0]))
    assert beyond.rise_m == pytest.approx([0.0, 0.9])
    assert beyond.forward_m_s == pytest.approx([0.2, 1.3])
    assert np.isnan(straight.at(np.array([0.299, 3.01]), np.zeros(2), np.ones(2)).range_m).all()


def test_between_the_nodes_at_which_it_jumps_a_line_is_met_and_outside_there_is_nothing() -> None:
    """Interpolation is exact on a straight line; what does not jump at a node is not guessed from its neighbours."""
    nodes, even = np.array([0.0, 1.0, 2.5, 3.0, 4.0]), np.linspace(0.0, 4.0, 17)
    found = _lines(np.array([np.nan, 3.0, 6.0, 7.0, np.nan]), nodes, even)
    inside = (even >= 1.0) & (even <= 3.0)
    assert np.isnan(found[~inside]).all()
    assert found[inside] == pytest.approx(1.0 + 2.0 * even[inside])
    hole = _lines(np.array([1.0, 3.0, np.nan, 7.0, 9.0]), nodes, even)
    assert hole == pytest.approx(1.0 + 2.0 * even)
    for known in ([], [2]):  # one node is no line
        values = np.full(5, np.nan)
        values[known] = 1.0
        assert np.isnan(_lines(values, nodes, even)).all()


def test_a_robot_that_never_jumps_has_no_surface(subject: Subject, monkeypatch: pytest.MonkeyPatch) -> None:
    stays = Jump("no_takeoff", "planar", 0.1, 0.2)
    monkeypatch.setattr("jumpcad.calibration.surface._jump", lambda *_: stays)
    with pytest.raises(JumpcadError, match="jumps with no energy, friction or floor that a calibration tries"):
        surface_of(subject.robot)
