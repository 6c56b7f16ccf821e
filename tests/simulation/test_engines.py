"""Both engines move a robot as mechanics says; how an engine is named and found."""

import itertools
import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.built import built
from support.flights import Flight

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, engines, simulate
from jumpcad.simulation.engines import default_engine, engine_named, require_engine
from jumpcad.simulation.mechanics import Mechanics

ENGINES = ["pybullet", "mujoco"]
FINE = Settings(dt_s=1 / 16000, solver_iterations=200)
"""Both engines are of first order in the step: conservation holds to that order."""


@pytest.mark.parametrize("engine", ENGINES)
def test_flight_keeps_momentum_and_follows_the_parabola(kenan: Robot, engine: str) -> None:
    """Once in the air, with springs, damping and loop at work inside: v_x is kept and v_z falls by g·t."""
    needs.package(engine)
    mechanics = Mechanics(kenan, 9.81)
    with engine_named(engine).world(kenan, FINE) as world:
        world.advance(round(0.070 / FINE.dt_s))
        before = world.state()
        world.advance(round(0.020 / FINE.dt_s))
        assert not world.loaded()
        after = world.state()
    change = mechanics.velocity_m_s(after) - mechanics.velocity_m_s(before)
    np.testing.assert_allclose(change, [0.0, 0.0, -9.81 * 0.020], atol=2e-4)


@pytest.mark.parametrize("engine", ENGINES)
def test_frictionless_ground_gives_no_forward_push(kenan: Robot, engine: str) -> None:
    """Without horizontal forces the centre of mass goes straight up."""
    needs.package(engine)
    ice = FINE.model_copy(update={"ground_friction": 0.0})
    with engine_named(engine).world(kenan, ice) as world:
        world.advance(round(0.050 / FINE.dt_s))
        velocity = Mechanics(kenan, 9.81).velocity_m_s(world.state())
    assert np.abs(velocity[:2]).max() < 3e-4 < 0.5 < velocity[2]


def test_without_damping_the_springs_energy_is_all_there(kenan: Robot) -> None:
    """No damping, no friction: nothing to lose, but for the engine's error at a fine step."""
    jump = simulate(kenan, FINE.model_copy(update={"joint_damping_nms_per_rad": 0.0, "ground_friction": 0.0}))
    assert jump.energy is not None
    assert jump.energy.joint_damping_j == 0.0
    assert abs(jump.energy.contact_j) < 0.002 * jump.spring_energy_j


def test_energy_budget_adds_up_to_the_springs_energy(jumping: list[Flight]) -> None:
    needs.package("pybullet")
    for flight, engine in itertools.product(jumping, ("pybullet", "planar")):
        jump = simulate(flight.robot, engine=engine)
        assert jump.energy is not None
        budget = vars(jump.energy)
        assert sum(budget.values()) == pytest.approx(jump.spring_energy_j, rel=1e-9)
        kept = sum(budget.values()) - jump.energy.joint_damping_j - jump.energy.slip_j - jump.energy.contact_j
        assert kept / jump.spring_energy_j == pytest.approx(jump.takeoff_energy_ratio, rel=1e-9)
        speed = (2 * (jump.energy.forward_j + jump.energy.upward_j) / jump.mass_kg) ** 0.5
        assert speed == pytest.approx(jump.takeoff_speed_m_s, rel=1e-4)


@pytest.mark.parametrize("engine", [*ENGINES, "planar"])
def test_dry_friction_in_the_joints_costs_energy(kenan: Robot, engine: str) -> None:
    """Three joints with dry friction take its torque times the angles that they turn, about δ each."""
    if engine != "planar":
        needs.package(engine)
    torque = 0.005
    undamped = Settings(joint_damping_nms_per_rad=0.0)
    free = simulate(kenan, undamped, engine)
    stiff = simulate(kenan, undamped.model_copy(update={"joint_friction_nm": torque}), engine)
    assert free.takeoff_energy_ratio is not None
    assert stiff.takeoff_energy_ratio is not None
    lost = (free.takeoff_energy_ratio - stiff.takeoff_energy_ratio) * kenan.spring.energy_j
    assert lost == pytest.approx(3 * torque * kenan.spring.wind_rad, rel=0.25)


@pytest.mark.parametrize(("engine", "torque_nm"), [("mujoco", 0.025), ("pybullet", 0.04)])
def test_a_leg_that_creeps_open_in_the_air_has_jumped(engine: str, torque_nm: float) -> None:
    """Dry friction lets it open until the robot is at its highest point; the planar engine knows no contact."""
    needs.package(engine)
    stiff = Settings(joint_friction_nm=torque_nm)
    jump, other = (simulate(built("kenan-2.0"), stiff, name) for name in (engine, "planar"))
    assert (jump.verdict, other.verdict) == ("jump", "jump")
    assert jump.ballistic_range_m == pytest.approx(other.ballistic_range_m, rel=0.01)
    assert jump.com_rise_m == pytest.approx(other.com_rise_m, rel=0.01)


@pytest.mark.parametrize("engine", ENGINES)
def test_froude_similarity(kenan: Robot, engine: str) -> None:
    """Four times as long, 4³ the mass, 4⁴ the stiffness, √4 the time: the same jump, four times as large."""
    needs.package(engine)
    scale = 4.0
    large = capsule_robot(kenan.design.model_copy(update={"carrying_link_mm": scale * kenan.design.carrying_link_mm}))
    bodies = {
        name: replace(large.bodies[name], mass_kg=body.mass_kg * scale**3, inertia_kg_m2=body.inertia_kg_m2 * scale**5)
        for name, body in kenan.bodies.items()
    }
    stiffness = kenan.spring.stiffness_nm_per_rad * scale**4
    large = replace(large, bodies=bodies, springs=(replace(large.spring, stiffness_nm_per_rad=stiffness),))
    small_jump, large_jump = (
        simulate(robot, Settings(dt_s=dt, solver_iterations=200, joint_damping_nms_per_rad=0.0), engine)
        for robot, dt in ((kenan, 1 / 8000), (large, 2 / 8000))
    )
    assert large_jump.fitness == pytest.approx(small_jump.fitness, rel=2e-3)


def test_a_missing_engine_is_said_with_the_way_out(kenan: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    engine_named.cache_clear()
    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(JumpcadError, match=r"pip install pybullet-arm64.*--engine mujoco works"):
        simulate(kenan, engine="pybullet")
    assert default_engine() == simulate(kenan).engine == "mujoco"
    monkeypatch.setitem(sys.modules, "mujoco", None)
    engine_named.cache_clear()
    with pytest.raises(JumpcadError, match=r"pip install mujoco; --engine pybullet works without it"):
        simulate(kenan, engine="mujoco")
    with pytest.raises(JumpcadError, match="no physics engine is installed"):
        default_engine()


def test_what_an_engine_writes_while_it_loads_is_not_seen(capfd: pytest.CaptureFixture[str]) -> None:
    """By the process itself, past Python; before and afterwards standard error is as it was, and no file stays open."""
    files = len(list(Path("/proc/self/fd").iterdir())) if Path("/proc/self/fd").exists() else 0
    os.write(2, b"before\n")
    with engines._silent_stderr():
        os.write(2, b"a banner\n")
    os.write(2, b"after\n")
    assert capfd.readouterr().err == "before\nafter\n"
    assert not files or len(list(Path("/proc/self/fd").iterdir())) == files


def test_an_engine_is_known_by_its_own_name_alone() -> None:
    """As it is a key of studies and files."""
    for name, told in (("mujico", r"\(did you mean mujoco"), ("Planar", r"\(did you mean planar"), ("", "planar")):
        with pytest.raises(JumpcadError, match=f"'{name}' is not an engine.*{told}"):
            require_engine(name)
