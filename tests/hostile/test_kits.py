"""Electrical parts that do not fit: one line with the value, the limit and a way out, and nothing is written."""

from pathlib import Path

import pytest

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


def own(kind: str, figures: str, like: str = "") -> str:
    """Return a workshop with a battery, controller or driver that is a shipped one with other figures."""
    table, shipped = {
        "battery": ("batteries", "lipo-1s-300"),
        "controller": ("boards", "xiao-esp32c3"),
        "driver": ("boards", "drv8833"),
    }[kind]
    return f'[bought]\n{kind} = "own"\n[{table}.own]\nlike = "{like or shipped}"\nsource = "x"\n{figures}'


NO_PINS = 'button = ""\npins = { GND = ["ground"], D1 = ["gpio3", "adc", "pwm"] }'
REFUSED = {
    "a battery that is too long for the plates": (
        own("battery", "length_mm = 300.0"),
        r"^part body_plate_\w+ of 30\d\.\d×.* does not fit the bed of 250\.0×.*: choose .* a smaller battery",
    ),
    "a board that is too long between the plates": (
        own("controller", "length_mm = 400.0"),
        r"^part body_plate_\w+ of .*40\d\.\d mm does not fit the bed of 250\.0×.*: choose .* smaller battery or boards",
    ),
    "a board with too few pins": (
        own("controller", NO_PINS),
        r"^own has no pin left for motor and sleep and ready: 1 of 4 suit: choose a controller with more pins",
    ),
    "a driver without outputs": (
        own("driver", 'pins = { GND = ["ground"], AIN1 = ["forward"] }'),
        r"^driver own has no pin motor\+ and motor-: choose another bought.driver",
    ),
    "two cells where one is borne": (
        '[bought]\nbattery = "lipo-2s-180"',
        r"^xiao-esp32c3 at BAT\+ gets 6\.\d\d to 8\.40 V and bears 3\.20 to 4\.20 V: choose a bought\.kit, ",
    ),
    "one cell for a motor of 12 V": (
        '[bought]\nkit = "strong-2s"\nbattery = "lipo-1s-300"',
        r"^n20-298-hpcb12 at winding gets 3\.30 to 4\.20 V and bears 5\.00 to 12\.00 V: choose a bought\.kit, ",
    ),
    "a charger that is too strong": (
        own("battery", "capacity_mah = 100.0\ncharge_ma = 100.0"),
        r"^xiao-esp32c3 charges own with 370 mA; 100 mA are allowed, by its charge_ma: another bought\.battery",
    ),
    "a part without a mass": (
        '[bought]\nbattery = "own"\n[batteries.own]\ndescription = "x"\nsource = "x"\nlength_mm = 30.0\n'
        "width_mm = 20.0\nheight_mm = 6.0\nvoltage_v = 3.7\ncapacity_mah = 300.0",
        r"my.toml:3: batteries\.own\.mass_g: missing: weigh it, or take the maker's figure$",
    ),
    "a part without a source": (
        own("battery", "mass_g = 9.0").replace('source = "x"\n', ""),
        r"my.toml:3: batteries\.own\.source: missing: say where the figures come from$",
    ),
    "a mount without a base": (
        "[body]\nplate_mm = 9.5",
        r"^no room for the sensor's mount: the base of its switch is -0\.\d\d mm outside the left plate, which is "
        r"9\.5 mm thick, 0\.35 mm are needed: choose a thinner body\.plate_mm",
    ),
}


PINS = 'button = ""\npins = { %s }'
NO_BOARD = {
    "one number at several pins": (
        PINS % ", ".join(f'D{pin} = ["gpio2", "pwm"]' for pin in range(5)),
        r"boards\.own\.pins\.D1 = 'gpio2': is the GPIO of D0 already: each pin has its own number; .*D4 = 'gpio2'",
    ),
    "one number at a pin and at the button's": (
        'button = "D9"\npins = { D0 = ["gpio9"], D9 = ["gpio9"] }',
        r"pins\.D9 = 'gpio9': is the GPIO of D0 already",
    ),
    "a number that no chip has": (PINS % 'D0 = ["gpio999999"]', r"pins\.D0 = 'gpio999999': must be at most gpio63"),
    "two numbers at one pin": (PINS % 'D0 = ["gpio2", "gpio3"]', r"pins\.D0 = 'gpio3': is a second GPIO of one pin"),
    "an unknown function": (
        PINS % 'D0 = ["gpio2", "frobnicate"]',
        r"pins\.D0 = 'frobnicate': is no function of a pin: use ground, battery, out, adc, .*, or gpio and its number",
    ),
    "a pin twice at a side": ('left = ["D0", "D0"]', r"my\.toml:6: boards\.own\.left = 'D0': stands at two places"),
    "a pin at both sides": ('left = ["D8"]', r"boards\.own\.left = 'D8': stands at two places: name each pin once"),
    "a diode at no input": (
        'diode_at = ["nope"]',
        r"boards\.own\.diode_at = 'nope': is none of the inputs in supply_v, BAT\+, 5V",
    ),
    "a diode where no input is": (
        "supply_v = {}",
        r"boards\.own\.diode_at = '5V': is none of the inputs in supply_v, of which it has none",
    ),
    "a button at no pin": (
        'button = "D99"',
        r"my\.toml:6: boards\.own\.button = 'D99': is none of its pins with a GPIO",
    ),
    "a button at ground": ('button = "GND"', r"my\.toml:6: boards\.own\.button = 'GND': is none of its pins"),
}


@pytest.mark.parametrize("case", NO_BOARD)
def test_a_board_that_contradicts_itself_is_refused_when_it_is_read(case: str, tmp_path: Path) -> None:
    figures, words = NO_BOARD[case]
    path = tmp_path / "my.toml"
    path.write_text(own("controller", figures), encoding="utf-8")
    with pytest.raises(JumpcadError, match=words) as refusal:
        load_workshop(path)
    assert "\n" not in str(refusal.value)


def test_boards_that_are_sold_do_not_contradict_themselves() -> None:
    """Ground is at several places of many boards."""
    from jumpcad.catalogue import load_catalogue

    boards = load_catalogue().boards
    for board in boards.values():
        assert not list(board.contradictions())
    several = boards["xiao-esp32c3"].model_copy(update={"left": ("GND", "D0", "D1", "GND", "not connected")})
    assert not list(several.contradictions())


@pytest.mark.parametrize("case", REFUSED)
def test_what_does_not_fit_is_refused_in_one_line(case: str, tmp_path: Path) -> None:
    text, words = REFUSED[case]
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(JumpcadError, match=words) as refusal:
        export(build(load_design("kenan-2.0"), load_workshop(path), "mine"), tmp_path / "out", pictures=False)
    assert "\n" not in str(refusal.value)
    assert not (tmp_path / "out").exists()


def test_a_battery_that_hits_the_cam_is_refused_with_its_size(tmp_path: Path) -> None:
    """Beside a cam that reaches to the plates' end no tray of 200 x 200 mm has room."""
    from jumpcad.catalogue import load_catalogue
    from jumpcad.layout.electronics import Electronics
    from jumpcad.layout.room import EVERYWHERE, disc
    from jumpcad.layout.tray_places import tray_place

    catalogue = load_catalogue()
    battery = catalogue.batteries["lipo-1s-300"].model_copy(update={"length_mm": 200.0, "height_mm": 200.0})
    electronics = Electronics(battery, catalogue.boards["xiao-esp32c3"], catalogue.boards["drv8833"])
    words = (
        r"^no room for the battery and electronics: [\d.]+ mm too little .*: raise .*, or choose a smaller battery or "
        r"smaller boards: lipo-1s-300, .* take 20[\d.]+ x 2[\d.]+ mm$"
    )
    with pytest.raises(JumpcadError, match=words):
        tray_place([disc("cam", (-20.0, 40.0), 60.0, EVERYWHERE)], electronics, 80.0, (-15.0, 15.0))
