"""What a multimeter and the firmware read of the battery's voltage, and how far either may be off (V)."""

from jumpcad.electronics.nets import LOWER_OHM, Wiring

RESISTOR = 0.01
"""Tolerance of the divider's resistors, as the bill orders them."""
METER_OHM, METER = 10e6, 0.01
"""Input resistance and error of a usual multimeter; judgement."""
CONVERTER_V = 0.035
"""Largest error of the ESP32-C3's calibrated converter over its range up to 2.5 V; its data sheet, from memory."""


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
