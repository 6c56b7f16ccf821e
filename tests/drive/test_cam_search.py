"""The search for the smallest cam: monotone in its limits, repeatable, and with a reason where there is none."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.drive.cam_findings import LIMITS as CAM_LIMITS
from jumpcad.drive.cam_findings import ROWS
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import measure
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
    torque = f"{math.radians(75.0) * 1.7:.2f} N·m"
    with pytest.raises(
        CannotBuildError, match=rf"winds the leg by 75\.0° against {torque}.*short.*compression_ratio"
    ) as no:
        synthesised(75, 1.7)
    assert (no.value.limit, no.value.unit) == ("cam", "")


@pytest.mark.parametrize(("limit", "met"), [("pressure_angle_rad", 0.16), ("pressure_mpa", 20.0)])
def test_a_limit_that_is_just_too_hard_is_missed_by_little(limit, met):
    """3 % beyond what a cam can do, the nearest one misses by a tenth of the limit at most."""

    def margin(tighter):
        try:
            synthesised(40, 0.6, replace(LIMITS, **{limit: tighter * met}))
        except CannotBuildError as refused:
            return refused.margin
        return 0.0

    margins = [margin(tighter) for tighter in (1.0, 0.97, 0.94, 0.91)]
    assert margins[0] == 0.0
    assert next(one for one in margins if one < 0.0) > -0.1


def test_a_roller_that_is_too_large_is_refused_with_what_misses():
    """One of 60 mm leaves no room for the fall, one of 100 mm none for a lever; the diameter that is named fits one."""
    with pytest.raises(CannotBuildError, match=r"misses: .* mm short.*a smaller bought\.roller"):
        synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=30.0))
    least = LIMITS.hub_radius_mm + 50.0 + LIMITS.clearance_mm  # the roller stays clear of the hub
    with pytest.raises(CannotBuildError, match=rf"no lever from {least:.1f} mm .* to 45 mm") as refused:
        synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=50.0))
    named = float(str(refused.value).partition("less than ")[2].partition(" mm")[0])
    for more, words in ((-0.1, "no cam winds"), (0.1, "no lever from")):
        with pytest.raises(CannotBuildError, match=words):
            synthesised(40, 0.6, replace(LIMITS, roller_radius_mm=named / 2.0 + more))


def test_the_same_inputs_give_the_same_cam():
    first, second = synthesised(45, 1.0), synthesised(45, 1.0)
    assert first.profile_mm.tobytes() == second.profile_mm.tobytes()


def test_rounding_the_smallest_cam_refuses_none():
    """Springs between two strengths that both have a cam, each cam as small as its contact pressure allows."""
    limits = replace(LIMITS, hub_radius_mm=8.4, gap_min_mm=11.0, cam_width_mm=3.4)
    for torque in np.linspace(1.45, 1.75, 160):
        cam = synthesised(52.0, torque / math.radians(52.0), limits)
        assert cam.contact_pressure_mpa <= limits.pressure_mpa + 1e-6


def test_no_neighbour_on_the_grid_is_a_cam_smaller_by_a_step_that_fits():
    """Steps of 10 µm and 0.01°: of the eight around the optimum the smallest that meets every limit is taken."""
    for compression_deg, stiffness in ((50, 0.6), (45, 1.0), (35, 0.8)):
        cam = synthesised(compression_deg, stiffness)
        steps = np.array([0.01, 0.01, math.radians(0.01)])
        shape = np.array(
            [cam.geometry.lever_mm, cam.geometry.axis_distance_mm - cam.geometry.lever_mm, cam.geometry.lead_rad]
        )
        assert shape / steps == pytest.approx(np.round(shape / steps), abs=1e-6)
        smaller = shape - steps * np.array(list(itertools.product((0.0, 1.0), repeat=3)))[1:]
        law = CamLaw(math.radians(compression_deg), stiffness, LIMITS.lift_rad, LIMITS.ramp_rad)
        outer, margins, _ = measure(law, LIMITS, smaller, 181)
        least = LIMITS.hub_radius_mm + LIMITS.roller_radius_mm + LIMITS.clearance_mm
        within = (smaller[:, 0] >= least) & (smaller[:, 1] >= LIMITS.gap_min_mm) & (margins > 0.0).all(axis=0)
        assert (outer[within] > cam.outer_radius_mm - 0.01).all()


def test_the_findings_of_a_cam_are_those_of_its_own_shape():
    """Not of one beside it on the grid: pressure angle, pressure and load again from its outline's shape."""
    for compression_deg, stiffness in ((50, 0.6), (45, 1.0), (35, 0.8), (55, 0.5)):
        cam = synthesised(compression_deg, stiffness)
        shape = [cam.geometry.lever_mm, cam.geometry.axis_distance_mm - cam.geometry.lever_mm, cam.geometry.lead_rad]
        law = CamLaw(math.radians(compression_deg), stiffness, LIMITS.lift_rad, LIMITS.ramp_rad)
        outer, margins, numbers = measure(law, LIMITS, np.array([shape]), 181)
        least = {checked.name: math.inf for checked in CAM_LIMITS}
        for row, margin in zip(ROWS, margins[:, 0], strict=True):
            name = CAM_LIMITS[row].name
            least[name] = min(least[name], margin)
        assert {finding.name: finding.margin for finding in cam.findings} == pytest.approx(least, abs=1e-9)
        assert cam.peak_contact_n == pytest.approx(numbers["force"][0])
        assert cam.contact_pressure_mpa == pytest.approx(numbers["pressure"][0])
        assert cam.max_pressure_angle_rad == pytest.approx(numbers["pressure_angle"][0])
        assert cam.min_convex_radius_mm == pytest.approx(numbers["convex_radius"][0])
        assert cam.outer_radius_mm == pytest.approx(outer[0], abs=0.01)
        assert cam.core_radius_mm == pytest.approx(np.hypot(*cam.profile_mm.T).min())


@pytest.mark.parametrize(
    ("compression_deg", "stiffness", "limits"),
    [
        (
            59.843012168981346, 0.8846896964689468,
            {"hub_radius_mm": 8.564176433625342, "gap_min_mm": 12.027203707062682, "cam_width_mm": 3.3530636639564904,
             "core_radius_mm": 8.82070042593328},
        ),
        (
            58.47583379121368, 0.6624894673184426,
            {"hub_radius_mm": 9.318527599039232, "gap_min_mm": 11.554559279210036, "cam_width_mm": 3.908010329909231,
             "core_radius_mm": 6.628585200405457},
        ),
    ],
)  # fmt: skip
def test_a_search_that_ends_outside_the_limits_starts_again_from_where_it_misses_least(
    compression_deg, stiffness, limits
):
    """Found at random, one of 300 tried: from none of the best points of the grid does the first search fit."""
    cam = synthesised(compression_deg, stiffness, replace(LIMITS, **limits))
    assert min(finding.margin for finding in cam.findings) > 0.0


def test_a_search_that_hopes_for_too_much_finds_a_cam_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """What coarse samples hide is found out at the finished shape, and kept in reserve from there on."""
    usual = synthesised(50, 0.6)
    monkeypatch.setattr(_Shapes, "RESERVE", -0.02)
    cam = synthesise_cam.__wrapped__(usual.law, LIMITS)
    assert cam.outer_radius_mm == pytest.approx(usual.outer_radius_mm, rel=0.02)
    assert min(finding.margin for finding in cam.findings) > -1e-6
