"""The rest stop's bar on its mesh: deepest where the leg hits, a seat for the pad, a tab in each plate."""

import numpy as np
import pytest
from support.built import cut, part, placed, region

from jumpcad.robot.robot import Robot


def test_tabs_stand_in_the_plates_slots(robot: Robot) -> None:
    """Pressed in: 0.1 mm on every side of the section."""
    for side, plate in (("left", robot.layout.lateral.left_plate), ("right", robot.layout.lateral.right_plate)):
        y = sum(plate) / 2.0
        tab, around = (region(cut(placed(robot, name), y)) for name in ("stop_bar", f"body_plate_{side}"))
        assert tab.intersection(around).area < 1e-3
        assert tab.buffer(robot.workshop.fits.press_mm + 0.01, join_style="mitre").intersection(around).length > 17.9


def test_the_pad_lies_in_its_seat_before_the_bar(robot: Robot) -> None:
    """Glued to the seat's floor, 0.02 mm before it, it stands out towards the leg by its thickness less 0.6 mm."""
    bar = part(robot, "stop_bar")
    item = next(one for one in robot.hardware if one.name == "stop_pad")
    pad = item.shown_mesh.copy().apply_transform(np.linalg.inv(bar.placements[0].T_body_part) @ item.T_body_part)
    thick = robot.layout.stop.pad.thickness_mm
    assert pad.bounds[:, 1] == pytest.approx([-0.6, thick - 0.6], abs=2e-3)
    assert pad.bounds[:, 2] == pytest.approx([0.0, 8.0], abs=2e-3)
    assert (pad.bounds[0, 0] + pad.bounds[1, 0]) / 2.0 == pytest.approx(0.0, abs=1e-3)
