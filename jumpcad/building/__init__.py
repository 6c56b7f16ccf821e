"""From a design and a workshop to a printed robot: assembled, checked, and strengthened where a check fails."""

from jumpcad.building.growth import build

__all__ = ["build"]
