"""The gear motor, and the screws of its cap (mm, g)."""

from collections.abc import Iterator
from functools import lru_cache

from jumpcad.mechanism.model import BODY
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import box_outline, placed_screw
from jumpcad.robot.layout import Layout
from jumpcad.robot.train.drawing import gear_turns
from jumpcad.robot.train.motor_socket import ear_places
from jumpcad.solids.outline import Region, disc, rectangle
from jumpcad.workshop import Workshop

CAP_SCREW_MM = 8.0
"""Length of the M2 screws that hold the motor's cap on the ears of its socket, a stock length; judgement: more thread
in plastic than twice their diameter, through a cap of 2.4 mm."""


def motor(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the gear motor and the screws of its cap; the shaft is turned to fit the pinion."""
    motor, (x, z), catalogue = layout.drive.train.motor, layout.motor_mm, workshop.catalogue
    low, front = layout.lateral.motor
    shaft_mass = catalogue.rod_mass_g(motor.shaft_mm, motor.shaft_length_mm)
    body = [(0.0, front - low, box_outline(motor.width_mm, motor.height_mm))]
    shaft = [(0.0, motor.shaft_length_mm, _d_shaft(motor.shaft_mm, motor.shaft_flat_mm))]
    article, turn = f"gear motor {motor.name}", gear_turns(layout)["motor_pinion"]
    article += f" ({motor.article})" if motor.article else ""
    yield bought("motor", article, BODY, motor.mass_g - shaft_mass, body, (x, low, z), layout.motor_angle_rad)
    yield bought("motor_shaft", article, BODY, shaft_mass, shaft, (x, front, z), turn, units=0)
    screw = catalogue.screws["M2"]
    for number, ear in enumerate(ear_places(layout), start=1):
        top = layout.lateral.motor_cap[1] - screw.button_head_height_mm
        yield placed_screw(f"cap_screw_{number}", BODY, ear, (top - CAP_SCREW_MM, top), 1.0, screw, catalogue)


@lru_cache(maxsize=64)
def _d_shaft(diameter_mm: float, across_flat_mm: float) -> Region:
    flat = rectangle((diameter_mm, 2.0 * diameter_mm)).translate((across_flat_mm, 0.0))
    return disc(diameter_mm) - flat
