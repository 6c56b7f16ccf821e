"""The last contact of a general engine before the springs are spent: the planar engine's take-off."""

from jumpcad.exporters import mjcf
from jumpcad.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation.engines import engine_named
from jumpcad.simulation.mechanics import Mechanics, ballistics
from jumpcad.simulation.run import AIRBORNE_S

GIVEN_UP_S = 0.3


def last_contact_range_m(robot: Robot, settings: Settings, engine: str) -> float | None:
    """Return the ballistic range after the last contact before the springs are spent; None if it does not fly."""
    mechanics = Mechanics(robot, settings.gravity_m_s2)
    hold = round(AIRBORNE_S / settings.dt_s)
    with engine_named(engine).world(robot, settings) as world:
        start = left = world.state()
        aloft = 0
        for _ in range(round(GIVEN_UP_S / settings.dt_s)):
            leg_rad = world.advance(1)
            aloft = 0 if world.loaded() else aloft + 1
            if aloft == 1:
                left = world.state()
            if leg_rad >= 0 and aloft >= hold and mechanics.velocity_m_s(world.state())[2] > 0:
                places = [mechanics.centre_of_mass_m(state) for state in (start, left)]
                return ballistics(*places, mechanics.velocity_m_s(left), settings.gravity_m_s2).range_m
    return None


def softer_mujoco_range_m(robot: Robot, settings: Settings, softness_steps: float) -> float | None:
    """Like `last_contact_range_m` in MuJoCo, contacts and loop with another time constant (of MuJoCo's own steps).

    At the usual 2 steps a sliding foot chatters; longer ones give way under it. Only many short steps avoid both.
    """
    usual = mjcf.SOFTNESS_STEPS
    mjcf.SOFTNESS_STEPS = softness_steps
    try:
        return last_contact_range_m(robot, settings, "mujoco")
    finally:
        mjcf.SOFTNESS_STEPS = usual
