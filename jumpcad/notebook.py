"""Pictures and tables in a notebook, by the method `_repr_html_` of objects.

A robot is drawn by packages that import it, so it cannot import them: `attach` gives the classes their method.
"""

import base64
from collections.abc import Iterable
from html import escape

from jumpcad.bundle.renders import rest_picture
from jumpcad.evaluation import EvaluationResult
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot import Robot
from jumpcad.simulation import Jump

PICTURE_SIZE = (420, 315)
Line = tuple[str, str]


def attach() -> None:
    """Give robots, jumps and evaluations their `_repr_html_`."""
    for kind, html in ((Mechanism, robot_html), (Jump, jump_html), (EvaluationResult, evaluation_html)):
        setattr(kind, "_repr_html_", html)  # noqa: B010  a class does not declare it


def robot_html(robot: Mechanism) -> str:
    """Return the picture of a printed robot at rest, and key figures of any mechanism."""
    lines = [
        ("mass", f"{1000.0 * robot.mass_kg:.1f} g"),
        ("spring energy", f"{robot.spring.energy_j:.3f} J"),
        ("longest link", f"{robot.design.l_max_mm:.1f} mm"),
    ]
    if not isinstance(robot, Robot):
        return _table(robot.name, lines)
    lines += [
        ("printed parts", str(sum(part.quantity for part in robot.parts))),
        ("bought parts", str(len(robot.hardware))),
        ("printer", robot.workshop.printer.name),
    ]
    return _picture(rest_picture(robot, PICTURE_SIZE)) + _table(robot.name, lines)


def jump_html(jump: Jump) -> str:
    """Return the key figures of a jump, or why there is none."""
    return _table("jump", [*_jump_lines(jump), *_error_lines(jump.findings)])


def evaluation_html(result: EvaluationResult) -> str:
    """Return the key figures of an evaluated design, and what rejects it."""
    lines = [
        *_jump_lines(result.jump),
        ("winding time", f"{result.metrics['winding_time_s']:.1f} s"),
        ("winding energy (electrical)", f"{result.metrics['electrical_energy_j']:.2f} J"),
    ]
    return _table(result.robot.name or "evaluation", [*lines, *_error_lines(result.findings)])


def _jump_lines(jump: Jump) -> list[Line]:
    figures = (
        ("ballistic range", jump.ballistic_range_m, "{:.3f} m"),
        ("rise of the centre of mass", jump.com_rise_m, "{:.3f} m"),
        ("fitness (range / longest link)", jump.fitness, "{:.2f}"),
        ("mass", jump.mass_kg, "{:.4f} kg"),
        ("spring energy", jump.spring_energy_j, "{:.3f} J"),
        ("energy at take-off / spring energy", jump.takeoff_energy_ratio, "{:.3f}"),
    )
    lines = [(label, form.format(value)) for label, value, form in figures if value is not None]
    return [("verdict", f"{jump.verdict} ({jump.engine})"), *lines]


def _error_lines(findings: Iterable[Finding]) -> list[Line]:
    return [(f"error: {finding.name}", f"{finding.message}; {finding.remedy}") for finding in errors(findings)]


def _picture(png: bytes) -> str:
    width, height = PICTURE_SIZE
    data = base64.b64encode(png).decode("ascii")
    return f'<img width="{width}" height="{height}" alt="the robot at rest" src="data:image/png;base64,{data}">'


def _table(title: str, lines: Iterable[Line]) -> str:
    rows = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in lines)
    return f"<table><caption>{escape(title)}</caption>{rows}</table>"
