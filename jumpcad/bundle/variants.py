"""Robots as they may be made: lengths, springs, mass and friction within the tolerances of the workshop."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.bundle.atomic_write import require_place, write_folder
from jumpcad.bundle.manifest import Bundle
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.mjcf_robot import mjcf_files, write_robot
from jumpcad.exporters.urdf import urdf_files, write_urdf
from jumpcad.files.reading import to_csv
from jumpcad.mechanism.variants import with_length_errors, with_lengths, with_spring_factor
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.simulation.prior import FLOOR_SHARE, PIN_FRICTION, PRINTED_MASS_SHARE, Prior

Format = Literal["mjcf", "urdf"]
FORMATS: tuple[Format, ...] = get_args(Format)
TABLE = "variants.csv"
COLUMNS = ("name", "l2_mm", "l3_mm", "l4_mm", "l5_mm", "stiffness_nmm_per_deg", "mass_g", "foot_friction",
           "body_friction", "pin_friction")  # fmt: skip
"""Columns of the table of what differs; stiffness is that of both springs, friction the coefficients."""


@check_arguments
def variants(robot: Robot, count: int = 100, seed: int = 0) -> tuple[Robot, ...]:
    """Return robots as they may be made of a design: named, with parts and workshop of the robot itself.

    Links have errors within two sliding fits, evenly spread; the rate of springs scatters by half of
    `safety.spring_rate_scatter` (a standard deviation), masses by 4 %, the friction of floor and pins as that of
    untested ones, as in `jumpcad simulate --uncertain`. The first robots are the same for any count.

    Raises
    ------
    JumpcadError
        If count is no whole number from 1 to 100,000.
    """
    rng = np.random.default_rng(seed)
    return tuple(_varied(robot, f"{robot.name or 'robot'}-{number:03d}", rng) for number in range(1, count + 1))


def _varied(robot: Robot, name: str, rng: np.random.Generator) -> Robot:
    workshop = robot.workshop
    error_mm = workshop.fits.link_tolerance_mm * rng.uniform(-1.0, 1.0, 4)
    rate = Prior("normal", 1.0, workshop.safety.spring_rate_scatter / 2.0, "workshop", 0.3)
    mass = Prior("normal", 1.0, PRINTED_MASS_SHARE, "model", 0.3)
    stiffer, heavier, ground, pins = rng.normal(size=4)
    made = with_lengths(robot, with_length_errors(robot.design, error_mm))
    made = with_spring_factor(made, float(rate.at(stiffer)))
    factor, floor = float(mass.at(heavier)), math.exp(FLOOR_SHARE * ground)
    bodies = {
        key: replace(body, mass_kg=factor * body.mass_kg, inertia_kg_m2=factor * body.inertia_kg_m2)
        for key, body in made.bodies.items()
    }
    rubs = made.friction and replace(
        made.friction, foot=floor * made.friction.foot, body=floor * made.friction.body,
        pin=math.exp(PIN_FRICTION.second * pins) * made.friction.pin,
    )  # fmt: skip
    return replace(made, name=name, bodies=bodies, friction=rubs)


@check_arguments
def export_variants(
    robot: Robot, made: Sequence[Robot], folder: str | Path, kind: Format = "mjcf", force: bool = False
) -> Bundle:
    """Write variants of a robot to a folder, with one set of meshes, as in a bundle, and a table of what differs."""
    require_place(folder)
    facts = {"variants": [one.name for one in made], "format_of_variants": kind}
    return write_folder(folder, f"{robot.name}-variants", facts, _contents(robot, made, kind), force)


def _contents(robot: Robot, made: Sequence[Robot], kind: Format) -> Iterator[tuple[str, str | bytes]]:
    exporters = (urdf_files, mjcf_files) if kind == "mjcf" else (urdf_files,)
    yield from ((path, data) for files in exporters for path, data in files(robot) if "/meshes/" in path)
    seen = visuals(robot)
    for one in made:
        if kind == "mjcf":
            yield f"mjcf/{one.name}.xml", write_robot(one, seen)
        else:
            yield f"urdf/{one.name}.urdf", write_urdf(one, seen)
            yield f"urdf/{one.name}.loop.json", write_loop(one)
    yield TABLE, to_csv([COLUMNS, *map(_row, made)])


def _row(one: Robot) -> list[object]:
    design, rubs = one.design, one.friction
    stiffness = math.radians(1000.0 * one.spring.stiffness_nm_per_rad)
    figures = [*design.links_mm, stiffness, 1000.0 * one.mass_kg]
    figures += [rubs.foot, rubs.body, rubs.pin] if rubs else []
    return [one.name, *(f"{value:.6g}" for value in figures)]
