"""The visible parts of a robot: every copy of every part with its mesh, its pose and its colour.

Every picture and every exported file takes its meshes and colours from here.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from jumpcad.parts.part import Part, Shape
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array, in_metres

if TYPE_CHECKING:
    import trimesh

Colour = tuple[float, float, float]

PRINTED_COLOURS: dict[str, Colour] = {
    "links": (0.93, 0.45, 0.13),
    "body": (0.60, 0.71, 0.82),
    "gears": (0.16, 0.52, 0.66),
}
"""Colours by the role of a printed part."""
BOUGHT_COLOURS: dict[str, Colour] = {
    "cable tie": (0.16, 0.16, 0.17),
    "foam tape": (0.92, 0.91, 0.86),
    "hook-and-loop": (0.16, 0.16, 0.17),
    "torsion spring": (0.30, 0.33, 0.38),
    "gear motor": (0.85, 0.70, 0.30),
    "bearing": (0.72, 0.74, 0.77),
    "steel rod": (0.66, 0.68, 0.71),
    "screw": (0.22, 0.23, 0.25),
    "standoff": (0.96, 0.96, 0.93),
    "battery": (0.20, 0.42, 0.85),
    "controller": (0.13, 0.50, 0.28),
    "driver": (0.50, 0.20, 0.50),
    "regulator": (0.13, 0.30, 0.50),
}
"""Colours by a word in a bought part's article or name; the first match counts."""
STEEL: Colour = (0.62, 0.64, 0.67)


@dataclass(frozen=True)
class Visual:
    """One printed or bought part on the robot.

    `name` is unique; `mesh_name` names its mesh, which copies share. `T_body_mesh` (4, 4) is the pose of the mesh (mm)
    in the frame of `body`, its translation in metres. `source` is the printed or bought part.
    """

    name: str
    mesh_name: str
    body: str
    T_body_mesh: Array
    colour: Colour
    source: Part | BoughtPart

    @property
    def mesh(self) -> "trimesh.Trimesh":
        """The mesh in its own frame (mm), as detailed as a picture needs."""
        return self.source.drawing.shown_mesh if isinstance(self.source, Part) else self.source.shown_mesh

    @property
    def shape(self) -> Shape | DrawnWire:
        """What the mesh is made from."""
        if isinstance(self.source, Part):
            return self.source.drawing.shape
        return self.source.wire or self.source.shape

    @property
    def corners_m(self) -> Array:
        """The corners (8, 3) of the mesh's bounding box in its own frame (m)."""
        low, high = self.mesh.bounds / 1000.0
        return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])

    def corners_at(self, pose: Array) -> Array:
        """Return the corners (8, 3) of that box where the mesh has a pose (4, 4) (m)."""
        return np.asarray(np.einsum("ij,nj->ni", pose[:3, :3], self.corners_m) + pose[:3, 3])


@decided_once
def visuals(robot: Robot) -> tuple[Visual, ...]:
    """Return every copy of every printed part, then every bought part."""
    return (*_printed(robot), *(_bought(item) for item in robot.hardware))


def _printed(robot: Robot) -> Iterator[Visual]:
    for part in robot.parts:
        for number, place in enumerate(part.placements, start=1):
            name = part.name if part.quantity == 1 else f"{part.name}_{number}"
            colour = PRINTED_COLOURS[part.drawing.role]
            yield Visual(name, part.name, place.body, in_metres(place.T_body_part), colour, part)


def _bought(item: BoughtPart) -> Visual:
    label = f"{item.article} {item.name}".lower()
    colour = next((colour for word, colour in BOUGHT_COLOURS.items() if word in label), STEEL)
    return Visual(item.name, item.name, item.body, in_metres(item.T_body_part), colour, item)
