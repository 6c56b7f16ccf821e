"""Masses in closed form: bought parts as the catalogue says, densities of walls and infill, places that are near.

How near masses and centres are over thousands of robots, `benchmarks/refuse.py` tells.
"""

import math

import numpy as np
import pytest
from support.built import built

from jumpcad.design import SEARCH_BOUNDS, limits_of, load_design
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.search.estimate.estimated_masses import (
    CARRIED_G,
    DESIGNS,
    MATERIALS,
    RANGES,
    _density,
    known,
    known_masses,
    mass_features,
    robot_of_masses,
)
from jumpcad.search.estimate.refusal import AHEAD_MM, LIGHTER
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, varied

SHOP = load_workshop(DEFAULT)
DESIGN = load_design("best-printable")
ROBOTS = (
    ("kenan-2.0", {}), ("best-ga", {}), ("best-printable", {}), ("best-printable", {"workshop": "light"}),
    ("best-printable", {"leg": "carbon-strip-3x6"}),
)  # fmt: skip


def own(kind: str, name: str, **values: float) -> Workshop:
    """Return a workshop whose battery, controller or motor of that name is another in these values."""
    table, data = getattr(SHOP.catalogue, kind), SHOP.model_dump(exclude_none=True)
    mine = {kind: {"own": table[name].model_dump(exclude_none=True) | values}}
    role = {"batteries": "battery", "boards": "controller", "motors": "motors"}[kind]
    bought = data["bought"] | {role: ("own",) if role == "motors" else "own"}
    return Workshop(**data | mine | {"bought": bought})


def test_masses_and_centres_are_near_those_of_the_built_robot() -> None:
    """Springs, lengths and angles are no estimate; what statics make of all is within what refusals allow for."""
    for name, how in ROBOTS:
        robot = built(name, **how)
        found = robot_of_masses(robot.design, robot.workshop)
        assert -0.22 < found.mass_kg / robot.mass_kg - 1.0 < 0.1, (name, how)  # lighter is safe: it refuses less
        for body in robot.bodies.values():
            assert 0.65 < found.bodies[body.name].mass_kg / body.mass_kg < 1.2, (name, how, body.name)
            assert found.bodies[body.name].com_m == pytest.approx(body.com_m, abs=0.012), (name, how, body.name)
        assert found.spring == robot.spring
        for one, other in zip(found.joints, robot.joints, strict=True):
            assert one.origin_m == pytest.approx(other.origin_m, abs=1e-12)
        (tips, weak), (true_tips, true_weak) = statics_findings(found), statics_findings(robot)
        assert true_tips.margin - tips.margin < AHEAD_MM
        assert weak.limit is not None
        assert true_weak.limit is not None
        assert weak.limit * (1.0 - LIGHTER) < true_weak.limit, (name, how)


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


def test_springs_of_a_shop_weigh_as_their_wire() -> None:
    """Two helices of steel, 7.85 g/cm³: the wire's section times turns times the mean circle."""
    name = next(iter(SHOP.catalogue.springs))
    coil = SHOP.catalogue.springs[name]
    length_cm = math.pi * (coil.inside_diameter_mm + coil.wire_mm) * coil.turns / 10.0
    grams = 2.0 * 7.85 * length_cm * math.pi * (coil.wire_mm / 20.0) ** 2
    more = known_masses(DESIGN, varied(SHOP, {"bought.spring": name}))[BODY] - known_masses(DESIGN, SHOP)[BODY]
    assert more == pytest.approx(grams)


def test_legs_of_bars_weigh_as_their_bars_and_their_ends_the_same_at_any_length() -> None:
    """3 x 6 mm of carbon at its density."""
    bar, shop = SHOP.catalogue.bars["carbon-strip-3x6"], varied(SHOP, {"bought.leg": "carbon-strip-3x6"})
    long = DESIGN.model_copy(update={"carrying_link_mm": DESIGN.carrying_link_mm + 50.0})
    per_mm = 3.0 * 6.0 * bar.density_g_cm3 / 1000.0
    assert known_masses(DESIGN, shop)[MAIN_LEG] == pytest.approx(per_mm * DESIGN.l2_mm)
    assert known_masses(DESIGN, shop)[FRONT_LINK] == pytest.approx(per_mm * DESIGN.l3_mm)
    short_leg, long_leg = (robot_of_masses(one, shop).bodies[MAIN_LEG].mass_kg for one in (DESIGN, long))
    assert 1000.0 * (long_leg - short_leg) == pytest.approx(per_mm * (long.l2_mm - DESIGN.l2_mm))


def test_sections_in_bending_grow_with_the_root_of_the_moment() -> None:
    """Of leg and toes: rate times the angle from rest to loaded (N·m), and the preload."""
    torque_nm = DESIGN.stiffness_nmm_per_deg / 1000.0 * math.degrees(DESIGN.compression_rad)
    plain, loaded = mass_features(DESIGN, SHOP), mass_features(DESIGN, varied(SHOP, {"spring.preload_deg": 5.0}))
    more = math.sqrt(1.0 + math.radians(5.0) / DESIGN.compression_rad)
    for body in (MAIN_LEG, FOOT):
        assert plain[body][3] / plain[body][2] == pytest.approx(math.sqrt(torque_nm))
        assert loaded[body][3] == pytest.approx(more * plain[body][3])


def test_axles_weigh_by_their_sections_and_toes_that_are_pushed_apart_have_bars_between() -> None:
    """A tube weighs what its bore leaves; a bar reaches from half the toes' own width, l5 sin(angle)."""
    for name, rod in SHOP.catalogue.rods.items():
        shop = varied(SHOP, {"bought.axle": name})
        bore_mm = rod.bore_share * shop.bought.axle_mm
        section = rod.density_g_cm3 * (shop.bought.axle_mm**2 - bore_mm**2)
        assert mass_features(DESIGN, shop)[BODY][3] == pytest.approx(section), name
    half = DESIGN.l5_mm * math.sin(math.radians(DESIGN.ground_link_angle_deg))
    narrow, wide = (varied(SHOP, {"body.toe_half_width_mm": half + more}) for more in (-2.0, 7.0))
    assert mass_features(DESIGN, narrow)[FOOT][4] == 0.0
    assert mass_features(DESIGN, wide)[FOOT][4] == pytest.approx(_density(FOOT, wide) * 7.0)


def test_a_section_is_solid_to_the_depth_of_its_walls_and_layers() -> None:
    """Walls on both sides, layers above and below; within, the infill. Lines overlap by their round ends (Slic3r)."""
    thin = {"process.infill": 0.1, "process.perimeters": 2, "process.top_layers": 2, "process.bottom_layers": 3}
    shop = varied(SHOP, {**thin, "roles.body": "PLA"})
    for body, role, width_mm, height_mm in (
        (BODY, "body", 6.0, 2.4), (MAIN_LEG, "links", 8.0, 6.0), (FOOT, "links", 6.0, 4.0),
    ):  # fmt: skip
        process, density = shop.process, shop.material(role).density_g_cm3  # type: ignore[arg-type]
        line = process.line_width_mm - process.layer_height_mm * (1.0 - math.pi / 4.0)
        inside = (width_mm - 2.0 * 2.0 * line) / width_mm * (height_mm - 5.0 * process.layer_height_mm) / height_mm
        assert 0.0 < inside < 1.0
        assert _density(body, shop) == pytest.approx(density * (1.0 - 0.9 * inside)), body
        for solid in ({"process.infill": 1.0}, {"process.perimeters": 15}, {"process.top_layers": 40}):
            assert _density(body, varied(shop, solid)) == pytest.approx(density), (body, solid)
        assert _density(body, varied(shop, {"mass.model": "solid"})) == density


def test_designs_are_known_to_the_ends_of_their_ranges_which_hold_the_default_bounds_of_a_search() -> None:
    for name, (low, high) in DESIGNS.items():
        ends = [known(DESIGN.model_copy(update={name: value}), SHOP) for value in (low, high)]
        beyond = [known(DESIGN.model_copy(update={name: value}), SHOP) for value in (0.999 * low, 1.001 * high)]
        assert (ends, beyond) == ([True, True], [False, False]), name
        assert limits_of(name)[0] <= low < SEARCH_BOUNDS[name].lower < SEARCH_BOUNDS[name].upper < high, name


def test_workshops_are_known_within_ranges() -> None:
    """Of numbers, of materials, and of the masses of carried parts; of boards, what all weigh together counts."""
    for table, name in RANGES:
        for value, sign in zip(RANGES[table, name], (-1.0, 1.0), strict=True):
            number = type(getattr(getattr(SHOP, table), name))
            for end, expected in ((number(value), True), (value + sign * 0.01, False)):
                shop = SHOP.model_copy(update={table: getattr(SHOP, table).model_copy(update={name: end})})
                assert known(DESIGN, shop) is expected, (table, name, end)
    for name, limits in MATERIALS.items():
        for number in (0.999 * limits[0], 1.001 * limits[1]):
            materials = {key: one.model_copy(update={name: number}) for key, one in SHOP.materials.items()}
            assert not known(DESIGN, SHOP.model_copy(update={"materials": materials})), (name, number)
    others = [SHOP.bought.driver, *([SHOP.bought.regulator] if SHOP.bought.regulator else [])]
    beside = sum(SHOP.catalogue.boards[name].mass_g for name in others)
    for kind, name, less in (
        ("batteries", SHOP.bought.battery, 0.0), ("boards", SHOP.bought.controller, beside),
        ("motors", next(iter(SHOP.catalogue.motors)), 0.0),
    ):  # fmt: skip
        low, high = CARRIED_G["battery" if kind == "batteries" else kind]
        for mass, expected in ((low + 0.01, True), (high - 0.01, True), (low - 0.01, False), (high + 0.01, False)):
            assert known(DESIGN, own(kind, name, mass_g=mass - less)) is expected, (kind, mass)


def test_parts_of_one_s_own_and_weighed_ones_are_not_known() -> None:
    """Also where they are the catalogue's by another name: what they weigh, or bear, was never compared."""
    assert known(DESIGN, SHOP)
    for kind in ("bearings", "springs", "pads"):
        mine = next(iter(getattr(SHOP.catalogue, kind).values())).model_dump(exclude_none=True)
        assert not known(DESIGN, Workshop(**SHOP.model_dump(exclude_none=True) | {kind: {"own": mine}})), kind
    weighed = SHOP.mass.model_copy(update={"weighed_g": {"main_leg": 9.0}})
    assert not known(DESIGN, SHOP.model_copy(update={"mass": weighed}))


def test_a_heavier_battery_of_one_s_own_weighs_as_much_more() -> None:
    light, heavy = (robot_of_masses(DESIGN, own("batteries", SHOP.bought.battery, mass_g=mass)) for mass in (8.0, 28.0))
    assert heavy.mass_kg - light.mass_kg == pytest.approx(0.02)
    np.testing.assert_array_equal(heavy.bodies[BODY].inertia_kg_m2, np.zeros((3, 3)))  # which statics do not need
