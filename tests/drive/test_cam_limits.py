"""Margins of many shapes at once against the finished cam's own curves."""

import math

import numpy as np
import pytest
from support.limits import default_limits

from jumpcad.drive.cam_findings import LIMITS
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import ROWS, measure
from jumpcad.drive.cam_search import synthesise_cam

CAM_LIMITS = default_limits().cam


@pytest.fixture(scope="module")
def measured() -> tuple:
    """A cam, and margins by name of its shape beside a larger and a smaller one."""
    law = CamLaw(math.radians(45), 1.0, CAM_LIMITS.lift_rad, CAM_LIMITS.ramp_rad)
    cam = synthesise_cam(law, CAM_LIMITS)
    shape = np.array([
        cam.lever_length_mm, cam.geometry.axis_distance_mm - cam.lever_length_mm, cam.geometry.lead_rad
    ])  # fmt: skip
    outer, rows, numbers = measure(law, CAM_LIMITS, shape * [[1.0], [1.2], [0.8]], 400)
    margins = {
        limit.name: np.min([row for row, of in zip(rows, ROWS, strict=True) if of == number], axis=0)
        for number, limit in enumerate(LIMITS)
    }
    return cam, outer, margins, numbers


def test_sizes_are_those_of_the_finished_cam(measured: tuple) -> None:
    cam, outer, margins, numbers = measured
    assert outer[0] == pytest.approx(cam.outer_radius_mm, abs=1e-9)
    assert margins["cam_core"][0] == pytest.approx(cam.core_radius_mm - CAM_LIMITS.core_radius_mm, abs=1e-3)
    hub = cam.geometry.axis_distance_mm - cam.outer_radius_mm - CAM_LIMITS.hub_radius_mm - CAM_LIMITS.clearance_mm
    assert margins["cam_hub"][0] == pytest.approx(hub, abs=1e-9)
    assert numbers["force"][0] == pytest.approx(cam.peak_contact_n, rel=1e-6)


def test_the_drop_ends_before_the_next_lift(measured: tuple) -> None:
    cam, _, margins, _ = measured
    """Run ahead by the dog's play, the roll-over and 3°, and 3° more, the cam may turn on by its reserve."""
    left = 2.0 * math.pi - cam.free_rad - math.radians(6.0) - CAM_LIMITS.reserve_rad
    assert margins["cam_drop"][0] == pytest.approx(left, abs=1e-9)


def test_a_smaller_cam_is_pressed_harder_and_a_larger_one_less(measured: tuple) -> None:
    _, outer, margins, numbers = measured
    assert outer[2] < outer[0] < outer[1]
    assert numbers["force"][2] > numbers["force"][0] > numbers["force"][1]
    assert margins["cam_contact"][2] < margins["cam_contact"][0] < margins["cam_contact"][1]
