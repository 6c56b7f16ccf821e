"""Springs from stock: their rate is the robot's, their arms meet their pins, what does not fit is refused."""

import math
import re
from dataclasses import replace

import pytest
from support.limits import default_limits
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.catalogue import StockSpring, load_catalogue
from jumpcad.checks import constraint_findings, quick_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.design import Design, load_design
from jumpcad.drive.spring import ARM_BEYOND_MM, TorsionSpring
from jumpcad.drive.spring_choice import fitted_spring, springs_on_leg
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import Finding, errors
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, load_workshop

KENAN = load_design("kenan-1.0")
STOCK, WIRE = load_catalogue().springs["9271K589"], load_catalogue().wire
LIMITS = replace(default_limits("kenan-1.0").spring, plate_pins_rad=(math.radians(55.0),))


def with_stock(name: str, **table: StockSpring) -> Workshop:
    workshop = load_workshop()
    bought = workshop.bought.model_copy(update={"spring": name})
    return workshop.model_copy(update={"bought": bought, "springs": table})


def fitted(
    spring: StockSpring, design: Design = KENAN, limits: object = LIMITS, preload_rad: float = 0.0
) -> TorsionSpring:
    on_leg = springs_on_leg(design, spring, preload_rad)
    return fitted_spring(spring, on_leg, -math.radians(design.rest_angle_deg), WIRE, limits)  # type: ignore[arg-type]


def wrong(robot: Robot) -> list[Finding]:
    """Return the violated limits that springs have a part in: forces, and what meets."""
    return errors([*constraint_findings(robot), *interference_findings(robot)])


@pytest.fixture(scope="module")
def robot() -> Robot:
    return build(KENAN, with_stock("9271K589"))


def test_two_of_them_are_the_robots_stiffness_and_a_finding_says_both(robot: Robot) -> None:
    assert robot.spring.stiffness_nm_per_rad == pytest.approx(2.0 * 26.36e-3 * 180.0 / math.pi)
    assert robot.spring.energy_j == pytest.approx(0.5 * robot.spring.stiffness_nm_per_rad * KENAN.compression_rad**2)
    assert robot.spring.one_sided
    (finding,) = (found for found in constraint_findings(robot) if found.name == "spring_rate")
    assert finding.severity == "info"
    assert (finding.value, finding.margin) == pytest.approx((52.72, 52.72 - 9.2))
    assert "52.72 N·mm/°" in finding.message
    assert "asks for 9.20" in finding.message
    assert finding.margin == pytest.approx(52.72 - 9.2)
    assert robot.design == KENAN
    assert "spring_rate" not in {found.name for found in constraint_findings(build(KENAN))}


def test_a_stock_spring_can_be_built_in(robot: Robot) -> None:
    """Nearly six times as stiff as Kenan's, it breaks nothing; in a softer axle it would."""
    assert errors(constraint_findings(robot)) == []
    articles = {item.name: item.article for item in robot.hardware if item.name in ("spring_left", "spring_right")}
    assert articles["spring_left"].startswith("torsion spring, right hand, twin of McMaster-Carr 9271K589 (90°")
    assert articles["spring_right"].startswith("torsion spring, left hand, McMaster-Carr 9271K589, arms cut to ")


def test_its_stress_is_that_of_its_torque() -> None:
    """q·32·M/(pi·d³) with q = (w + 0.07)/(w - 0.75) (EN 13906-3)."""
    spring = fitted(STOCK)
    index = (16.21 + 2.667) / 2.667
    torque = 26.36 * math.degrees(KENAN.compression_rad)
    stress = (index + 0.07) / (index - 0.75) * 32.0 * torque / (math.pi * 2.667**3)
    assert spring.stress_mpa == pytest.approx(stress)
    assert 1650.0 < spring.tensile_mpa < 1690.0  # EN 10270-1 SM: 1690 at 2.5 mm, 1650 at 2.8 mm


def test_arms_that_are_too_short_are_refused() -> None:
    with pytest.raises(CannotBuildError, match=r"arms of 12 mm do not reach the pins; 1\d\.\d mm are needed: "):
        fitted(STOCK.model_copy(update={"arm_length_mm": 12.0}))
    outer, pin = STOCK.inside_diameter_mm + 2.0 * STOCK.wire_mm, LIMITS.pin_mm
    beside = (outer + pin) / 2.0  # from the axle, square to the arm, to the middle of the pin at the arm's side
    needed = math.sqrt(LIMITS.pin_radius_mm(outer) ** 2 - beside**2) + ARM_BEYOND_MM
    for more, words in ((-0.01, f"do not reach the pins; {needed:.1f} mm are needed"), (0.01, "there is room from")):
        with pytest.raises(CannotBuildError, match=words):
            fitted(STOCK.model_copy(update={"arm_length_mm": needed + more}))


def test_a_coil_that_grips_its_bushing_is_refused() -> None:
    thin = STOCK.model_copy(update={"wire_mm": 1.0, "inside_diameter_mm": 4.2, "turns": 3.25})
    wide = replace(LIMITS, plate_pins_rad=tuple(math.radians(angle) for angle in range(360)))
    words = r"a bushing of (\d\.\d\d) mm; the axle needs one of 5\.20 mm: choose one with a larger inside diameter, or "
    with pytest.raises(CannotBuildError, match=f"{words}lower compression_ratio") as refused:
        fitted(thin, limits=wide)
    room = float(re.search(words, str(refused.value))[1])  # type: ignore[index]
    assert (refused.value.limit, refused.value.unit) == ("spring_bushing", "mm")
    assert refused.value.margin == pytest.approx(room - 5.2, abs=0.0051)
    larger, less = thin.model_copy(update={"inside_diameter_mm": 5.8}), KENAN.compression_ratio / 4.0
    assert fitted(larger, limits=wide).mandrel_mm > 5.2
    on_less = KENAN.model_copy(update={"compression_ratio": less})
    with pytest.raises(CannotBuildError) as closer:
        fitted(thin, on_less, limits=wide)
    assert refused.value.margin < closer.value.margin < 0.0


def test_a_leg_that_is_too_short_for_its_pin_is_refused() -> None:
    short = KENAN.model_copy(update={"carrying_link_mm": 55.0})
    with pytest.raises(CannotBuildError, match=r"leg's pin [\d.]+ mm from the axle; in a leg of 55\.0 mm at most 27"):
        build(short, with_stock("9271K589"))


def test_an_unknown_one_is_refused() -> None:
    with pytest.raises(JumpcadError, match=r"bought.spring = '9271K588': is no spring .*did you mean 9271K589"):
        build(KENAN, with_stock("9271K588"))


def test_an_own_one_may_be_chosen() -> None:
    """Four turns and a quarter of 1.3 mm wire, nearly as stiff as Kenan's: the arms are those of a quarter turn."""
    own = StockSpring(
        name="own", source="a test", wire_mm=1.3, inside_diameter_mm=6.4, turns=4.25, arm_angle_deg=90.0,
        arm_length_mm=30.0, rate_nmm_per_deg=4.8,
    )  # fmt: skip
    robot = build(KENAN, with_stock("own", own=own))
    spring = robot.layout.drive.spring
    assert spring.turns == 4.25
    assert spring.rate_nmm_per_deg == pytest.approx(4.8)
    assert wrong(robot) == []


@pytest.mark.parametrize("preload_deg", [0.0, 9.0])
def test_preloaded_springs_are_told_where_their_pin_would_have_to_be(preload_deg: float) -> None:
    """A pin at what is named as their range holds them; the preload turns the range by as much."""
    askew, rooms = STOCK.model_copy(update={"arm_angle_deg": (STOCK.arm_angle_deg + 150.0) % 360.0}), []
    for preload_rad in (0.0, math.radians(preload_deg)):
        with pytest.raises(CannotBuildError) as refused:
            fitted(askew, preload_rad=preload_rad)
        room = re.search(r"must be between (\d+)° and (\d+)°", str(refused.value))
        assert room is not None
        rooms.append([float(one) for one in room.groups()])
    middle = math.radians(sum(rooms[1]) / 2.0)
    fitted(askew, limits=replace(LIMITS, plate_pins_rad=(middle,)), preload_rad=math.radians(preload_deg))
    assert rooms[0][0] - rooms[1][0] == pytest.approx(preload_deg, abs=1.01)


def test_springs_with_opposite_arms_fit_where_they_are_loaded_at_rest() -> None:
    """By as much preload as their pin is off, where the room stays; a robot keeps its limits, and has K·(q² - p²)/2."""
    opposite = load_catalogue().springs["9271K621"]
    with pytest.raises(CannotBuildError, match=r"raise spring\.preload_deg, or choose") as refused:
        fitted(opposite)
    named = math.radians(0.01 - (refused.value.margin or 0.0))
    fitted(opposite, preload_rad=named)
    with pytest.raises(CannotBuildError, match="there is room from"):
        fitted(opposite, preload_rad=named - math.radians(1.5))
    workshop = with_stock("9271K621")
    design = load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 20.0})  # which they need not have
    robot = build(design, workshop_with(workshop, spring={"preload_deg": 75.0}))
    assert wrong(robot) == []
    twice = (math.degrees(design.compression_rad) + 75.0) ** 2 - 75.0**2
    assert robot.spring.energy_j == pytest.approx(2.0 * 6.56e-3 * math.radians(1.0) * twice / 2.0)


@pytest.mark.parametrize("off_deg", [60.0, 150.0, 210.0, 300.0])
def test_arms_at_the_wrong_angle_name_the_room_and_the_angle_that_fits(off_deg: float) -> None:
    """Arms turned by what is named plus a degree bring the pin just into the range, on the side that is nearer."""
    limits = replace(LIMITS, plate_pins_rad=tuple(map(math.radians, (70.0, 50.0, 60.0))))
    askew = STOCK.model_copy(update={"arm_angle_deg": (STOCK.arm_angle_deg + off_deg) % 360.0})
    with pytest.raises(CannotBuildError, match="there is room from 50° to 70°") as refused:
        fitted(askew, limits=limits)
    about = float(str(refused.value).partition("arms about ")[2].partition("°")[0])
    away = float(re.findall(r"(\d+)° away", str(refused.value))[0])
    turned = abs((about - askew.arm_angle_deg + 180.0) % 360.0 - 180.0)
    assert turned == pytest.approx(away + 1.0, abs=1.01)
    fitted(askew.model_copy(update={"arm_angle_deg": about}), limits=limits)
    back = math.copysign(2.5, (askew.arm_angle_deg - about + 180.0) % 360.0 - 180.0)
    with pytest.raises(CannotBuildError, match="there is room from"):
        fitted(askew.model_copy(update={"arm_angle_deg": (about + back) % 360.0}), limits=limits)


def test_where_several_directions_of_the_plates_pin_are_free_the_shortest_arms_are_taken() -> None:
    """In whatever order they come: each direction alone gives its arms."""
    angles = [math.radians(angle) for angle in (55.0, 53.0, 57.0)]
    alone = [fitted(STOCK, limits=replace(LIMITS, plate_pins_rad=(angle,))).arms.lever_mm for angle in angles]
    shortest = min(alone)
    assert max(alone) > shortest + 0.5
    for order in (angles, angles[::-1], [angles[1], angles[2], angles[0]]):
        found = fitted(STOCK, limits=replace(LIMITS, plate_pins_rad=tuple(order)))
        assert found.arms.lever_mm == shortest
        assert found.plate_pin_rad == angles[alone.index(shortest)]


def test_no_refusal_or_finding_names_a_stiffness_that_decides_nothing() -> None:
    """A roller that bears 5 N is too weak for these springs, made or bought."""
    workshop = with_stock("9271K589")
    weak = load_catalogue().bearings["623"].model_copy(update={"name": "weak", "static_load_n": 5.0})
    for spring, named in (("", True), ("9271K589", False)):
        bought = workshop.bought.model_copy(update={"spring": spring, "roller": "weak"})
        with pytest.raises(CannotBuildError, match=r"force on the roller .* N short") as refused:
            build(KENAN, workshop.model_copy(update={"bought": bought, "bearings": {"weak": weak}}))
        assert ("stiffness_nmm_per_deg" in str(refused.value)) == named
        assert ("weaker bought.spring" in str(refused.value)) != named
    remedies = [found.remedy for found in quick_findings(build(KENAN, workshop))]
    assert any("weaker bought.spring" in remedy for remedy in remedies)
    assert not any("stiffness_nmm_per_deg" in remedy for remedy in remedies)
