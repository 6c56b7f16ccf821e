"""Margins of many shapes at once against the finished cam's own curves."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.drive.cam import CamGeometry
from jumpcad.drive.cam_findings import LIMITS, cam_findings
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import FIRST_ROWS, ROWS, axis_range, measure
from jumpcad.transforms import turned_about_y

CAM_LIMITS = default_limits().cam
NOTHING = {"pressure_angle": [0.0], "pressure": [0.0], "force": [0.0]}


@pytest.mark.parametrize("scale", [1.0, 1.15])
@pytest.mark.parametrize(("preload_deg", "ease_deg"), [(0.0, 0.0), (4.0, 0.0), (0.0, 25.0)])
def test_margins_are_those_of_the_pitch_curve_as_drawn(scale: float, preload_deg: float, ease_deg: float) -> None:
    """Forces, angles and curvature by differences along the roller's path in the cam's frame, 40,000 places.

    The normal's angle to the roller's way is the pressure angle; the contact force has the springs' moment about the
    hub; a roller on a curve of radius r - R is pressed as 1/(1/R + 1/r) of a cylinder on a flat (Hertz); profiles are
    measured where they are convex.
    """
    limits = CAM_LIMITS
    preload_rad, ease_rad = np.radians([preload_deg, ease_deg]).tolist()
    law = CamLaw(math.radians(45), 1.0, limits.lift_rad, limits.ramp_rad, preload_rad, ease_rad)
    lever, gap, lead = 14.0 * scale, 15.0 * scale, 0.4
    outer, rows, numbers = measure(law, limits, np.array([[lever, gap, lead]]), 4000)
    shape = CamGeometry(law, lever, lever + gap, 1.4, lead, limits.roller_radius_mm, limits.clearance_mm,
                        limits.overshoot_rad)  # fmt: skip
    cam = np.linspace(1e-6, law.lift_rad - 1e-6, 40001)
    wind = law.wind_rad(cam)
    pitch = shape.pitch_mm(cam)
    speed = np.gradient(pitch, cam, axis=0)
    bend = np.gradient(speed, cam, axis=0)
    size = np.hypot(*speed.T)
    normal = np.column_stack([-speed[:, 1], speed[:, 0]]) / size[:, None]
    normal *= np.sign((normal * pitch).sum(axis=1))[:, None]  # away from the axis
    way = np.gradient(shape.roller_mm(wind), wind, axis=0)
    way = turned_about_y(way / np.hypot(*way.T)[:, None], -cam)
    cosine = np.abs((normal * way).sum(axis=1))[2:-2]
    curvature = (-(bend * normal).sum(axis=1) / size**2)[2:-2]
    force = 1000.0 * (wind[2:-2] + law.preload_rad) / (lever * cosine)
    radius = 1.0 / np.where(np.abs(curvature) > 1e-9, curvature, 1e-9) - limits.roller_radius_mm
    relative = 1.0 / limits.roller_radius_mm + 1.0 / radius
    modulus = limits.modulus_mpa / (1.0 - limits.poisson**2)
    pressure = np.sqrt(force * relative * modulus / (math.pi * limits.cam_width_mm))
    bends = [law.ramp_rad, law.lift_rad - law.ease_rad]
    away = [i for i, one in enumerate(np.abs(cam[2:-2, None] - bends).min(axis=1)) if one > 2e-3]
    found = {
        limit.name: min(float(row[0]) for row, of in zip(rows, ROWS, strict=True) if of == number)
        for number, limit in enumerate(LIMITS)
    }
    assert outer[0] == pytest.approx(np.hypot(*shape.tip_mm))
    assert found["cam_pressure_angle"] == pytest.approx(limits.pressure_angle_rad - math.acos(cosine.min()), abs=2e-3)
    assert numbers["pressure_angle"][0] == pytest.approx(math.acos(cosine.min()), abs=2e-3)
    assert found["cam_roller_load"] == pytest.approx(limits.roller_load_n - force.max(), abs=0.05)
    convex = 1.0 / curvature[away][curvature[away] > 1e-6].max()
    assert numbers["convex_radius"][0] == pytest.approx(convex, rel=0.02)
    assert found["cam_undercut"] == pytest.approx(
        convex - limits.roller_radius_mm - limits.undercut_margin_mm, abs=0.02 * convex
    )
    assert numbers["pressure"][0] == pytest.approx(pressure[away].max(), rel=0.02)
    assert found["cam_contact"] == pytest.approx(
        limits.pressure_mpa - pressure[away].max(), abs=0.02 * limits.pressure_mpa
    )
    past = shape.roller_mm(-limits.overshoot_rad) - shape.axis_mm
    way_out = past + (limits.roller_radius_mm + limits.clearance_mm) * shape.roller_mm(-limits.overshoot_rad) / lever
    nearest = np.hypot(*past) - limits.roller_radius_mm - limits.clearance_mm, np.hypot(*way_out)
    cores = [float(row[0]) for row, of in zip(rows, ROWS, strict=True) if LIMITS[of].name == "cam_core"]
    assert cores == pytest.approx([distance - limits.core_radius_mm for distance in nearest], abs=1e-6)
    assert found["cam_core"] == min(cores)
    corner = shape.in_body(shape.tip_mm, shape.free_rad)
    behind = math.atan2(corner[1], corner[0]) - (shape.lever_start_rad - limits.overshoot_rad)
    overshoot = [float(row[0]) for row, of in zip(rows, ROWS, strict=True) if LIMITS[of].name == "cam_overshoot"]
    assert overshoot == pytest.approx([behind, lead - limits.overshoot_rad], abs=1e-6)
    assert found["cam_overshoot"] == min(overshoot)
    fallen = 2.0 * math.pi - found["cam_drop"]
    edge = shape.in_body(shape.contact_mm(np.array([0.0])), fallen)[0]
    places = shape.roller_mm(-limits.overshoot_rad * np.array([1.0, 0.5, 0.0]))  # from past rest to rest
    gaps = np.hypot(*(places - edge).T) - limits.roller_radius_mm - limits.clearance_mm
    next_lift = [float(row[0]) for row, of in zip(rows, ROWS, strict=True) if LIMITS[of].name == "cam_next_lift"]
    assert next_lift == pytest.approx(gaps, abs=1e-6)


def test_shapes_measured_together_are_measured_as_each_alone() -> None:
    law = CamLaw(math.radians(45), 1.0, CAM_LIMITS.lift_rad, CAM_LIMITS.ramp_rad)
    shapes = np.array([[14.0, 15.0, 0.3], [16.1, 17.25, 0.2], [12.0, 20.0, 0.5]])
    outer, rows, numbers = measure(law, CAM_LIMITS, shapes, 400)
    for index in range(len(shapes)):
        alone_outer, alone_rows, alone = measure(law, CAM_LIMITS, shapes[index : index + 1], 400)
        assert outer[index] == pytest.approx(alone_outer[0])
        np.testing.assert_allclose(rows[:, index], alone_rows[:, 0], rtol=1e-12)
        assert {name: values[index] for name, values in numbers.items()} == pytest.approx(
            {name: values[0] for name, values in alone.items()}
        )


def test_a_cam_has_room_between_the_limits_of_its_direction() -> None:
    """The axis no lower than the cam's radius, no farther back than lever, limit and body allow."""
    law = CamLaw(math.radians(45), 1.0, CAM_LIMITS.lift_rad, CAM_LIMITS.ramp_rad)
    axis, outer = np.array([30.0]), np.array([15.0])

    def ends(lead_deg: float, **changed: float) -> tuple[float, float]:
        limits = replace(CAM_LIMITS, **changed)
        highest, lowest = axis_range(law, limits, axis, np.radians([lead_deg]), outer)
        return math.degrees(highest[0]), math.degrees(lowest[0])

    assert ends(10.0) == pytest.approx((115.0, 60.0))
    assert ends(30.0) == pytest.approx((180.0 - 45.0 - 30.0, 60.0))
    assert ends(10.0, axis_min_rad=0.1) == pytest.approx((115.0, 30.0))
    assert ends(10.0, axis_min_rad=0.1, lowest_mm=6.0) == pytest.approx((115.0, math.degrees(math.asin(0.7))))
    assert ends(0.0, axis_max_rad=3.0) == pytest.approx((135.0, 60.0))
    assert ends(0.0, axis_max_rad=3.0, lever_loaded_max_rad=9.0) == pytest.approx((150.0, 60.0))


@pytest.mark.parametrize(("roller_mm", "passes"), [(10.0, True), (15.0, False)])
def test_a_roller_that_is_larger_than_the_cam_never_falls_past_its_corner(roller_mm: float, passes: bool) -> None:
    """The face is an arc about the hub, of lever, roller and clearance: no corner of a small cam is so far away.

    The cam's axis is 26 mm from the hub, the arc 35.6 mm with a roller of 30 mm diameter: a corner that is less than
    9.6 mm from the axis never comes to it.
    """
    limits = replace(CAM_LIMITS, roller_radius_mm=roller_mm, clearance_mm=0.6)
    law = CamLaw(math.radians(45), 1.0, limits.lift_rad, limits.ramp_rad)
    outer, rows, _ = measure(law, limits, np.array([[20.0, 6.0, 0.3]]), 181)
    assert (outer[0] > 20.0 + roller_mm + 0.6 - 26.0) == passes
    margin = np.minimum.reduceat(rows[:, 0], FIRST_ROWS)
    (checked,) = (one for one in cam_findings(limits, margin, NOTHING) if one.name == "cam_drop")
    assert ("nowhere passes the corner" in checked.message) != passes
    assert (checked.severity == "error") or passes
