"""The public functions on robots. Where they take a robot, they take a design too, which is then built first."""

from pathlib import Path

from jumpcad import notebook
from jumpcad.arguments import check_arguments
from jumpcad.building import build
from jumpcad.bundle.export import export as export_robot
from jumpcad.bundle.manifest import Bundle
from jumpcad.checks import check as check_robot
from jumpcad.design import Design
from jumpcad.evaluation import evaluate
from jumpcad.findings import Finding
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import Jump
from jumpcad.simulation import simulate as simulate_mechanism
from jumpcad.simulation.chain import Chain

__all__ = ["build", "capsule_robot", "check", "evaluate", "export", "simulate"]

notebook.attach()


@check_arguments
def simulate(robot: Mechanism | Chain | Design, settings: Settings | None = None, engine: str = "pybullet") -> Jump:
    """Simulate the jump of a robot; see `jumpcad.simulation.simulate`.

    Parameters
    ----------
    robot
        A printed or a capsule robot, or that of `load_robot`; a design is built in the default workshop.
    settings, engine
        As for `jumpcad.simulation.simulate`.

    Raises
    ------
    JumpcadError
        If an argument is of another type, the engine is unknown or not installed, or cannot do what the settings ask.
    CannotBuildError
        If a design cannot be built.
    """
    return simulate_mechanism(build(robot) if isinstance(robot, Design) else robot, settings, engine)


@check_arguments
def check(robot: Mechanism | Design) -> list[Finding]:
    """Return the findings of every check on a robot, also of limits that are kept; see `jumpcad.checks.check`.

    Raises
    ------
    JumpcadError
        If it is neither robot nor design.
    CannotBuildError
        If a design cannot be built.
    """
    return check_robot(build(robot) if isinstance(robot, Design) else robot)


@check_arguments
def export(
    robot: Robot | Design,
    folder: str | Path,
    pictures: bool = True,
    step: bool = False,
    force: bool = False,
    ros2: bool = False,
) -> Bundle:
    """Write a robot's bundle; see `jumpcad.bundle.export.export`.

    Raises
    ------
    JumpcadError
        If an argument is of another type, or the bundle would replace a user's own files.
    CannotBuildError
        If a design cannot be built.
    """
    return export_robot(build(robot) if isinstance(robot, Design) else robot, folder, pictures, step, force, ros2)
