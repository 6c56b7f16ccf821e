"""The stop's pad: it halts the leg and does not throw it back."""

import pytest
from support import needs
from support.built import built

from jumpcad.exporters.mjcf import SUBSTEPS
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.simulation import Settings
from jumpcad.simulation.engines import engine_named

BEYOND_RAD = 0.5
"""Past the stop: so far that a pad would push much more than is needed to halt the leg."""


@pytest.mark.parametrize(("engine", "substeps"), [("pybullet", 1), ("mujoco", SUBSTEPS)])
@pytest.mark.parametrize("dt_s", [0.0005, 0.0001])
def test_the_leg_is_halted_within_one_of_the_engines_own_steps(engine: str, substeps: int, dt_s: float) -> None:
    """By the leg's inertia times its rate over the step."""
    needs.package(engine)
    robot, rate = built("kenan-2.0"), 1e-3
    assert robot.stop is not None
    with engine_named(engine).world(robot, Settings(dt_s=dt_s)) as world:
        held = world._pad.torque_nm(robot.stop.angle_rad + BEYOND_RAD, rate)
    inertia = leg_inertia_kg_m2(robot, robot.stop.angle_rad)
    assert held == pytest.approx(inertia * rate * substeps / dt_s)
