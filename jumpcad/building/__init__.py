"""From a design and a workshop to a printed robot: assembled, checked, and strengthened where a check fails."""

from jumpcad.building.assembly import layout_of
from jumpcad.building.growth import build, built_and_checked

__all__ = ["build", "built_and_checked", "layout_of"]
