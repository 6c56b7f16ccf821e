"""Diameters of bores: what the default workshop's fits make of what is bought, and what is measured (mm)."""

import numpy as np

from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop
from support.built import cut, inscribed_diameter, part, placed
from support.workshops import workshop_with

PRESS, SLIDING, LOOSE, EYE, LYING, RIB = 0.10, 0.20, 0.30, 0.10, 0.10, 0.05
"""Per side, in the default workshop."""
TOLERANCE_MM = 0.003
AXLE, MR63_OUTER, N20_SHAFT, N20_FLAT = 3.0, 6.0, 3.0, 2.5

RUNNING, LYING_HOLE = AXLE + 2 * SLIDING, AXLE + 2 * LYING

APART = {"press_mm": 0.05, "eye_mm": 0.08, "lying_mm": 0.15}
"""Tight bores, eyes and lying holes have the same fit in the default workshop; here they differ."""

LOADS = 1.1 * 1.05
"""Stiffest springs within ±10 %, and a reserve of 5 %, in the default workshop's [safety]."""


def with_fits_apart(workshop: Workshop) -> Workshop:
    """Return a workshop in which no two of the tight fits are equal."""
    return workshop_with(workshop, fits=APART)


def chamfered(robot: Robot, name: str) -> bool:
    """Tell whether a part's first layer, which spreads on the bed, is set back on all sides by the workshop's chamfer.

    It rises at 45° and is printed as steps, each as wide as the slope is in the middle of its layer.
    """
    shape, fits = part(robot, name).shape, robot.workshop.fits
    bottom, above = (
        np.array(region.bounds()) for region in shape.regions_at([0.05, fits.first_layer_chamfer_mm + 0.2])
    )
    inset = fits.first_layer_chamfer_mm - robot.workshop.process.first_layer_mm / 2.0
    return bool(((bottom - above) * [1.0, 1.0, -1.0, -1.0] > inset - 0.01).all())


def measured(robot: Robot, name: str, y: float, centre: np.ndarray, copy: int = 0) -> float:
    """Return the diameter of the bore about a place in a section of a part."""
    return inscribed_diameter(cut(placed(robot, name, copy), y), centre)
