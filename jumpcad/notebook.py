"""Pictures and tables in a notebook, by the method `_repr_html_` of objects; a robot's page by its method `show`.

A robot is drawn by packages that import it, so it cannot import them: `attach` gives the classes their method.
"""

import base64
import importlib
import sys
import tempfile
import webbrowser
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from pathlib import Path

from jumpcad.bundle.export import report_page
from jumpcad.bundle.renders import rest_picture
from jumpcad.evaluation import EvaluationResult
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump

PICTURE_SIZE = (420, 315)
PAGE_PIXELS = 720
"""Height of a page below a notebook's cell; judgement: viewer and controls are seen whole."""
Line = tuple[str, str]


def attach() -> None:
    """Give robots, jumps and evaluations their `_repr_html_`, and printed robots `show`."""
    for kind, html in ((Mechanism, robot_html), (Jump, jump_html), (EvaluationResult, evaluation_html)):
        setattr(kind, "_repr_html_", html)  # noqa: B010  a class does not declare it
    setattr(Robot, "show", show)  # noqa: B010  declared for type checkers only


@dataclass(frozen=True)
class ShownPage:
    """A page that a notebook shows in a frame of its own, whose program runs there."""

    html: str

    def _repr_html_(self) -> str:
        frame = f'width="100%" height="{PAGE_PIXELS}" style="border: 0" title="report"'
        return f'<iframe {frame} srcdoc="{escape(self.html)}"></iframe>'


def show(robot: Robot) -> Path | None:
    """Show the robot's report page: in a notebook below the cell, elsewhere in the web browser.

    Returns
    -------
    Path or None
        The temporary file that the browser opens, which is kept; None in a notebook. A browser installed as a snap
        cannot read the system's temporary folder: set TMPDIR to a folder in your home.
    """
    page = report_page(robot)
    ipython = sys.modules.get("IPython")  # a notebook has loaded it, and has a kernel, unlike IPython's terminal
    if getattr(ipython and ipython.get_ipython(), "kernel", None) is not None:
        importlib.import_module("IPython.display").display(ShownPage(page))
        return None
    with tempfile.NamedTemporaryFile("w", prefix="jumpcad-", suffix=".html", encoding="utf-8", delete=False) as stream:
        stream.write(page)
    path = Path(stream.name)
    webbrowser.open(path.as_uri())
    return path


def robot_html(robot: Mechanism) -> str:
    """Return the picture of a printed robot at rest, and key figures of any mechanism."""
    lines = [
        ("mass", f"{1000.0 * robot.mass_kg:.1f} g"),
        ("spring energy", f"{robot.spring.energy_j:.3f} J"),
        ("longest link", f"{robot.design.l_max_mm:.1f} mm"),
    ]
    if not isinstance(robot, Robot):
        return figures_table(robot.name, lines)
    lines += [
        ("printed parts", str(sum(part.quantity for part in robot.parts))),
        ("bought parts", str(len(robot.hardware))),
        ("printer", robot.workshop.printer.name),
    ]
    (width, height), data = PICTURE_SIZE, base64.b64encode(rest_picture(robot, PICTURE_SIZE)).decode("ascii")
    picture = f'<img width="{width}" height="{height}" alt="the robot at rest" src="data:image/png;base64,{data}">'
    return picture + figures_table(robot.name, lines)


def jump_html(jump: Jump) -> str:
    """Return the key figures of a jump, or why there is none."""
    return figures_table("jump", [*_jump_lines(jump), *_error_lines(jump.findings)])


def evaluation_html(result: EvaluationResult) -> str:
    """Return the key figures of an evaluated design, and what rejects it."""
    lines = [
        *_jump_lines(result.jump),
        ("winding time", f"{result.metrics['winding_time_s']:.1f} s"),
        ("winding energy (electrical)", f"{result.metrics['electrical_energy_j']:.2f} J"),
    ]
    return figures_table(result.robot.name or "evaluation", [*lines, *_error_lines(result.findings)])


def _jump_lines(jump: Jump) -> list[Line]:
    figures = (
        ("touchdown distance", jump.touchdown_distance_m, "{:.3f} m"),
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


def figures_table(title: str, lines: Iterable[Line]) -> str:
    """Return a table of names and values under a title."""
    rows = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in lines)
    return f"<table><caption>{escape(title)}</caption>{rows}</table>"
