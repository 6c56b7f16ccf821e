"""Where the trays of battery and boards lie, and the standoffs beside them (mm, x-z in the body frame)."""

import numpy as np

from jumpcad.dimensions import CLEAR_MM, GAP_MM, STANDOFF_RADIUS_MM
from jumpcad.findings import higher
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, best_place, box_obstacle, disc, grid_candidates
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

GRID_MM = 2.0
"""Distance between candidate places; judgement."""
TRAY_AHEAD_MM, TRAY_HIGHEST_MM = 30.0, 60.0
"""Places tried for trays: from the hub to this far ahead of the front pivot, up to this height; judgement."""
HEIGHT_COST = 1.2
"""Cost of a tray's height over that of its distance from the front pivot; judgement: a low body tips less."""
STANDOFF_BEHIND_MM, STANDOFF_AHEAD_MM, STANDOFF_HIGHEST_MM = 20.0, 40.0, 80.0
"""Places tried for standoffs: this far behind the cam's axis, ahead of the front pivot or trays, and up; judgement.
"""
STANDOFFS_APART_MM = 8.0
"""Distance added to the usual clearance between standoffs; judgement: closer ones hold the plates in one place only."""


def tray_place(obstacles: list[Obstacle], electronics: Electronics, l1_mm: float, inside: Interval) -> Array:
    """Return the middle (2,) of the lower tray's underside.

    Over the front pivot the battery balances cam and motor: the body's centre of mass then lies between the pivots.
    """
    half = electronics.half_mm
    places = grid_candidates((-l1_mm / 2.0, l1_mm / 2.0 + TRAY_AHEAD_MM), (0.0, TRAY_HIGHEST_MM), GRID_MM)
    index = best_place(
        "battery and electronics", obstacles, places + np.array([0.0, half[1]]), half, 0.0, inside,
        lambda p: np.abs(p[:, 0] - 0.5 * l1_mm) + HEIGHT_COST * np.abs(p[:, 1] - half[1]),
        (*higher("d_coef", "carrying_link_mm", note="a longer body"), "choose a smaller battery or smaller boards: "
         f"{electronics.names} take {electronics.length_mm:.1f} x {electronics.height_mm:.1f} mm"),
    )  # fmt: skip
    return np.asarray(places[index])


def electronics_obstacle(electronics: Electronics, tray_mm: Array, inside: Interval) -> Obstacle:
    """Return trays, battery and boards as one box across the whole body."""
    return box_obstacle("electronics", electronics.middle_mm(tray_mm), electronics.half_mm, 0.0, inside)


def standoff_places(
    obstacles: list[Obstacle], cam_axis: Array, front: Array, electronics: Electronics, tray_mm: Array, inside: Interval
) -> tuple[Array, ...]:
    """Return the places of the standoffs that, with the axles, hold the plates apart at the top of the body.

    They are wanted in front of the boards, and between cam and boards, above both.
    """
    centre = electronics.middle_mm(tray_mm)
    top_z = centre[1] + electronics.half_mm[1] + STANDOFF_RADIUS_MM + GAP_MM
    wanted = [
        np.array([centre[0] + electronics.half_mm[0], top_z]),
        np.array([(cam_axis[0] + centre[0]) / 2.0, max(top_z, cam_axis[1])]),
    ]
    x = (cam_axis[0] - STANDOFF_BEHIND_MM, max(front[0], centre[0]) + STANDOFF_AHEAD_MM)
    places = grid_candidates(x, (0.0, STANDOFF_HIGHEST_MM), GRID_MM)
    around = STANDOFF_RADIUS_MM + CLEAR_MM + STANDOFFS_APART_MM
    found: list[Array] = []
    for target in wanted:
        taken = [disc("standoff", place, around, EVERYWHERE) for place in found]
        index = best_place(
            "standoffs", [*obstacles, *taken], places, (STANDOFF_RADIUS_MM, STANDOFF_RADIUS_MM), 0.0, inside,
            lambda p, target=target: np.linalg.norm(p - target, axis=1),  # type: ignore[misc]
            higher("carrying_link_mm"),
        )  # fmt: skip
        found.append(places[index])
    return tuple(found)
