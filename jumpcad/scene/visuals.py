"""The visible parts of a robot: every copy of every part with its mesh, its pose and its colour; how far they reach.

Every picture and every exported file takes its meshes and colours from here. A page that shows a robot while it is
changed takes the walls of a stack's slabs and the ends of them that lie bare: the same picture as the solid's mesh,
many times faster. Their triangles do not share corners, so they are nothing to print or to compute with.
"""

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import manifold3d
import numpy as np
import numpy.typing as npt

from jumpcad.mechanism.model import body_poses
from jumpcad.parts.part import Part, Shape
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array, Trimesh, chained, in_metres

Colour = tuple[float, float, float]

PRINTED_COLOURS: dict[str, Colour] = {
    "links": (0.93, 0.45, 0.13),
    "body": (0.60, 0.71, 0.82),
    "gears": (0.16, 0.52, 0.66),
}
"""Colours by the role of a printed part."""
BOUGHT_COLOURS: dict[str, Colour] = {
    "cable tie": (0.16, 0.16, 0.17), "foam tape": (0.92, 0.91, 0.86), "hook-and-loop": (0.16, 0.16, 0.17),
    "torsion spring": (0.30, 0.33, 0.38), "gear motor": (0.85, 0.70, 0.30), "bearing": (0.72, 0.74, 0.77),
    "steel rod": (0.66, 0.68, 0.71), "screw": (0.22, 0.23, 0.25), "standoff": (0.96, 0.96, 0.93),
    "battery": (0.20, 0.42, 0.85), "controller": (0.13, 0.50, 0.28), "driver": (0.50, 0.20, 0.50),
    "regulator": (0.13, 0.30, 0.50), "gyroscope": (0.55, 0.30, 0.10),
}  # fmt: skip
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
    def mesh(self) -> Trimesh:
        """The mesh in its own frame (mm), as detailed as a picture needs."""
        return self.source.shown_mesh

    @property
    def shape(self) -> Shape | DrawnWire:
        """What the mesh is made from."""
        return (isinstance(self.source, BoughtPart) and self.source.wire) or self.source.shape

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
    found = []
    for part in robot.parts:
        for number, place in enumerate(part.placements, start=1):
            name = part.name if part.quantity == 1 else f"{part.name}_{number}"
            colour = PRINTED_COLOURS[part.role]
            found.append(Visual(name, part.name, place.body, in_metres(place.T_body_part), colour, part))
    for item in robot.hardware:
        label = f"{item.article} {item.name}".lower()
        colour = next((colour for word, colour in BOUGHT_COLOURS.items() if word in label), STEEL)
        found.append(Visual(item.name, item.name, item.body, in_metres(item.T_body_part), colour, item))
    return tuple(found)


Triangles = npt.NDArray[np.int64]
Piece = tuple[Array, Triangles]
"""Vertices (n, 3) in mm, and triangles (m, 3) whose corners run counter-clockwise seen from outside."""

UNSEEN_MM = 0.02
"""How far outlines are simplified; judgement: less than a pixel, however near the camera comes."""
FLAT_MM = 1e-4
"""Tolerance of the triangulation; corners lie on a grid of 1e-3 mm."""


def seen(one: Visual) -> Piece:
    """Return vertices (n, 3) in mm, in the mesh's own frame, and triangles (m, 3) of a part as it is seen."""
    shape = one.shape
    if isinstance(shape, Stack):
        return surface(shape)
    return np.asarray(one.mesh.vertices), np.asarray(one.mesh.faces)


@lru_cache(maxsize=128)
def surface(stack: Stack) -> Piece:
    """Return the outside of a stack: vertices (n, 3) in mm, and triangles (m, 3)."""
    cases = {(slab.number, slab.pocket_number, slab.inset_mm): slab for slab in stack.slabs}
    regions = {case: slab.region.simplify(UNSEEN_MM) for case, slab in cases.items()}
    slabs = [(slab.z0_mm, slab.z1_mm, regions[slab.number, slab.pocket_number, slab.inset_mm]) for slab in stack.slabs]
    pieces = [*(_wall(region.to_polygons(), z0, z1) for z0, z1, region in slabs), *_ends(slabs)]
    first = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    triangles = [number + corners for number, (_, corners) in zip(first, pieces, strict=False)]
    return np.concatenate([vertices for vertices, _ in pieces]), np.concatenate(triangles)


def _wall(contours: Sequence[Array], z0_mm: float, z1_mm: float) -> Piece:
    """Return the wall over contours (k, 2) between two heights."""
    flat = np.concatenate(contours)
    count = len(flat)
    here = np.arange(count)
    there = np.concatenate(
        [np.roll(ring, -1) for ring in np.split(here, np.cumsum([len(one) for one in contours])[:-1])]
    )
    low, high = (np.column_stack([flat, np.full(count, z)]) for z in (z0_mm, z1_mm))
    triangles = [np.column_stack([here, there, there + count]), np.column_stack([here, there + count, here + count])]
    return np.concatenate([low, high]), np.concatenate(triangles)


def _ends(slabs: Sequence[tuple[float, float, Region]]) -> Iterator[Piece]:
    """Yield the flat faces of slabs (z0, z1, region) that no neighbour covers."""
    nothing = (-np.inf, -np.inf, Region())
    for (_, z1, lower), (z0, _, upper) in itertools.pairwise([nothing, *slabs, nothing]):
        met = z0 == z1
        for z, region, other, up in ((z1, lower, upper, True), (z0, upper, lower, False)):
            contours = (region - other if met else region).to_polygons()
            if not contours:
                continue
            flat = np.concatenate(contours)
            triangles = np.asarray(manifold3d.triangulate(contours, FLAT_MM), dtype=np.int64).reshape(-1, 3)
            yield np.column_stack([flat, np.full(len(flat), z)]), triangles if up else triangles[:, ::-1]


ROUND_OFF_M = 1e-9
"""Larger than the error of a placed bounding box."""


def extent_m(robot: Robot) -> Array:
    """Return length, width and height (3,) of a robot that stands with its springs at rest, bought parts included (m).

    Every part counts with its whole outline over its whole height: exact for a part of one outline, an upper bound for
    others; 0.006 mm too large in the templates, where a pad at the nose is the farthest point.
    """
    poses = body_poses(robot)
    pieces: list[tuple[Shape, str, Array]] = [(item.shape, item.body, item.T_body_part) for item in robot.hardware]
    for part in robot.parts:
        pieces += [(part.shape, place.body, place.T_body_part) for place in part.placements]
    of_bodies, of_pieces = np.array([poses[body] for _, body, _ in pieces]), np.array([pose for *_, pose in pieces])
    boxes = _boxes_m(np.array([shape.bounds_mm for shape, *_ in pieces]), of_bodies, of_pieces)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)

    def reach(numbers: Iterable[int]) -> None:
        for number in numbers:
            if (boxes[number, 0] < low).any() or (boxes[number, 1] > high).any():
                shape, body, pose = pieces[number]
                corners = _corners_m(shape, chained(poses[body], in_metres(pose)))
                np.minimum(low, corners[0], out=low)
                np.maximum(high, corners[1], out=high)

    first = dict.fromkeys([*boxes[:, 0].argmin(axis=0).tolist(), *boxes[:, 1].argmax(axis=0).tolist()])
    reach(first)
    # few boxes reach beyond these
    beyond = np.flatnonzero((boxes[:, 0] < low).any(axis=1) | (boxes[:, 1] > high).any(axis=1)).tolist()
    reach(number for number in beyond if number not in first)
    return np.asarray(high - low)


def _boxes_m(bounds_mm: Array, T_world_body: Array, T_body_part: Array) -> Array:
    """Return boxes (n, 2, 3) in the world (m) that contain bounding boxes (n, 2, 3) (mm).

    Bodies' poses (n, 4, 4) are in m, those of the parts in mm.
    """
    T_world_part = np.einsum("nij,njk->nik", T_world_body[:, :3, :3], T_body_part[:, :3])
    middle, half = bounds_mm.mean(axis=1), (bounds_mm[:, 1] - bounds_mm[:, 0]) / 2000.0
    rotation = T_world_part[:, :, :3]
    centre = T_world_part[:, :, 3] + np.einsum("nij,nj->ni", rotation, middle)
    centre = T_world_body[:, :3, 3] + centre / 1000.0
    reach = np.einsum("nij,nj->ni", np.abs(rotation), half) + ROUND_OFF_M
    return np.stack([centre - reach, centre + reach], axis=1)


def _corners_m(shape: Shape, T_world_part: Array) -> Array:
    """Return lower and upper corner (2, 3) of a shape's bounding box in the world (m)."""
    flat = np.einsum("ij,nj->ni", T_world_part[:3, :2], shape.outline_mm).T.copy() / 1000.0  # rows are quicker
    upright = np.outer(shape.bounds_mm[:, 2], T_world_part[:3, 2]) / 1000.0
    middle = T_world_part[:3, 3]
    return np.stack([middle + flat.min(axis=1) + upright.min(axis=0), middle + flat.max(axis=1) + upright.max(axis=0)])
