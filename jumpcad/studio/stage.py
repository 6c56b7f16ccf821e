"""The studio's 3-D scene: frames of the bodies, meshes of the parts (sent again only if changed), a ghost robot."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.design import Design
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.surface import seen
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.solids.tube import Wire
from jumpcad.transforms import Array

WRONG = (0.80, 0.16, 0.14)
"""Colour of a part that violates a limit."""
SIDE, MIDDLE = np.array((0.7, -1.3, 0.7)), np.array((0.15, 0.0, 0.35))
"""First position of the camera, and the point at which it looks, over the robot's size."""
GHOST_COLOUR, GHOST_OPACITY = (0.5, 0.55, 0.6), 0.25


class Stage:
    """What a viser server shows; names of nodes are `/robot/BODY/PART` and `/ghost/BODY/PART`."""

    def __init__(self, server: Any) -> None:
        self.server = server
        self.meshes: dict[str, tuple[object, Any]] = {}
        self.frames: dict[str, Any] = {}
        server.scene.set_up_direction("+z")
        server.scene.add_grid("/ground", 4.0, 4.0, cell_size=0.05, section_size=0.5, cell_thickness=0.5)

    def look_at(self, design: Design) -> None:
        """Put the camera of pages that are opened from now on where it sees a design's robot."""
        size_m = design.carrying_link_mm * (1.0 + design.e_coef) / 1000.0
        camera = self.server.initial_camera
        camera.position, camera.look_at = tuple(size_m * SIDE), tuple(size_m * MIDDLE)

    def show(self, robot: Robot, wrong: frozenset[str] = frozenset()) -> int:
        """Show a robot at rest, the parts named in `wrong` in red; return how many meshes were sent."""
        self.pose(body_poses(robot), "robot")
        return self._put("robot", visuals(robot), None, wrong)

    def show_ghost(self, robot: Robot | None) -> None:
        """Show another robot's printed parts transparent in the same place; None removes them."""
        if robot is None:
            self._put("ghost", (), GHOST_OPACITY)
            return
        self.pose(body_poses(robot), "ghost")
        printed = {part.name for part in robot.parts}
        self._put("ghost", tuple(one for one in visuals(robot) if one.mesh_name in printed), GHOST_OPACITY)

    def pose(self, poses: Mapping[str, Array], tree: str = "robot") -> None:
        """Put the bodies' frames at poses (4, 4) in the world (m); `tree` is `robot` or `ghost`."""
        for body, pose in poses.items():
            turn = Rotation.from_matrix(pose[:3, :3]).as_quat()
            self.place(f"/{tree}/{body}", (*pose[:3, 3], *turn))

    def place(self, frame: str, seven: Any) -> None:
        """Put a frame at a position (m) and quaternion (x, y, z, w): seven numbers."""
        x, y, z, qx, qy, qz, qw = (float(value) for value in seven)
        if frame not in self.frames:
            self.frames[frame] = self.server.scene.add_frame(frame, show_axes=False)
        _put_at(self.frames[frame], (x, y, z), (qw, qx, qy, qz))

    def _put(
        self, tree: str, things: tuple[Visual, ...], opacity: float | None, wrong: frozenset[str] = frozenset()
    ) -> int:
        """Show parts below a tree, and remove the tree's others; return how many meshes were sent.

        A part whose mesh is the same is moved, not sent again.
        """
        names = {f"/{tree}/{one.body}/{one.name}": one for one in things}
        for name in [name for name in self.meshes if name.startswith(f"/{tree}/") and name not in names]:
            self.meshes.pop(name)[1].remove()
        sent = 0
        for name, one in names.items():
            colour = WRONG if one.mesh_name in wrong else one.colour if opacity is None else GHOST_COLOUR
            x, y, z, w = Rotation.from_matrix(one.T_body_mesh[:3, :3]).as_quat().tolist()
            turn, place = (w, x, y, z), tuple(one.T_body_mesh[:3, 3].tolist())
            key = (_shape(one), colour)
            if name in self.meshes and self.meshes[name][0] == key:
                _put_at(self.meshes[name][1], place, turn)
                continue
            vertices_mm, triangles = seen(one)
            self.meshes[name] = key, self.server.scene.add_mesh_simple(
                name, vertices_mm * 0.001, triangles,
                color=colour, opacity=opacity, flat_shading=True, wxyz=turn, position=place,
            )  # fmt: skip
            sent += 1
        return sent


def _put_at(handle: Any, place: tuple[float, ...], turn: tuple[float, ...]) -> None:
    """Put a node at a position (m) and quaternion (w, x, y, z); each that changes is a message to every page."""
    if tuple(handle.position) != place:
        handle.position = place
    if tuple(handle.wxyz) != turn:
        handle.wxyz = turn


def _shape(one: Visual) -> object:
    """Return a key that is equal for equal meshes."""
    shape = one.shape
    if isinstance(shape, Wire):  # it lies in its body's frame, and its mesh does not
        return shape.points_mm.tobytes(), shape.diameter_mm, one.T_body_mesh.tobytes()
    return shape
