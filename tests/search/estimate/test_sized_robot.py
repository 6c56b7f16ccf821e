"""Robots whose links are sized but not laid out: as near as refusals need, and which workshops are near.

How near over thousands of robots, `benchmarks/refuse.py` tells.
"""

import math
from dataclasses import replace

import pytest
from support.built import LONG_TOES, built

from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot import Robot
from jumpcad.search.estimate.quick_mass import axle_measure
from jumpcad.search.estimate.sized_robot import NUMBERS, SizedLinks, near, printed_g_mm, sized_robot, usual_bearing
from jumpcad.strength.bearings import hub_bearings
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, varied

SHOP = load_workshop(DEFAULT)
DESIGN = load_design("best-printable")


@pytest.fixture(scope="module", params=[("best-ga", "default"), ("best-printable", "light"), (LONG_TOES, "default")])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(*request.param)


def test_masses_centres_and_inertias_are_near_those_of_the_built_robot(robot: Robot) -> None:
    """Strong robots, whose sections have grown, are the farthest."""
    guess = sized_robot(robot.design, robot.workshop)
    assert guess.mass_kg == pytest.approx(robot.mass_kg, rel=0.07)
    for name, body in robot.bodies.items():
        mine = guess.bodies[name]
        assert mine.mass_kg == pytest.approx(body.mass_kg, rel=0.12), name
        assert mine.com_m[[0, 2]] == pytest.approx(body.com_m[[0, 2]], abs=0.005), name
        assert mine.inertia_kg_m2[1, 1] == pytest.approx(body.inertia_kg_m2[1, 1], rel=0.25), name
        assert mine.com_m[1] == 0.0


def test_what_touches_the_ground_is_that_of_the_built_robot(robot: Robot) -> None:
    """Nose, toe tips and the ends of the body, seen from the side; sections that have grown differ by tenths."""
    guess = sized_robot(robot.design, robot.workshop)
    assert guess.foot_depth_m == pytest.approx(robot.foot_depth_m, abs=3e-4)
    for name in (BODY, FOOT):
        mine, built_ones = guess.bodies[name].contacts, robot.bodies[name].contacts[:2]
        for one, other in zip(mine, built_ones, strict=True):
            assert one.centre_m[[0, 2]] == pytest.approx(other.centre_m[[0, 2]], abs=5e-4)
            assert one.radius_m == pytest.approx(other.radius_m, abs=5e-4)
            assert one.surface == other.surface


def test_toes_touch_the_ground_with_half_their_tips_height_and_their_pads() -> None:
    """Tips of 5 mm with pads of 1.6 mm, whatever the rails' are: as low as all of the foot, at the toes' tips."""
    links = SizedLinks.of(DESIGN, SHOP)
    sized = replace(links.sections, toe_tip_height_mm=5.0, rail_tip_mm=3.2, pad_mm=1.6)
    nose, toe = replace(links, sections=sized).contacts()[FOOT]
    assert 1000.0 * toe.radius_m == pytest.approx(2.5 + 1.6)
    assert [1000.0 * (one.centre_m[2] - one.radius_m) for one in (nose, toe)] == pytest.approx(
        [-sized.foot_depth_mm - 1.6] * 2
    )


def test_friction_stop_and_springs_are_those_of_the_built_robot(robot: Robot) -> None:
    guess = sized_robot(robot.design, robot.workshop)
    assert guess.friction == robot.friction
    assert guess.spring == robot.spring
    assert guess.stop is not None
    assert robot.stop is not None
    assert (guess.stop.joint, guess.stop.angle_rad) == (robot.stop.joint, pytest.approx(robot.stop.angle_rad))
    assert guess.stop.stiffness_nm_per_rad == pytest.approx(robot.stop.stiffness_nm_per_rad, rel=0.25)
    assert guess.roller_off is None


def test_the_hub_s_bearing_is_that_of_the_built_robot(robot: Robot) -> None:
    bearing = robot.layout.hub_bearing
    assert bearing is not None
    assert usual_bearing(robot.workshop, robot.spring) == bearing
    axle = robot.workshop.bought.axle_mm
    fitting = [one for one in robot.workshop.catalogue.bearings.values() if one.bore_mm == axle]
    lightest = min(fitting, key=lambda one: one.mass_g)
    weak = replace(robot.spring, stiffness_nm_per_rad=robot.spring.stiffness_nm_per_rad / 10.0)
    assert usual_bearing(robot.workshop, weak) == lightest != bearing


def test_a_hub_without_bearings_rubs_on_its_axle() -> None:
    guess = sized_robot(DESIGN, varied(SHOP, {"bought.leg_bearing": "", "bought.retention": "nuts"}))
    assert guess.friction is not None
    assert guess.friction.pin_radius_m == (0.0015,) * 4


def test_a_solid_bar_weighs_its_volume_and_infill_saves_the_inside() -> None:
    """10 mm by 6 mm of PETG, 1.27 g/cm³; of infill alone, without walls and layers, a fifth of it."""
    solid = varied(SHOP, {"process.infill": 1.0})
    assert printed_g_mm(solid, "links", 10.0, 6.0) == pytest.approx(1.27e-3 * 60.0)
    assert printed_g_mm(SHOP, "links", 1.0, 6.0) == pytest.approx(1.27e-3 * 6.0)  # all walls
    assert printed_g_mm(SHOP, "links", 10.0, 1.0) == pytest.approx(1.27e-3 * 10.0)  # all layers
    light = varied(SHOP, {"process.infill": 0.2})
    inside = (printed_g_mm(light, "links", 30.0, 20.0) - printed_g_mm(light, "links", 20.0, 20.0)) / (1.27e-3 * 10.0)
    layers = 9 * 0.2
    assert inside == pytest.approx(layers + 0.2 * (20.0 - layers))


def test_solid_links_weigh_their_mean_cross_sections() -> None:
    """Toes taper in both directions, from 7 to 5 mm wide; leg and rails in one, front links in none."""
    links, g_mm3 = SizedLinks.of(DESIGN, varied(SHOP, {"process.infill": 1.0})), 1.27e-3
    sized = links.sections
    assert links.toe_g_mm == pytest.approx(g_mm3 * 6.0 * (sized.toe_root_mm + sized.toe_tip_height_mm) / 2.0)
    assert links.rail_g_mm == pytest.approx(
        g_mm3 * sized.lug_thickness_mm * (sized.rail_root_mm + sized.rail_tip_mm) / 2.0
    )
    assert links.leg_g_mm == pytest.approx(g_mm3 * sized.thickness_mm * (sized.leg_root_mm + sized.leg_tip_mm) / 2.0)
    assert links.front_g_mm == pytest.approx(g_mm3 * sized.thickness_mm * sized.front_mm)


def test_links_weigh_the_same_whatever_gears_are_printed_in() -> None:
    """In the default workshop links and gears are of one material."""
    plain, other = (SizedLinks.of(DESIGN, shop) for shop in (SHOP, varied(SHOP, {"roles.gears": "PLA"})))
    for name in ("leg_g_mm", "front_g_mm", "toe_g_mm", "rail_g_mm", "mass_features"):
        assert getattr(plain, name) == getattr(other, name)


def test_toes_apart_are_heavier_by_their_screws() -> None:
    """A bed on which the foot fits keeps it in one piece."""
    small, large = (SizedLinks.of(built(LONG_TOES).design, shop) for shop in (SHOP, with_bed(600.0)))
    assert (small.apart, large.apart) == (1.0, 0.0)
    at_tips = (one.places(dict.fromkeys(one.known_g, 20.0))[FOOT][3] for one in (small, large))
    assert next(at_tips) == pytest.approx(toe_tip_mm(small.plain.design)[0] / small.plain.design.l5_mm / 20.0)
    assert next(at_tips) == 0.0


def with_bed(size_mm: float) -> Workshop:
    return SHOP.model_copy(update={"printer": SHOP.printer.model_copy(update={"bed_mm": (size_mm,) * 3})})


def test_bars_reach_from_the_toes_to_the_width_that_is_asked_for() -> None:
    half = DESIGN.l5_mm * math.sin(math.radians(DESIGN.ground_link_angle_deg))
    for more, length in ((-3.0, 0.0), (6.0, 6.0)):
        shop = varied(SHOP, {"body.toe_half_width_mm": half + more})
        bars = SizedLinks.of(DESIGN, shop).mass_features[FOOT][3]
        assert bars == pytest.approx(shop.material("links").density_g_cm3 * length, abs=1e-9)


@pytest.mark.parametrize("shop", ["default", "fine", "light"])
def test_shipped_workshops_are_near_with_designs_of_the_default_bounds(shop: str) -> None:
    workshop = load_workshop(shop)
    for end in ("lower", "upper"):
        design = Design(**{name: getattr(bound, end) for name, bound in SEARCH_BOUNDS.items()})
        assert near(design, workshop)
        for name, bound in SEARCH_BOUNDS.items():
            beyond = getattr(bound, end) * (0.999 if end == "lower" else 1.001)
            assert not near(design.model_copy(update={name: beyond}), workshop), name


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"bought.kit": "strong-2s"}, True),
        ({"bought.retention": "nuts", "bought.leg_bearing": "", "roles.links": "PLA"}, True),
        ({"roles.links": "PLA", "roles.body": "PLA", "roles.gears": "PLA"}, True),  # and no other material is left
        ({"bought.leg": "carbon-strip-3x6"}, False),
        ({"bought.axle_mm": 2.0}, False),
        ({"ground.pad": "rubber-2"}, False),
        ({"fits.wall_mm": 1.3}, False),
        ({"process.perimeters": 4}, False),
        ({"body.stop_deg": 4.0}, False),
        ({"mass.model": "solid"}, False),
        *(({".".join(key): end}, True) for key, ends in NUMBERS.items() for end in ends),
        *(({".".join(key): low - 0.01}, False) for key, (low, _) in NUMBERS.items()),
        *(({".".join(key): high + 0.01}, False) for key, (_, high) in NUMBERS.items()),
    ],
)
def test_workshops_are_near_that_differ_in_nothing_but_what_was_measured(
    values: dict[str, float | str], expected: bool
) -> None:
    assert near(DESIGN, varied(SHOP, values)) is expected


def test_materials_of_one_s_own_are_not_near() -> None:
    petg = SHOP.materials["PETG"].model_copy(update={"density_g_cm3": 1.2})
    assert not near(DESIGN, SHOP.model_copy(update={"materials": SHOP.materials | {"PETG": petg}}))


@pytest.mark.parametrize("preload_deg", [0.0, 8.0])
def test_masses_places_and_inertias_are_proportional_to_what_carries_them(preload_deg: float) -> None:
    """By bodies: plates, springs and axles; the leg, its hubs and bearings; the front link; toes, rails and bars.

    Places are moments over the mass; springs count with their energy, the preload's included, and their torque's root.
    """
    shop = varied(SHOP, {"spring.preload_deg": preload_deg, "body.toe_half_width_mm": 40.0})
    links, mass = SizedLinks.of(DESIGN, shop), {BODY: 90.0, MAIN_LEG: 20.0, FRONT_LINK: 5.0, FOOT: 12.0}
    design, sized, spring = DESIGN, links.sections, links.plain.spring
    loaded = design.compression_rad + math.radians(preload_deg)
    torque = spring.stiffness_nm_per_rad * loaded
    energy_mj, root = 500.0 * spring.stiffness_nm_per_rad * loaded**2, (1000.0 * torque) ** (1.0 / 3.0)
    density = shop.material("links").density_g_cm3
    plate = 1000.0 * printed_g_mm(shop, "body", 60.0, shop.body.plate_mm) / 60.0
    battery = chosen_parts(shop).battery.mass_g / mass[BODY]
    x, y = toe_tip_mm(design).tolist()
    toes, rails, bars = links.toe_g_mm * design.l5_mm, links.rail_g_mm * design.l4_mm, density * max(0.0, 40.0 - y)
    l1, l2, l3, l4 = design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm
    found = {
        "mass": links.mass_features, "x": links.places(mass), "z": links.heights(mass), "turn": links.inertias(mass)
    }  # fmt: skip
    known = {
        "mass": {
            BODY: (plate, plate * l1, energy_mj, root, axle_measure(shop)),
            MAIN_LEG: (1.0, links.leg_g_mm * l2, 2.0 * links.bearing_g, density * sized.thickness_mm),
            FRONT_LINK: (density * sized.thickness_mm, links.front_g_mm * l3),
            FOOT: (1.0, toes, rails, bars, links.apart, density * sized.foot_depth_mm**2),
        },
        "x": {
            BODY: (1.0, battery, battery * l1, l1, root, energy_mj),
            MAIN_LEG: (1.0, l2, links.leg_g_mm * l2**2 / 20.0),
            FRONT_LINK: (l3,),
            FOOT: tuple(m / 12.0 for m in (rails * l4, toes * x, bars * x, links.apart * x / design.l5_mm, l4)),
        },
        "z": {
            BODY: (1.0, l1, root, battery), MAIN_LEG: (1.0,), FRONT_LINK: (1.0,), FOOT: (1.0, sized.foot_depth_mm),
        },
        "turn": {
            BODY: (90.0, 90.0 * l1**2), MAIN_LEG: (20.0 * l2**2,), FRONT_LINK: (5.0 * l3**2,),
            FOOT: (rails * l4**2, toes * x**2, 12.0),
        },
    }  # fmt: skip
    assert bars > 0.0
    for kind, bodies in known.items():
        assert found[kind].keys() == bodies.keys()
        for name, values in bodies.items():
            assert found[kind][name] == pytest.approx(values), (kind, name)


@pytest.mark.parametrize("leg_bearing", ["", "683", "any"])
def test_a_hub_has_no_bearing_or_the_only_one_that_is_allowed_whatever_pushes(leg_bearing: str) -> None:
    shop = load_workshop()
    bought = shop.bought.model_copy(update={"leg_bearing": leg_bearing})
    shop = shop.model_copy(update={"bought": bought})
    for stiffness in (5.0, 500.0):
        spring = load_design("best-bo").model_copy(update={"stiffness_nmm_per_deg": stiffness})
        found = usual_bearing(shop, springs_on_leg(spring))
        known = [bearing for bearing in hub_bearings(shop) if bearing is not None]
        assert found is None if not known else found in known[:2]
        assert leg_bearing != "683" or found == shop.catalogue.bearings["683"]
