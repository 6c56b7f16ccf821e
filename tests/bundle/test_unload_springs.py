"""The way out of loaded springs: an iron reaches the shaft's end, a stick the gear, no cutter the teeth in mesh."""

import numpy as np
import pytest
import trimesh
from support.built import built, geared, of_kit, placed

from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import chained

TIP_MM, SHANK_MM, TIP_LENGTH_MM = 2.0, 5.0, 8.0
"""A pencil iron: diameter of tip and of what follows it, length of the tip."""


ROBOTS = {
    "kenan-2.0": lambda: built("kenan-2.0"),
    "strong-2s": lambda: of_kit("strong-2s", "best-bo"),
    "two pairs of gears": geared,
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]()


def loaded(robot: Robot) -> dict[str, trimesh.Trimesh]:
    """Return all that is seen of a robot with loaded springs, by name, in the body's frame (mm)."""
    poses = body_poses(robot, 1.0)
    T_body_world = np.linalg.inv(poses[BODY])
    T_mm = np.diag([1000.0, 1000.0, 1000.0, 1.0])
    shown = {}
    for thing in visuals(robot):
        pose = T_mm @ T_body_world @ chained(poses[thing.body], thing.T_body_mesh) @ np.linalg.inv(T_mm)
        shown[thing.name] = thing.mesh.copy().apply_transform(pose)
    return shown


def rod(start: np.ndarray, end: np.ndarray, diameter_mm: float) -> trimesh.Trimesh:
    """Return a cylinder between two points."""
    return trimesh.creation.cylinder(diameter_mm / 2.0, segment=np.stack([start, end]), sections=24)


@pytest.mark.thorough
def test_an_iron_reaches_the_end_of_the_motors_shaft_through_the_left_plate(robot: Robot) -> None:
    things, (x, z) = loaded(robot), robot.layout.motor_mm
    shaft = things["motor_shaft"].bounds[1][1]
    outside = robot.layout.lateral.left_plate[1]
    iron = [
        rod(np.array([x, shaft + 0.05, z]), np.array([x, outside + TIP_LENGTH_MM, z]), TIP_MM),
        rod(np.array([x, outside + TIP_LENGTH_MM, z]), np.array([x, outside + 60.0, z]), SHANK_MM),
    ]
    for name, mesh in things.items():
        if name.startswith(("wiring", "tie", "tape")):
            continue  # laid where there is room
        for piece in iron:
            if (mesh.bounds[0] < piece.bounds[1]).all() and (piece.bounds[0] < mesh.bounds[1]).all():
                both = trimesh.boolean.intersection([mesh, piece], engine="manifold")
                assert both.is_empty or both.volume < 0.01, name
    assert shaft > robot.layout.lateral.left_plate[0] - 2.0  # it ends in the hole or just before it


def test_a_stick_reaches_a_quarter_of_the_cam_gears_rim(robot: Robot) -> None:
    """Of its rim, at the tips of the teeth, that much is outside both plates' convex outlines, seen from the side."""
    import shapely

    outlines = [
        shapely.convex_hull(shapely.multipoints(placed(robot, f"body_plate_{side}").vertices[:, [0, 2]]))
        for side in ("left", "right")
    ]
    radius = robot.layout.drive.train.stages[-1].wheel.tip_radius_mm
    angles = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    rim = robot.layout.cam_axis_mm + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    open_to = ~np.any([shapely.contains_xy(outline, *rim.T) for outline in outlines], axis=0)
    assert open_to.mean() > 0.25


@pytest.mark.thorough
def test_no_cutter_reaches_the_teeth_in_mesh(robot: Robot) -> None:
    """Jaws of 3 mm come to the pinion from no side within 30 degrees of them, along the gears or 30 degrees aside."""
    things, layout = loaded(robot), robot.layout
    wheel = layout.cam_axis_mm if layout.idler_mm is None else layout.idler_mm
    to_mesh = np.arctan2(*(wheel - layout.motor_mm)[::-1])
    middle = np.array([layout.motor_mm[0], sum(layout.lateral.gears[-1]) / 2.0, layout.motor_mm[1]])
    radius = layout.drive.train.stages[0].pinion.tip_radius_mm
    others = [mesh for name, mesh in things.items() if name not in ("motor_pinion", "motor_shaft")]
    for aside in np.radians([-30.0, -15.0, 0.0, 15.0, 30.0]):
        outwards = np.array([np.cos(to_mesh + aside), 0.0, np.sin(to_mesh + aside)])
        for tilt in np.radians([-30.0, 0.0, 30.0]):
            along = np.cos(tilt) * outwards + np.sin(tilt) * np.array([0.0, 1.0, 0.0])
            jaws = rod(middle + (radius - 1.0) * outwards, middle + (radius - 1.0) * outwards + 60.0 * along, 3.0)
            near = [m for m in others if (m.bounds[0] < jaws.bounds[1]).all() and (jaws.bounds[0] < m.bounds[1]).all()]
            cut = (trimesh.boolean.intersection([mesh, jaws], engine="manifold") for mesh in near)
            assert any(not both.is_empty and both.volume > 0.3 for both in cut), np.degrees([aside, tilt])
