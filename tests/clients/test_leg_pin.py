"""From the exported files alone: the leg's springs' pin goes in from outside, through the left plate, and stays."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from clients.clearances import Bundle, Piece
from manifold3d import Manifold, OpType
from support.built import built

from jumpcad.bundle.export import export

PIN = "leg_spring_pin"
TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-printable")
OTHERS = {
    "kenan-2.0 with clips": {"retention": "clips", "axle": "silver-steel"},
    "best-bo with screws as axles": {"retention": "nuts"},
}
STEP_MM = 0.5
TOLERANCE_MM3 = 0.3
"""As in `clearances`: the meshes of bought parts leave out detail below 0.05 mm."""


@pytest.fixture(scope="module", params=[*TEMPLATES, *OTHERS])
def bundle(
    request: pytest.FixtureRequest, bundle_of: Callable[[str], Path], tmp_path_factory: pytest.TempPathFactory
) -> Bundle:
    """A template's bundle, or one with other axles and pins."""
    if request.param in TEMPLATES:
        return Bundle(bundle_of(request.param))
    robot = built(request.param.split()[0], **OTHERS[request.param])
    return Bundle(export(robot, tmp_path_factory.mktemp("bundle") / "it", pictures=False).folder)


def placed(bundle: Bundle, pieces: list[Piece], leg_rad: float, within: Manifold | None = None) -> Manifold:
    """Return pieces of the main leg and of the body, as one, with the leg at an angle; what lies within a box alone."""
    leg = bundle.leg_place(leg_rad)[:3]
    solids = [piece.solid.transform(leg) if piece.link == "main_leg" else piece.solid for piece in pieces]
    if within is not None:
        solids = [solid ^ within for solid in solids]
    return Manifold.batch_boolean(solids, OpType.Add)


def inserted(bundle: Bundle) -> list[Piece]:
    """Return the pin as it goes in: with the clip at its left end, if it has one."""
    return [piece for piece in bundle.pieces if piece.name in (PIN, f"{PIN}_clip_2")]


def around(bundle: Bundle) -> list[Piece]:
    """Return what stands when the pin goes in: body and leg, without the pin and what keeps it."""
    return [
        piece
        for piece in bundle.pieces
        if piece.link in ("body", "main_leg") and not piece.name.startswith((PIN, "ankle_pin", "front_eye"))
    ]


def passage(moving: Manifold, up_to_mm: float) -> Manifold:
    """Return the box that something needs on its way to the left, and a little more."""
    low, high = np.array(moving.bounding_box()).reshape(2, 3) + np.array([[-0.1], [0.1]])
    return Manifold.cube([high[0] - low[0], up_to_mm - low[1], high[2] - low[2]]).translate(low.tolist())


@pytest.mark.parametrize("at", ["rest", "stop"])
def test_the_pin_meets_nothing_from_outside_to_its_seat(bundle: Bundle, at: str) -> None:
    leg = 0.0 if at == "rest" else bundle.stop
    pin, others = placed(bundle, inserted(bundle), leg), around(bundle)
    pad = [piece for piece in others if piece.name != "stop_pad"]  # which the leg touches
    outside = max(placed(bundle, [piece], leg).bounding_box()[4] for piece in others)
    standing = placed(bundle, pad, leg, passage(pin, outside))
    way = np.arange(0.0, outside - pin.bounding_box()[1] + STEP_MM, STEP_MM)
    assert way[-1] > 20.0
    for moved in way:
        assert (pin.translate([0.0, float(moved), 0.0]) ^ standing).volume() < TOLERANCE_MM3, moved


def test_its_hole_is_at_rest_and_at_the_stop_only(bundle: Bundle) -> None:
    """A thin rod along the pin's axis, from outside to the leg, meets the plate where the springs are loaded."""
    pin = next(piece for piece in bundle.pieces if piece.name == PIN).solid.bounding_box()
    plate = next(piece for piece in bundle.pieces if piece.name == "body_plate_left").solid
    axis = Manifold.cube([0.1, 200.0, 0.1])
    axis = axis.translate([(pin[0] + pin[3]) / 2.0 - 0.05, pin[4], (pin[2] + pin[5]) / 2.0 - 0.05])
    seen = {leg: (axis.transform(bundle.leg_place(leg)[:3]) ^ plate).volume() for leg in (0.0, bundle.stop)}
    assert max(seen.values()) == 0.0
    beside = (axis.transform(bundle.leg_place(math.radians(-20.0))[:3]) ^ plate).volume()
    assert beside == pytest.approx(0.1 * 0.1 * 2.4, rel=1e-3)  # body.plate_mm


def test_what_keeps_the_pin_is_on_the_leg(bundle: Bundle) -> None:
    """Pushed to the left the pin is stopped by its split pin or right clip on the leg, before its head is in the plate.

    Pushed to the right it is stopped by its head or left clip.
    """
    leg = next(piece.solid for piece in bundle.pieces if piece.name == "main_leg")
    kept = [piece for piece in bundle.pieces if piece.name.startswith(PIN)]
    whole = Manifold.batch_boolean([piece.solid for piece in kept], OpType.Add)
    plate = next(piece for piece in bundle.pieces if piece.name == "body_plate_left").solid
    for way in (1.0, -1.0):
        free = next(
            by for by in np.arange(0.0, 12.0, 0.1) if (whole.translate([0.0, way * by, 0.0]) ^ leg).volume() > 1.0
        )
        if way > 0.0:
            assert whole.bounding_box()[4] + free < plate.bounding_box()[1]
            moved = whole.translate([0.0, float(free), 0.0])
            body = [piece for piece in bundle.pieces if piece.link == "body" and not piece.name.startswith("spring_")]
            near = moved.bounding_box()
            reach = math.hypot(max(near[0], near[3], key=abs), max(near[2], near[5], key=abs))
            x, _, z = bundle.leg_place(0.0)[:3, 3]
            slab = Manifold.cube([2.0 * reach, near[4] - near[1], 2.0 * reach]).translate(
                [x - reach, near[1], z - reach]
            )
            others = Manifold.batch_boolean([piece.solid ^ slab for piece in body], OpType.Add)
            for angle in np.linspace(bundle.wound, bundle.stop, 12):
                shared = (moved.transform(bundle.leg_place(float(angle))[:3]) ^ others).volume()
                assert shared < TOLERANCE_MM3, math.degrees(angle)
