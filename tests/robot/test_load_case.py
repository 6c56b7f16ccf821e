"""What strength checks share: loads of landing and loaded springs, and the axles and pins that they bend."""

import io
import math
from dataclasses import replace

import numpy as np
import pytest
import yourdfpy
from support.built import built, geared
from support.masses import in_plane
from support.strengths import strength_findings

from jumpcad.design import load_design
from jumpcad.dimensions import GAP_MM
from jumpcad.exporters.urdf import write_urdf
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import BODY
from jumpcad.robot.load_case import LoadCase, axle_beams
from jumpcad.robot.robot import Robot
from jumpcad.strength.axles import SCREW_CORE_MM, SCREW_THREAD_MM
from jumpcad.strength.loads import push_off, toe_load_n
from jumpcad.transforms import Array


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-bo"])
def test_the_arms_forces_turn_leg_and_plates_with_the_springs_torque(name: str) -> None:
    """A pin is pushed away from the hub, square to its arm; winding is counter-clockwise seen from the right.

    So the leg is pushed back clockwise, and the plates the other way with the same torque.
    """
    robot = built(name)
    spring, case = robot.layout.drive.spring, LoadCase(robot)
    (on_leg, on_pin), _ = case.wound_forces_n
    loaded = spring.leg_pin_rad + robot.design.compression_rad
    for force, angle, sense in ((on_leg, loaded, -1.0), (on_pin, spring.plate_pin_rad, 1.0)):
        x, z = spring.arms.pin_radius_mm * math.cos(angle), spring.arms.pin_radius_mm * math.sin(angle)
        assert x * force[1] - z * force[0] == pytest.approx(sense * 1000.0 * robot.spring.peak_torque_nm)
        assert (x * force[0] + z * force[1]) / math.hypot(*force) > spring.arms.mean_mm / 2.0


@pytest.mark.parametrize(("axis", "matters"), [(0, True), (1, False), (2, True)])
def test_the_push_off_is_that_of_the_body_in_the_plane_of_motion(axis: int, matters: bool) -> None:
    """Where the body's mass is across the robot changes no force; along and above it does where the body turns."""
    robot = built("best-printable")
    body = robot.bodies[BODY]
    moved = replace(body, com_m=body.com_m + 0.01 * np.eye(3)[axis])
    forces = LoadCase(replace(robot, bodies={**robot.bodies, BODY: moved})).forces.ground_n
    assert np.allclose(forces, LoadCase(robot).forces.ground_n, rtol=1e-3) == (not matters)
    gyration = 1000.0 * math.sqrt(moved.inertia_kg_m2[1, 1] / moved.mass_kg)
    mass = in_plane(moved.mass_kg, (1000.0 * moved.com_m[0], 1000.0 * moved.com_m[2]), gyration)
    assert np.allclose(forces, push_off(robot.linkage, mass, robot.spring).ground_n)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_axles_and_pins_are_beams_between_what_holds_them(name: str) -> None:
    """Places from the meshes, forces from the springs' torque: M of beams by hand, stress 32·M/(pi·d³)."""
    robot = built(name)
    case, spring, sections = LoadCase(robot), robot.layout.drive.spring, robot.layout.sections

    plates = [robot.layout.lateral.left_plate, robot.layout.lateral.right_plate]
    left, right = (sum(plate) / 2.0 for plate in plates)  # the plates without what stands on them
    span, arm_n = left - right, spring.torque_nmm / spring.arms.lever_mm
    roller = next(item for item in robot.hardware if item.name == "roller")
    cam = float(roller.shown_mesh.copy().apply_transform(roller.T_body_part).bounds[:, 1].mean())
    end = robot.layout.lateral.spring_left[1] - spring.wire_mm / 2.0
    thickness = sections.thickness_mm
    (_, on_pin), _ = case.wound_forces_n
    eye = max(case.front_n, case.landing_n) / 2.0
    by_hand = {
        # the spring that is nearer to its plate loads that plate more; the other plate's share bends over a longer arm
        "spring_pin": 2.0 * arm_n / span * max(-right * (left - end), left * (-right - end)),
        "front_axle": 2.0 * eye / span * max(-right * (left - thickness / 3.0), left * (-right - thickness / 3.0)),
        "leg_pin": arm_n * (GAP_MM + spring.wire_mm / 2.0 + thickness / 4.0),
        "foot_pin": max(case.ankle_n, case.front_n, case.landing_n) / 2.0
        * (robot.layout.lateral.lug_left[0] + sections.lug_thickness_mm / 2.0 - thickness / 4.0),
    }  # fmt: skip
    assert math.hypot(*on_pin) == pytest.approx(2.0 * arm_n)
    # the cam gear's teeth push back on the cam's axle, less than the cam and nearer to the plate
    alone = robot.layout.drive.cam.peak_contact_n * (cam - right) * (left - cam) / span
    assert 0.9 * alone < case.steel_stresses_mpa["cam_axle"] * math.pi * robot.layout.axle_mm**3 / 32.0 < 1.3 * alone
    for pin, moment in by_hand.items():
        diameter = case.bars[pin].diameter_mm
        least = 32.0 * moment / (math.pi * diameter**3)
        assert case.steel_stresses_mpa[pin] >= 0.97 * least, pin
        if robot.layout.retention != "nuts":
            assert case.steel_stresses_mpa[pin] == pytest.approx(least, rel=0.05), pin


def test_a_landing_is_stopped_over_the_workshops_distance() -> None:
    """Springs' energy becomes height; m·g·h over the stop, and the weight. A toe's blow turns the body: it is less."""
    robot = built("kenan-2.0")
    case = LoadCase(robot)
    weight = robot.mass_kg * 9.80665
    joules = robot.spring.energy_j
    stop_m = robot.workshop.safety.landing_stop_mm / 1000.0
    assert case.landing_n == pytest.approx(joules / stop_m + weight, rel=2e-3)
    body = robot.bodies["body"]
    k_x, k_y = (1000.0 * math.sqrt(body.inertia_kg_m2[i, i] / body.mass_kg) for i in (0, 1))
    x, y = _toe_from_body_mm(robot)
    share = 1.0 / (1.0 + (x / k_y) ** 2 + (y / k_x) ** 2)
    assert case.toe_blow_n == pytest.approx(share * case.landing_n)
    assert case.axial_n == pytest.approx(robot.workshop.ground.foot_friction * case.landing_n)


def test_the_thread_of_a_screw_that_is_an_axle_bears_less_than_its_shank() -> None:
    """Near the right plate, whose reaction bends it; the springs' pin has the same moment all along between its arms.

    M3's core: 2.39 mm; thread of at least 6 mm.
    """
    robot = built("kenan-2.0", retention="nuts")
    case, lateral = LoadCase(robot), robot.layout.lateral
    plates = [sum(plate) / 2.0 for plate in (lateral.left_plate, lateral.right_plate)]
    screw = next(item for item in robot.hardware if item.name == "leg_axle")
    points = screw.shown_mesh.copy().apply_transform(screw.T_body_part).bounds[:, 1]
    thread = points[0] + SCREW_THREAD_MM  # its end towards the head, which is on the left
    spring = robot.layout.drive.spring
    pin = spring.torque_nmm / spring.arms.lever_mm * (lateral.spring_right[0] + spring.wire_mm / 2.0 - plates[1])
    in_thread = 32.0 * pin / (math.pi * SCREW_CORE_MM**3)
    assert case.steel_stresses_mpa["spring_pin"] == pytest.approx(in_thread, rel=0.1)
    for axle in ("leg_axle", "front_axle", "cam_axle"):
        beam = case.beams[axle]
        assert beam.supports_mm == pytest.approx(plates)
        within = np.array([thread, *(place for place in beam.places_mm if place < thread)])
        thread_mpa = 32.0 * beam.moments_nmm(within).max() / (math.pi * SCREW_CORE_MM**3)
        assert case.steel_stresses_mpa[axle] == pytest.approx(
            max(case.bars[axle].stress_mpa(beam.largest_nmm()), thread_mpa), rel=0.03
        )


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_springs_torque_is_rate_times_turn(name: str) -> None:
    """In the units of a spring maker's list: N·mm per degree, from rest to loaded."""
    design = load_design(name)
    torque = design.stiffness_nmm_per_deg * math.degrees(design.compression_rad)
    assert LoadCase(built(name)).torque_nmm == pytest.approx(torque)


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-bo"])
def test_pins_and_toes_bear_the_most_that_a_push_off_has(name: str) -> None:
    """On its way the pins' forces change; the ankle bears the springs' torque over the leg, and the force along it."""
    case, design = LoadCase(built(name)), load_design(name)
    forces, along = case.forces, case.forces.leg_axial_n
    preload = built(name).spring.preload_rad
    across = 1000.0 * design.stiffness_nm_per_rad * (preload - forces.leg_rad) / design.l2_mm
    stands = forces.ground_n[:, 1] > 0.0
    at_ankle = np.hypot(across, along)[stands]
    assert case.ankle_n == pytest.approx(at_ankle.max())
    assert at_ankle.min() < 0.8 * case.ankle_n
    assert case.front_n == pytest.approx(max(forces.front_n.max(), -forces.front_n.min()))
    both = toe_load_n(forces, design, 1000.0 * built(name).foot_depth_m)
    assert case.toes_n == pytest.approx(both.max())
    assert both.min() < 0.8 * case.toes_n


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_dog_is_as_long_as_the_cam_gear_is_wide_wherever_that_lies(name: str) -> None:
    """Longer jaws are bent more; the boss, which is a tube, is twisted alike."""
    robot = built(name)
    lateral = robot.layout.lateral

    def stress(low_mm: float, wide: float) -> float:
        gears = ((low_mm, low_mm + wide), *lateral.gears[1:])
        moved = replace(robot.layout, lateral=replace(lateral, gears=gears))
        return LoadCase(replace(robot, layout=moved)).dog_stress_mpa(1.0)

    low, high = lateral.gears[0]
    assert stress(low, high - low) == LoadCase(robot).dog_stress_mpa(1.0)
    assert stress(low + 7.0, high - low) == pytest.approx(stress(low, high - low))
    assert stress(low, 4.0 * (high - low)) > 1.5 * stress(low, high - low)
    assert LoadCase(robot).dog_stress_mpa(2.0) == pytest.approx(2.0 * LoadCase(robot).dog_stress_mpa(1.0))
    # two jaws of 1 N·m, 0.05 mm long: hardly bent, but sheared by 3·F/(2·A), A from the gear's hub to the outer side
    dog, fits = robot.layout.drive.dog, robot.workshop.fits
    inside = robot.layout.axle_mm + 4.0 * fits.sliding_mm + 2.0 * fits.wall_min_mm
    middle = (dog.outer_mm + inside) / 4.0
    area = (dog.outer_mm - inside) / 2.0 * middle * dog.jaw_rad
    assert stress(low, 0.05) == pytest.approx(math.sqrt(3.0) * 1.5 * 1000.0 / (2.0 * middle) / area, rel=1e-3)


def _toe_from_body_mm(robot: Robot) -> tuple[float, float]:
    """How far the nearer toe's tip is from the body's centre of mass, along the sole and across: by the URDF's tree."""
    model = yourdfpy.URDF.load(io.BytesIO(write_urdf(robot).encode()), load_meshes=False, build_scene_graph=True)
    ankle_to_body = np.linalg.inv(model.get_transform("foot", "body"))
    centre = 1000.0 * (ankle_to_body @ np.append(robot.bodies["body"].com_m, 1.0))
    x, y = toe_tip_mm(robot.design)
    return float(centre[0] - x), float(y - abs(centre[1]))


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_plates_carry_what_the_mechanism_pushes(name: str) -> None:
    """Leg, springs' pin and cam: action and reaction, so that of the springs' and cam's forces nothing is left over."""
    case = LoadCase(built(name))
    (_, on_pin), on_lever = case.wound_forces_n
    pushed = {axle: beam.on_plates_n().sum(axis=0) for axle, beam in case.beams.items()}
    assert pushed["leg_axle"] == pytest.approx(on_lever - on_pin)
    assert pushed["spring_pin"] == pytest.approx(on_pin)
    assert np.hypot(*pushed["front_axle"]) == pytest.approx(max(case.front_n, case.landing_n))
    # springs and leg stand in the middle, the roller beside it: what tilts the leg's axle is the cam's push alone
    beam = case.beams["leg_axle"]
    assert beam.places_mm @ beam.forces_n == pytest.approx(sum(case.layout.lateral.cam) / 2.0 * on_lever)


def test_arms_in_line_bend_the_axle_between_hub_and_coils() -> None:
    """Each coil passes on its arms' forces where they leave it, half a wire within its ends; no cam pushes.

    In the middle M is the reaction's moment less those of outer end, inner end and bearing, of F/2 each.
    """
    layout, force, none = built("best-bo").layout, np.array([0.0, 80.0]), np.zeros(2)
    beam = axle_beams(layout, (force, -force), none, none)["leg_axle"]
    left, right = (abs(float(np.mean(plate))) for plate in (layout.lateral.left_plate, layout.lateral.right_plate))
    wire, (inner, outer) = layout.drive.spring.wire_mm, layout.lateral.spring_left
    bearing = (8.0 - 3.0) / 2.0  # 683: 3 mm wide, in a hub of 8 mm
    arms = (outer - wire / 2.0) - (inner + wire / 2.0) + bearing
    by_hand = 80.0 * left / (left + right) * right - 40.0 * arms
    assert beam.moments_nmm(np.zeros(1)) == pytest.approx([by_hand])


@pytest.mark.parametrize("pairs", [1, 2])
def test_teeth_and_cam_hold_the_shaft_in_balance(pairs: int) -> None:
    """The cam gear is turned with the cam's torque over its efficiency; the idler's two gears hold each other."""
    robot = built("best-bo") if pairs == 1 else geared()
    case, layout, kept = LoadCase(robot), robot.layout, robot.workshop.safety.gear_efficiency
    train, beam = layout.drive.train, case.beams["cam_axle"]
    ratio = np.prod([pair.ratio for pair in train.stages])
    torque = 1000.0 * train.motor_torque_nm * ratio * kept**pairs
    radius = train.stages[-1].wheel.pitch_radius_mm
    least = torque / train.stages[-1].wheel.tip_radius_mm
    on_gear = beam.forces_n[1]
    assert least < np.linalg.norm(on_gear) < 1.2 * torque / radius  # 1/cos 20° and the shifts
    assert beam.forces_n[0] == pytest.approx(-case.wound_forces_n[1])
    assert list(beam.places_mm) == pytest.approx([np.mean(layout.lateral.cam), np.mean(layout.lateral.gears[0])])
    assert ("idler_axle" in case.beams) == (pairs == 2)
    if layout.idler_mm is None:
        return
    idler = case.beams["idler_axle"]
    assert idler.forces_n[0] == pytest.approx(-on_gear)
    assert list(idler.places_mm) == pytest.approx([np.mean(one) for one in layout.lateral.gears])
    pitch = train.stages[-1].pinion.teeth / (train.stages[-1].pinion.teeth + train.stages[-1].wheel.teeth)
    inner = layout.idler_mm + pitch * (layout.cam_axis_mm - layout.idler_mm)
    pitch = train.stages[0].wheel.teeth / (train.stages[0].pinion.teeth + train.stages[0].wheel.teeth)
    outer = layout.idler_mm + pitch * (layout.motor_mm - layout.idler_mm)
    held = _about_y(inner - layout.idler_mm, idler.forces_n[0])
    driven = _about_y(outer - layout.idler_mm, idler.forces_n[1])
    assert driven * kept == pytest.approx(-held)  # what friction takes comes from the motor
    names = {finding.name for finding in strength_findings(robot)}
    assert {"front_axle_strength", "idler_axle_strength"} <= names


def _about_y(arm: Array, force: Array) -> float:
    """Moment about +y of a force at an arm, both x-z."""
    return float(arm[1] * force[0] - arm[0] * force[1])


def test_the_front_link_bears_on_its_axle_at_thirds_of_its_half_width() -> None:
    """Pressures that grow evenly from the middle: M = F/2·(S - w/3) between plates at ± S, of 80 N."""
    layout, none = built("best-bo").layout, np.zeros(2)
    beam = axle_beams(layout, (none, none), none, np.array([0.0, 80.0]))["front_axle"]
    left, right = (abs(float(np.mean(plate))) for plate in (layout.lateral.left_plate, layout.lateral.right_plate))
    by_hand = 80.0 * left * right / (left + right) - 40.0 * layout.sections.thickness_mm / 3.0
    assert beam.moments_nmm(np.zeros(1)) == pytest.approx([by_hand])
