"""Axles and pins for the strength checks: section, yield stress, retention; beams on both plates (mm, MPa, N)."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Catalogue, Rod
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.drive.gears import GearPair
from jumpcad.strength.stress import VON_MISES
from jumpcad.transforms import Array
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


@dataclass(frozen=True)
class AxleBeam:
    """A straight beam on two supports under forces across it (statics; Roark, ch. 8).

    - `supports_mm`: Places of the left and of the right plate's middle, y to the left.
    - `places_mm`, `forces_n`: Places (n,) of the forces between the plates, and forces (n, 2), x-z in the body's frame.
    """

    supports_mm: tuple[float, float]
    places_mm: Array
    forces_n: Array

    @classmethod
    def of(cls, supports_mm: tuple[float, float], *loads: tuple[float, Array]) -> "AxleBeam":
        """Return the beam under loads, each a place and a force (2,)."""
        return cls(supports_mm, np.array([place for place, _ in loads]), np.array([force for _, force in loads]))

    def on_plates_n(self) -> Array:
        """Return what the axle presses on the left and on the right plate (2, 2)."""
        left, right = self.supports_mm
        share = (self.places_mm - right) / (left - right)
        return np.stack([share, 1.0 - share]) @ self.forces_n

    @property
    def plate_load_n(self) -> float:
        """The larger of what both plates carry."""
        return float(np.linalg.norm(self.on_plates_n(), axis=1).max())

    def moments_nmm(self, at_mm: Array) -> Array:
        """Return the bending moments (k,) at places (k,) between the plates."""
        beyond = np.maximum(at_mm[:, None] - self.places_mm, 0.0)
        moments = (at_mm - self.supports_mm[1])[:, None] * self.on_plates_n()[1] - beyond @ self.forces_n
        return np.asarray(np.linalg.norm(moments, axis=1))

    def largest_nmm(self, up_to_mm: float = np.inf) -> float:
        """Return the largest bending moment from the right plate to a place: at a force, or there."""
        return float(self.moments_nmm(np.minimum(self.places_mm, up_to_mm)).max())


def on_hub(force_n: Array, half_mm: float, place_mm: float = 0.0) -> Iterator[tuple[float, Array]]:
    """Yield the loads of a hub that bears `half_mm` to either side of y = 0, pushed at a place (mm).

    Pushed beside them it tilts, so that the nearer one may carry more than the whole force.
    """
    for side in (1.0, -1.0):
        yield side * half_mm, force_n * (0.5 + side * place_mm / (2.0 * half_mm))


def mesh_force_n(torque_nmm: float, pair: GearPair, wheel_mm: Array, pinion_mm: Array, sense: float) -> Array:
    """Return the force (2,) of a pinion's teeth on the wheel that it drives.

    T over the wheel's base radius along the line of action: the wheel is pushed in its sense of rotation, and away from
    the pinion (Shigley 13-14). The sense is 1 for a wheel that turns positively about +y, -1 for the other way.
    """
    away = (wheel_mm - pinion_mm) / np.linalg.norm(wheel_mm - pinion_mm)
    along = sense * np.array([-away[1], away[0]])
    angle = pair.working_angle_rad
    force: Array = torque_nmm / pair.wheel.base_radius_mm * (math.cos(angle) * along + math.sin(angle) * away)
    return force
