"""Programs that pretend to be PrusaSlicer, and a robot to slice."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from jumpcad.printing import prusaslicer
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop

OBEDIENT = """
import sys
arguments = sys.argv[1:]
if "--help" in arguments:
    sys.exit(print("PrusaSlicer-2.9.1+fake based on Slic3r"))
value = lambda option: arguments[arguments.index(option) + 1]
settings = dict(line.rstrip("\\n").split(" = ", 1) for line in open(value("--load")) if " = " in line)
settings |= {"estimated printing time (normal mode)": "1h 2m 30s", "filament used [mm]": "100.00"}
TAMPER
with open(value("--output"), "w") as gcode:
    gcode.write("M83\\n;HEIGHT:0.2\\n;TYPE:Perimeter\\nG1 X0 Y0\\nG1 X10 Y0 E100\\n")
    gcode.writelines(f"; {key} = {value}\\n" for key, value in settings.items())
"""
"""Copies every setting; what replaces `TAMPER` may change them."""


def with_seams_behind(patch: pytest.MonkeyPatch) -> None:
    """Let PrusaSlicer put seams behind instead of where they are seen least, which takes it half of its time.

    Where a seam lies changes no plastic.
    """
    make = prusaslicer.slicer_settings
    patch.setattr(prusaslicer, "slicer_settings", lambda *workshop: make(*workshop) | {"seam_position": "rear"})


def pretend_slicer(program: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a Python program in the slicer's place; it is written to a folder."""
    programs = folder / "programs"
    programs.mkdir()
    (programs / "prusa-slicer").write_text(f"#!{sys.executable}\n{program}")
    (programs / "prusa-slicer").chmod(0o755)
    monkeypatch.setenv("PATH", str(programs))


def three_parts(robot: Robot) -> Robot:
    """Return a robot of a link of PETG, four rings of PETG and a plate of PLA."""
    parts = tuple(part for part in robot.parts if part.name in ("body_plate_left", "front_link", "ring"))
    return replace(robot, parts=parts, workshop=load_workshop("default"))
