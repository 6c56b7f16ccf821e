"""The public functions on robots. Where they take a robot, they take what `build` takes too, and build it first."""

from pathlib import Path

from jumpcad import notebook
from jumpcad.arguments import check_arguments
from jumpcad.bundle.export import export as export_robot
from jumpcad.bundle.manifest import Bundle, robot_of
from jumpcad.checks import check as check_robot
from jumpcad.design import Design
from jumpcad.evaluation import evaluate
from jumpcad.findings import Finding
from jumpcad.mechanism.model import Mechanism, Multibody
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import Jump
from jumpcad.simulation import simulate as simulate_mechanism
from jumpcad.workshop import Workshop

__all__ = ["build", "capsule_robot", "check", "evaluate", "export", "simulate"]

notebook.attach()


@check_arguments
def build(design: Design | str | Path, workshop: Workshop | None = None, name: str | None = None) -> Robot:
    """Build the printed robot of a design, a template, a design file or a bundle, as the command line does.

    Parameters
    ----------
    design
        What to build. A template's name brings its own workshop, a bundle what it was built from.
    workshop
        In which it is built; by default the design's own, `design.workshop_name`.
    name
        Engraved on its plates unless it is empty: by default that of template, file or bundle, `robot` for a design.

    Raises
    ------
    JumpcadError
        If an argument has a wrong type or cannot be read; if design or workshop were changed to invalid values, or has
        the weight of a part that no robot has; if the name cannot be a file's name.
    CannotBuildError
        If the mechanism cannot work or cannot be laid out; the message names the reason and what to change.
    """
    return robot_of(design, workshop, name)


@check_arguments
def simulate(
    robot: Multibody | Design | str | Path, settings: Settings | None = None, engine: str | None = None
) -> Jump:
    """Simulate the jump of a robot; see `jumpcad.simulation.simulate`.

    Parameters
    ----------
    robot
        A printed or a capsule robot, that of `load_robot`, or what `build` takes.
    settings, engine
        As for `jumpcad.simulation.simulate`.

    Raises
    ------
    JumpcadError
        If an argument is of another type, the engine is unknown or not installed, or cannot do what the settings ask.
    CannotBuildError
        If a design cannot be built.
    """
    return simulate_mechanism(robot_of(robot) if isinstance(robot, Design | str | Path) else robot, settings, engine)


@check_arguments
def check(robot: Mechanism | Design | str | Path) -> list[Finding]:
    """Return the findings of every check on a robot, also of limits that are kept; see `jumpcad.checks.check`.

    Raises
    ------
    JumpcadError
        If it is neither robot nor design.
    CannotBuildError
        If a design cannot be built.
    """
    return check_robot(robot_of(robot) if isinstance(robot, Design | str | Path) else robot)


@check_arguments
def export(
    robot: Robot | Design | str | Path, folder: str | Path, pictures: bool = True, step: bool = False,
    force: bool = False, ros2: bool = False,
) -> Bundle:  # fmt: skip
    """Write a robot's bundle; see `jumpcad.bundle.export.export`.

    Raises
    ------
    JumpcadError
        If an argument is of another type, or the bundle would replace a user's own files.
    CannotBuildError
        If a design cannot be built.
    """
    made = robot_of(robot) if isinstance(robot, Design | str | Path) else robot
    return export_robot(made, folder, pictures, step, force, ros2)
