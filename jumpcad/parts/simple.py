"""Bought parts of simple shape: boxes, bearings and screws."""

from functools import lru_cache

from jumpcad.catalogue import Bearing, Catalogue, Screw
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.solids.outline import Region, disc, hexagon, hole, rectangle, ring
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array


@lru_cache(maxsize=64)
def round_outline(outer_mm: float, bore_mm: float = 0.0) -> Region:
    """Return a disc, or a ring, about the origin."""
    return ring(outer_mm, bore_mm) if bore_mm else disc(outer_mm)


@lru_cache(maxsize=64)
def box_outline(width_mm: float, height_mm: float) -> Region:
    """Return a rectangle about the origin."""
    return rectangle((width_mm, height_mm))


def placed_box(
    name: str, article: str, x: float, y: float, z: float, size_x: float, size_y: float, size_z: float, mass_g: float
) -> BoughtPart:
    """Return a box of the body, at the middle of its underside, by its sizes along the axes (mm)."""
    slabs = [(-size_y / 2.0, size_y / 2.0, box_outline(size_x, size_z))]
    return bought(name, article, BODY, mass_g, slabs, (x, y, z + size_z / 2.0))


def placed_screw(
    name: str, body: str, centre: Array, shank: Interval, side: float, screw: Screw, catalogue: Catalogue
) -> BoughtPart:
    """Return a screw whose shank fills an interval of y; its head sits at the left end (side +1) or the right (-1)."""
    height, width = screw.button_head_height_mm, screw.button_head_mm
    length = round(shank[1] - shank[0], 6)
    seat = length if side > 0 else -height
    volume_mass = catalogue.rod_mass_g(screw.diameter_mm, length) + catalogue.rod_mass_g(width, 0.7 * height)
    slabs = [(0.0, length, round_outline(screw.diameter_mm)), (seat, seat + height, round_outline(width))]
    at = (centre[0], shank[0], centre[1])
    return bought(name, f"screw {screw.name} x {length:g} {screw.norm}", body, volume_mass, slabs, at)


@lru_cache(maxsize=64)
def hexagon_outline(across_flats_mm: float, bore_mm: float) -> Region:
    """Return a hexagon with a bore, about the origin."""
    return hexagon(across_flats_mm) - hole(bore_mm)


def interval(a: float, b: float) -> Interval:
    """Return both ends of an interval, the lower one first."""
    return (a, b) if a < b else (b, a)


def bearing_part(name: str, centre: Array, right_mm: float, bearing: Bearing) -> BoughtPart:
    """Return a bearing whose right side is at `right_mm` along y."""
    slabs = [(0.0, bearing.width_mm, round_outline(bearing.outer_mm, bearing.bore_mm))]
    at = (centre[0], right_mm, centre[1])
    size = f"{bearing.bore_mm:g} x {bearing.outer_mm:g} x {bearing.width_mm:g} mm"
    return bought(name, f"ball bearing {bearing.name} ZZ, {size}", MAIN_LEG, bearing.mass_g, slabs, at)
