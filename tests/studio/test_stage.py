"""The studio's scene on a server that only keeps what it is given: places in metres, colours, what is removed again."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.mechanism.model import body_poses
from jumpcad.scene.visuals import Visual, visuals
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
