"""Collision shapes: capsules along the links, and a box about the body that never reaches the ground."""

import numpy as np
import pytest
from support.built import built
from support.decimals import decimals

from jumpcad.exporters.collision import body_box, capsules
from jumpcad.mechanism.model import BODY, BODY_NAMES
from jumpcad.mechanism.poses import body_poses
from jumpcad.scene.visuals import visuals


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_capsules_lie_along_the_links_and_the_toes(name: str) -> None:
    """Six tenths of the ankle's height thick; toes no thicker than eight tenths of the spheres at their tips."""
    robot = built(name)
    design = robot.design
    lengths = dict(zip(BODY_NAMES, (0.0, design.l2_mm, design.l3_mm, design.l4_mm), strict=True))
    for body, length in lengths.items():
        shapes = list(capsules(robot, body))
        toes = [one for one in robot.bodies[body].contacts if one.surface == "foot" and one.centre_m[0] < 0.0]
        assert len(shapes) == (length > 0.0) + len(toes)
        if length:
            link = shapes.pop(0)
            assert link.start_m.tolist() == [0.0, 0.0, 0.0]
            assert link.end_m == pytest.approx([length / 1000.0, 0.0, 0.0])
            assert link.radius_m == pytest.approx(0.6 * robot.foot_depth_m, abs=1e-6)
        assert decimals([[one.end_m, one.radius_m] for one in shapes]) <= 6  # micrometres
        for shape, toe in zip(shapes, toes, strict=True):
            assert shape.end_m == pytest.approx(toe.centre_m, abs=1e-6)
            assert shape.radius_m == pytest.approx(min(0.6 * robot.foot_depth_m, 0.8 * toe.radius_m), abs=1e-6)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_box_holds_the_bodys_parts_above_a_millimetre_over_the_ground(name: str) -> None:
    robot = built(name)
    seen = visuals(robot)
    box = body_box(robot, seen)
    assert box is not None
    assert decimals([box.low_m, box.high_m]) == 4  # tenths of a millimetre
    points = np.concatenate(
        [
            one.mesh.vertices / 1000.0 @ one.T_body_mesh[:3, :3].T + one.T_body_mesh[:3, 3]
            for one in seen
            if one.body == BODY
        ]
    )
    low, high = points.min(axis=0), points.max(axis=0)
    assert (box.high_m > high - 1e-4).all()  # a turned part's own box is larger
    assert (box.high_m < high + 0.006).all()
    assert (box.low_m[:2] < low[:2] + 1e-4).all()
    assert (box.low_m[:2] > low[:2] - 0.006).all()
    pose = body_poses(robot, 1.0)[BODY]
    corners = np.array([[x, 0.0, box.low_m[2]] for x in (box.low_m[0], box.high_m[0])])
    heights = corners @ pose[:3, :3].T[:, 2] + pose[2, 3]
    assert heights.min() >= 0.001 - 1e-4
    raised = box.low_m[2] > low[2] + 2e-4
    assert not raised or heights.min() == pytest.approx(0.001, abs=2e-4)
    assert box.low_m[2] > low[2] - 0.006
    assert body_box(robot, [one for one in seen if one.body != BODY]) is None
