"""Sections that hold: checked with a solid rectangle's textbook formula, and against the issue's own example."""

import math

import numpy as np
import pytest
from support.fits import LOADS, with_fits_apart
from support.strengths import with_own
from support.workshops import workshop_with

from jumpcad.design import load_design
from jumpcad.dimensions import STOP_SEAT_MM
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot import sizing
from jumpcad.robot.sizing import TYPICAL_BODY, Sections, leg_flex_share, sections
from jumpcad.strength.growth import Growth
from jumpcad.strength.loads import push_off, toe_load_n
from jumpcad.strength.stress import SOLID, Beam
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.workshop import Role

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo")


def with_links(workshop: Workshop, **changes: float) -> Workshop:
    links = workshop.material("links").model_copy(update=changes)
    return workshop.model_copy(update={"materials": {**workshop.materials, workshop.material_name("links"): links}})


def test_ten_by_six_millimetres_of_petg_flex_as_the_hand_calculation_says() -> None:
    # U = T²·l/(6·E·I) for a uniform cantilever: 5.6 % of the springs' 0.72 J, at 15.6 MPa
    design = load_design("best-bo")
    share = leg_flex_share(design, Beam(6.0, np.full(201, 10.0)), 2000.0, springs_on_leg(design))
    torque = 1000.0 * design.peak_spring_torque_nm
    by_hand = torque**2 * design.l2_mm / (6.0 * 2000.0 * 500.0) / (1000.0 * design.spring_energy_j)
    assert share == pytest.approx(by_hand, rel=1e-3)
    assert share == pytest.approx(0.056, abs=0.001)


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_section_exceeds_the_design_stress_even_as_a_solid_bar(name: str) -> None:
    design, workshop = load_design(name), load_workshop()
    sizes = sections(Linkage(design), workshop)
    torque = 1000.0 * design.peak_spring_torque_nm
    for along in np.linspace(0.0, 1.0, 50):
        height = sizes.leg_root_mm + along * (sizes.leg_tip_mm - sizes.leg_root_mm)
        assert 6.0 * torque * (1.0 - along) / (sizes.thickness_mm * height**2) < 15.0
    assert 6.0 * torque / (sizes.thickness_mm * sizes.lever_root_mm**2) < 15.0


def test_every_beam_has_its_own_width_and_its_own_heights_from_root_to_tip() -> None:
    """Lugs and rails are as thick as each other, a toe narrows to 5 mm; what stands on the sole prints upright."""
    own = Sections(*np.arange(21.0, 37.0).tolist())
    widths = {"leg": (21, 21), "front": (21, 21), "toe": (31, 5), "rail": (27, 27)}
    heights = {"leg": (22, 23), "front": (24, 24), "toe": (32, 33), "rail": (29, 30)}
    for name, ends in widths.items():
        beam = getattr(own, name)(SOLID)
        width, height = (np.atleast_1d(size) for size in (beam.width_mm, beam.height_mm))
        assert (width[0], width[-1]) == ends
        assert (height[0], height[-1]) == heights[name]
        assert beam.upright == (name in ("toe", "rail"))


@pytest.mark.parametrize("name", ["carbon-tube-4x2", "carbon-tube-6x4", "carbon-strip-3x6"])
def test_legs_with_a_bar_have_walls_around_its_socket(name: str) -> None:
    """Above and below it a wall, beside it a thin one, and the play of a lying hole on every side."""
    workshop = with_fits_apart(load_workshop())
    sizes = sections(Linkage(load_design("kenan-2.0")), workshop_with(workshop, bought={"leg": name}))
    bar, fits = workshop.catalogue.bars[name], workshop.fits
    high = bar.height_mm + 2.0 * (fits.lying_mm + fits.wall_mm)
    assert sizes.front_mm == pytest.approx(max(6.0, high), abs=0.011)
    assert sizes.leg_tip_mm >= high - 1e-9
    assert sizes.leg_root_mm >= high - 1e-9
    around_axle = workshop.bought.axle_mm / 2.0 + 0.3 + 2.0 * fits.wall_mm
    assert sizes.eye_radius_mm == pytest.approx(max(around_axle, high / 2.0), abs=0.006)
    assert sizes.thickness_mm == pytest.approx(max(6.0, bar.width_mm + 2.0 * (fits.lying_mm + fits.wall_min_mm)))


def test_weaker_or_softer_links_grow() -> None:
    design, workshop = load_design("best-bo"), load_workshop()
    usual = sections(Linkage(design), workshop)
    weak = sections(Linkage(design), with_links(workshop, strength_in_plane_mpa=30.0))
    soft = sections(Linkage(design), with_links(workshop, modulus_mpa=1000.0))
    for name in ("lever_root_mm", "toe_root_mm", "rail_root_mm"):
        assert getattr(weak, name) > 1.1 * getattr(usual, name)
        # a thicker leg changes the foot's depth a little, and with it the toes' loads
        assert getattr(soft, name) == pytest.approx(getattr(usual, name), rel=5e-3)
    assert soft.leg_root_mm > 1.1 * usual.leg_root_mm


@pytest.mark.parametrize("role", ["gears", "body"])
def test_what_others_are_printed_in_does_not_size_the_links(role: Role) -> None:
    """Nor the rest stop's bar, which is printed as links are; of weak links all that bears grows."""
    linkage, workshop = Linkage(load_design("best-bo")), load_workshop()
    usual = sections(linkage, workshop)
    assert sections(linkage, with_own(workshop, role, 0.2)) == usual
    weak = sections(linkage, with_own(workshop, "links", 0.2))
    for name in ("leg_root_mm", "lever_root_mm", "rail_root_mm", "toe_root_mm", "stop_mm"):
        assert getattr(weak, name) > getattr(usual, name), name


def test_eyes_and_a_thin_dog_grow_with_the_axle() -> None:
    """Half a millimetre of radius, and one of diameter where the jaws are as thin as can be printed."""
    linkage, shop = Linkage(load_design("kenan-2.0")), load_workshop()
    thick = workshop_with(shop, bought={"axle_mm": shop.bought.axle_mm + 1.0})
    before, after = sections(linkage, shop), sections(linkage, thick)
    assert after.eye_radius_mm - before.eye_radius_mm == pytest.approx(0.5)
    assert after.dog_mm - before.dog_mm == pytest.approx(1.0)


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_leg_bears_the_springs_torque_and_more_than_the_force_along_it(
    monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """The torque is known; masses are not yet, so a fifth more than the axial force of a typical body."""
    asked, linkage = [], Linkage(load_design(name))
    bend = sizing.tapered_stress_mpa
    monkeypatch.setattr(sizing, "tapered_stress_mpa", lambda leg, *loads: asked.append(loads) or bend(leg, *loads))
    sections(linkage, load_workshop())
    axial = 1.2 * np.abs(push_off(linkage, TYPICAL_BODY).leg_axial_n).max()
    assert asked
    for loads in asked:
        assert loads == pytest.approx((1000.0 * linkage.design.peak_spring_torque_nm, axial), rel=1e-6)


def test_hollow_links_are_higher_than_solid_ones() -> None:
    design, workshop = load_design("best-bo"), load_workshop()
    solid = workshop_with(workshop, process={"infill": 1.0})
    by_hand = math.sqrt(6.0 * 1.15 * LOADS * 1000.0 * design.peak_spring_torque_nm / (8.0 * 15.0))
    assert sections(Linkage(design), solid).lever_root_mm == pytest.approx(math.ceil(147.0 * by_hand) / 100.0)
    assert sections(Linkage(design), workshop).lever_root_mm > 1.05 * by_hand


def test_eyes_keep_two_walls_around_their_axle() -> None:
    """An axle of 3 mm, 0.3 mm of play on the radius, two walls of 1.2 mm: 4.2 mm from the middle."""
    sizes = sections(Linkage(load_design("kenan-2.0")), load_workshop())
    assert sizes.eye_radius_mm == pytest.approx(1.5 + 0.3 + 2.0 * 1.2)


def test_the_stops_bar_is_a_beam_on_the_plates_under_the_pads_force() -> None:
    """Of solid PETG, 45 MPa, 8 mm along the leg: F/4·(L - w/2) = b·h²·S/6, twice the force, below a seat of 0.6 mm.

    The pad's force is 0.82 of that of a lossless spring which takes 12 % of the springs' energy.
    """
    solid = workshop_with(process={"infill": 1.0})
    design = load_design("best-bo")
    sizes = sections(Linkage(design), solid)
    width = sizes.thickness_mm
    rate = solid.stop_pad.rate_n_per_mm(width, 8.0)
    force = 2.0 * 0.82 * math.sqrt(2.0 * 0.12 * 1000.0 * design.spring_energy_j * rate)
    moment = force / 4.0 * (39.0 - width / 2.0)
    assert sizes.stop_mm == pytest.approx(STOP_SEAT_MM + math.sqrt(6.0 * moment / (8.0 * 45.0)), abs=0.03)


def test_dogs_are_twisted_alike_whatever_their_torque() -> None:
    """16·T/(pi·d³) is one stress for all designs whose dog is thicker than the least."""
    shop = load_workshop()
    least = sections(Linkage(load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.5})), shop).dog_mm
    stresses = []
    for stiffness in (20.0, 30.0, 40.0):
        design = load_design("best-bo").model_copy(update={"stiffness_nmm_per_deg": stiffness})
        dog = sections(Linkage(design), shop).dog_mm
        assert dog >= least
        if dog > least:
            stresses.append(16.0 * 1000.0 * design.peak_spring_torque_nm / (math.pi * dog**3))
    assert len(stresses) >= 2
    assert stresses == pytest.approx([stresses[0]] * len(stresses), rel=0.01)


def test_the_least_dog_has_jaws_that_print_around_the_gears_hub() -> None:
    """Axle, play, the hub's wall, play, and a jaw as thick as the thinnest column even between its drawn corners."""
    shop = load_workshop()
    fits = shop.fits
    weak = load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.1})
    jaw = fits.pin_min_mm + 0.05
    radius = 1.5 + fits.sliding_mm + fits.wall_min_mm + fits.sliding_mm + jaw
    assert sections(Linkage(weak), shop).dog_mm == pytest.approx(2.0 * radius, abs=0.011)


def test_preloaded_springs_ask_for_thicker_dogs_and_legs() -> None:
    """Their torque grows by (δ + p)/δ, the dog's diameter by its cube root, a solid lever's height by the root."""
    design = load_design("best-bo").model_copy(update={"stiffness_nmm_per_deg": 30.0})
    solid = workshop_with(process={"infill": 1.0})
    loaded = workshop_with(solid, spring={"preload_deg": 10.0})
    usual, more = (sections(Linkage(design), one) for one in (solid, loaded))
    times = 1.0 + math.radians(10.0) / design.compression_rad
    assert more.thickness_mm == usual.thickness_mm
    assert more.dog_mm / usual.dog_mm == pytest.approx(times ** (1.0 / 3.0), abs=2e-3)
    assert more.lever_root_mm / usual.lever_root_mm == pytest.approx(math.sqrt(times), abs=2e-3)


def test_a_robot_with_hardly_any_spring_has_the_least_sections() -> None:
    """Links 6 mm high and thick; the leg's root, which a pin's hole weakens, and the lever have 2 mm more."""
    weak = load_design("kenan-2.0").model_copy(update={"stiffness_nmm_per_deg": 0.05})
    sizes = sections(Linkage(weak), load_workshop())
    assert (sizes.thickness_mm, sizes.front_mm, sizes.leg_tip_mm) == (6.0, 6.0, 6.0)
    assert sizes.leg_root_mm == sizes.lever_root_mm == 6.0 + 2.0
    assert (sizes.rail_root_mm, sizes.rail_tip_mm, sizes.toe_root_mm) == (3.2, 3.2, 3.2)  # 16 layers of 0.2 mm
    assert (sizes.toe_tip_height_mm, sizes.stop_mm) == (2.4, 6.0)
    eye = max(sizes.eye_radius_mm, sizes.leg_tip_mm / 2.0)
    assert sizes.foot_depth_mm == pytest.approx(eye + 1.0)  # the links are 1 mm above the ground


def test_what_fails_grows_and_nothing_else_does() -> None:
    """Each factor by a quarter; tips of rails and toes taper from their roots."""
    linkage, shop = Linkage(load_design("best-bo")), load_workshop()
    plain = vars(sections(linkage, shop))
    grown = {"lever": "lever_root_mm", "toe": "toe_root_mm", "rail": "rail_root_mm", "dog": "dog_mm", "stop": "stop_mm"}
    tips = {"toe": {"toe_tip_height_mm"}, "rail": {"rail_tip_mm"}}
    for factor, size in {**grown, "front": "front_mm"}.items():
        found = vars(sections(linkage, shop, growth=Growth(**{factor: 1.25})))
        assert {name for name in plain if found[name] != plain[name]} == {size, *tips.get(factor, ())}, factor
        assert found[size] == pytest.approx(1.25 * plain[size], abs=0.011), factor


@pytest.mark.parametrize("times", [1.0, 1.5, 2.5])
def test_the_foot_is_as_deep_as_the_higher_of_eyes_and_leg_and_a_millimetre(times: float) -> None:
    """A leg that tapers to 0.6 of its root's height is higher than its eye once it has grown."""
    sizes = sections(Linkage(load_design("best-bo")), load_workshop(), growth=Growth(leg=times))
    assert sizes.leg_tip_mm == pytest.approx(max(6.0, 0.6 * sizes.leg_root_mm))
    assert sizes.foot_depth_mm == pytest.approx(max(sizes.eye_radius_mm, sizes.leg_tip_mm / 2.0) + 1.0)
    assert (sizes.leg_tip_mm / 2.0 > sizes.eye_radius_mm) == (times > 1.0)


@pytest.mark.parametrize("pad", ["", "tpu-2"])
@pytest.mark.parametrize(("angle_deg", "bends"), [(16.0, True), (38.0, True), (75.0, False)])
def test_toes_and_rails_bear_the_ground_under_the_pads(pad: str, angle_deg: float, bends: bool) -> None:
    """Solid bars, 1.15 times the load of both tips, half of it on either: b·h²·S/6, 7 mm wide toes, 4 mm wide rails.

    A rail is bent by what a tip is behind it, and twisted by what it is beside it, 5.5 or 6.5 mm from the middle, with
    half its strength: √3·T·(3 + 1.8·c/b)/(b·c²). The ground's force along the ground has a longer arm with a pad.
    """
    solid = workshop_with(process={"infill": 1.0}, ground={"pad": pad})
    linkage = Linkage(load_design("best-bo").model_copy(update={"ground_link_angle_deg": angle_deg}))
    sizes, length = sections(linkage, solid), linkage.design.l5_mm
    ground = sizes.foot_depth_mm + (2.0 if pad else 0.0)
    tips = 1.15 * toe_load_n(push_off(linkage, TYPICAL_BODY), linkage.design, ground).max()

    def bent_mm(arm: float, width: float) -> float:
        return math.sqrt(6.0 * tips / 2.0 * arm * LOADS / (width * 15.0))

    assert sizes.toe_root_mm == pytest.approx(math.ceil(100.0 * bent_mm(length, 7.0)) / 100.0)
    angle, height = math.radians(angle_deg), sizes.rail_root_mm
    bending = bent_mm(length * math.cos(angle), 4.0)
    torque = tips / 2.0 * (length * math.sin(angle) - (sizes.thickness_mm / 2.0 + 2.5))
    short, long = sorted((4.0, height))
    shear = math.sqrt(3.0) * torque / (long * short**2) * (3.0 + 1.8 * short / long)
    assert height > 3.2
    if bends:
        assert height == pytest.approx(math.ceil(100.0 * bending) / 100.0)
        assert shear < 22.5
    else:
        assert height > bending + 0.1
        assert shear == pytest.approx(45.0 / 2.0, rel=2e-3)
    assert sizes.ground_mm == pytest.approx(ground)


def test_hollow_toes_and_rails_stand_upright_on_their_layers() -> None:
    """Three lines of 0.45 mm at their sides, 0.9 mm of layers below and above, a fifth of solid plastic within.

    Wide enough for a core: M·h/(2·I) of what is left is the stress that links may have, to a hundredth of a millimetre.
    """
    shop = load_workshop()
    linkage = Linkage(load_design("best-bo").model_copy(update={"ground_link_angle_deg": 16.0}))
    assert (shop.process.perimeters, shop.process.line_width_mm, shop.process.infill) == (3, 0.45, 0.4)
    sizes, length = sections(linkage, shop), linkage.design.l5_mm
    tips = 1.15 * toe_load_n(push_off(linkage, TYPICAL_BODY), linkage.design, sizes.foot_depth_mm).max()
    behind = length * math.cos(math.radians(linkage.design.ground_link_angle_deg))
    for width, height, arm in ((7.0, sizes.toe_root_mm, length), (4.0, sizes.rail_root_mm, behind)):
        core = (width - 2.7) * (height - 1.8) ** 3
        second = (width * height**3 - 0.8 * core) / 12.0
        assert core > 0.0
        assert tips / 2.0 * arm * height / 2.0 / second == pytest.approx(15.0 / LOADS, rel=5e-3)
