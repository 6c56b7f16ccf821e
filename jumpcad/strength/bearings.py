"""The main leg's hub: loads of its bearings with the springs loaded, and the bearings that carry them (N, mm).

Two bearings sit at the hub's faces. The springs' arms press evenly on both; the cam pushes beside the leg, where the
roller is, so that the leg tilts against them and the nearer one carries more than the cam's whole force.
"""

import math

import numpy as np

from jumpcad.catalogue import Bearing, Catalogue, Washer
from jumpcad.design import Design
from jumpcad.dimensions import ROLLER_WASHER_MM
from jumpcad.drive import Drive
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array, direction
from jumpcad.workshop import Workshop

ANY = "any"
"""Instead of a bearing's name in a workshop: the lightest of the catalogue that carries its load."""
LONGEST_ARM_MM = 10.0
"""Springs' torque over a bearing's load; judgement: about the longest of many designs, so that few hubs carry less."""
LARGEST_ROLLER_MM = 13.0
"""Rollers of 16 mm and more overlapped the flank of their cam by 0.1 to 17 mm³, 4° to 5° past rest, which the limits of
the cam's search do not see; those of 13 mm did not (measured on two templates)."""
RING_PLAY_MM = 0.2
"""How much narrower than a roller's outer ring begins is what the screw clamps; judgement: makers differ by as much."""
SHOULDER_MM = 0.8
"""Least distance between the seats of both bearings; judgement: four layers of 0.2 mm."""


def hub_bearings(workshop: Workshop) -> list[Bearing | None]:
    """Return the bearings that a workshop allows in the hub, the lightest first; None where it names none."""
    name, axle = workshop.bought.leg_bearing, workshop.bought.axle_mm
    if not name:
        return [None]
    known = workshop.catalogue.bearings
    named = list(known.values()) if name == ANY else [known[name]]
    fitting = [bearing for bearing in named if bearing.bore_mm == axle]
    if not fitting:
        raise JumpcadError(
            f'bought.leg_bearing = "{name}": no such bearing has the bore of bought.axle_mm = {axle:g}: '
            'change one of them, or run the hub on its axle (leg_bearing = "")'
        )
    return [*sorted(fitting, key=lambda bearing: bearing.mass_g)]


def roller_bearing(workshop: Workshop) -> Bearing:
    """Return the bearing that runs on the cam."""
    roller, screw = workshop.catalogue.bearings[workshop.bought.roller], workshop.catalogue.screws["M3"]
    if roller.bore_mm != screw.diameter_mm:
        raise JumpcadError(
            f'bought.roller = "{roller.name}": its bore of {roller.bore_mm:g} mm does not fit the {screw.name} '
            f"screw that holds it: choose a bearing with a bore of {screw.diameter_mm:g} mm"
        )
    if roller.outer_mm > LARGEST_ROLLER_MM:
        raise JumpcadError(
            f'bought.roller = "{roller.name}": with {roller.outer_mm:g} mm diameter it would meet its cam where '
            f"the leg swings past rest: choose a bearing of {LARGEST_ROLLER_MM:g} mm diameter or less"
        )
    roller_washer(roller, workshop.catalogue)
    return roller


def roller_washer(roller: Bearing, catalogue: Catalogue) -> Washer:
    """Return the widest washer between lever and roller that leaves the roller's outer ring free."""
    head, free = catalogue.screws["M3"].button_head_mm, roller.outer_ring_mm - RING_PLAY_MM
    washers = sorted(catalogue.washers.values(), key=lambda washer: -washer.outer_mm)
    for washer in washers:
        if max(washer.outer_mm, head) <= free:
            return washer
    raise JumpcadError(
        f'bought.roller = "{roller.name}": the screw clamps its outer ring, which begins at about '
        f"{roller.outer_ring_mm:.1f} mm, between the screw's head of {head:g} mm and the smallest washer of "
        f"{washers[-1].outer_mm:g} mm: choose a bearing of 7 mm diameter or more"
    )


def roller_screw_mm(leg_mm: float, roller: Bearing, catalogue: Catalogue) -> float:
    """Return the length of the screw through roller, washer, a leg of `leg_mm` and the lock nut behind it."""
    clamped = leg_mm + ROLLER_WASHER_MM + roller.width_mm + catalogue.nuts["M3 nyloc"].height_mm
    return catalogue.screws["M3"].length_for(clamped, "choose a narrower bought.leg_bearing or bought.roller")


def first_guess(bearings: list[Bearing | None], design: Design, workshop: Workshop) -> int:
    """Return the number of the bearing to try first; those before it are hardly ever strong enough."""
    springs = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    load = 1000.0 * springs.peak_torque_nm / LONGEST_ARM_MM
    enough = (bearing is None or load <= allowed_n(bearing, workshop) for bearing in bearings[:-1])
    return next((number for number, good in enumerate(enough) if good), len(bearings) - 1)


def hub_width_mm(bearing: Bearing | None) -> float:
    """Return how wide the hub must be for two bearings and the shoulder between them."""
    return 0.0 if bearing is None else 2.0 * bearing.width_mm + SHOULDER_MM


def loaded_forces_n(design: Design, drive: Drive) -> tuple[Array, Array]:
    """Return the forces (2,) of both springs' arms on the leg, and of the cam on the lever, springs loaded.

    In the body's x-z plane, with the roller at the end of the lift. An arm pushes its pin away from the hub, square to
    the arm.
    """
    spring = drive.spring
    outwards = direction(-(spring.leg_pin_rad + design.compression_rad - spring.arms.turn_rad))
    on_leg = 2.0 * spring.pin_force_n * outwards
    lever = drive.cam.geometry.lever_start_rad + design.compression_rad
    return on_leg, drive.cam.peak_contact_n * np.array([-math.sin(lever), math.cos(lever)])


def bearing_load_n(forces_n: tuple[Array, Array], leg_mm: float, roller_mm: float, bearing: Bearing) -> float:
    """Return the load of the more heavily loaded of two bearings under `loaded_forces_n`, the arms' amid the hub.

    The leg's width may have to grow for the bearings; the roller is beside it.
    """
    arms, cam = forces_n
    width = max(leg_mm, hub_width_mm(bearing))
    tilt = (width / 2.0 + ROLLER_WASHER_MM + roller_mm / 2.0) / (width - bearing.width_mm)
    return float(max(np.linalg.norm(arms / 2.0 + cam * (0.5 + side * tilt)) for side in (-1.0, 1.0)))


def allowed_n(bearing: Bearing, workshop: Workshop) -> float:
    """Return the largest load of a bearing: its static load rating over safety factor and reserves."""
    return bearing.static_load_n / (workshop.safety.bearing_factor * workshop.safety.load_factor)
