"""assembly.md: what to print, what to buy, which springs to order, and how it goes together."""

import math
from collections import Counter
from collections.abc import Iterator

from jumpcad.exporters.bom import bill_of_materials
from jumpcad.exporters.shapes import Shape
from jumpcad.exporters.steps import assembly_steps
from jumpcad.parts.part import Part
from jumpcad.robot import Robot


def write_guide(robot: Robot, pictures: bool = True) -> str:
    """Return the guide in Markdown; `pictures` says whether `pictures/step-N.png` are beside it."""
    lines = [
        f"# {robot.name}",
        "",
        f"{1000.0 * robot.mass_kg:.1f} g. Left and right are the robot's own, seen from above with the jump ahead.",
        *_tables(robot),
        *_springs(robot),
        *_steps(robot, pictures),
    ]
    return "\n".join(lines) + "\n"


def _tables(robot: Robot) -> Iterator[str]:
    items = bill_of_materials(robot)
    yield from ("", "## Print", "", "| part | copies | material | g each |", "|---|--:|---|--:|")
    for item in (item for item in items if item.kind == "printed"):
        yield f"| {item.name} | {item.quantity} | {item.material} | {1000.0 * item.mass_kg:.2f} |"
    yield from ("", "## Buy", "", "| article | quantity | g each |", "|---|--:|--:|")
    for item in (item for item in items if item.kind == "bought"):
        yield f"| {item.name} | {item.quantity} | {1000.0 * item.mass_kg:.2f} |"


def _springs(robot: Robot) -> Iterator[str]:
    """Yield the order for the spring maker."""
    if robot.plan is None:
        return
    spring = robot.plan.drive.spring
    rate = 1000.0 * spring.stiffness_nm_per_rad * math.pi / 180.0
    wind = math.degrees(robot.spring.wind_rad)
    yield from (
        "",
        "## Springs to order",
        "",
        "Two torsion springs, one wound left-hand and one right-hand, close-coiled, of patented spring steel wire:",
        "",
        f"- wire {spring.wire_mm:g} mm, inside diameter {spring.inside_diameter_mm:.2f} mm, {spring.turns:.2f} turns, "
        f"body at most {spring.body_length_mm:.1f} mm long when wound",
        f"- two straight arms of {spring.arm_length_mm:.1f} mm, {math.degrees(spring.free_arm_angle_rad):.0f}° apart "
        "when relaxed",
        f"- {rate:.2f} N·mm/° each; works from 0° to {wind:.1f}°, closing; {spring.stress_mpa:.0f} MPa at most "
        f"({spring.allowable_mpa:.0f} MPa allowed)",
    )


def _steps(robot: Robot, pictures: bool) -> Iterator[str]:
    for number, step in enumerate(assembly_steps(robot), start=1):
        yield from ("", f"## {number}. {step.title}", "", step.text, "")
        if pictures:
            yield from (f"![{step.title}](pictures/step-{number}.png)", "")
        for label, count in Counter(_label(shape) for shape in step.added if _counts(shape)).items():
            yield f"- {count} × {label}"


def _label(shape: Shape) -> str:
    source = shape.source
    return source.name if isinstance(source, Part) else source.article


def _counts(shape: Shape) -> bool:
    """Tell whether a shape is a thing of its own, not a piece of one that is listed elsewhere."""
    return isinstance(shape.source, Part) or shape.source.units > 0
