"""Circuit boards: pins that contradict each other, voltages, the USB socket."""

import contextlib

import pytest

from jumpcad.catalogue import Board, load_catalogue


def test_a_boards_pins_contradict_each_other_by_what_they_say() -> None:
    """Each GPIO of a controller has one pin and each pin one GPIO, up to 63; what a pin does is one of a list."""
    board = load_catalogue().boards["xiao-esp32c3"]
    plain = board.model_copy(update={"supply_v": {"5V": (4.0, 6.0)}, "diode_at": ("5V",), "left": (), "right": ()})
    for pins, button, found in (
        ({"A": ("gpio1", "pwm"), "B": ("gpio63",)}, "B", []),
        ({"A": ("gpio1",), "B": ("gpio64",)}, "A", [("B", "gpio64", "must be at most gpio63")]),
        ({"A": ("gpio1",), "B": ("gpio1",)}, "A", [("B", "gpio1", "is the GPIO of A already")]),
        ({"A": ("gpio1", "gpio2")}, "A", [("A", "gpio2", "is a second GPIO of one pin")]),
        ({"A": ("gpio1", "blink")}, "A", [("A", "blink", "is no function of a pin: use ground, battery, out,")]),
        ({"A": ("gpio1",), "B": ("ground",)}, "B", [("button", "B", "is none of its pins with a GPIO, A:")]),
        ({"A": ("gpio1",)}, "", []),
    ):
        told = list(plain.model_copy(update={"pins": pins, "button": button}).contradictions())
        assert [(place[-1], value) for place, value, _ in told] == [(place, value) for place, value, _ in found]
        assert all(reason.startswith(start) for (_, _, reason), (_, _, start) in zip(told, found, strict=True))
    lost = plain.model_copy(update={"pins": {}, "button": "", "diode_at": ("VIN",)})
    ((place, value, reason),) = lost.contradictions()
    assert (place, value, reason) == (("diode_at",), "VIN", "is none of the inputs in supply_v, 5V")


def test_voltages_ascend() -> None:
    data = load_catalogue().boards["xiao-esp32c3"].model_dump(exclude_none=True)
    for volts, taken in (((3.0, 3.001), True), ((3.0, 3.0), False), ((4.0, 3.0), False)):
        with contextlib.nullcontext() if taken else pytest.raises(ValueError, match=r"\[lowest, highest\] in volts"):
            Board(**data | {"name": "own", "supply_v": {"5V": volts}, "diode_at": ()})
