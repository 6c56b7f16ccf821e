"""The drawings of the springs as DXF, read by ezdxf."""

import io
import math

import ezdxf
import numpy as np
import pytest
from support.built import built

from jumpcad.bundle.spring_dxf import spring_dxfs


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
        assert any("N·mm/°" in one.dxf.text for one in space.query("TEXT"))
    assert turns == [-turns[1], turns[1]]  # mirror images


def _between_deg(one: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two vectors (2,)."""
    return float(np.degrees(np.arccos(one @ other / np.linalg.norm(one) / np.linalg.norm(other))))
