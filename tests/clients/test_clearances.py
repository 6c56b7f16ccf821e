"""From the exported files alone: nothing meets anything, from loaded springs to the stop and its pad's give."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from clients.clearances import Bundle

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-printable")
"""The prototypes and the template that is the strongest; the checks find nothing wrong with the others either."""


@pytest.fixture(scope="module", params=TEMPLATES)
def bundle(request: pytest.FixtureRequest, bundle_of: Callable[[str], Path]) -> Bundle:
    return Bundle(bundle_of(request.param))


def test_nothing_meets_anything_in_sixty_positions(bundle: Bundle) -> None:
    poses = bundle.poses()
    assert len(poses) == 60
    assert min(pose.leg for pose in poses) == pytest.approx(bundle.wound, abs=math.radians(0.5))
    assert max(pose.leg for pose in poses) == pytest.approx(bundle.stop + bundle.give)
    assert [(a, b, round(volume, 2)) for a, b, volume, _ in bundle.meetings(poses)] == []


def test_the_leg_meets_the_pad_at_the_stops_angle_and_not_before(bundle: Bundle) -> None:
    """The pad's and the heel's faces are parallel at the stop: just before it the gap is the angle times the radius."""
    pieces = {piece.name: piece for piece in bundle.pieces}

    def gap(leg_rad: float) -> float:
        leg = pieces["main_leg"].solid.transform(bundle.leg_place(leg_rad)[:3])
        return float(leg.min_gap(pieces["stop_pad"].solid, 3.0))

    radius = bundle.manifest["stop"]["radius_mm"]
    assert gap(bundle.stop - math.radians(0.05)) < 0.05
    half = 8.0 / 2.0  # of the pad's length: its far edge is nearest
    before = math.radians(2.0)
    assert gap(bundle.stop - before) == pytest.approx(before * (radius - half), rel=0.05)


def test_the_blow_is_symmetric_between_the_plates(bundle: Bundle) -> None:
    """Pad and leg are both centred on the middle plane."""
    for name in ("stop_pad", "main_leg"):
        box = next(piece.solid for piece in bundle.pieces if piece.name == name).bounding_box()
        assert box[1] == pytest.approx(-box[4], abs=1e-3)


def test_the_pads_are_the_lowest_of_the_foot(bundle: Bundle) -> None:
    """Seen flat on the ground, as the loop file says how deep that is."""
    solids = {piece.name: piece.solid for piece in bundle.pieces if piece.link == "foot"}
    lowest = sorted((solid.bounding_box()[2], name) for name, solid in solids.items())
    assert all(name.endswith("_pad") or name.startswith("nose_pad") for _, name in lowest[:4])
    assert lowest[0][0] == pytest.approx(-1000.0 * bundle.loop["foot_depth_m"], abs=0.02)


def test_the_program_sees_a_leg_that_no_stop_holds(bundle_of: Callable[[str], Path]) -> None:
    """Turned 8° farther past rest than the stop and its pad let it, the leg runs into the stop's bar."""
    room = Bundle(bundle_of("kenan-2.0"))
    room.stop += math.radians(8.0)
    assert any(pair[:2] == ("stop_bar", "main_leg") for pair in room.meetings())


def test_the_program_sees_a_part_in_the_way(bundle_of: Callable[[str], Path]) -> None:
    """A standoff moved onto the leg is met by it, and one moved into the gear by the gear."""
    room = Bundle(bundle_of("kenan-2.0"))
    pieces = {piece.name: piece for piece in room.pieces}
    number = room.pieces.index(pieces["standoff_1"])
    for name in ("main_leg", "cam_gear"):
        place = room.leg_place(room.wound / 2.0) if name == "main_leg" else np.eye(4)
        solid = pieces[name].solid.transform(place[:3])
        there, here = (
            np.reshape(one.bounding_box(), (2, 3)).mean(axis=0) for one in (solid, pieces["standoff_1"].solid)
        )
        room.pieces[number] = replace(pieces["standoff_1"], solid=pieces["standoff_1"].solid.translate(there - here))
        assert any({"standoff_1", name} <= set(pair[:2]) for pair in room.meetings())
