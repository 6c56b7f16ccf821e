"""What guide and firmware's README say of motor, battery, boards and program: figures, not words."""

import math
from typing import Any

from jumpcad.bundle import firmware_numbers as firmware
from jumpcad.catalogue.electrical import DEAD_CELL_V
from jumpcad.electronics.nets import LOWER_OHM, Wiring
from jumpcad.electronics.supply import boards_beside_a
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.electronics.leads import lead_lengths
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.robot.stop.thing import free_release_j

STORED_V = 3.8
"""Per lithium polymer cell at rest, for storage; practice."""
FULL_AFTER = 1.5
"""Time to charge over that of the capacity at the full current, which falls at the end; judgement."""

RESISTOR = 0.01
"""Tolerance of the divider's resistors, as the bill orders them."""
METER_OHM, METER = 10e6, 0.01
"""Input resistance and error of a usual multimeter; judgement."""
CONVERTER_V = 0.035
"""Largest error of the ESP32-C3's calibrated converter over its range up to 2.5 V; its data sheet, from memory."""
BOX_FREE_MM = 8.0
"""Between a box on which a robot lies and its cage, and from the hoops down to the table; judgement."""


@decided_once
def operation_values(robot: Robot) -> dict[str, Any]:
    """Return articles, currents (mA), voltages (V), times (s, ms) and energies (J) by the names that templates use."""
    workshop, train, cam = robot.workshop, robot.layout.drive.train, robot.layout.drive.cam
    chosen, program = robot.layout.electronics, firmware.numbers(robot)
    supply, wiring = robot.supply, robot.wiring
    battery, controller = chosen.battery, chosen.controller
    free = supply.driven(train.motor, supply.nominal_v, workshop.safety.motor_torque_max_nm)
    duty = supply.duty(train.motor, workshop.safety.motor_torque_max_nm)
    # the battery gives that share of the motor's current: in PWM's pauses some of it flows back
    free_a = duty * train.motor.no_load_current_a
    boards_a = supply.boards_w / supply.nominal_v
    rate = None if controller.charge_ma is None else controller.charge_ma / battery.capacity_mah
    cuts = lead_lengths(robot.layout, wiring)
    low, high = pin_share(wiring)
    free_j, bears_j = free_release_j(robot)
    return {
        "name": robot.name, "program": program, "motor": train.motor, "battery": battery, "controller": controller,
        "parts": chosen.components, "regulator": chosen.regulator, "diode": chosen.diode,
        "charged_by_usb": chosen.charged_by_usb, "usb_side": robot.layout.fittings.usb_side, "charge_rate": rate,
        "charge_h": rate and FULL_AFTER / rate, "outside_ma": min(battery.capacity_mah, battery.bears_ma),
        "stored_v": STORED_V * battery.cells, "dead_v": DEAD_CELL_V * battery.cells,
        "left_on_h": battery.capacity_mah / 1000.0 * battery.voltage_v / supply.boards_w, "full_v": supply.full_v,
        "nominal_v": supply.nominal_v, "sensor_pin": wiring.pins.get("ready", "its pin of the sensor"),
        "divider_pin": wiring.pins.get("battery", ""), "divider_share": (low, high),
        "state_off_v": state_off_v(wiring, supply.nominal_v), "resistors": wiring.resistors,
        "opens": bool(wiring.ready_level), "contact": wiring.contact,
        "battery_pads": controller.with_function("battery"),
        "driver_supply": [str(one) for _, one, end, *_ in cuts if end.part == "capacitor" and one.part == "driver"],
        "motor_plus": next((str(one) for _, one, end, *_ in cuts if (end.part, end.pin) == ("motor", "+")), "motor +"),
        "motor_wire_mm": max((mm for *_, end, _, mm in cuts if end.part == "motor"), default=0.0),
        # a bench supply feeds the controller only if its own button starts it: else USB does
        "boards_a": boards_a if controller.button else boards_beside_a(chosen),
        "free_a": free_a + (boards_a if controller.button else boards_beside_a(chosen)), "wind_s": train.winding_s,
        "wind_j": train.electrical_j, "free_rpm": free.no_load_rpm,
        "dry_s": 2.0 * math.pi * train.ratio / (free.no_load_rpm * math.pi / 30.0),
        "after_ms": firmware.AFTER_RELEASE_MS, "landing_s": firmware.LANDING_MS / 1000.0,
        "delay_s": firmware.BUTTON_DELAY_MS / 1000.0, "stroke_deg": math.degrees(cam.law.compression_rad),
        "lift_deg": math.degrees(cam.law.lift_rad), "worn_deg": math.degrees(robot.release.worn_rad),
        "pull_n": 2.0 * robot.layout.drive.spring.torque_nmm / robot.design.carrying_link_mm,
        "shaft_hole_mm": train.motor.shaft_mm + 2.0 * workshop.fits.drawn.loose_mm, "box_mm": _box_mm(robot),
        "free_j": free_j, "bears_j": bears_j,
        "preloaded": robot.layout.drive.spring.preload_rad > robot.layout.stop.angle_rad,
    }  # fmt: skip


def _box_mm(robot: Robot) -> tuple[float, float] | None:
    """Return the most length and the least height of a box on which a plate lies between hoops; None without a cage."""
    cage = robot.layout.of(Cage)
    if cage is None:
        return None
    (rear, front), (low, high) = cage.bars, robot.layout.lateral.outside  # fmt: skip
    between = float(front.place_mm[0] - rear.place_mm[0]) - 2.0 * BOX_FREE_MM
    beside = max(arc.radius_mm for arc in cage.arcs) - (high - low) / 2.0 + BOX_FREE_MM
    return 10.0 * math.floor(between / 10.0), 10.0 * math.ceil(beside / 10.0)


def pin_share(wiring: Wiring) -> tuple[float, float]:
    """Return the least and the largest share of the battery's voltage that a multimeter reads at the divider's pin.

    Both resistors may be off in opposite directions, and the multimeter's resistance lies beside the lower one.
    """
    upper = wiring.upper_ohm or 0
    source = upper * LOWER_OHM / (upper + LOWER_OHM)
    least, most = (
        LOWER_OHM * (1.0 + by) / (LOWER_OHM * (1.0 + by) + upper * (1.0 - by)) for by in (-RESISTOR, RESISTOR)
    )
    loaded = METER_OHM / (METER_OHM + source)
    return least * loaded * (1.0 - METER), most * loaded * (1.0 + METER)


def state_off_v(wiring: Wiring, battery_v: float) -> float:
    """Return by how much the voltage that `state` prints may differ from the battery's: resistors and converter."""
    divider = wiring.divider
    return 2.0 * RESISTOR * (divider - 1.0) / divider * battery_v + CONVERTER_V * divider
