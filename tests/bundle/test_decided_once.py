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
from jumpcad.scene.assembly_steps import assembly_steps
from jumpcad.scene.visuals import visuals

DECIDES: tuple[Callable[..., object], ...] = (
    assembly_steps, bill_of_materials, chosen_parts, numbers, operation_values, packed, print_plates, soldering_svg,
    supply_of, visuals, wiring_of,
)  # fmt: skip


@pytest.mark.parametrize("pictures", [False, pytest.param(True, marks=pytest.mark.thorough)])
def test_an_export_decides_each_thing_once(tmp_path: Path, pictures: bool) -> None:
    codes = {getattr(decide, "__wrapped__", decide).__code__: decide.__name__ for decide in DECIDES}
    calls: Counter[str] = Counter()

    def count(frame: FrameType, event: str, _: object) -> None:
        code: CodeType = frame.f_code
        if event == "call" and code in codes:
            calls[codes[code]] += 1

    robot = replace(built("kenan-2.0"))  # which carries nothing yet
    before = sys.getprofile()
    sys.setprofile(count)
    try:
        export(robot, tmp_path / "kenan-2.0", pictures)
    finally:
        sys.setprofile(before)
    assert calls == dict.fromkeys(codes.values(), 1)
