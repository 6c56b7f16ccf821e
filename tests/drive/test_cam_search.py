"""The search for the smallest cam: monotone in its limits, repeatable, and with a reason where there is none."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_search import _Shapes, synthesise_cam
from jumpcad.errors import CannotBuildError

LIMITS = default_limits().cam


def synthesised(compression_deg, stiffness, limits=LIMITS):
    law = CamLaw(math.radians(compression_deg), stiffness, limits.lift_rad, limits.ramp_rad)
    return synthesise_cam(law, limits)


def test_a_wider_clearance_never_makes_a_smaller_cam():
    sizes = [synthesised(50, 0.6, replace(LIMITS, clearance_mm=gap)).outer_radius_mm for gap in (0.2, 0.5, 0.8)]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[-1]


def test_what_no_cam_can_do_is_refused_with_what_to_change():
    with pytest.raises(CannotBuildError, match=r"no cam winds the leg by 75\.0° .*short.*compression_ratio"):
        synthesised(75, 1.7)


def test_a_roller_that_is_too_large_is_refused_with_what_misses():
    """One of 60 mm leaves no room for the fall, one of 100 mm none for a lever; the diameter that is named fits one."""
    with pytest.raises(CannotBuildError, match=r"misses: .* mm short.*a smaller bought\.roller"):
        synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=30.0))
    with pytest.raises(CannotBuildError, match=r"no lever from .* to 45 mm") as refused:
        synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=50.0))
    named = float(str(refused.value).partition("less than ")[2].partition(" mm")[0])
    with pytest.raises(CannotBuildError, match="no cam winds"):
        synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=named / 2.0 - 0.1))


def test_the_same_inputs_give_the_same_cam():
    first, second = synthesised(45, 1.0), synthesised(45, 1.0)
    assert first.profile_mm.tobytes() == second.profile_mm.tobytes()


def test_rounding_the_smallest_cam_refuses_none():
    """Springs between two strengths that both have a cam, each cam as small as its contact pressure allows."""
    limits = replace(LIMITS, hub_radius_mm=8.4, gap_min_mm=11.0, cam_width_mm=3.4)
    for torque in np.linspace(1.45, 1.75, 160):
        cam = synthesised(52.0, torque / math.radians(52.0), limits)
        assert cam.contact_pressure_mpa <= limits.pressure_mpa + 1e-6


def test_a_found_cam_fits_its_limits_and_a_much_smaller_one_does_not():
    law = CamLaw(math.radians(50), 0.6, LIMITS.lift_rad, LIMITS.ramp_rad)
    cam = synthesise_cam(law, LIMITS)
    gap = cam.geometry.axis_distance_mm - cam.lever_length_mm
    shape = np.array([cam.lever_length_mm, gap, cam.geometry.lead_rad])
    shapes = _Shapes(law, LIMITS)
    shapes.reserve = 0.0 * shapes.reserve
    assert shapes._fits(np.log(1.05 * shape))
    assert not shapes._fits(np.log(0.8 * shape))
