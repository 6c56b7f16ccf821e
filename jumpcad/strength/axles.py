"""Axles and pins for the strength checks: section, yield stress, and strength of their retention (mm, MPa, N)."""

import math
from dataclasses import dataclass

from jumpcad.catalogue import Catalogue, Rod
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.strength.stress import VON_MISES
from jumpcad.workshop import BoughtParts, Workshop

SOFT = "silver-steel"
"""The rod in which grooves can be cut and which is sold in every diameter."""
SCREW_SHANK_MM, SCREW_CORE_MM, SCREW_THREAD_MM = 2.86, 2.39, 20.5
"""M3 ISO 4762: least shank, core (ISO 724), and thread with its run-out, from the end, of lengths above 20 mm."""
SCREW_YIELD_MPA = 1080.0
"""Property class 12.9 (ISO 898-1)."""
SCREW_AREA_MM2 = 5.03
"""Stress area of M3 (ISO 898-1)."""


@dataclass(frozen=True)
class RoundBar:
    """A round axle or pin, perhaps with a bore, and the axial load at which its retention fails."""

    diameter_mm: float
    bore_mm: float
    yield_mpa: float
    axial_n: float

    def stress_mpa(self, moment_nmm: float) -> float:
        """Return its bending stress, 32·M·d/(pi·(d⁴ - b⁴))."""
        return 32.0 * moment_nmm * self.diameter_mm / (math.pi * (self.diameter_mm**4 - self.bore_mm**4))


def axle_bar(workshop: Workshop) -> RoundBar:
    """Return an axle across the plates; the retention of a rod in blind bores fails when a bore's floor shears off."""
    bought, safety, catalogue = workshop.bought, workshop.safety, workshop.catalogue
    if bought.retention == "nuts":
        return RoundBar(SCREW_SHANK_MM, 0.0, SCREW_YIELD_MPA, SCREW_AREA_MM2 * SCREW_YIELD_MPA / safety.metal_factor)
    rod, diameter = catalogue.rods[bought.axle], bought.axle_mm
    limit_mpa = min(rod.yield_mpa, safety.steel_yield_mpa)
    if bought.retention == "clips":
        axial = catalogue.clip_for(diameter).load_n / safety.metal_factor
    else:
        shear = workshop.material("body").strength_in_plane_mpa / VON_MISES / safety.printed_factor
        axial = math.pi * diameter * AXLE_FLOOR_MM * shear
    return RoundBar(diameter, rod.bore_share * diameter, limit_mpa, axial)


def clipped_pins(catalogue: Catalogue, bought: BoughtParts) -> Rod | None:
    """Return the rod of pins with clips: the axles' own, or silver steel where clevis pins are not made so thin.

    None where foot and leg have clevis pins.
    """
    if bought.retention == "clips":
        return catalogue.rods[bought.axle]
    thick = any(pin.diameter_mm == bought.axle_mm for pin in catalogue.clevis_pins.values())
    return None if thick else catalogue.rods[SOFT]


def pin_head_mm(catalogue: Catalogue, bought: BoughtParts) -> float:
    """Return the largest diameter of a pin of foot or leg as it is put in: its head, or the clip at its left end."""
    if clipped_pins(catalogue, bought):
        return catalogue.clip_for(bought.axle_mm).outer_mm
    return catalogue.clevis_pin_for(bought.axle_mm).head_mm


def pin_bar(workshop: Workshop) -> RoundBar:
    """Return a pin of foot or leg: a clevis pin with its split pin, or a rod with clips."""
    bought, safety, catalogue = workshop.bought, workshop.safety, workshop.catalogue
    if rod := clipped_pins(catalogue, bought):
        diameter = bought.axle_mm
        axial = catalogue.clip_for(diameter).load_n / safety.metal_factor
        return RoundBar(diameter, rod.bore_share * diameter, min(rod.yield_mpa, safety.steel_yield_mpa), axial)
    pin = catalogue.clevis_pin_for(bought.axle_mm)
    return RoundBar(pin.diameter_mm, 0.0, min(pin.yield_mpa, safety.steel_yield_mpa), pin.load_n / safety.metal_factor)
