"""What is decided about a robot is decided once in an export: the robot carries it, and the writers write."""

import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import CodeType, FrameType

import pytest
from support.built import built

from jumpcad.bundle.bom import bill_of_materials
from jumpcad.bundle.drawings.soldering import soldering_svg
from jumpcad.bundle.export import export
from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide.operation_values import operation_values
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import wiring_of
from jumpcad.electronics.supply import supply_of
from jumpcad.exporters.threemf import print_plates
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import assembly_steps
from jumpcad.scene.visuals import visuals

DECIDES: tuple[Callable[..., object], ...] = (
    assembly_steps, bill_of_materials, chosen_parts, numbers, operation_values, packed, print_plates, soldering_svg,
    supply_of, visuals, wiring_of,
)  # fmt: skip
ONCE = {decide.__name__: 1 for decide in DECIDES}


def test_an_export_decides_each_thing_once(small_robot: Robot, tmp_path: Path) -> None:
    assert decided(small_robot, tmp_path / "frog", pictures=False) == ONCE


@pytest.mark.thorough
def test_so_does_one_with_all_parts_and_pictures(tmp_path: Path) -> None:
    assert decided(built("kenan-2.0"), tmp_path / "kenan-2.0", pictures=True) == ONCE


def decided(robot: Robot, folder: Path, pictures: bool) -> Counter[str]:
    """Count what an export decides about a robot that carries nothing yet."""
    codes = {getattr(decide, "__wrapped__", decide).__code__: decide.__name__ for decide in DECIDES}
    calls: Counter[str] = Counter()

    def count(frame: FrameType, event: str, _: object) -> None:
        code: CodeType = frame.f_code
        if event == "call" and code in codes:
            calls[codes[code]] += 1

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        export(replace(robot), folder, pictures)
    finally:
        sys.setprofile(before)
    return calls
