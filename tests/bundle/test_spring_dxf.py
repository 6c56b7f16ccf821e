"""The drawings of the springs as DXF, read by ezdxf."""

import io
import math
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import pytest
from support.built import built

from jumpcad.bundle.drawings.spring_sheet import spring_dxfs, spring_sheets


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_arms_are_tangents_of_the_coil_at_the_ordered_angle(name: str) -> None:
    robot = built(name)
    spring = robot.layout.drive.spring
    drawings = dict(spring_dxfs(robot))
    assert sorted(drawings) == ["order/spring-left-hand.dxf", "order/spring-right-hand.dxf"]
    turns = []
    for text in drawings.values():
        space = ezdxf.read(io.StringIO(text)).modelspace()
        radii = sorted(circle.dxf.radius for circle in space.query("CIRCLE"))
        assert radii[1] - radii[0] == pytest.approx(spring.wire_mm)
        relaxed = [np.array(line.get_points("xy")) for line in space.query('LWPOLYLINE[layer=="WIRE"]')]
        for start, end in relaxed:
            assert start @ (end - start) == pytest.approx(0.0, abs=1e-6)
            assert np.linalg.norm(start) == pytest.approx(np.mean(radii))
            assert np.linalg.norm(end - start) == pytest.approx(spring.arm_length_mm)
        (loaded,) = (np.array(line.get_points("xy")) for line in space.query('LWPOLYLINE[layer=="LOADED"]'))
        far, near, wound = (line[1] - line[0] for line in (*relaxed, loaded))
        assert _between_deg(far, near) == pytest.approx(math.degrees(spring.free_arm_angle_rad), abs=1e-4)
        assert _between_deg(far, wound) == pytest.approx(math.degrees(spring.wound_rad), abs=1e-4)
        turns.append(np.sign(np.cross([*far, 0.0], [*wound, 0.0])[2]))
        words = sorted(space.query("TEXT"), key=lambda one: -one.dxf.insert.y)  # from above
        assert words[0].dxf.text.startswith(f"robot: {name}")
        # beside the arms, wherever these point
        assert min(one.dxf.insert.x for one in words) > radii[1] + spring.arm_length_mm
        assert any("N·mm/°" in one.dxf.text for one in words)
        assert {one.dxf.insert.x for one in words} == {words[0].dxf.insert.x}
        assert {one.dxf.height for one in words} == {2.0}
        assert np.diff([one.dxf.insert.y for one in words]) == pytest.approx(-3.5)  # lines below each other
        assert {one.dxf.layer for one in words} == {"TEXT"}
        widths = [line.dxf.const_width for line in space.query("LWPOLYLINE")]
        assert widths == pytest.approx([spring.wire_mm, spring.wire_mm, 0.0])
        assert {tuple(circle.dxf.center) for circle in space.query("CIRCLE")} == {(0.0, 0.0, 0.0)}
        assert {circle.dxf.layer for circle in space.query("CIRCLE")} == {"WIRE"}
        assert 2.0 * radii[0] == pytest.approx(spring.inside_diameter_mm)
    assert list(drawings) == ["order/spring-right-hand.dxf", "order/spring-left-hand.dxf"]
    # seen along its axis a right-hand coil goes away clockwise; loading winds it further, as DXF has y up
    assert turns == [-1.0, 1.0]


@pytest.mark.parametrize(("hand", "rises"), [("right", 1.0), ("left", -1.0)])
def test_in_front_the_wire_of_a_right_hand_coil_rises_to_the_right(hand: str, rises: float) -> None:
    """As the thread of a usual screw; SVG has y down. The side view's axis is upright at x = 200."""
    (drawing,) = (text for path, text in spring_sheets(built("kenan-2.0")) if path == f"order/spring-{hand}-hand.svg")
    lines = [
        [float(line.get(key, "")) for key in ("x1", "y1", "x2", "y2")]
        for line in ET.fromstring(drawing).iter("{http://www.w3.org/2000/svg}line")
        if line.get("stroke") == "#4d535c" and float(line.get("x1", "")) > 150.0
    ]
    assert len(lines) > 3
    for x0, y0, x1, y1 in lines:
        assert (x0 + x1) / 2.0 == pytest.approx(200.0, abs=0.01)
        assert np.sign((y0 - y1) * (x1 - x0)) == rises


def _between_deg(one: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two vectors (2,)."""
    return float(np.degrees(np.arccos(one @ other / np.linalg.norm(one) / np.linalg.norm(other))))
