"""Bodies are the sum of their parts' meshes and touch the ground where the design says; pins rub at their radius."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from support.built import LONG_TOES, built, part
from support.each import each
from support.strengths import with_own
from support.workshops import workshop_with

from jumpcad.building import bodies, build
from jumpcad.building.assembly import drawings, layout_of
from jumpcad.building.bodies import _contacts, friction_of, release_of, require_parts, weighed_part
from jumpcad.design import load_design
from jumpcad.drive.release import MovingParts
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Friction
from jumpcad.printing import layer_mass, layers
from jumpcad.printing.layer_mass import printed_moments
from jumpcad.robot.robot import Robot
from jumpcad.solids.moments import mass_of
from jumpcad.solids.stl import to_trimesh
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.workshop import Role


def pieces(robot: Robot, body: str) -> list[tuple[trimesh.Trimesh, float]]:
    """Return mesh (m, in the body's frame) and mass of everything on a body."""
    found = [(one.mesh.copy(), place, one.mass_kg) for one in robot.parts for place in one.placements]
    found += [(to_trimesh(item.solid), item, item.mass_kg) for item in robot.hardware]
    return [
        (mesh.apply_transform(at.T_body_part).apply_scale(0.001), mass) for mesh, at, mass in found if at.body == body
    ]


@each("name", ["kenan-2.0", LONG_TOES])
@each("body", BODY_NAMES)
def test_bodies_are_the_sum_of_their_meshes(name: str, body: str) -> None:
    """Mass, centre and tensor of every mesh by trimesh, and Steiner's theorem."""
    robot = built(name, mass_model="solid")
    assert {part.mass_source for part in robot.parts} == {"solid"}
    masses, centres, tensors = [], [], []
    for mesh, mass in pieces(robot, body):
        mesh.density = mass / mesh.volume
        masses.append(mass)
        centres.append(mesh.center_mass)
        tensors.append(mesh.moment_inertia)
    total = sum(masses)
    centre = np.average(centres, axis=0, weights=masses)
    inertia = np.zeros((3, 3))
    for mass, at, tensor in zip(masses, centres, tensors, strict=True):
        arm = at - centre
        inertia += tensor + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    found = robot.bodies[body]
    assert found.mass_kg == pytest.approx(total, rel=1e-9)
    np.testing.assert_allclose(found.com_m, centre, atol=1e-6)
    # Meshes leave out what is below 0.05 mm: kenan-2.0's main leg alone has its centre 0.9 µm off, on an arm of 30 mm.
    np.testing.assert_allclose(found.inertia_kg_m2, inertia, atol=4e-5 * np.abs(inertia).max())


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_body_tensors_belong_to_bodies(name: str) -> None:
    for body in built(name).bodies.values():
        low, middle, high = np.linalg.eigvalsh(body.inertia_kg_m2)
        assert 0 < low <= middle <= high < low + middle
        np.testing.assert_allclose(body.inertia_kg_m2, body.inertia_kg_m2.T, atol=1e-18)


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
def test_what_touches_the_ground_is_where_the_design_says(name: str) -> None:
    """Foot: nose at the front eye, tips at the toes' length and angle; body: both ends of its strut."""
    robot = built(name)
    design = robot.design
    angle = math.radians(design.ground_link_angle_deg)
    x, y = -design.l5_mm * math.cos(angle), design.l5_mm * math.sin(angle)
    feet = {one.name: 1000.0 * one.centre_m for one in robot.bodies[FOOT].contacts}
    assert feet["front_eye"] == pytest.approx([design.l4_mm, 0.0, 0.0])
    assert feet["left_toe"][:2] == pytest.approx([x, y])
    assert feet["right_toe"][:2] == pytest.approx([x, -y])
    for one in robot.bodies[FOOT].contacts:
        assert one.centre_m[2] - one.radius_m == pytest.approx(-robot.foot_depth_m)
    sections, (_, *toes) = robot.layout.sections, robot.bodies[FOOT].contacts
    for toe in toes:  # from the pad's lower face to its upper one, around the printed tip
        assert 2000.0 * toe.radius_m == pytest.approx(sections.toe_tip_height_mm + 2.0 * sections.pad_mm)
    ends = {one.name: (1000.0 * one.centre_m, 1000.0 * one.radius_m) for one in robot.bodies[BODY].contacts}
    for end, sign in (("back", -1.0), ("front", 1.0)):
        assert ends[end][0] == pytest.approx([sign * design.l1_mm / 2.0, 0.0, 0.0])
        assert ends[end][1] == pytest.approx(1.5 + 3.0)  # a seat of 3 mm around an axle of 3 mm


@pytest.mark.parametrize("axle_mm", [2.0, 4.0])
def test_the_bodys_ends_are_as_thick_as_their_seats_around_the_axles(axle_mm: float) -> None:
    """A seat of 3 mm around an axle; the ground is that far from its middle."""
    ends = _contacts(replace(built("kenan-2.0").layout, axle_mm=axle_mm))[BODY]
    assert [1000.0 * one.radius_m for one in ends] == pytest.approx([axle_mm / 2.0 + 3.0] * 2)


def test_pins_rub_at_their_radius_and_a_ball_bearing_does_not() -> None:
    robot = built("kenan-2.0")
    assert robot.layout.hub_bearing is not None
    assert robot.friction.pin_radius_m == (0.0, 0.0015, 0.0015, 0.0015)
    assert built("kenan-2.0", leg_bearing="").friction.pin_radius_m == (0.0015,) * 4
    rough = workshop_with(pins={"friction": 0.4}, ground={"friction": 0.7, "bare_friction": 0.5})
    rubbing = Friction(foot=0.7, body=0.5, pin=0.4, pin_radius_m=(0.0, 0.002, 0.002, 0.002))
    assert friction_of(replace(robot.layout, axle_mm=4.0), rough) == rubbing


def weighed(**grams: float) -> Workshop:
    """Return the default workshop with weights of parts (g)."""
    return workshop_with(mass={"weighed_g": grams})


def test_solid_parts_weigh_their_volume() -> None:
    """PETG 1.27 and PLA 1.24 g/cm³."""
    robot = built("kenan-2.0", mass_model="solid")
    for one in robot.parts:
        density = {"PETG": 1270.0, "PLA": 1240.0}[one.material]
        assert one.mass_kg == pytest.approx(density * one.mesh.volume * 1e-9, rel=5e-4), one.name


def test_printed_parts_are_mostly_lighter_than_solid_ones() -> None:
    """Nothing but narrow frames, in which a slicer's lines overlap, is heavier (PrusaSlicer: the trays by 3 %)."""
    printed, solid = built("kenan-2.0"), built("kenan-2.0", mass_model="solid")
    for light, heavy in zip(printed.parts, solid.parts, strict=True):
        assert 0.4 * heavy.mass_kg < light.mass_kg < 1.08 * heavy.mass_kg, light.name
    assert printed.mass_kg < solid.mass_kg


def test_a_weighed_part_weighs_what_the_scale_says() -> None:
    robot = build(load_design("kenan-2.0"), workshop_with(mass={"weighed_g": {"foot": 12.5}}))
    foot = next(part for part in robot.parts if part.name == "foot")
    assert foot.mass_kg == pytest.approx(0.0125)
    assert foot.mass_source == "weighed"
    gained = 0.0125 - next(part for part in built("kenan-2.0").parts if part.name == "foot").mass_kg
    assert robot.bodies[FOOT].mass_kg - built("kenan-2.0").bodies[FOOT].mass_kg == pytest.approx(gained, rel=1e-9)


def test_a_misspelt_weighed_part_is_told_when_the_parts_are_known() -> None:
    with pytest.raises(
        JumpcadError, match=r"mass\.weighed_g\.fot: no such part \(did you mean foot\?\); the robot has"
    ):
        build(load_design("kenan-2.0"), weighed(fot=12.5))


@pytest.mark.parametrize("grams", [-1.0, 0.0, math.nan, math.inf, "5", None, True])
def test_weights_that_nothing_has_are_refused_in_python_too(grams: float) -> None:
    with pytest.raises(JumpcadError, match=r"mass\.weighed_g\.foot = .*: must be"):
        build(load_design("kenan-2.0"), weighed(foot=grams))
    changed = load_workshop().model_copy(deep=True)
    changed.mass.weighed_g["foot"] = grams
    with pytest.raises(JumpcadError, match=r"mass\.weighed_g\.foot = .*: must be"):
        build(load_design("kenan-2.0"), changed)


@pytest.mark.parametrize("share", [1e-3, 1e3])
def test_a_weight_in_kilograms_or_milligrams_is_refused(share: float) -> None:
    (foot,) = (part for part in built("kenan-2.0").parts if part.name == "foot")
    with pytest.raises(JumpcadError, match=r"weighed_g\.foot = .*: as drawn it weighs about 8\.5 g: is it in grams"):
        build(load_design("kenan-2.0"), weighed(foot=share * 1000.0 * foot.mass_kg))


def test_parts_of_which_a_workshops_choice_decides_may_be_weighed_for_all_robots() -> None:
    """Ends of legs of bars, and the mount of a sensor: for a robot without them their weights are of no use."""
    whole = layout_of(load_design("kenan-2.0"), shop := load_workshop())
    barred = layout_of(load_design("kenan-2.0"), workshop_with(bought={"leg": "carbon-tube-4x2"}))
    few, more = ({one.name for one in drawings(layout, shop)} for layout in (replace(whole, sensor=None), barred))
    assert more - few == {"main_leg_end", "sensor_mount"}
    require_parts(more, sorted(few))


def test_a_part_weighs_what_the_printers_own_nozzle_lays() -> None:
    """A wider one bridges the infill of a plate with thicker threads."""
    workshop = load_workshop()
    wide = workshop_with(workshop, printer={"nozzle_mm": 0.6})
    drawing = next(part for part in built("kenan-2.0").parts if part.name == "body_plate_right")
    assert weighed_part(drawing, wide).mass_kg > 1.001 * weighed_part(drawing, workshop).mass_kg


def test_corners_that_are_left_out_of_plates_weigh_next_to_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """At most 0.05 % of a part's mass and 0.1 % of its inertia, against corners of half the tolerance."""
    robots = [built("kenan-2.0"), built("best-printable", "light")]
    parts = [part for robot in robots for part in robot.parts if part.name.startswith(("body_plate", "electronics"))]
    assert len(parts) == 8
    monkeypatch.setattr(layers, "MANY_HOLES", 10_000)
    monkeypatch.setattr(layer_mass, "FEW", 0)
    for one, shop in zip(parts, [robot.workshop for robot in robots for _ in range(4)], strict=True):
        density = shop.material("body").density_g_cm3
        moments = printed_moments(one.shape, shop.process, shop.printer.nozzle_mm)
        fine = mass_of(moments, density)
        assert one.mass_kg != fine.mass_kg or one.name.startswith("electronics"), "no corner was left out"
        assert one.mass_kg == pytest.approx(fine.mass_kg, rel=5e-4), one.name
        assert np.diag(one.mass.inertia_kg_m2) == pytest.approx(np.diag(fine.inertia_kg_m2), rel=1e-3), one.name


@pytest.fixture(scope="module")
def robot() -> Robot:
    """Its parts weigh as much as solid ones: their density is the material's."""
    return built("kenan-2.0", mass_model="solid")


@pytest.fixture(scope="module")
def moving(robot: Robot) -> MovingParts:
    return moving_in(robot, robot.workshop)


def moving_in(robot: Robot, workshop: Workshop) -> MovingParts:
    """Return what moves of a robot, its lever printed in a workshop."""
    seen: list[Any] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bodies, "release", lambda *given: seen.append(given))
        release_of(robot.layout, workshop, robot.parts, robot.hardware, robot.bodies, robot.spring)
    ((drive, found, _),) = seen
    assert drive is robot.layout.drive
    assert isinstance(found, MovingParts)
    return found


@pytest.mark.parametrize(
    ("name", "field", "axle"),
    [("cam", "cam_kg_m2", "cam"), ("cam_gear", "cam_gear_kg_m2", "cam"), ("motor_pinion", "pinion_kg_m2", "motor")],
)
def test_wheels_have_their_inertia_about_their_own_axle(
    robot: Robot, moving: MovingParts, name: str, field: str, axle: str
) -> None:
    """The mesh's tensor about its centre, and Steiner's term to the axle, along y."""
    found = part(robot, name)
    mesh = found.mesh.copy().apply_transform(found.placements[0].T_body_part).apply_scale(0.001)
    mesh.density = found.mass_kg / mesh.volume
    at = {"cam": robot.layout.cam_axis_mm, "motor": robot.layout.motor_mm}[axle]
    off = mesh.center_mass[[0, 2]] - np.asarray(at) / 1000.0
    expected = mesh.moment_inertia[1, 1] + found.mass_kg * float(off @ off)
    assert getattr(moving, field) == pytest.approx(expected, rel=2e-3)


def test_the_roller_moves_with_a_quarter_of_its_lever(robot: Robot, moving: MovingParts) -> None:
    """Rayleigh: 33/140 of a uniform cantilever; of a printed lever of that length, thickness and mean height."""
    sections, material = robot.layout.sections, robot.workshop.material("links")
    length, height = robot.layout.drive.cam.geometry.lever_mm, (sections.lever_root_mm + 9.0) / 2.0
    bearing = sum(item.mass_kg for item in robot.hardware if item.name.startswith("roller"))
    solid = 33.0 / 140.0 * length * height * sections.thickness_mm * material.density_g_cm3 * 1e-6
    more = moving.roller_kg - bearing
    assert bearing > 0.001
    assert 0.4 * solid < more <= solid
    filled = moving_in(robot, workshop_with(robot.workshop, process={"infill": 1.0}))
    assert filled.roller_kg - bearing == pytest.approx(solid, rel=1e-3)


@pytest.mark.parametrize(("role", "share"), [("links", 0.5), ("gears", 1.0), ("body", 1.0)])
def test_the_lever_is_printed_as_links_are(robot: Robot, moving: MovingParts, role: Role, share: float) -> None:
    bearing = sum(item.mass_kg for item in robot.hardware if item.name.startswith("roller"))
    found = moving_in(robot, with_own(robot.workshop, role, 0.5))
    assert found.lever_n_per_m == pytest.approx(share * moving.lever_n_per_m)
    assert found.roller_kg - bearing == pytest.approx(share * (moving.roller_kg - bearing))


def test_the_lever_bends_as_a_cantilever_that_tapers(robot: Robot, moving: MovingParts) -> None:
    """F/f = 3·E·I/L³; between that of its root's section and that of its eye's, less what infill leaves out."""
    sections, material = robot.layout.sections, robot.workshop.material("links")
    length = robot.layout.drive.cam.geometry.lever_mm / 1000.0
    stiffness = [
        3.0 * material.modulus_mpa * 1e6 * sections.thickness_mm * height**3 / 12.0 * 1e-12 / length**3
        for height in (9.0, sections.lever_root_mm)
    ]
    assert 0.4 * min(stiffness) < moving.lever_n_per_m <= max(stiffness)


def test_the_cam_runs_on_its_axle_with_the_running_fit(robot: Robot, moving: MovingParts) -> None:
    assert moving.bore_mm == pytest.approx(3.4)  # 0.2 mm around an axle of 3 mm
    thin = replace(robot, layout=replace(robot.layout, axle_mm=2.0))
    assert moving_in(thin, robot.workshop).bore_mm == pytest.approx(2.4)
    assert moving.spring is robot.spring
    assert math.isfinite(moving.leg.push_off_s(robot.spring, 0.0))
