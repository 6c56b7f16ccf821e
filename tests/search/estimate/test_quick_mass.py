"""Masses in closed form: bought parts as the catalogue says, densities of walls and infill, places that are near.

How near masses and centres are over thousands of robots, `benchmarks/refuse.py` tells.
"""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from support.built import built

from jumpcad.design import Design, limits_of, load_design
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot import Robot
from jumpcad.search.estimate.quick_mass import (
    CARRIED_G,
    DESIGNS,
    MATERIALS,
    RANGES,
    _density,
    _motors_g,
    body_x_features,
    foot_x_features,
    known,
    known_masses,
    mass_features,
    quick_robot,
    ranges,
)
from jumpcad.search.estimate.quick_refusal import KNOWN
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, varied

SHOP = load_workshop(DEFAULT)
DESIGN = load_design("best-printable")
ROBOTS = {
    "kenan-2.0": ("kenan-2.0", {}), "best-ga": ("best-ga", {}), "best-printable": ("best-printable", {}),
    "light": ("best-printable", {"workshop": "light"}), "bars": ("best-printable", {"leg": "carbon-strip-3x6"}),
}  # fmt: skip


def changed(workshop: Workshop = SHOP, **values: object) -> Workshop:
    return varied(workshop, {key.replace("__", "."): value for key, value in values.items()})  # type: ignore[dict-item]


def own(kind: str, name: str, **values: float) -> Workshop:
    """Return a workshop whose battery, controller or motor of that name is another in these values."""
    table, data = getattr(SHOP.catalogue, kind), SHOP.model_dump(exclude_none=True)
    mine = {kind: {"own": table[name].model_dump(exclude_none=True) | values}}
    role = {"batteries": "battery", "boards": "controller", "motors": "motors"}[kind]
    bought = data["bought"] | {role: ("own",) if role == "motors" else "own"}
    return Workshop(**data | mine | {"bought": bought})


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    name, how = ROBOTS[request.param]
    return built(name, **how)


def test_masses_and_centres_are_near_those_of_the_built_robot(robot: Robot) -> None:
    """A link's centre, between its eyes, is exact; what statics make of all is within what refusals allow for."""
    guess = quick_robot(robot.design, robot.workshop)
    assert -0.22 < guess.mass_kg / robot.mass_kg - 1.0 < 0.1  # lighter is safe: it refuses less
    for name, body in robot.bodies.items():
        assert 0.65 < guess.bodies[name].mass_kg / body.mass_kg < 1.2, name
        assert guess.bodies[name].com_m[[0, 2]] == pytest.approx(body.com_m[[0, 2]], abs=0.012), name
        assert guess.bodies[name].com_m[1] == 0.0
        np.testing.assert_array_equal(guess.bodies[name].inertia_kg_m2, np.zeros((3, 3)))  # which statics do not need
    assert [guess.bodies[name].com_m[2] for name in (MAIN_LEG, FRONT_LINK, FOOT)] == [0.0, 0.0, 0.0]
    link = guess.bodies[FRONT_LINK].com_m[0]
    assert link == pytest.approx(robot.bodies[FRONT_LINK].com_m[0], abs=2e-4)
    assert guess.bodies[BODY].com_m[2] == pytest.approx(robot.bodies[BODY].com_m[2], abs=0.0025)
    quick, exact = statics_findings(guess), statics_findings(robot)
    assert exact[0].margin - quick[0].margin < KNOWN.ahead_mm
    assert quick[1].limit is not None
    assert exact[1].limit is not None
    assert quick[1].limit * (1.0 - KNOWN.lighter) < exact[1].limit < quick[1].limit / (1.0 - 2.0 * KNOWN.lighter)


def test_springs_joints_and_loop_are_those_of_the_built_robot(robot: Robot) -> None:
    """Lengths and angles are no estimate; it stands on its tips, with nothing below them."""
    guess = quick_robot(robot.design, robot.workshop)
    assert guess.spring == robot.spring
    for one, other in zip(guess.joints, robot.joints, strict=True):
        assert (one.name, one.parent, one.child) == (other.name, other.parent, other.child)
        assert one.origin_m == pytest.approx(other.origin_m, abs=1e-12)
        assert one.rest_angle_rad == pytest.approx(other.rest_angle_rad)
    (leg,) = (one for one in guess.joints if one.child == MAIN_LEG)
    assert sorted((abs(leg.lower_rad), abs(leg.upper_rad))) == pytest.approx([0.0, robot.design.compression_rad])
    assert guess.foot_depth_m == 0.0
    assert all((body.inertia_kg_m2 == 0.0).all() for body in guess.bodies.values())


def test_a_preload_is_in_the_springs_torque() -> None:
    shop = changed(spring__preload_deg=10.0)
    assert quick_robot(DESIGN, shop).spring.preload_rad == pytest.approx(math.radians(10.0))


def test_of_parts_that_are_bought_the_body_has_all_but_the_wire() -> None:
    """Battery, boards, small parts of the catalogue, and the lightest motor that may drive it (g)."""
    catalogue, bought = SHOP.catalogue, SHOP.bought
    motors = [catalogue.motors[name].mass_g for name in bought.motors or catalogue.motors]
    boards = [bought.controller, bought.driver, *([bought.regulator] if bought.regulator else [])]
    small = [name for role in ("sensor", "switch", "plug", "capacitor") if (name := getattr(bought, role))]
    weight = catalogue.batteries[bought.battery].mass_g + min(motors)
    weight += sum(catalogue.boards[name].mass_g for name in boards)
    weight += sum(catalogue.components[name].mass_g for name in small)
    weight += catalogue.components[bought.diode].mass_g if bought.diode else 0.0
    assert known_masses(DESIGN, SHOP) == pytest.approx({BODY: weight, MAIN_LEG: 0.0, FRONT_LINK: 0.0, FOOT: 0.0})
    free = SHOP.model_copy(update={"bought": bought.model_copy(update={"motors": ()})})
    lightest = min(motor.mass_g for motor in catalogue.motors.values())
    assert known_masses(DESIGN, free)[BODY] == pytest.approx(weight - min(motors) + lightest)


@pytest.mark.parametrize(("own_g", "lightest_g"), [(8.5, 8.5), (11.5, 10.0)])
def test_of_motors_that_may_drive_it_the_body_has_the_lightest(own_g: float, lightest_g: float) -> None:
    """One of the user's own beside an N20 of 10 g: what is refused must be too weak with either."""
    shop = own("motors", "n20-298", mass_g=own_g)
    both, alone = (
        shop.model_copy(update={"bought": shop.bought.model_copy(update={"motors": motors})})
        for motors in (("own", "n20-298"), ("n20-298",))
    )
    assert shop.catalogue.motors["n20-298"].mass_g == 10.0
    assert known_masses(DESIGN, both)[BODY] - known_masses(DESIGN, alone)[BODY] == pytest.approx(lightest_g - 10.0)


def test_springs_of_a_shop_weigh_as_their_wire() -> None:
    """Two helices of steel, 7.85 g/cm³: the wire's section times turns times the mean circle."""
    name = next(iter(SHOP.catalogue.springs))
    coil = SHOP.catalogue.springs[name]
    length_cm = math.pi * (coil.inside_diameter_mm + coil.wire_mm) * coil.turns / 10.0
    grams = 2.0 * 7.85 * length_cm * math.pi * (coil.wire_mm / 20.0) ** 2
    more = known_masses(DESIGN, changed(bought__spring=name))[BODY] - known_masses(DESIGN, SHOP)[BODY]
    assert more == pytest.approx(grams)


def test_legs_of_bars_weigh_as_their_bars_and_their_ends_the_same_at_any_length() -> None:
    """3 x 6 mm of carbon at its density; a leg that is printed grows with its length, and with the springs' torque."""
    bar, shop = SHOP.catalogue.bars["carbon-strip-3x6"], changed(bought__leg="carbon-strip-3x6")
    long = DESIGN.model_copy(update={"carrying_link_mm": DESIGN.carrying_link_mm + 50.0})
    per_mm = 3.0 * 6.0 * bar.density_g_cm3 / 1000.0
    assert known_masses(DESIGN, shop)[MAIN_LEG] == pytest.approx(per_mm * DESIGN.l2_mm)
    assert known_masses(DESIGN, shop)[FRONT_LINK] == pytest.approx(per_mm * DESIGN.l3_mm)
    short_leg, long_leg = (quick_robot(one, shop).bodies[MAIN_LEG].mass_kg for one in (DESIGN, long))
    assert 1000.0 * (long_leg - short_leg) == pytest.approx(per_mm * (long.l2_mm - DESIGN.l2_mm))
    strong = DESIGN.model_copy(update={"stiffness_nmm_per_deg": 4.0 * DESIGN.stiffness_nmm_per_deg})
    ends, whole = (mass_features(DESIGN, one) for one in (shop, SHOP))
    density = _density(MAIN_LEG, SHOP)
    assert ends[MAIN_LEG] == pytest.approx((1.0, density, 0.0, 0.0))
    assert ends[FRONT_LINK] == pytest.approx((density, density, 0.0))
    assert whole[FRONT_LINK] == pytest.approx((density, 0.0, density * DESIGN.l3_mm))
    assert whole[MAIN_LEG][:3] == pytest.approx((1.0, 0.0, density * DESIGN.l2_mm))
    assert mass_features(strong, SHOP)[MAIN_LEG][3] == pytest.approx(2.0 * whole[MAIN_LEG][3])
    assert mass_features(strong, SHOP)[FOOT][3] == pytest.approx(2.0 * whole[FOOT][3])
    loaded = mass_features(DESIGN, varied(SHOP, {"spring.preload_deg": 5.0}))
    moment = 1.0 + math.radians(5.0) / DESIGN.compression_rad
    assert loaded[MAIN_LEG][3] == pytest.approx(math.sqrt(moment) * whole[MAIN_LEG][3])


def test_the_root_of_the_peak_moment_is_that_of_newton_metres() -> None:
    """Rate times the angle from rest to loaded, N·m: preloaded by nothing."""
    torque_nm = DESIGN.stiffness_nmm_per_deg / 1000.0 * math.degrees(DESIGN.compression_rad)
    leg, foot = (mass_features(DESIGN, SHOP)[name] for name in (MAIN_LEG, FOOT))
    assert leg[3] / leg[2] == pytest.approx(math.sqrt(torque_nm))
    assert foot[3] / foot[2] == pytest.approx(math.sqrt(torque_nm))
    density = _density(FOOT, SHOP)
    assert foot[:3] == pytest.approx((1.0, density * DESIGN.l4_mm, density * DESIGN.l5_mm))


def test_axles_and_plates_weigh_by_their_sections() -> None:
    """A tube weighs what its bore leaves; plates by their thickness, and by the body's length."""
    rods = SHOP.catalogue.rods
    for name, rod in rods.items():
        shop = changed(bought__axle=name)
        body = mass_features(DESIGN, shop)[BODY]
        bore_mm = rod.bore_share * shop.bought.axle_mm
        assert body[3] == pytest.approx(rod.density_g_cm3 * (shop.bought.axle_mm**2 - bore_mm**2))
        plates = shop.body.plate_mm * _density(BODY, shop)
        assert body[:3] == pytest.approx((1.0, plates, plates * DESIGN.l1_mm))
    assert any(rod.bore_share for rod in rods.values())


def test_toes_that_are_pushed_apart_have_bars_between() -> None:
    """A bar on each side from half the toes' own width, l5 sin(angle), to what the workshop asks for."""
    half = DESIGN.l5_mm * math.sin(math.radians(DESIGN.ground_link_angle_deg))
    narrow, wide = (changed(body__toe_half_width_mm=half + more) for more in (-2.0, 7.0))
    assert mass_features(DESIGN, narrow)[FOOT][4] == 0.0
    assert mass_features(DESIGN, wide)[FOOT][4] == pytest.approx(_density(FOOT, wide) * 7.0)


@pytest.mark.parametrize(
    ("body", "role", "width_mm", "height_mm"),
    [
        (BODY, "body", 6.0, 2.4),
        (MAIN_LEG, "links", 8.0, 6.0),
        (FRONT_LINK, "links", 8.0, 6.0),
        (FOOT, "links", 6.0, 4.0),
    ],
)
def test_a_section_is_solid_to_the_depth_of_its_walls_and_layers(
    body: str, role: str, width_mm: float, height_mm: float
) -> None:
    """Walls on both sides, layers above and below; within, the infill. Lines overlap by their round ends (Slic3r)."""
    shop = changed(
        process__infill=0.1, process__perimeters=2, process__top_layers=2, process__bottom_layers=3, roles__body="PLA"
    )  # fmt: skip
    assert shop.material("body").density_g_cm3 != shop.material("links").density_g_cm3
    process, density = shop.process, shop.material(role).density_g_cm3
    line = process.line_width_mm - process.layer_height_mm * (1.0 - math.pi / 4.0)
    inside = (width_mm - 2.0 * 2.0 * line) / width_mm * (height_mm - 5.0 * process.layer_height_mm) / height_mm
    assert 0.0 < inside < 1.0
    assert _density(body, shop) == pytest.approx(density * (1.0 - 0.9 * inside))
    assert _density(body, changed(shop, process__infill=1.0)) == pytest.approx(density)
    assert _density(body, changed(shop, process__perimeters=15)) == pytest.approx(density)
    assert _density(body, changed(shop, process__top_layers=40)) == pytest.approx(density)
    assert _density(body, changed(shop, mass__model="solid")) == density


def test_centres_lie_between_what_they_are_weighed_by() -> None:
    """A battery of a quarter of the body: its part of the mean, over the body's length; a foot by ankle, nose, tips."""
    battery = SHOP.catalogue.batteries[SHOP.bought.battery].mass_g
    assert body_x_features(DESIGN, SHOP, 4.0 * battery) == pytest.approx((0.75, 0.25, 0.25 * DESIGN.l1_mm))
    one, nose, tips = foot_x_features(DESIGN)
    assert (one, nose) == (1.0, DESIGN.l4_mm)
    assert abs(tips) <= DESIGN.l5_mm


@pytest.mark.parametrize("name", DESIGNS)
def test_designs_are_known_to_the_ends_of_their_ranges(name: str) -> None:
    low, high = DESIGNS[name]
    ends = [known(DESIGN.model_copy(update={name: value}), SHOP) for value in (low, high)]
    beyond = [known(DESIGN.model_copy(update={name: value}), SHOP) for value in (0.999 * low, 1.001 * high)]
    assert (ends, beyond) == ([True, True], [False, False])


def test_what_is_known_is_wider_than_what_is_searched() -> None:
    """The default bounds of a search are about half as wide."""
    for name, bound in Design.model_fields.items():
        assert name in DESIGNS, bound
    from jumpcad.design import SEARCH_BOUNDS

    widths = [
        (SEARCH_BOUNDS[name].upper - SEARCH_BOUNDS[name].lower) / (high - low) for name, (low, high) in DESIGNS.items()
    ]
    assert 0.4 < np.mean(widths) < 0.7
    assert all(limits_of(name)[0] <= low < high <= limits_of(name)[1] for name, (low, high) in DESIGNS.items())
    assert all(
        low < SEARCH_BOUNDS[name].lower < SEARCH_BOUNDS[name].upper < high for name, (low, high) in DESIGNS.items()
    )


@pytest.mark.parametrize("key", RANGES)
def test_workshops_are_known_within_ranges_that_a_workshop_may_have(key: tuple[str, str]) -> None:
    """Every end is a value that the workshop takes; beyond it, the robot is built."""
    table, name = key
    number = getattr(getattr(SHOP, table), name)
    for value, sign in zip(RANGES[key], (-1.0, 1.0), strict=True):
        end = type(number)(value)
        shop = SHOP.model_copy(update={table: getattr(SHOP, table).model_copy(update={name: end})})
        assert known(DESIGN, shop)
        assert type(getattr(SHOP, table)).model_validate(getattr(shop, table).model_dump(exclude_none=True))
        far = SHOP.model_copy(update={table: getattr(SHOP, table).model_copy(update={name: value + sign * 0.01})})
        assert not known(DESIGN, far)


def test_other_numbers_may_be_half_or_twice_the_default_s() -> None:
    found = ranges()
    assert found["fits", "sliding_mm"] == (0.5 * SHOP.fits.sliding_mm, 2.0 * SHOP.fits.sliding_mm)
    assert found["safety", "strength_factor"] == pytest.approx(
        (SHOP.safety.strength_factor / 2.0, 2.0 * SHOP.safety.strength_factor)
    )
    assert {key: found[key] for key in RANGES} == RANGES


@pytest.mark.parametrize("name", MATERIALS)
def test_materials_are_known_within_their_ranges(name: str) -> None:
    for value, sign in zip(MATERIALS[name], (-1.0, 1.0), strict=True):
        for number, expected in ((value, True), (value * (1.0 + 0.001 * sign), False)):
            materials = {key: one.model_copy(update={name: number}) for key, one in SHOP.materials.items()}
            assert known(DESIGN, SHOP.model_copy(update={"materials": materials})) is expected


def test_carried_parts_are_known_within_their_ranges() -> None:
    """Of boards, what all of them weigh together counts."""
    bought, catalogue = SHOP.bought, SHOP.catalogue
    others = [bought.driver, *([bought.regulator] if bought.regulator else [])]
    beside = sum(catalogue.boards[name].mass_g for name in others)
    for kind, name, less in (
        ("batteries", bought.battery, 0.0),
        ("boards", bought.controller, beside),
        ("motors", next(iter(catalogue.motors)), 0.0),
    ):
        low, high = CARRIED_G["battery" if kind == "batteries" else kind]
        for mass, expected in ((low + 0.01, True), (high - 0.01, True), (low - 0.01, False), (high + 0.01, False)):
            assert known(DESIGN, own(kind, name, mass_g=mass - less)) is expected, (kind, mass)


@pytest.mark.parametrize("kind", ["bearings", "springs", "pads"])
def test_parts_of_one_s_own_are_not_known(kind: str) -> None:
    """Also where they are the catalogue's by another name: what they weigh, or bear, was never compared."""
    table = getattr(SHOP.catalogue, kind)
    mine = next(iter(table.values())).model_dump(exclude_none=True)
    assert known(DESIGN, SHOP)
    assert not known(DESIGN, Workshop(**SHOP.model_dump(exclude_none=True) | {kind: {"own": mine}}))


@pytest.mark.parametrize(
    ("chosen", "masses"), [((), [10.0, 8.0, 12.0]), (("large",), [12.0]), (("n20", "large"), [10.0, 12.0])]
)
def test_motors_that_may_be_taken_are_those_of_the_workshop_or_all(
    chosen: tuple[str, ...], masses: list[float]
) -> None:
    motors = {name: SimpleNamespace(mass_g=mass) for name, mass in (("n20", 10.0), ("small", 8.0), ("large", 12.0))}
    workshop: Any = SimpleNamespace(catalogue=SimpleNamespace(motors=motors), bought=SimpleNamespace(motors=chosen))
    assert _motors_g(workshop) == masses
