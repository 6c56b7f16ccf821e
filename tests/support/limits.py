"""Limits of the drive as the default workshop gives them."""

import math
from dataclasses import replace

from jumpcad.building.bearing_and_drive import drive_limits
from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.drive import DriveLimits
from jumpcad.drive.cam_law import CamLaw
from jumpcad.mechanism.linkage import Linkage
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sizing import sections
from jumpcad.strength.bearings import hub_bearings, hub_width_mm
from jumpcad.workshop import load_workshop

LP6 = tuple(name for name in load_catalogue().motors if name.count("-") == 1)
"""Motors of the low-power winding."""


def default_limits(name: str = "kenan-2.0") -> DriveLimits:
    """Return the limits of a drive in the default workshop, for a template's links with the lightest hub bearing."""
    workshop = load_workshop()
    bearing, *_ = hub_bearings(workshop)
    sizes = sections(Linkage(load_design(name)), workshop, hub_width_mm(bearing))
    # supply None: every motor of the catalogue at its rated voltage
    roller = load_catalogue().bearings[workshop.bought.roller]
    limits = drive_limits(workshop, roller, sizes, HoleSizes.of(workshop, bearing))
    return replace(limits, motors=LP6, train=replace(limits.train, supply=None))


def law_of(name: str) -> CamLaw:
    """Return how a cam winds a template's springs in 310 degrees, 30 of them at either end."""
    design = load_design(name)
    return CamLaw(design.compression_rad, design.stiffness_nm_per_rad, math.radians(310), math.radians(30))
