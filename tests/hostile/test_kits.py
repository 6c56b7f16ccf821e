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
    "a mount without a base": (
        "[body]\nplate_mm = 9.5",
        r"^no room for the sensor's mount: the base of its switch is -0\.\d\d mm outside the left plate, which is "
        r"9\.5 mm thick, 0\.35 mm are needed: choose a thinner body\.plate_mm",
    ),
}


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
