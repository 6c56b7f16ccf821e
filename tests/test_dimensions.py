"""Shared sizes, from what they are said to follow from: norms of fasteners, printed lines and layers, other sizes."""

import math

import pytest
from support.places import ROOT

from jumpcad import dimensions
from jumpcad.catalogue import load_catalogue
from jumpcad.dimensions import unit_of_key
from jumpcad.parts.small import CAP_HEAD_DEPTH_MM
from jumpcad.workshop import load_workshop

DOCS = (ROOT / "docs" / "limits.md").read_text(encoding="utf-8")
LINE_MM, LAYER_MM = 0.4, 0.2
"""Width of a nozzle's line and height of a layer."""


def test_gravity_is_the_standard_one_rounded() -> None:
    assert round(9.80665, 2) == dimensions.GRAVITY_M_S2


def test_fasteners_are_those_of_the_catalogue() -> None:
    """M3 washers of 0.5 mm and 7 mm, button heads of 1.65 mm and 5.7 mm; hexagons' corners are at s/√3."""
    catalogue = load_catalogue()
    screw, washer, clip = catalogue.screws["M3"], catalogue.washers["M3"], catalogue.clips["2.3"]
    assert (dimensions.ROLLER_WASHER_MM, washer.height_mm) == (0.5, 0.5)
    assert (dimensions.ROLLER_HEAD_MM, screw.button_head_height_mm) == (1.65, 1.65)
    assert pytest.approx(washer.outer_mm / 2.0 + 1.0) == dimensions.LEVER_EYE_RADIUS_MM
    corner = catalogue.standoffs["M3"].across_flats_mm / math.sqrt(3.0)
    assert corner < dimensions.STANDOFF_RADIUS_MM < corner + 0.05
    fits, line = load_workshop().fits, load_workshop().process.line_width_mm
    assert pytest.approx(catalogue.screws["M2"].cylinder_head_mm + 2.0 * 2.0 * line) == dimensions.CAP_EAR_MM
    widest = max(clip.outer_mm, screw.button_head_mm, 5.5 * 2.0 / math.sqrt(3.0)) / 2.0
    assert widest + 2.0 * fits.sliding_mm < dimensions.AXLE_END_RADIUS_MM < widest + 0.5


def test_walls_and_floors_are_whole_lines_and_layers() -> None:
    fits = load_workshop().fits
    assert pytest.approx(4 * LINE_MM) == dimensions.SOCKET_WALL_MM
    assert pytest.approx(8 * LAYER_MM) == dimensions.TRAY_MM
    assert pytest.approx(4 * LAYER_MM) == dimensions.AXLE_FLOOR_MM
    assert pytest.approx(LAYER_MM) == dimensions.MOTOR_CLAMP_MM
    assert pytest.approx(CAP_HEAD_DEPTH_MM + 4 * LAYER_MM) == dimensions.MOTOR_CAP_MM
    assert pytest.approx(2.5 * fits.wall_mm) == dimensions.PAD_WALL_MM
    assert pytest.approx(5 * LINE_MM) == dimensions.PIN_HOLE_EDGE_MM
    assert pytest.approx(1.5 + fits.sliding_mm + 1.5) == dimensions.SPACER_RADIUS_MM
    assert fits.sliding_mm < dimensions.SOCKET_PLAY_MM


def test_plays_and_gaps_add_up() -> None:
    """The leg has 0.6 mm in all between two bushings, more than the gap between parts; a tray has two tabs of 10 mm."""
    assert pytest.approx(0.6) == 4.0 * dimensions.BUSHING_PLAY_MM
    assert dimensions.GAP_MM == 0.5
    assert 2.0 * load_workshop().fits.loose_mm < dimensions.CLEAR_MM
    assert dimensions.TRAY_LENGTH_MIN_MM == 2.0 * (1.0 + dimensions.TAB_MM) + 8.0 == 30.0
    assert dimensions.STRAP_SLOT_MM[1] == 10.0 + 1.0
    assert all(slot > tie for slot, tie in zip(dimensions.TIE_SLOT_MM, (1.1, 2.5), strict=True))


def test_heads_and_pads_have_room_in_what_is_made_for_them() -> None:
    """A head of 3.8 mm (ISO 14580 M2) in its counterbore, one of 5.7 mm (ISO 7380-1 M3) on its pad, each with play."""
    catalogue, fits = load_catalogue(), load_workshop().fits
    head, button = catalogue.screws["M2"].cylinder_head_mm, catalogue.screws["M3"].button_head_mm
    assert (head, button) == (3.8, 5.7)
    assert head < dimensions.CAP_HEAD_MM < head + 2.0 * fits.loose_mm
    assert button + 2.0 * fits.wall_mm < dimensions.STANDOFF_PAD_MM < button + 4.0 * fits.wall_mm
    assert dimensions.STOP_SEAT_MM < 1.5 < dimensions.STOP_PAD_MM  # the thinnest pad stands out of its seat


def test_an_axle_has_the_play_at_its_end_that_users_are_told() -> None:
    """docs/limits.md: of a plate's blind bore it leaves so much empty; more than the cut of a rod by hand is off."""
    assert f"axle's end play leaves {dimensions.AXLE_END_PLAY_MM:g} mm empty" in DOCS
    assert 0.1 < dimensions.AXLE_END_PLAY_MM < dimensions.GAP_MM


def test_a_pin_in_the_springs_boss_and_the_plate_hardly_leans() -> None:
    """It has two of its diameters to stand in; in a sliding fit it leans by less than 5°."""
    workshop = load_workshop()
    held = dimensions.SPRING_BOSS_MM + workshop.body.plate_mm
    assert held >= 2.0 * workshop.bought.axle_mm
    assert math.degrees(math.atan(2.0 * workshop.fits.sliding_mm / held)) < 5.0


@pytest.mark.parametrize(
    ("key", "unit"),
    [("stiffness_nmm_per_deg", "N·mm/°"), ("rate_nm_per_rad", "N·m/rad"), ("rate_n_per_mm", "N/mm"), ("mass_g", "g"),
     ("density_g_cm3", "g/cm³"), ("price_eur_per_kg", "EUR/kg"), ("pad_area_mm2", "mm²"), ("bed_mm", "mm"),
     ("limit_nm", "N·m"), ("capacity_mah", "mAh"), ("stall_ma", "mA"), ("bears_a", "A"), ("name", ""), ("mm", "")],
)  # fmt: skip
def test_a_key_says_its_unit(key: str, unit: str) -> None:
    assert unit_of_key(key) == unit
