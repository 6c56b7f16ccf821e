"""What the guide says of motor, springs, sizes and jump, computed by hand from data sheets and the design."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from jumpcad.bundle.expected import _measured, _near_stop, _prong_mm, expected, filled
from jumpcad.bundle.operation import by_button, cable, charging, charging_loaded, switching_off, to_stop, usb_out
from support.built import built, geared, part, placed

from jumpcad.building import build
from jumpcad.bundle import expected as module
from jumpcad.bundle.drawings.wiring import wires
from jumpcad.bundle.firmware import numbers
from jumpcad.design import load_design
from jumpcad.dimensions import AXLE_FLOOR_MM
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import Wiring
from jumpcad.errors import CannotBuildError
from jumpcad.workshop import load_workshop


def figure(words: dict[str, str], name: str) -> float:
    return float(words[name])


def test_the_motor_is_a_line_from_no_load_to_stall_in_series_with_battery_and_driver() -> None:
    """Pololu 2371: 6 V, 73 rpm with 70 mA, 0.67 A stalled; one cell of 3.7 to 4.2 V has no need of PWM."""
    robot = built("kenan-2.0")
    words, train, chosen = expected(robot, []), robot.layout.drive.train, chosen_parts(robot.workshop)
    series = chosen.battery.ohm + chosen.driver.resistance_ohm
    winding = 6.0 / 0.67
    rpm = 73.0 * (3.7 - 0.07 * (winding + series)) / (6.0 - 0.07 * winding)
    assert figure(words, "free_rpm") == pytest.approx(rpm, abs=0.51)
    (stage,) = train.stages
    turn_s = 60.0 / rpm * stage.wheel.teeth / stage.pinion.teeth
    assert figure(words, "dry_s") == pytest.approx(turn_s, abs=0.051)
    boards_ma = 24.0 + 1.7  # of the controller and of the driver
    assert figure(words, "boards_ma") == pytest.approx(boards_ma, abs=0.51)
    assert figure(words, "free_ma") == pytest.approx(70.0 + boards_ma, abs=0.51)
    assert figure(words, "peak_ma") == pytest.approx(1000.0 * train.peak_current_a + boards_ma, abs=0.51)
    for name in ("boards", "free"):
        assert figure(words, f"{name}_a") == pytest.approx(figure(words, f"{name}_ma") / 1000.0, abs=0.0056)
    assert (words["battery_v"], words["nominal_v"]) == ("3.7 to 4.2", "3.7")
    volt_amperes = 3.7 * figure(words, "wind_ma") / 1000.0
    assert volt_amperes * train.winding_s == pytest.approx(train.electrical_j, rel=0.01)
    assert figure(words, "wind_j") == pytest.approx(train.electrical_j, abs=0.0051)
    assert figure(words, "wind_s") == pytest.approx(train.winding_s, abs=0.051)


@pytest.mark.parametrize(("button", "read"), [("BOOT", "the boards included"), (None, "the controller left to the")])
def test_a_bench_supply_feeds_the_controller_only_if_its_own_button_starts_it(
    monkeypatch: pytest.MonkeyPatch, button: str | None, read: str
) -> None:
    robot = built("kenan-2.0")
    chosen = chosen_parts(robot.workshop)
    controller = chosen.controller.model_copy(update={"button": button})
    monkeypatch.setattr(module, "chosen_parts", lambda _: replace(chosen, controller=controller))
    words = expected(robot, [])
    assert (words["cable"], words["wind_by"], words["jump_by"]) == (
        cable(controller), by_button("wind", controller), by_button("jump", controller)
    )  # fmt: skip
    assert words["jump_by"].startswith("Press" if button else "Type")
    chosen = replace(chosen, controller=controller)
    assert (words["usb_out"], words["stop_by"], words["off"]) == (
        usb_out(chosen),
        to_stop(chosen),
        switching_off(chosen),
    )
    assert (words["charge_how"], words["charge_loaded"]) == (charging(chosen), charging_loaded(chosen))
    assert words["boards_read"].startswith(read)
    assert (figure(words, "boards_ma") > 20.0) == (button is not None)


def test_times_and_limits_are_those_of_the_program() -> None:
    robot = built("kenan-2.0")
    words, values = expected(robot, []), numbers(robot)
    for name, value, factor in (
        ("wind_max", "WIND_MAX_MS", 1000.0), ("release_ms", "RELEASE_MAX_MS", 1.0), ("min_v", "BATTERY_MIN_V", 1.0),
        ("after_ms", "AFTER_RELEASE_MS", 1.0), ("landing_s", "LANDING_MS", 1000.0),
    ):  # fmt: skip
        assert factor * figure(words, name) == values[value], name
    assert figure(words, "ready_deg") == pytest.approx(values["READY_DEG"] or math.nan, abs=0.51)
    assert words["divider_pin"] == "D1"
    for volts, share in zip(words["divider_v"].split(" to "), words["divider_share"].split(" to "), strict=True):
        assert float(volts) == pytest.approx(3.7 * float(share), abs=0.0071)


def test_what_state_prints_is_off_by_that_of_the_battery_and_not_of_its_pin() -> None:
    """680 over 200 kΩ on two cells: 2 % of 0.77 of 7.4 V, and 35 mV times 4.4, are 0.27 V together."""
    words = _measured(Wiring((), {"battery": "D1"}, 680_000), 7.4)
    assert (words["state_off"], words["divider_pin"]) == ("0.3", "D1")


def test_one_pair_of_gears_turns_the_cam_against_the_motor_and_two_with_it() -> None:
    one, two = expected(built("kenan-2.0"), []), expected(geared(), [])
    assert one["cam_turn"] == two["cam_turn"] == two["motor_turn"] == "counter-clockwise"
    assert one["motor_turn"] == "clockwise"


@pytest.mark.parametrize("preload_deg", [0.0, 4.0])
def test_what_hands_feel_of_the_springs_follows_from_hookes_law(preload_deg: float) -> None:
    """A spring of k N·mm/° pushes with k times its angle over the lever; both on the leg's pin at the hub.

    With the leg on its stop, 3° past rest, a spring is loaded by 3° less.
    """
    design, shop = load_design("kenan-2.0"), load_workshop()
    preloaded = shop.spring.model_copy(update={"preload_deg": preload_deg})
    robot = build(design, shop.model_copy(update={"spring": preloaded}))
    words, spring = expected(robot, []), robot.layout.drive.spring
    rate = design.stiffness_nmm_per_deg / 2.0
    compression_deg = math.degrees(design.compression_rad)
    wound_deg = compression_deg if not preload_deg else math.degrees(spring.wound_rad)
    wider = math.floor(0.1 * wound_deg)
    assert words["stroke"] == f"{compression_deg:.0f}"
    assert words["lift"] == "310"
    at_stop = preload_deg - 3.0
    slack = (
        "up to 3° with springs as ordered, for up to 13° with arms" if not preload_deg else "slack for up to 9° before"
    )
    assert slack in words["near_stop"]
    assert words["wider"] == f"{wider}"
    assert figure(words, "preload") == max(0.0, at_stop)
    assert figure(words, "preload_n") == pytest.approx(max(0.0, at_stop) * rate / spring.arms.lever_mm, abs=0.051)
    arm_n = max(1.0, (at_stop + wider) * rate / spring.arms.lever_mm)
    assert figure(words, "arm_n") == pytest.approx(arm_n, abs=0.51)
    assert figure(words, "foot_n") == pytest.approx(2.0 * rate * wound_deg / design.carrying_link_mm, abs=0.051)
    joules = rate * math.radians(1.0) * (wound_deg**2 - preload_deg**2) / 1000.0
    assert figure(words, "energy") == pytest.approx(joules, abs=0.0051)
    assert figure(words, "push_ms") == pytest.approx(1000.0 * robot.release.push_off_s, abs=0.51)
    assert figure(words, "pin_hole") == pytest.approx(robot.layout.pin_hole.diameter_mm, abs=0.051)
    assert figure(words, "dog_play") == pytest.approx(math.degrees(robot.layout.drive.dog.play_rad), abs=0.51)


def test_springs_with_much_preload_push_the_leg_against_its_stop() -> None:
    """With 13° and more even the narrowest arms, 10° less, are loaded on a stop 3° past rest."""
    assert _near_stop(0.0, 0.0) == "The springs push it against its stop."
    assert "slack for up to 1° before its stop: no fault" in _near_stop(0.0, 0.4)


def test_slack_is_never_said_to_be_less_than_it_is() -> None:
    """0.4° and 2.2° are 1° and 3° at most; 3° stays 3° where its last digit is lost on the way from radians."""
    assert "slack, for up to 1° with springs as ordered, for up to 3° with" in _near_stop(0.4, 2.2)
    assert "slack, for up to 3° with springs as ordered" in _near_stop(math.degrees(math.radians(3.0)), 13.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("across", "along", "out", "prong"),
    [(20.0, 0.0, 1.0, 6.0), (8.1, 0.0, 1.0, 3.5), (8.4, 4.9, 1.0, 3.5), (8.1, 5.1, 1.0, 6.0), (5.0, 0.0, 1.0, 3.0),
     (8.1, 0.0, -3.0, 6.0)],
)  # fmt: skip
def test_the_block_stops_half_a_millimetre_before_what_stands_beside_the_window(
    across: float, along: float, out: float, prong: float, sign: float
) -> None:
    """An N20's window is 8 x 10 mm; the block is 9 mm long, with 3 to 6 mm on either side, in halves of a millimetre.

    The thing is 2 mm wide and long, `across` and `along` from the window's middle, outside of the plate.
    """
    robot = built("kenan-2.0")
    layout, item = robot.layout, next(one for one in robot.hardware if one.body == "body")
    corners = np.array([[x, y, z] for x in (across, across + 2.0) for y in (0.0, out) for z in (along, along + 2.0)])
    turn = layout.motor_angle_rad
    cos, sin = sign * math.cos(turn), sign * math.sin(turn)
    points = np.column_stack([
        layout.motor_mm[0] + cos * corners[:, 0] - sin * corners[:, 2],
        layout.lateral.right_plate[0] - corners[:, 1],
        layout.motor_mm[1] + sin * corners[:, 0] + cos * corners[:, 2],
    ])  # fmt: skip
    thing = replace(item, T_body_part=np.eye(4))
    vars(thing)["look"] = SimpleNamespace(vertices=points)  # the mesh that is seen
    assert _prong_mm(replace(robot, hardware=(thing,))) == prong


def test_sizes_are_those_of_the_parts() -> None:
    """A rod of 3 mm in a bore reamed 0.1 mm wider; a rod may be 0.3 mm short, and then has as much more play."""
    robot = built("kenan-2.0")
    words = expected(robot, [])
    assert words["eye_drill"] == "3.1"
    least, most = map(float, words["end_play"].split(" mm, or "))
    assert most - least == pytest.approx(0.3)
    rod = next(item for item in robot.hardware if item.name == "leg_axle")
    between = float(np.diff(robot.layout.lateral.outside)[0]) - 2.0 * AXLE_FLOOR_MM  # of the plates' closed bores
    assert least == pytest.approx(between - float(np.ptp(rod.look.vertices[:, 2])), abs=0.051)
    assert figure(words, "motor_wire") == max(mm for *_, end, _, mm in wires(robot) if end.part == "motor")

    def length(name: str) -> float:
        return float(part(robot, name).mesh.extents[2])

    right, left = length("front_spacer_right"), length("front_spacer_left")
    assert words["front_tubes"] == f"{right:.1f} mm on the right, {left:.1f} mm on the left"
    assert right != pytest.approx(left, abs=0.05)
    for name, tube in (
        ("bushing_left", "spring_bushing_left"), ("bushing_right", "spring_bushing_right"),
        ("cam_tube", "cam_spacer_right"),
    ):  # fmt: skip
        assert figure(words, name) == pytest.approx(length(tube), abs=0.051)
    socket, cap = (placed(robot, name).bounds[:, 1] for name in ("body_plate_right", "motor_cap"))
    assert figure(words, "clamp") == pytest.approx(cap[0] - socket[1], abs=1e-3)  # the cap lies on the motor
    pins = {
        item.article: (item.body, *(float(place) for place in item.T_body_part[[0, 2], 3])) for item in robot.hardware
    }
    design = robot.design
    assert pins[words["ankle_pin"]] == ("foot", pytest.approx(0.0), pytest.approx(0.0))
    assert pins[words["front_pin"]] == ("foot", pytest.approx(design.l4_mm), pytest.approx(0.0))
    assert pins[words["leg_pin"]][0] == "main_leg"
    assert (
        words["axle_length"]
        == f"{np.ptp([placed(robot, f'body_plate_{side}').bounds[:, 1] for side in ('left', 'right')]):.0f}"
    )
    wide, long = map(float, words["window"].split(" x "))
    assert words["block"] == f"{wide + 12.0:g} x {long - 1.0:g}"
    assert words["groove"] == f"{wide:g}"


def test_the_free_floor_is_twice_the_jump_and_a_metre_at_least(monkeypatch: pytest.MonkeyPatch) -> None:
    """In steps of half a metre upwards; 3 m by 2 m where nothing is known of the jump."""
    robot = built("kenan-2.0")

    def words(**jump: object) -> list[str]:
        monkeypatch.setattr(module, "simulate", lambda robot, engine: SimpleNamespace(**jump))
        found = expected(robot, [])
        return [found[name] for name in ("range", "rise", "far", "high")]

    assert words(verdict="jump", ballistic_range_m=0.883, com_rise_m=0.634) == ["880", "630", "2", "1.5"]
    assert words(verdict="jump", ballistic_range_m=0.31, com_rise_m=0.12) == ["310", "120", "1", "1"]
    for verdict, reach, rise in (("no jump", 0.9, 0.6), ("jump", None, 0.6), ("jump", 0.9, None)):
        found = words(verdict=verdict, ballistic_range_m=reach, com_rise_m=rise)
        assert found == ["0", "0", "3", "2"]

    def refused(robot: object, engine: str) -> None:
        raise CannotBuildError("no engine")

    monkeypatch.setattr(module, "simulate", refused)
    found = expected(robot, [])
    assert [found[name] for name in ("range", "rise", "far", "high")] == ["?", "?", "3", "2"]


def test_screws_are_tightened_by_their_size_and_less_in_plastic_and_a_thumb_presses_in_newtons() -> None:
    """Usual tables give 1.3 N·m for M3 and 0.37 N·m for M2 of strength 8.8; M3 strips its thread in plastic sooner."""
    words = expected(built("kenan-2.0"), [])
    m3, m2, plastic = (figure(words, f"torque_{name}") for name in ("m3", "m2", "plastic"))
    assert 1.3 / 4.0 < m3 < 1.3 / 2.0
    assert 0.37 / 4.0 < m2 < 0.37 / 2.0
    assert m2 < plastic < m3
    assert figure(words, "press_n") == module.PRESS_N


def test_names_in_braces_are_replaced_and_steps_are_counted_from_one() -> None:
    steps = [SimpleNamespace(key="trays"), SimpleNamespace(key="motor")]
    words = expected(built("kenan-2.0"), steps)  # type: ignore[arg-type]
    assert filled("from step {step_trays} to {step_motor}", words) == "from step 1 to 2"


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_a_sentence_may_go_on_with_switching_off(kit: str) -> None:
    """In the middle of a sentence it begins with a small letter, and is the same otherwise."""
    shop = load_workshop()
    chosen = shop.catalogue.kits[kit].model_dump() | {"kit": kit}
    robot = build(
        load_design("best-printable"), shop.model_copy(update={"bought": shop.bought.model_copy(update=chosen)})
    )
    words = expected(robot, [])
    first = {"light-1s": "Pull the USB cable", "strong-2s": "Switch off"}[kit]
    assert words["off"].startswith(first)
    assert words["off_then"] == first[0].lower() + words["off"][1:]


def test_the_capacitors_wires_start_at_named_pins_of_the_driver() -> None:
    """Both poles; without a capacitor the pins have no name here."""
    robot = built("kenan-2.0")
    found = expected(robot, [])["driver_supply"].split(" and ")
    driver = chosen_parts(robot.workshop).driver
    assert len(found) == 2
    pins = [words.removeprefix("the driver ") for words in found]
    assert set(pins) <= set(driver.pins) | set(driver.supply_v)
    assert pins[0] in driver.supply_v
    assert pins[1] in driver.with_function("ground")
    bare = robot.workshop.model_copy(update={"bought": robot.workshop.bought.model_copy(update={"capacitor": ""})})
    without = expected(replace(robot, workshop=bare), [])
    assert without["driver_supply"] == "the driver's supply pins"
    # a beep between the plug's poles is a short circuit, unless a capacitor is being charged
    assert (without["beep"], expected(robot, [])["beep"]) == ("", " (a short beep is the capacitor)")
