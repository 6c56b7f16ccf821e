"""From a design and a workshop to a printed robot: assembled, judged by strength checks, and grown where it is weak."""

from jumpcad.building.growth import build

__all__ = ["build"]
