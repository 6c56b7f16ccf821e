"""How a part lies on the printer's bed: along its sides, or at an angle where it is too long for that (mm)."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.errors import CannotBuildError
from jumpcad.findings import Ways, lower
from jumpcad.transforms import Array

ROUND_OFF_MM = 1e-6

SMALLER: dict[str, Ways] = {
    "main_leg": lower("carrying_link_mm"),
    "front_link": lower("carrying_link_mm", "c_coef"),
    "foot": lower("carrying_link_mm", "d_coef", "e_coef"),
    "toe": lower("carrying_link_mm", "e_coef"),
    "body_plate": (*lower("carrying_link_mm", "d_coef"), "choose a smaller battery or boards"),
    "cage_bar": lower("cage.rear_radius_mm", "cage.front_radius_mm"),
}
"""What to change where a part is too large, by the beginning of its name; other parts are the body's."""
CAGED = (*lower("cage.front_ahead_mm", "cage.rear_behind_mm", note="shorter horns"), 'no cage (cage.rod = "")')


@dataclass(frozen=True)
class BedFit:
    """A turn about z in whole degrees, and what is left of the bed at the tightest of its three sides (mm)."""

    angle_deg: float
    margin_mm: float


def fit_to_bed(bounds_mm: Array, outline: Callable[[], Array], bed_mm: Sequence[float]) -> BedFit:
    """Return how a part fits the bed: along its sides if it can, else at an angle; the best if it does not fit.

    Given are lower and upper corner of its bounding box, (2, 3), and the usable bed (x, y, z). `outline` gives points
    (n, 2) that span its convex hull seen from above; it is asked only where the box does not fit.
    """
    x, y, z = (bounds_mm[1] - bounds_mm[0]).tolist()
    bed_x, bed_y, bed_z = bed_mm
    along = BedFit(0.0, min(bed_x - x, bed_y - y, bed_z - z)), BedFit(90.0, min(bed_x - y, bed_y - x, bed_z - z))
    best = max(along, key=lambda fit: fit.margin_mm)
    if best.margin_mm >= -ROUND_OFF_MM:
        return best
    for found in _at_angles(outline(), z, np.asarray(bed_mm)):
        if found.margin_mm >= -ROUND_OFF_MM:
            return found
        best = max(best, found, key=lambda fit: fit.margin_mm)
    return best


def require_bed(
    name: str, bounds_mm: Array, outline: Callable[[], Array], bed_mm: Sequence[float], caged: bool = False
) -> BedFit:
    """Return how a part lies on the bed; `caged` says whether body plates have horns for a cage."""
    found = fit_to_bed(bounds_mm, outline, bed_mm)
    if found.margin_mm < -ROUND_OFF_MM:
        size, bed = ("×".join(f"{side:.1f}" for side in sides) for sides in (bounds_mm[1] - bounds_mm[0], bed_mm))
        horns = CAGED if caged and name.startswith("body_plate") else ()
        smaller = next((words for part, words in SMALLER.items() if name.startswith(part)), SMALLER["body_plate"])
        raise CannotBuildError(
            f"part {name} of {size} mm does not fit the bed of {bed} mm at any angle, by {-found.margin_mm:.1f} mm",
            "bed", found.margin_mm, ways=("choose a larger printer in the workshop", *horns, *smaller),
        )  # fmt: skip
    return found


def _at_angles(outline_mm: Array, height_mm: float, bed_mm: Array) -> Iterator[BedFit]:
    """Yield the fit at each whole degree between 0° and 90°."""
    angles = np.arange(1.0, 90.0)
    cos, sin = np.cos(np.radians(angles))[:, None], np.sin(np.radians(angles))[:, None]
    x, y = outline_mm.T
    sides = np.stack([np.ptp(cos * x - sin * y, axis=1), np.ptp(sin * x + cos * y, axis=1)], axis=-1)
    margins = np.minimum((bed_mm[:2] - sides).min(axis=1), bed_mm[2] - height_mm)
    yield from map(BedFit, angles.tolist(), margins.tolist())
