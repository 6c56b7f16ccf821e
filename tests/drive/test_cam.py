"""The cam against mechanics: virtual work, the roller rolled around the finished polygon, and its drop."""

import math

import numpy as np
import pytest
from support.built import built
from support.limits import default_limits

from jumpcad.drive.cam import CamGeometry
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_search import synthesise_cam

LIMITS = default_limits().cam


def law(compression_deg, stiffness):
    return CamLaw(math.radians(compression_deg), stiffness, LIMITS.lift_rad, LIMITS.ramp_rad)


def synthesised(compression_deg, stiffness, limits=LIMITS):
    return synthesise_cam(law(compression_deg, stiffness), limits)


def distance_to_polygon(points, polygon):
    """Distances (n,) of points to a closed polygon; negative inside."""
    start, edge = polygon, np.roll(polygon, -1, axis=0) - polygon
    offset = points[:, None] - start
    along = np.clip((offset * edge).sum(-1) / (edge**2).sum(-1), 0, 1)
    distance = np.hypot(*np.moveaxis(offset - along[..., None] * edge, -1, 0)).min(axis=1)
    angles = np.arctan2(-offset[..., 1], -offset[..., 0])
    turns = np.diff(np.concatenate([angles, angles[:, :1]], axis=1), axis=1)
    winding = np.round(((turns + math.pi) % (2 * math.pi) - math.pi).sum(axis=1) / (2 * math.pi))
    return np.where(winding != 0, -distance, distance)


def cam_cases():
    cases = [(2, 0.5), (12, 1.7), (40.7, 0.527), (52.9, 1.69), (58, 1.0), (60, 0.6)]
    return [pytest.param(*case, id=f"{case[0]}deg") for case in cases]


def test_the_layout_of_the_design_note_has_its_pitch_radii():
    a_law = law(53, 1.0)
    axis = np.array([-14.0, 30.0])
    direction = math.atan2(axis[1], axis[0])
    geometry = CamGeometry(
        a_law, 24.0, float(np.hypot(*axis)), direction, math.radians(120) - direction, 3.5, 0.4, 0.05
    )
    radii = np.hypot(*geometry.pitch_mm(np.linspace(0, a_law.lift_rad, 100)).T)
    assert radii.min() == pytest.approx(9.4, abs=0.1)
    assert radii.max() == pytest.approx(28.8, abs=0.1)


@pytest.mark.parametrize(("compression_deg", "stiffness"), cam_cases())
def test_the_largest_torque_at_the_cam_is_the_springs_times_how_fast_the_leg_turns(compression_deg, stiffness):
    """Virtual work with a leg angle that is differentiated numerically: k·theta·dtheta/dphi, after the ramp."""
    cam = synthesised(compression_deg, stiffness)
    phi = np.linspace(0.0, LIMITS.lift_rad, 4001)
    wind = cam.wind_rad(phi)
    assert cam.law.peak_torque_nm == pytest.approx((stiffness * wind * np.gradient(wind, phi))[600:-1].max(), rel=2e-3)


@pytest.mark.parametrize(("compression_deg", "stiffness"), cam_cases())
def test_contact_force_and_spring_do_the_same_work(compression_deg, stiffness):
    """The force that holds the spring, along the numerical normal of the profile, turns the cam by dE/dphi."""
    cam = synthesised(compression_deg, stiffness)
    phi = np.linspace(1e-4, LIMITS.lift_rad - 1e-4, 300)
    phi = phi[np.abs(phi - LIMITS.ramp_rad) > 1e-3]
    step = 1e-5
    tangent = cam.geometry.contact_mm(phi + step) - cam.geometry.contact_mm(phi - step)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    outward = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    cos, sin = np.cos(phi), np.sin(phi)
    normal = np.stack([cos * outward[:, 0] + sin * outward[:, 1], cos * outward[:, 1] - sin * outward[:, 0]], axis=1)
    contact = cam.geometry.in_body(cam.geometry.contact_mm(phi), phi)
    per_newton_on_leg = (contact[:, 0] * normal[:, 1] - contact[:, 1] * normal[:, 0]) / 1000
    force = stiffness * cam.wind_rad(phi) / per_newton_on_leg
    arm = contact - cam.geometry.axis_mm
    # The cam turns clockwise; the reaction of the leg on it is counter-clockwise.
    torque = force * (arm[:, 0] * -normal[:, 1] - arm[:, 1] * -normal[:, 0]) / 1000
    assert (force > 0).all()
    assert force.max() == pytest.approx(cam.peak_contact_n, rel=0.01)
    energy = 0.5 * stiffness * cam.wind_rad(np.stack([phi - step, phi + step])) ** 2
    assert torque == pytest.approx((energy[1] - energy[0]) / (2 * step), rel=1e-6)
    angle = np.arccos(np.clip(per_newton_on_leg * 1000 / cam.geometry.lever_mm, -1, 1))
    assert angle.max() <= math.radians(45) + 1e-9
    assert angle.max() == pytest.approx(cam.max_pressure_angle_rad, abs=0.02)


@pytest.mark.parametrize(("compression_deg", "stiffness"), cam_cases())
def test_the_roller_rolls_on_the_polygon_through_lift_and_release(compression_deg, stiffness):
    cam = synthesised(compression_deg, stiffness)
    phi = np.linspace(0, 2 * math.pi, 720, endpoint=False)
    wind = cam.wind_rad(phi)
    gap = distance_to_polygon(cam.geometry.in_cam(cam.geometry.roller_mm(wind), phi), cam.profile_mm)
    gap -= cam.geometry.roller_radius_mm
    assert gap.min() > -0.02
    touching = phi <= LIMITS.lift_rad
    assert np.abs(gap[touching]).max() < 0.02
    over_tip = (phi > LIMITS.lift_rad) & (wind > 0)
    assert np.abs(gap[over_tip]).max() < 0.02
    assert wind[touching][-1] == pytest.approx(math.radians(compression_deg), rel=0.01)
    assert (wind[phi > cam.geometry.free_rad] == 0).all()


@pytest.mark.parametrize(("compression_deg", "stiffness"), cam_cases())
def test_the_falling_leg_clears_the_cam_at_every_cam_angle_of_the_drop(compression_deg, stiffness):
    cam = synthesised(compression_deg, stiffness)
    wind = np.linspace(0, math.radians(compression_deg), 60)
    for phi in np.linspace(cam.geometry.free_rad, 2 * math.pi, 12):
        roller = cam.geometry.in_cam(cam.geometry.roller_mm(wind), np.full(wind.shape, phi))
        assert distance_to_polygon(roller, cam.profile_mm).min() > cam.geometry.roller_radius_mm - 1e-3
    past = np.linspace(-LIMITS.overshoot_rad, math.radians(compression_deg), 80)
    gaps = []
    for phi in np.linspace(cam.geometry.free_rad, cam.geometry.free_rad + LIMITS.reserve_rad, 5):
        roller = cam.geometry.in_cam(cam.geometry.roller_mm(past), np.full(past.shape, phi))
        gaps.append(distance_to_polygon(roller, cam.profile_mm).min() - cam.geometry.roller_radius_mm)
    assert min(gaps) > LIMITS.clearance_mm - 0.02
    assert gaps[0] == pytest.approx(LIMITS.clearance_mm, abs=0.02)


@pytest.mark.parametrize(("compression_deg", "stiffness"), cam_cases())
def test_the_cam_keeps_clear_of_hub_axle_and_ground_line(compression_deg, stiffness):
    cam = synthesised(compression_deg, stiffness)
    hub = np.zeros((1, 2))
    for phi in np.linspace(0, 2 * math.pi, 145):
        polygon = cam.geometry.in_body(cam.profile_mm, np.full(len(cam.profile_mm), phi))
        assert distance_to_polygon(hub, polygon)[0] >= LIMITS.hub_radius_mm + LIMITS.clearance_mm - 1e-6
        assert polygon[:, 1].min() >= LIMITS.lowest_mm - 1e-6
    assert np.hypot(*cam.geometry.axis_mm) - cam.geometry.lever_mm >= LIMITS.gap_min_mm - 1e-6
    radii = np.hypot(*cam.profile_mm.T)
    assert radii.min() >= LIMITS.core_radius_mm - 1e-6
    assert radii.max() == pytest.approx(cam.outer_radius_mm)
    assert all(finding.margin > -1e-6 for finding in cam.findings)


def test_every_turn_of_the_cam_winds_like_the_first():
    cam = synthesised(50.0, 3.0)
    phi = np.linspace(0.05, 2.0 * math.pi - 0.05, 60)
    for turns in (-1, 1, 2, 3):
        np.testing.assert_allclose(cam.wind_rad(phi + 2.0 * math.pi * turns), cam.wind_rad(phi), atol=1e-9)
    assert np.ptp(cam.wind_rad(phi)) > 0.8


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_relief_ends_where_the_lift_begins(name):
    """An arc about the cam's axis, from the hollow on to the direction of the lift's first point: a radial step."""
    geometry = built(name).layout.drive.cam.geometry
    outline = geometry.outline_mm()
    last, first = outline[-1], outline[0]
    assert math.remainder(math.atan2(*last[::-1]) - math.atan2(*first[::-1]), 2.0 * math.pi) == pytest.approx(
        0, abs=1e-9
    )
    relief = np.hypot(*outline[-15:].T)
    assert np.ptp(relief) == pytest.approx(0.0, abs=1e-9)
    turns = np.diff(np.unwrap(np.arctan2(*outline[-16:].T[::-1])))
    assert turns == pytest.approx(turns[0], abs=1e-9)  # even steps from the hollow on
    assert np.hypot(*first) >= relief[0] - 1e-9
    assert first == pytest.approx(geometry.contact_mm(0.0))
