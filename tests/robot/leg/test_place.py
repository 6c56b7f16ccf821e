"""The hole for the leg's pin: where the pin is at rest and at the stop, and what may not stand in its way."""

import math

import numpy as np
import pytest
from support.built import built, in_body
from support.decimals import decimals
from support.each import each

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.model import MAIN_LEG
from jumpcad.robot.leg.place import PinHole, bar_place, pin_hole
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, disc

HOLE_MM, AXLE_MM = 5.2, 3.0


def hole(robot: Robot, *around: Obstacle) -> PinHole:
    layout = robot.layout
    return pin_hole(
        robot.linkage, list(around), layout.stop, layout.lateral, layout.leg_pin_mm, HOLE_MM, AXLE_MM
    )  # fmt: skip


def test_the_pin_is_free_from_rest_to_the_stop(robot: Robot) -> None:
    found, pin = hole(robot), np.array([robot.layout.leg_pin_mm, 0.0])
    assert found.rest_mm == pytest.approx(in_body(robot, MAIN_LEG, 0.0, pin), abs=2e-6)
    assert found.stop_mm == pytest.approx(in_body(robot, MAIN_LEG, -robot.layout.stop.angle_rad, pin), abs=2e-6)
    assert decimals([found.rest_mm, found.stop_mm]) == 6  # nanometres: cosines differ between processors
    kept = found.obstacle((1.0, 2.0))
    assert found.pad_mm == HOLE_MM + 2.0 * 2.0
    assert kept.points_mm.tolist() == [found.rest_mm.tolist(), found.stop_mm.tolist()]
    assert (kept.radius_mm, kept.y_mm) == (found.pad_mm / 2.0, (1.0, 2.0))


@each("end", ["rest_mm", "stop_mm"])
@each(("plate", "reach_mm"), [(True, HOLE_MM / 2.0 + 2.0), (False, HOLE_MM / 2.0)])
def test_what_stands_in_its_way_or_in_the_material_around_it_is_named(
    robot: Robot, end: str, plate: bool, reach_mm: float
) -> None:
    """Beside the leg the hole's width is kept free, in the plate 2 mm more, at both ends."""
    lateral, found = robot.layout.lateral, hole(robot)
    y = lateral.left_plate if plate else (lateral.leg[1], lateral.left_plate[0])
    outwards = getattr(found, end) - (found.rest_mm + found.stop_mm) / 2.0
    outwards /= math.hypot(*outwards)

    def post(gap_mm: float, name: str = "post") -> Obstacle:
        return disc(name, getattr(found, end) + (reach_mm + 1.0 + gap_mm) * outwards, 1.0, y)

    assert hole(robot, post(0.01)).diameter_mm == HOLE_MM
    with pytest.raises(CannotBuildError, match=r"0\.3 mm too little beside the post") as refused:
        hole(robot, post(-0.3), disc("far", (500.0, 0.0), 1.0, EVERYWHERE))
    assert refused.value.margin == pytest.approx(-0.3, abs=1e-6)
    for moving in ("lever", "front link"):  # these move with the leg, beside its pin
        hole(robot, post(-0.3, moving))


@pytest.mark.parametrize("axle_mm", [2.0, 3.0])
def test_the_hole_keeps_off_the_bores_of_the_axles(axle_mm: float) -> None:
    robot = built("kenan-2.0")
    layout = robot.layout
    near = axle_mm / 2.0 + 0.8 + HOLE_MM / 2.0 + 2.0  # the bore, a clearance, and half of the hole with its edge
    given = (robot.linkage, [], layout.stop, layout.lateral)
    assert pin_hole(*given, near + 0.01, HOLE_MM, axle_mm).diameter_mm == HOLE_MM
    with pytest.raises(CannotBuildError, match=r"0\.1 mm too little beside the bore of the leg axle"):
        pin_hole(*given, near - 0.09, HOLE_MM, axle_mm)


@pytest.mark.parametrize("more_mm", [-0.1, 0.1])
def test_the_hole_keeps_2_mm_off_the_slot_of_the_rest_stop(robot: Robot, more_mm: float) -> None:
    """At the stop, the slot begins behind the leg's middle line by its heel and the pad, less its seat of 0.6 mm."""
    layout, stop = robot.layout, robot.layout.stop
    behind = stop.heel_mm + stop.pad.thickness_mm - 0.6
    beside_slot = stop.radius_mm - 1.5  # tabs of 5 mm begin where the bar of 8 mm does
    given = (robot.linkage, [], stop, layout.lateral, beside_slot, 2.0 * (behind - 2.0 - more_mm), AXLE_MM)
    if more_mm > 0.0:
        assert pin_hole(*given).pad_mm == pytest.approx(2.0 * (behind - more_mm))
        return
    with pytest.raises(CannotBuildError, match=r"0\.1 mm too little beside the rest stop's slot"):
        pin_hole(*given)


STRIP = load_catalogue().bars["carbon-strip-3x6"]


def test_the_bending_socket_is_five_heights_and_the_other_8_mm() -> None:
    """A strip of 6 mm height: from 10 to 40 mm, and from 92 to 100 mm; the bar is 0.2 mm shorter at both ends."""
    place = bar_place("main leg", STRIP, 10.0, 0.0, 100.0, bends=True)
    assert (place.floor_mm, place.mouth_mm, place.far_mouth_mm, place.far_floor_mm) == (10.0, 40.0, 92.0, 100.0)
    assert place.length_mm == pytest.approx(89.6)
    assert place.middle_mm == 55.0
    assert bar_place("front link", STRIP, 10.0, 0.0, 100.0, bends=False).mouth_mm == 18.0
    assert bar_place("main leg", STRIP, 10.0, 45.0, 100.0, bends=True).mouth_mm == 45.0


def test_five_millimetres_between_the_sockets_are_enough() -> None:
    assert bar_place("main leg", STRIP, 10.0, 0.0, 53.0, bends=True).far_mouth_mm == 45.0
    with pytest.raises(CannotBuildError, match=r": 4\.0 mm of the main leg are free") as refused:
        bar_place("main leg", STRIP, 10.0, 0.0, 52.0, bends=True)
    assert refused.value.margin == pytest.approx(-1.0)
