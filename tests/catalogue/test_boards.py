"""Circuit boards: pins that contradict each other, voltages, the USB socket."""

from jumpcad.catalogue import load_catalogue


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
        ({"A": ("gpio٣",)}, "", [("A", "gpio٣", "is no function of a pin")]),
    ):
        told = list(plain.model_copy(update={"pins": pins, "button": button}).contradictions())
        assert [(place[-1], value) for place, value, _ in told] == [(place, value) for place, value, _ in found]
        assert all(reason.startswith(start) for (_, _, reason), (_, _, start) in zip(told, found, strict=True))
    for side, pins in (("left", ("D0", "D0")), ("left", ("D8",))):  # on the shipped board D8 is at the right
        ((place, value, reason),) = board.model_copy(update={side: pins}).contradictions()
        assert (place, value, reason[:20]) == ((side,), pins[0], "stands at two places"), pins
    several = board.model_copy(update={"left": ("GND", "D0", "D1", "GND", "not connected")})  # ground is at many places
    assert not list(several.contradictions())
    lost = plain.model_copy(update={"pins": {}, "button": "", "diode_at": ("VIN",)})
    ((place, value, reason),) = lost.contradictions()
    assert (place, value, reason) == (("diode_at",), "VIN", "is none of the inputs in supply_v, 5V")
