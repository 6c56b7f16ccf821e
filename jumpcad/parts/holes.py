"""Holes and shafts from the one fit profile: every clearance of every part comes from here (mm)."""

from dataclasses import dataclass
from typing import Self

from jumpcad.catalogue import Bearing
from jumpcad.solids.outline import Region, hole
from jumpcad.solids.stack import Stack
from jumpcad.workshop import Fits, Process, Workshop


@dataclass(frozen=True)
class HoleSizes:
    """Diameters of holes for a nominal shaft, the hub's seat, and the edge on the bed."""

    fits: Fits
    process: Process
    axle_mm: float
    bearing: Bearing | None

    @classmethod
    def of(cls, workshop: Workshop, bearing: Bearing | None) -> Self:
        """Return the bores of a workshop's fits and axles, and of the hub's bearings."""
        return cls(workshop.fits.drawn, workshop.process, workshop.bought.axle_mm, bearing)

    def press(self, diameter_mm: float) -> float:
        """Return the diameter of a hole that holds a shaft tightly."""
        return diameter_mm + 2.0 * self.fits.press_mm

    def eye(self, diameter_mm: float) -> float:
        """Return the diameter of a link's eye that swings on a pin with little play."""
        return diameter_mm + 2.0 * self.fits.eye_mm

    def lying(self, diameter_mm: float) -> float:
        """Return the diameter of a hole that prints lying, for a pin that something else keeps."""
        return diameter_mm + 2.0 * self.fits.lying_mm

    def running(self, diameter_mm: float) -> float:
        """Return the diameter of a hole that turns on a shaft."""
        return diameter_mm + 2.0 * self.fits.sliding_mm

    def loose(self, diameter_mm: float) -> float:
        """Return the diameter of a hole that a shaft passes freely."""
        return diameter_mm + 2.0 * self.fits.loose_mm

    @property
    def hub_bore_mm(self) -> float:
        """Bore of the leg's hub."""
        return self.press(self.bearing.outer_mm) if self.bearing else self.running(self.axle_mm)

    @property
    def hub_radius_mm(self) -> float:
        """Outer radius of the leg's hub."""
        return self.hub_bore_mm / 2.0 + 2.0 * self.fits.wall_mm

    def hub_slabs(self, y0_mm: float, y1_mm: float) -> list[tuple[float, float, Region]]:
        """Return the hub's bore as slabs (y0, y1, hole): a seat at either face and a shoulder, or one running bore."""
        if self.bearing is None:
            return [(y0_mm, y1_mm, hole(self.running(self.axle_mm)))]
        seat = hole(self.press(self.bearing.outer_mm))
        width = self.bearing.width_mm
        shoulder = hole(max(self.bearing.outer_mm - 1.2, self.running(self.axle_mm)))
        return [(y0_mm, y0_mm + width, seat), (y0_mm + width, y1_mm - width, shoulder), (y1_mm - width, y1_mm, seat)]

    def chamfered(self, stack: Stack) -> Stack:
        """Return a stack with the edge of its bed face chamfered, since the first layer spreads."""
        return stack.chamfered(
            self.fits.first_layer_chamfer_mm, self.process.layer_height_mm, self.process.first_layer_mm
        )
