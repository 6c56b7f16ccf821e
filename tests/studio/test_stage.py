"""The studio's scene on a server that only keeps what it is given: places in metres, colours, what is removed again."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.design import load_design
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.solids.tube import DrawnWire
from jumpcad.studio.playback import ShownMoment
from jumpcad.studio.stage import StudioStage

NAME = "kenan-2.0"


@dataclass
class Node:
    """A frame or a mesh: what it was given, what was set since, how often it was removed."""

    given: dict[str, Any]
    removed: int = 0
    acts: list[Any] = field(default_factory=list)

    def __post_init__(self) -> None:
        vars(self).update({"position": (0.0, 0.0, 0.0), "wxyz": (1.0, 0.0, 0.0, 0.0), "opacity": None} | self.given)

    def remove(self) -> None:
        self.removed += 1

    def on_click(self, act: Any) -> None:
        self.acts.append(act)


class Scene:
    """Keeps every node by its name, the newest under each."""

    def __init__(self) -> None:
        self.nodes: dict[str, Node] = {}
        self.up, self.ground = "", Node({})

    def set_up_direction(self, way: str) -> None:
        self.up = way

    def add_grid(self, _: str, *size_m: float, **given: Any) -> None:
        self.ground = Node({"size_m": size_m} | given)

    def add_frame(self, name: str, **given: Any) -> Node:
        assert name not in self.nodes
        self.nodes[name] = Node(given)
        return self.nodes[name]

    def add_mesh_simple(self, name: str, vertices: Any, faces: Any, **given: Any) -> Node:
        self.nodes[name] = Node({"vertices": np.array(vertices), "faces": np.array(faces)} | given)
        return self.nodes[name]

    def shown(self, tree: str) -> dict[str, Any]:
        """Return the meshes below a tree that were not removed."""
        return {
            name: node for name, node in self.nodes.items()
            if name.startswith(f"/{tree}/") and "faces" in node.given and not node.removed
        }  # fmt: skip


@pytest.fixture
def clicked() -> list[str]:
    return []


@pytest.fixture
def stage(clicked: list[str]) -> Iterator[StudioStage]:
    made = StudioStage(SimpleNamespace(scene=Scene()), clicked.append)
    yield made
    made.meshes.clear()


def named(name: str) -> Visual:
    return next(one for one in visuals(built(NAME)) if one.name == name)


def pose(node: Any) -> np.ndarray:
    """Return a node's pose (4, 4)."""
    found = np.eye(4)
    found[:3, :3] = Rotation.from_quat(node.wxyz, scalar_first=True).as_matrix()
    found[:3, 3] = node.position
    return found


def test_the_ground_is_level_with_squares_of_50_mm(stage: StudioStage) -> None:
    assert stage.server.scene.up == "+z"
    assert stage.server.scene.ground.given["cell_size"] == 0.05


def test_every_part_stands_where_the_robot_has_it_and_says_its_name(stage: StudioStage, clicked: list[str]) -> None:
    """Meshes in metres in the frames of their bodies, which stand at rest on the ground."""
    sent = stage.show(built(NAME))
    shown = stage.server.scene.shown("robot")
    assert sent == len(shown) == len(visuals(built(NAME)))
    for body, wanted in body_poses(built(NAME)).items():
        assert pose(stage.frames[f"/robot/{body}"]) == pytest.approx(wanted, abs=1e-9)
    for one in visuals(built(NAME)):
        node = shown[f"/robot/{one.body}/{one.name}"]
        assert pose(node) == pytest.approx(one.T_body_mesh, abs=1e-9)
        assert node.color == tuple(round(255.0 * share) for share in one.colour)
        assert node.opacity is None
        node.acts[0](None)
    for name in ("main_leg", "battery"):
        (node,) = [node for path, node in shown.items() if path.endswith(f"/{name}")]
        assert np.ptp(node.vertices, axis=0) == pytest.approx(np.ptp(named(name).corners_m, axis=0), abs=1e-4)
    assert clicked == [one.name for one in visuals(built(NAME))]


def test_copies_of_a_part_say_their_own_names(stage: StudioStage, clicked: list[str], small_robot: Robot) -> None:
    """Of which the studio looks up what the part is."""
    stage._put("robot", visuals(small_robot))
    copies = [one for one in visuals(small_robot) if one.name != one.mesh_name]
    assert len(copies) >= 2
    for one in copies:
        stage.server.scene.nodes[f"/robot/{one.body}/{one.name}"].acts[0](None)
    assert clicked == [one.name for one in copies]


def test_a_spring_of_thicker_wire_or_in_another_place_is_sent_again(stage: StudioStage) -> None:
    spring = named("spring_left")
    wire = spring.shape
    assert isinstance(wire, DrawnWire)
    thick = replace(wire, diameter_mm=1.1 * wire.diameter_mm)
    away = replace(wire, points_mm=wire.points_mm + 0.1)
    sent = [
        stage._put("robot", (replace(spring, source=spring.source.seen_as(one)),))  # type: ignore[union-attr]
        for one in (wire, replace(wire, points_mm=wire.points_mm.copy()), thick, thick, away)
    ]
    assert sent == [1, 0, 1, 0, 1]


def test_a_robot_that_cannot_be_built_leaves_the_last_one_pale_and_a_ghost_as_it_is(stage: StudioStage) -> None:
    stage.show(built(NAME))
    stage.show_ghost(built(NAME))
    before = {
        name: (node.color, node.opacity) for name, node in stage.server.scene.nodes.items() if "faces" in node.given
    }
    stage.fade()
    for name, (colour, opacity) in before.items():
        node = stage.server.scene.nodes[name]
        assert node.color == colour
        assert node.opacity == opacity if name.startswith("/ghost/") else 0.0 < node.opacity < 0.5


def test_a_ghost_is_the_printed_parts_seen_through_until_it_is_let_go(stage: StudioStage) -> None:
    """In the same place, and nothing to click on."""
    stage.show(built(NAME))
    stage.show_ghost(built(NAME))
    ghost, printed = stage.server.scene.shown("ghost"), {part.name for part in built(NAME).parts}
    assert set(ghost) == {f"/ghost/{one.body}/{one.name}" for one in visuals(built(NAME)) if one.mesh_name in printed}
    for name, node in ghost.items():
        assert pose(node) == pytest.approx(pose(stage.server.scene.nodes[name.replace("ghost", "robot")]))
        assert (0.0 < node.opacity < 0.5, node.acts) == (True, [])
    for body, wanted in body_poses(built(NAME)).items():
        assert pose(stage.frames[f"/ghost/{body}"]) == pytest.approx(wanted, abs=1e-9)
    stage.show_ghost(None)
    assert stage.server.scene.shown("ghost") == {}
    assert len(stage.server.scene.shown("robot")) == len(visuals(built(NAME)))
    assert not any(name.startswith("/ghost/") for name in stage.meshes)


def test_what_a_violated_limit_is_about_is_red_between_pale_parts_and_whole_again_when_it_is_kept(
    stage: StudioStage,
) -> None:
    """Copies of a part are red together."""
    copies = {one.name for one in visuals(built(NAME)) if one.mesh_name == "cam_gear"}
    stage.show(built(NAME), frozenset({"cam_gear"}))
    for name, node in stage.server.scene.shown("robot").items():
        if name.rpartition("/")[2] in copies:
            assert node.opacity is None
            assert node.color[0] > 2 * max(node.color[1:])
        else:
            assert 0.0 < node.opacity < 0.5
    assert stage.show(built(NAME)) == 0
    for one in visuals(built(NAME)):
        node = stage.server.scene.nodes[f"/robot/{one.body}/{one.name}"]
        assert (node.color, node.opacity) == (tuple(round(255.0 * share) for share in one.colour), None)


def test_a_body_goes_where_a_moment_has_it_and_what_turns_turns_about_its_axis(stage: StudioStage) -> None:
    """Quaternions of a moment have their real part last, those of the server first."""
    stage.show(built(NAME))
    turn = Rotation.from_euler("xyz", [10.0, 20.0, 30.0], degrees=True)
    moment = ShownMoment({BODY: np.array([0.1, 0.2, 0.3, *turn.as_quat()])}, {"motor_pinion": 0.4}, "drop", 0.0, 1.0)
    stage.move(moment)
    found = pose(stage.frames[f"/robot/{BODY}"])
    assert found[:3, 3] == pytest.approx([0.1, 0.2, 0.3])
    assert found[:3, :3] == pytest.approx(turn.as_matrix())
    assert pose(stage.frames[f"/robot/{MAIN_LEG}"]) == pytest.approx(body_poses(built(NAME))[MAIN_LEG], abs=1e-9)
    one, (x_m, z_m) = named("motor_pinion"), built(NAME).layout.motor_mm / 1000.0
    about = Rotation.from_euler("y", 0.4)
    placed = pose(stage.server.scene.nodes[f"/robot/{one.body}/motor_pinion"])
    axis = np.array([x_m, 0.0, z_m])
    assert placed[:3, 3] == pytest.approx(axis + about.apply(one.T_body_mesh[:3, 3] - axis), abs=1e-6)
    assert placed[:3, :3] == pytest.approx(about.as_matrix() @ one.T_body_mesh[:3, :3], abs=1e-9)


def test_the_path_is_a_thin_line_through_its_points_one_at_a_time(stage: StudioStage) -> None:
    """A millimetre thick; a point that comes twice in a row is gone through once."""
    bent = np.column_stack([np.linspace(0.0, 0.2, 30), np.zeros(30), 0.1 + 0.05 * np.sin(np.linspace(0.0, 3.0, 30))])
    nodes = stage.server.scene.nodes
    stage.show_path(np.repeat(bent, 2, axis=0))
    first = nodes["/path"]
    line = trimesh.Trimesh(first.vertices, first.faces)
    thick_m = line.volume / np.linalg.norm(np.diff(bent, axis=0), axis=1).sum()
    assert thick_m == pytest.approx(np.pi * 0.0005**2, rel=0.15)
    assert np.linalg.norm(first.vertices[:, None] - bent, axis=2).min(axis=1).max() == pytest.approx(0.0005, rel=0.01)
    stage.show_path(bent + 1.0)
    assert (first.removed, nodes["/path"].removed) == (1, 0)
    assert nodes["/path"].vertices.min(axis=0) == pytest.approx(bent.min(axis=0) + 1.0, abs=6e-4)
    stage.show_path(None)
    stage.show_path(None)
    assert nodes["/path"].removed == 1


def test_the_camera_stands_farther_off_large_robots_and_on_a_high_page() -> None:
    """As many times as legs and toes together are longer; a page higher than wide shows less from side to side."""
    calls: list[Any] = []
    server: Any = SimpleNamespace(
        initial_camera=SimpleNamespace(), on_client_connect=calls.append,
        scene=SimpleNamespace(set_up_direction=lambda _: None, add_grid=lambda *_, **__: None),
    )  # fmt: skip
    stage, design, places = StudioStage(server), load_design("kenan-2.0"), []
    larger = design.model_copy(update={"carrying_link_mm": 2.0 * design.carrying_link_mm})
    toes = design.model_copy(update={"e_coef": 2.0 * design.e_coef + 1.0})
    for one in (design, larger, toes):
        stage.look_at(one)
        places.append(np.array([server.initial_camera.position, server.initial_camera.look_at]))
    size_m = (design.l2_mm + design.l5_mm) / 1000.0
    assert 1.5 * size_m < np.linalg.norm(places[0][0] - places[0][1]) < 4.0 * size_m
    assert places[1] == pytest.approx(2.0 * places[0])
    assert places[2] == pytest.approx(2.0 * places[0])
    for aspect, moved in ((1.5, False), (0.6, True)):
        camera = SimpleNamespace(aspect=aspect, position=tuple(places[2][0]), look_at=tuple(places[2][1]))
        calls[-1](SimpleNamespace(camera=camera))
        away = np.linalg.norm(np.subtract(camera.position, camera.look_at))
        assert (away > 1.2 * np.linalg.norm(places[2][0] - places[2][1])) == moved
