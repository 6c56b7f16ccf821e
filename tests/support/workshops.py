"""Workshops with some of their values changed."""

from dataclasses import replace
from typing import Any

from jumpcad.electronics.supply import chosen_parts
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, load_workshop


def workshop_with(workshop: Workshop | None = None, /, **sections: dict[str, Any]) -> Workshop:
    """Return a workshop, the default one if none is given, with some values of some sections changed, unchecked."""
    workshop = workshop or load_workshop("default")
    parts = {name: getattr(workshop, name).model_copy(update=values) for name, values in sections.items()}
    return workshop.model_copy(update=parts)


def rewired(robot: Robot, workshop: Workshop) -> Robot:
    """Return a robot with the electrical parts of another workshop, the rest as it was."""
    electronics = replace(robot.layout.electronics, **vars(chosen_parts(workshop)))
    return replace(robot, workshop=workshop, layout=replace(robot.layout, electronics=electronics))
