"""The studio's 3-D scene: frames of the bodies, meshes of the parts (sent again only if changed), a ghost robot."""

import threading
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.bundle.viewer import turning_parts
from jumpcad.design import Design
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, seen, visuals
from jumpcad.solids.tube import DrawnWire, tube
from jumpcad.studio.answers import ShownMoment
from jumpcad.transforms import Array, chained, pose_about_y

WRONG = (0.80, 0.16, 0.14)
"""Colour of a part that violates a limit."""
SEEN_THROUGH = 0.3
"""Opacity of the other parts, so that a violated part inside is seen; judgement."""
SIDE, MIDDLE = np.array((1.1, -1.9, 1.0)), np.array((0.45, 0.0, 0.35))
"""First position of the camera, and the point at which it looks, over the robot's size: the jump is in view too."""
HIGH_SIDE, LOW_MIDDLE = np.array((1.5, -3.0, 0.6)), np.array((0.5, 0.0, -0.5))
"""The same on a page higher than wide, whose lower half the panel covers."""
GHOST_COLOUR, GHOST_OPACITY = (0.5, 0.55, 0.6), 0.25
PATH_COLOUR, PATH_MM = (0.82, 0.29, 0.36), 1.0


class StudioStage:
    """What a viser server shows; names of nodes are `/robot/BODY/PART`, `/ghost/BODY/PART` and `/path`.

    `clicked` is called with the name of a part of the robot, as in `jumpcad.scene.visuals`.
    """

    def __init__(self, server: Any, clicked: Callable[[str], None] = lambda _: None) -> None:
        self.server, self._clicked = server, clicked
        self.lock = threading.RLock()
        self.meshes: dict[str, tuple[object, Any]] = {}
        self.frames: dict[str, Any] = {}
        self._turning: dict[str, tuple[Any, Array, Array]] = {}
        self._path: Any = None
        server.scene.set_up_direction("+z")
        server.scene.add_grid("/ground", 4.0, 4.0, cell_size=0.05, section_size=0.5, cell_thickness=0.5)

    def look_at(self, design: Design) -> None:
        """Put the camera of pages that are opened from now on where it sees a design's robot and its jump."""
        size_m = design.carrying_link_mm * (1.0 + design.e_coef) / 1000.0
        camera = self.server.initial_camera
        camera.position, camera.look_at = tuple(size_m * SIDE), tuple(size_m * MIDDLE)

        def seen_on_a_phone(client: Any) -> None:
            if client.camera.aspect < 1.0:
                client.camera.position, client.camera.look_at = tuple(size_m * HIGH_SIDE), tuple(size_m * LOW_MIDDLE)

        self.server.on_client_connect(seen_on_a_phone)

    def show(self, robot: Robot, wrong: frozenset[str] = frozenset()) -> int:
        """Show a robot at rest, the parts named in `wrong` in red; return how many meshes were sent."""
        with self.lock:
            self.pose(body_poses(robot), "robot")
            things = visuals(robot)
            sent = self._put("robot", things, wrong)
            meshes = {one.name: (self.meshes[_node("robot", one)][1], one.T_body_mesh) for one in things}
            self._turning = {one["node"]: (*meshes[one["node"]], one["axis_m"]) for one in turning_parts(robot)}
        return sent

    def show_ghost(self, robot: Robot | None) -> None:
        """Show another robot's printed parts transparent in the same place; None removes them."""
        with self.lock:
            if robot is None:
                self._put("ghost", ())
                return
            self.pose(body_poses(robot), "ghost")
            printed = {part.name for part in robot.parts}
            self._put("ghost", tuple(one for one in visuals(robot) if one.mesh_name in printed))

    def fade(self) -> None:
        """Show the robot pale: it is not that of the design."""
        with self.lock:
            for name, (_, handle) in self.meshes.items():
                if name.startswith("/robot/"):
                    _give(handle, opacity=SEEN_THROUGH)

    def show_path(self, com_m: Array | None) -> None:
        """Show the path (n, 3) of the centre of mass (m); None removes it."""
        if self._path is not None:
            self._path.remove()
        self._path = None
        if com_m is not None:
            apart = np.insert(np.abs(np.diff(com_m, axis=0)).sum(axis=1) > 0.0, 0, True)
            line = tube(1000.0 * com_m[apart], PATH_MM)
            self._path = self.server.scene.add_mesh_simple(
                "/path", line.vertices * 0.001, line.faces, color=PATH_COLOUR, cast_shadow=False
            )

    def move(self, moment: ShownMoment) -> None:
        """Move bodies and turning parts to where they are at a moment."""
        for body, seven in moment.frames.items():
            self.place(f"/robot/{body}", seven)
        for part, angle_rad in moment.turned_rad.items():
            handle, T_body_mesh, (x, z) = self._turning[part]
            about = chained(pose_about_y(angle_rad, (x, z)), pose_about_y(0.0, (-x, -z)))
            place, turn = _placed(chained(about, T_body_mesh))
            _give(handle, position=place, wxyz=turn)

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
        _give(self.frames[frame], position=(x, y, z), wxyz=(qw, qx, qy, qz))

    def _put(self, tree: str, things: tuple[Visual, ...], wrong: frozenset[str] = frozenset()) -> int:
        """Show parts below a tree, and remove others; return how many meshes were sent: those that are not the same."""
        names = {_node(tree, one): one for one in things}
        for name in [name for name in self.meshes if name.startswith(f"/{tree}/") and name not in names]:
            self.meshes.pop(name)[1].remove()
        sent = 0
        for name, one in names.items():
            colour, opacity = _look(tree, one, wrong)
            place, turn = _placed(one.T_body_mesh)
            key: object = one.shape
            if isinstance(one.shape, DrawnWire):  # it lies in its body's frame, and its mesh does not
                key = one.shape.points_mm.tobytes(), one.shape.diameter_mm, one.T_body_mesh.tobytes()
            if name in self.meshes and self.meshes[name][0] == key:
                handle = self.meshes[name][1]
                _give(handle, position=place, wxyz=turn, color=colour, opacity=opacity)
                continue
            vertices_mm, triangles = seen(one)
            handle = self.server.scene.add_mesh_simple(
                name, vertices_mm * 0.001, triangles,
                color=colour, opacity=opacity, flat_shading=True, wxyz=turn, position=place,
            )  # fmt: skip
            if tree == "robot":
                handle.on_click(lambda _, part=one.name: self._clicked(part))
            self.meshes[name] = key, handle
            sent += 1
        return sent


def _node(tree: str, one: Visual) -> str:
    return f"/{tree}/{one.body}/{one.name}"


def _look(tree: str, one: Visual, wrong: frozenset[str]) -> tuple[tuple[int, ...], float | None]:
    """Return colour (0 to 255) and opacity of a part; None is opaque."""
    if tree == "ghost":
        colour, opacity = GHOST_COLOUR, GHOST_OPACITY
    elif one.mesh_name in wrong:
        colour, opacity = WRONG, None
    else:
        colour, opacity = one.colour, SEEN_THROUGH if wrong else None
    return tuple(round(255.0 * value) for value in colour), opacity


def _placed(pose: Array) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return position and quaternion (w, x, y, z) of a pose."""
    x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat().tolist()
    return tuple(pose[:3, 3].tolist()), (w, x, y, z)


def _give(handle: Any, **values: Any) -> None:
    """Give a node position (m), quaternion (w, x, y, z), colour or opacity; each change is a message to every page."""
    for name, value in values.items():
        held = getattr(handle, name)
        if (tuple(held) if isinstance(value, tuple) else held) != value:
            setattr(handle, name, value)
