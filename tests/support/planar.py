"""Moments of the planar engine: what tests of its kernel begin with."""

import math

from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.planar import PlanarWorld
from jumpcad.simulation.planar_model import Contact, Losses, PlanarModel, PlanarMotion, StepState, planar_model

NO_CONTACT = Contact(-1, -1, kernel.SEPARATE, 0.0, 0.0, 0.0)
FINE = Settings(dt_s=1 / 16000)


def moving(model: PlanarModel, leg_rad: float, height_m: float = 0.5) -> StepState:
    """Return a moment in the air in which everything moves."""
    speed = PlanarMotion(0.4 + 1.3j, 2.1, 9.0)
    return StepState(
        0.02 + 1j * height_m, 0.3, leg_rad, speed, NO_CONTACT, 0.0, Losses(0.0, 0.0, 0.0, 0.0, 0.0), math.inf, True
    )


def world_at(robot: Robot, moment: StepState, settings: Settings = FINE) -> PlanarWorld:
    """Return a planar world at a moment of its own."""
    world = PlanarWorld(robot, settings)
    world.go_to(moment)
    return world


def model_of(robot: Robot, settings: Settings = FINE) -> PlanarModel:
    """Return the model of a robot."""
    return planar_model(robot, settings)


def turn_of(moment: StepState) -> complex:
    """Return the turn of the foot as a complex number."""
    return complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))


def with_damping(settings: Settings, nms_per_rad: float = 0.0) -> Settings:
    """Return settings with other damping of the joints (N·m·s/rad)."""
    return settings.model_copy(update={"joint_damping_nms_per_rad": nms_per_rad})
