"""Legs with a bought bar between printed ends, from the exported files: fit, room, joints and mass."""

from pathlib import Path

import numpy as np
import pytest
from clients import clearances, spring_pins
from manifold3d import JoinType
from support.built import built

from jumpcad.bundle.export import export

BARS = ("carbon-tube-4x2", "carbon-strip-3x6")
HELD_MM = 0.3
"""A gap for glue is at most this wide."""


@pytest.fixture(scope="module", params=BARS)
def bundle(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bars") / "kenan-2.0"
    return export(built("kenan-2.0", leg=request.param), folder, pictures=False).folder


def test_springs_fit_and_nothing_meets_anything_in_sixty_positions(bundle: Path) -> None:
    room = clearances.Bundle(bundle)
    assert [fit.wrong for fit in spring_pins.fits(bundle)] == [[], []]
    assert [(a, b, round(volume, 2)) for a, b, volume, _ in room.meetings()] == []


def test_each_bar_is_as_long_as_its_line_of_the_bill_and_reaches_from_eye_to_eye(bundle: Path) -> None:
    """Its middle is on the line between the leg's two joints, which lie in the plane of the printed ends' bores."""
    room = clearances.Bundle(bundle)
    lengths = {"main_leg": room.joints["ankle"][:3, 3], "front_link": room.loop["loop"]["point_a_m"]}
    bill = (bundle / "bom.csv").read_text()
    for link, end in lengths.items():
        (bar,) = [piece for piece in room.pieces if piece.name == f"{link}_bar"]
        low, high = np.reshape(bar.solid.bounding_box(), (2, 3))
        assert bar.link == link
        assert f"cut {high[0] - low[0]:.1f} mm" in bill
        assert 0.0 < low[0] < high[0] < 1000.0 * np.linalg.norm(end)
        assert (low + high)[2] / 2.0 == pytest.approx(0.0, abs=0.01)


def test_both_sockets_hold_the_bar_all_round(bundle: Path) -> None:
    """Sections across the leg in its four sockets."""
    room = clearances.Bundle(bundle)
    for link in ("main_leg", "front_link"):
        (bar,) = [piece for piece in room.pieces if piece.name == f"{link}_bar"]
        ends = [piece for piece in room.pieces if piece.link == link and piece.name.startswith(link) and piece != bar]
        low, high = bar.solid.bounding_box()[::3]
        for x in (low + 4.0, high - 4.0):
            inside = bar.solid.rotate([0.0, -90.0, 0.0]).slice(x)
            around = [piece.solid.rotate([0.0, -90.0, 0.0]).slice(x) for piece in ends]
            (wall,) = [one for one in around if not one.is_empty()]
            assert (wall ^ inside).is_empty()
            held = inside.offset(HELD_MM, JoinType.Round)  # the wall is no farther away above, below and beside
            assert (held ^ wall).bounds() == pytest.approx(held.bounds(), abs=0.01)
