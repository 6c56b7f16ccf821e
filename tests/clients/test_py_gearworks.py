"""Gears against py_gearworks, which draws involutes as exact curves and finds centre distances by itself."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from manifold3d import CrossSection
from support import needs

from jumpcad.drive.gears import Gear, GearPair, gear_pair

PAIRS = [(12, 31, 1.0), (14, 40, 1.25), (17, 18, 1.5)]
BACKLASH_MM = 0.15
CHORDS = 24
"""Points along each of its curves."""


def program() -> Any:
    """Return the other program; it takes 4 s to import, so not where tests are collected."""
    return needs.package("py_gearworks")


def other(gear: Gear) -> Any:
    """Return the other program's gear: its backlash is that of a pair, in modules, along the line of action."""
    module, line = gear.module_mm, math.cos(math.radians(20.0))
    return program().SpurGear(
        number_of_teeth=gear.teeth,
        module=module,
        height=gear.face_width_mm,
        profile_shift=gear.shift,
        dedendum_coefficient=1.25,
        addendum_coefficient=1.0 - gear.tip_cut_mm / module,
        backlash=gear.thinning_mm * line / module,
    )


def outline(gear: Any) -> np.ndarray:
    """Return points (n, 2) along the other program's outline, in order."""
    edges = gear.build_boundary_wire(0.0).order_edges()
    points = [[tuple(edge.position_at(share))[:2] for share in np.arange(CHORDS) / CHORDS] for edge in edges]
    return np.concatenate(points)


def distance_mm(points: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Return the distances (n,) of points (n, 2) from the sides of a closed polygon."""
    edge = np.roll(polygon, -1, axis=0) - polygon
    offset = points[:, None] - polygon
    along = np.clip((offset * edge).sum(-1) / np.maximum((edge**2).sum(-1), 1e-18), 0.0, 1.0)
    return np.hypot(*np.moveaxis(offset - along[..., None] * edge, -1, 0)).min(axis=1)


def pairs() -> list[GearPair]:
    return [gear_pair(pinion, wheel, module, 5.0, BACKLASH_MM) for pinion, wheel, module in PAIRS]


@pytest.mark.parametrize("pair", pairs(), ids=[str(pair) for pair in PAIRS])
def test_circles_and_flanks_are_the_same(pair: GearPair) -> None:
    for gear in (pair.pinion, pair.wheel):
        theirs = other(gear)
        assert theirs.pitch_radius == pytest.approx(gear.pitch_radius_mm)
        assert theirs.r_base == pytest.approx(gear.base_radius_mm)
        assert theirs.addendum_radius == pytest.approx(gear.tip_radius_mm)
        assert theirs.dedendum_radius == pytest.approx(gear.root_radius_mm)
        radius, angle = np.hypot(*gear.profile_mm.T), np.arctan2(*gear.profile_mm.T[::-1])
        flanks = (radius > gear.form_radius_mm + 1e-6) & (radius < gear.tip_radius_mm - 1e-6)
        involute = gear.profile_mm[flanks & (np.abs(angle) < 3.0 * math.pi / gear.teeth)]
        assert len(involute) >= 3 * 16, "three teeth with two flanks each"
        assert distance_mm(involute, outline(theirs)).max() < 2e-3


@pytest.mark.parametrize("pair", pairs(), ids=[str(pair) for pair in PAIRS])
def test_they_stand_at_the_same_distance(pair: GearPair) -> None:
    """Without backlash, which the other program takes by moving gears apart and this one by thinner teeth."""
    pinion, wheel = (other(replace(gear, thinning_mm=0.0)) for gear in (pair.pinion, pair.wheel))
    pinion.mesh_to(wheel, target_dir=program().RIGHT)
    assert float(np.hypot(*pinion.center[:2])) == pytest.approx(pair.centre_distance_mm, abs=1e-6)


@pytest.mark.parametrize("pair", pairs(), ids=[str(pair) for pair in PAIRS])
def test_one_turns_in_the_other(pair: GearPair) -> None:
    """The pinion drawn here, in the middle of the play of the wheel drawn there, touches nothing through a pitch."""
    pinion, wheel = CrossSection([pair.pinion.profile_mm]), CrossSection([outline(other(pair.wheel))])
    ratio, pitch = pair.wheel.teeth / pair.pinion.teeth, 360.0 / pair.wheel.teeth
    for turn in np.linspace(0.0, pitch, 7):
        mating = pinion.rotate(180.0 + 180.0 / pair.pinion.teeth - turn * ratio)
        assert (wheel.rotate(turn) ^ mating.translate((pair.centre_distance_mm, 0.0))).area() < 1e-6
        pushed = mating.rotate(math.degrees(0.6 * BACKLASH_MM / pair.pinion.pitch_radius_mm))
        assert (wheel.rotate(turn) ^ pushed.translate((pair.centre_distance_mm, 0.0))).area() > 1e-4
