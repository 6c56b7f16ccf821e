"""Forces of the push-off against mechanics that can be written down, and against momentum."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.masses import in_plane

from jumpcad.design import Design, load_design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.mechanism.flight import Blow
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.settings import Settings
from jumpcad.simulation.planar import PlanarWorld
from jumpcad.strength.loads import (
    BLOW_FACTOR,
    PEAK_SHARE,
    POSITIONS,
    push_off,
    rail_moment_nmm,
    rail_twist_nmm,
    reflected_share,
    stop_blow,
    toe_load_n,
    toe_moment_nmm,
)

BODY = in_plane(0.1, (4.0, 17.0), 42.0)
TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo")


@pytest.mark.parametrize("c_coef", [0.8, 0.9, 1.0, 1.1, 1.2])
def test_forces_and_torques_on_the_body_balance(c_coef: float) -> None:
    # two forces are solved from three equations of motion; what is left over shows any wrong arm or sign
    design = load_design("best-ga").model_copy(update={"c_coef": c_coef, "compression_ratio": 0.3})
    forces = push_off(Linkage(design), BODY)
    assert forces.residual_n.max() < 0.001 * np.linalg.norm(forces.ground_n, axis=1).max()
    stands = forces.residual_n[forces.ground_n[:, 1] > 0.0]
    assert len(np.unique(stands)) == len(stands) > 5  # each position has its own


def test_parallel_legs_swing_the_body_like_a_pendulum() -> None:
    # equal parallel links: the body does not turn, each of its points goes round a circle of radius l2
    design = load_design("kenan-2.0")
    assert design.c_coef == 1.0
    forces = push_off(Linkage(design), BODY)
    loaded = math.radians(design.rest_angle_deg) - design.compression_rad
    angle = loaded + (forces.leg_rad - forces.leg_rad[0])  # of the legs above the ground
    outward = np.stack([-np.cos(angle), np.sin(angle)], axis=-1)
    onward = np.stack([np.sin(angle), np.cos(angle)], axis=-1)
    weight = BODY.mass_kg * GRAVITY_M_S2
    torque = -1000.0 * design.stiffness_nm_per_rad * forces.leg_rad
    rise_mm = design.l2_mm * (np.sin(angle) - math.sin(loaded))
    spring_nmm = 500.0 * design.stiffness_nm_per_rad * (design.compression_rad**2 - forces.leg_rad**2)
    centripetal = 2.0 * (spring_nmm - weight * rise_mm) / design.l2_mm
    stands = np.linalg.norm(forces.ground_n, axis=1) > 0
    along = np.einsum("ij,ij->i", forces.ground_n, onward)
    inward = -np.einsum("ij,ij->i", forces.ground_n, outward)
    assert np.count_nonzero(stands) > 5
    assert along[stands] == pytest.approx((torque / design.l2_mm)[stands], abs=0.02)
    assert inward[stands] == pytest.approx((centripetal - weight * np.sin(angle))[stands], abs=0.02)


@pytest.mark.parametrize("name", ["best-ga", "best-bo"])
@pytest.mark.parametrize("gyration_mm", [25.0, 42.0, 90.0])
def test_the_ground_pushes_as_in_an_engine_whose_links_weigh_nothing(name: str, gyration_mm: float) -> None:
    """At release, from a standstill; the legs are not parallel, so that the body turns."""
    mass = in_plane(0.1, (4.0, 17.0), gyration_mm)
    plain = capsule_robot(load_design(name))
    light = {key: replace(body, mass_kg=1e-9, inertia_kg_m2=1e-15 * np.eye(3)) for key, body in plain.bodies.items()}
    com, inertia = np.array([0.004, 0.0, 0.017]), 0.1 * (gyration_mm / 1000.0) ** 2 * np.eye(3)
    body = replace(light["body"], mass_kg=0.1, com_m=com, inertia_kg_m2=inertia)
    settings = Settings(dt_s=1e-5, joint_damping_nms_per_rad=0.0, foot_friction=50.0)
    world = PlanarWorld(replace(plain, bodies=light | {"body": body}), settings)
    world.advance(20)
    contact = world.moment.contact
    along, up = push_off(plain.linkage, mass).ground_n[0]
    assert (contact.first_ns + contact.second_ns) / 1e-5 == pytest.approx(up, rel=0.02)
    assert contact.along_ns / 1e-5 == pytest.approx(along, rel=0.02)


def test_leg_carries_the_springs_torque_to_the_ankle() -> None:
    design = load_design("best-bo")
    forces = push_off(Linkage(design), BODY)
    shear = 1000.0 * design.peak_spring_torque_nm / design.l2_mm
    squared = np.sum(forces.ankle_n[0] ** 2) - forces.leg_axial_n[0] ** 2
    assert math.sqrt(squared) == pytest.approx(shear)


@pytest.mark.parametrize("name", TEMPLATES)
def test_forces_grow_with_mass_and_springs_together(name: str) -> None:
    """With springs and body both a thousandth, the same motion, by a thousandth of the forces."""
    linkage = Linkage(load_design(name))
    springs = springs_on_leg(linkage.design)
    weak = replace(springs, stiffness_nm_per_rad=springs.stiffness_nm_per_rad / 1000.0)
    whole, small = push_off(linkage, BODY, springs), push_off(linkage, BODY.scaled_to(1e-4), weak)
    for one in ("ground_n", "ankle_n", "front_eye_n", "leg_axial_n", "front_n"):
        forces = getattr(whole, one)
        assert np.abs(forces).max() > 0.0
        np.testing.assert_allclose(1000.0 * getattr(small, one), forces, rtol=1e-9, atol=1e-9)


def test_heavier_robots_leave_the_ground_later() -> None:
    design = load_design("kenan-2.0")
    light, heavy = (push_off(Linkage(design), in_plane(mass, (4.0, 17.0), 42.0)) for mass in (0.05, 0.2))
    assert np.count_nonzero(light.ground_n[:, 1]) < np.count_nonzero(heavy.ground_n[:, 1])


def test_feet_never_bear_more_than_the_ground_gives() -> None:
    for name in TEMPLATES:
        design = load_design(name)
        forces = push_off(Linkage(design), BODY)
        toes_n = toe_load_n(forces, design, 5.2)
        assert np.all(toes_n <= forces.ground_n[:, 1] + 1e-9)
        assert np.all(toes_n >= 0)


@pytest.mark.parametrize(
    ("name", "positions", "within"),
    [
        ("best-ga", POSITIONS, 1e-2),
        ("best-bo", POSITIONS, 1e-2),
        ("best-ga", 129, 1e-3),
        ("best-bo", 129, 1e-3),
        ("best-printable", 129, 1e-3),
    ],
)
def test_the_foot_balances_on_nose_and_toes(
    monkeypatch: pytest.MonkeyPatch, name: str, positions: int, within: float
) -> None:
    """A foot without mass: the ground's force, at its two ends, against leg and front link; moments about the ankle.

    Speeds are differences between positions: with half the step the error is a third to a quarter.

    The front link's part is what the leg does not carry; the ground's friction has the foot's depth as its arm. In
    other templates the nose bears nothing.
    """
    monkeypatch.setattr("jumpcad.strength.loads.POSITIONS", positions)
    design, depth_mm = load_design(name), 10.0
    forces = push_off(Linkage(design), BODY)
    toes_n = toe_load_n(forces, design, depth_mm)
    back_mm = design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg))
    (along, up), eye_up = forces.ground_n.T, (forces.ground_n - forces.ankle_n)[:, 1]
    nose = up - toes_n
    on_both = (toes_n > 1e-6) & (nose > 1e-6)
    moment = nose * design.l4_mm - toes_n * back_mm + along * depth_mm - eye_up * design.l4_mm
    assert on_both.any()
    assert moment[on_both] == pytest.approx(0.0, abs=within * np.abs(up * design.l4_mm).max())


def test_a_rod_struck_at_its_end_meets_the_blow_with_a_quarter_of_its_mass() -> None:
    # textbook: k² = l²/12, so 1/(1 + (l/2)²/k²) = 1/4
    assert reflected_share((50.0, 0.0), (1.0, 100.0 / math.sqrt(12.0))) == pytest.approx(0.25)
    assert reflected_share((0.0, 0.0), (30.0, 40.0)) == 1.0


def test_toes_and_rails_balance_about_the_ankle() -> None:
    # both rails together bear the moment of the tips' forces about the ankle axle
    design = Design(**{**load_design("kenan-2.0").model_dump(), "ground_link_angle_deg": 60.0})
    assert 2.0 * rail_moment_nmm(design, 10.0) == pytest.approx(10.0 * design.l5_mm * 0.5)
    assert toe_moment_nmm(design, 10.0) == pytest.approx(5.0 * design.l5_mm)
    aside_mm = design.l5_mm * math.sqrt(0.75)  # of a tip; a rail 5.5 mm beside the middle is twisted by what is beyond
    assert rail_twist_nmm(design, 10.0, 5.5) == pytest.approx(5.0 * (aside_mm - 5.5))
    assert rail_twist_nmm(design, 10.0, aside_mm + 1.0) == 0.0


def test_nothing_bears_after_the_robot_has_left_the_ground() -> None:
    """A light robot on a strong design leaves early, and stays off: every force is then zero."""
    design = load_design("best-bo")
    forces = push_off(Linkage(design), in_plane(0.02, (4.0, 17.0), 42.0))
    up = forces.ground_n[:, 1]
    off = int(np.argmax(up <= 0.0))
    assert 0 < off < len(up) - 1
    toes_n = toe_load_n(forces, design, 5.2)
    parts = (forces.ankle_n, forces.front_eye_n, forces.leg_axial_n, forces.front_n)
    for one in (forces.ground_n, *parts, toes_n, forces.residual_n):
        assert (one[off:] == 0.0).all()
        assert np.isfinite(one).all()
    assert (np.abs(forces.front_n[:off]) > 0.0).any()


BLOW = Blow(takeoff_rad=0.1, stop_rad_s=40.0, inertia_kg_m2=2e-5)
ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM = 0.15, 12.0, 90.0


def test_a_pads_give_holds_the_energy_of_the_blow() -> None:
    """Half of stiffness times deflection squared, in the turn of the leg and in millimetres of the pad."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    assert found.energy_j == pytest.approx(2e-5 * 40.0**2 / 2.0)
    assert 0.5 * found.stop.stiffness_nm_per_rad * found.give_rad**2 == pytest.approx(found.energy_j)
    assert 0.5 * PAD_N_PER_MM * found.give_mm**2 == pytest.approx(1000.0 * found.energy_j)  # N·mm are mJ


def test_what_is_an_arc_for_the_pad_is_an_angle_for_the_leg() -> None:
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    assert found.give_mm == pytest.approx(RADIUS_MM * found.give_rad)
    assert found.torque_nm == pytest.approx(found.force_n * RADIUS_MM / 1000.0)


def test_the_peak_force_is_that_of_a_mass_on_a_spring_less_what_does_not_come_back() -> None:
    """v·√(k·m) of a mass m = I/r² at v = ω·r, times 0.82: here 0.48 m/s, 139 g, 90 N/mm, so 53.7 and 44.0 N."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    mass, speed = 2e-5 / 0.012**2, 40.0 * 0.012
    assert found.force_n == pytest.approx(0.82 * speed * math.sqrt(90_000.0 * mass))
    assert found.force_n == pytest.approx(44.0, abs=0.05)
    assert found.force_n == pytest.approx(0.82 * PAD_N_PER_MM * found.give_mm)


def test_the_stop_acts_on_the_leg_from_its_angle_on() -> None:
    """With the pad's stiffness about the joint: a turn moves it by r, and its force has the lever r."""
    stop = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM).stop
    assert (stop.joint, stop.angle_rad) == ("leg", 0.15)
    turn = 1e-3
    force_n = PAD_N_PER_MM * RADIUS_MM * turn
    assert stop.stiffness_nm_per_rad * turn == pytest.approx(force_n * RADIUS_MM / 1000.0)


@pytest.mark.parametrize(
    ("times", "force", "give"),
    [
        ({"speed": 2.0}, 2.0, 2.0),
        ({"inertia": 4.0}, 2.0, 2.0),
        ({"pad": 4.0}, 2.0, 0.5),
        ({"radius": 2.0}, 1.0, 1.0),  # half of the mass's share at twice the speed: the same in N and mm
    ],
)
def test_force_and_give_grow_as_those_of_a_mass_on_a_spring(times: dict[str, float], force: float, give: float) -> None:
    usual = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    blow = Blow(0.1, 40.0 * times.get("speed", 1.0), 2e-5 * times.get("inertia", 1.0))
    other = stop_blow(blow, ANGLE_RAD, RADIUS_MM * times.get("radius", 1.0), PAD_N_PER_MM * times.get("pad", 1.0))
    assert (other.force_n / usual.force_n, other.give_mm / usual.give_mm) == pytest.approx((force, give))


def test_a_lossless_pad_stepped_through_gives_as_far_and_presses_as_hard() -> None:
    """I·q'' = -k·q from the blow's speed on, in steps of 0.1 µs, until it stands still."""
    found = stop_blow(BLOW, ANGLE_RAD, RADIUS_MM, PAD_N_PER_MM)
    step, turn, rate, hardest = 1e-7, 0.0, BLOW.stop_rad_s, 0.0
    while rate > 0.0:
        torque = found.stop.stiffness_nm_per_rad * turn
        rate -= torque / BLOW.inertia_kg_m2 * step
        turn += rate * step
        hardest = max(hardest, torque)
    assert turn == pytest.approx(found.give_rad, rel=1e-3)
    assert hardest * PEAK_SHARE == pytest.approx(found.torque_nm, rel=1e-3)


def test_the_share_of_the_peak_is_no_less_than_the_least_that_a_dashpot_leaves() -> None:
    """Spring and dashpot in parallel: the least peak of all dampings is 0.81 of the undamped one's.

    Damping ratio 0.26; with less the spring is pressed further, with more the dashpot resists at once.
    """
    peaks = []
    for ratio in np.linspace(0.05, 0.6, 56):
        damped = math.sqrt(1.0 - ratio**2)
        t = np.linspace(0.0, 3.0, 6001)
        decay = np.exp(-ratio * t)
        x = decay * np.sin(damped * t) / damped
        v = decay * (np.cos(damped * t) - ratio * np.sin(damped * t) / damped)
        peaks.append(float((x + 2.0 * ratio * v).max()))
    assert min(peaks) == pytest.approx(0.81, abs=0.005)
    assert min(peaks) <= PEAK_SHARE <= 1.0


def test_twice_the_force_is_borne() -> None:
    assert BLOW_FACTOR == 2.0
