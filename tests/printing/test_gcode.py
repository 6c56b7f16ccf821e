"""Reading G-code: lines, volumes and moments of toolpaths written by hand."""

import math

import numpy as np
import pytest
from support.gcode import read_gcode

from jumpcad.solids.moments import G_PER_CM3, mass_of

ABSOLUTE = """M82
;HEIGHT:0.2
;TYPE:Perimeter
G92 E0
G1 Z.2 F600
G1 X10 Y5
G1 E2 ; prime
G1 X30 Y5 E3
G1 X30 Y15 ; travel
G1 E1.5
G1 F2400
G1 E3
;TYPE:Solid infill
G1 X10 Y15 E4
; filament_diameter = 1.75
; estimated printing time (normal mode) = 1m 5s
"""
RELATIVE = ABSOLUTE.replace("M82", "M83").replace("E3\n;TYPE", "E1.5\n;TYPE").replace("Y5 E3", "Y5 E1")
RELATIVE = RELATIVE.replace("E1.5\nG1 F", "E-1.5\nG1 F").replace("Y15 E4", "Y15 E1")
RAPID = ABSOLUTE.replace("G1 X30 Y15 ;", "G0 X30 Y15 ;")


@pytest.mark.parametrize("text", [ABSOLUTE, RELATIVE, RAPID])
def test_only_moves_that_lay_a_line_count(text):
    path = read_gcode(text)
    assert path.filament_mm == pytest.approx([1.0, 1.0])
    assert path.kinds == ("Perimeter", "Solid infill")
    np.testing.assert_allclose(path.starts_mm, [[10, 5, 0.2], [30, 15, 0.2]])
    np.testing.assert_allclose(path.ends_mm, [[30, 5, 0.2], [10, 15, 0.2]])
    assert path.volumes_mm3.sum() == pytest.approx(2.0 * math.pi * 1.75**2 / 4.0)
    assert path.remarks["estimated printing time (normal mode)"] == "1m 5s"


def test_a_line_begins_at_the_origin_where_nothing_was_said_before():
    path = read_gcode("M83\n;HEIGHT:0.2\nG1 X10 Y5 E1\n")
    np.testing.assert_array_equal(path.starts_mm, [[0.0, 0.0, 0.0]])
    np.testing.assert_array_equal(path.ends_mm, [[10.0, 5.0, 0.0]])


def test_lines_turn_like_thin_rods():
    path = read_gcode(ABSOLUTE)
    found = mass_of(path.moments(), 1.0)
    rod = math.pi * 1.75**2 / 4.0 * G_PER_CM3
    assert found.com_m == pytest.approx([0.020, 0.010, 0.0001])
    assert found.inertia_kg_m2[0, 0] == pytest.approx(2.0 * rod * 0.005**2)
    assert found.inertia_kg_m2[1, 1] == pytest.approx(2.0 * rod * 0.020**2 / 12.0)
    assert found.inertia_kg_m2[2, 2] == pytest.approx(2.0 * rod * (0.020**2 / 12.0 + 0.005**2))


def test_three_lines_of_different_heights_have_their_plastic_half_a_line_lower():
    """0.3, 0.2 and 0.1 mm high, all 10 mm long at 0.5 mm, with 1, 2 and 3 mm of filament."""
    text = "M83\nG1 X0 Y0 Z.5\n;HEIGHT:0.3\nG1 X10 E1\n;HEIGHT:0.2\nG1 X0 E2\n;HEIGHT:0.1\nG1 X10 E3\n"
    found = mass_of(read_gcode(text + "; filament_diameter = 1.75\n").moments(), 1.0)
    assert found.com_m[2] == pytest.approx((0.35 * 1.0 + 0.4 * 2.0 + 0.45 * 3.0) / 6.0 / 1000.0)
    assert found.com_m[0] == pytest.approx(0.005)


def test_absolute_feed_begins_at_zero():
    path = read_gcode("M82\nG1 X0 Y0 Z.2\n;HEIGHT:0.2\nG1 X10 E1.5\nG1 X0 E2\n; filament_diameter = 1.75\n")
    assert path.filament_mm == pytest.approx([1.5, 0.5])


def test_absolute_feed_goes_on_after_moves_that_feed_nothing():
    """2 mm of filament are fed, then the nozzle travels, then the fed length is 3 mm: 1 mm more."""
    lines = ["M82", ";HEIGHT:0.2", "G1 X0 Y0 Z.2", "G1 X10 E2", "G1 Z.6", "G0 Y5", "G1 Z.2", "G1 X0 E3"]
    path = read_gcode("\n".join([*lines, "; filament_diameter = 1.75"]))
    assert path.filament_mm == pytest.approx([2.0, 1.0])


@pytest.mark.parametrize(("mode", "back", "on"), [("M82", "E.5", "E1.5"), ("M83", "E-.5", "E1")])
def test_filament_that_is_drawn_back_on_the_way_lays_no_line(mode, back, on):
    """As wiping does: the nozzle goes on while filament is drawn back; moving in height alone lays none either."""
    lines = [mode, ";HEIGHT:0.2", "G1 X0 Y0 Z.2", "G1 Y10 E1", f"G1 X20 {back}", f"G1 X30 {on}"]
    up = "G1 Z.4 E2" if mode == "M82" else "G1 Z.4 E.5"
    path = read_gcode("\n".join([*lines, up, "; filament_diameter = 1.75"]))
    assert path.filament_mm == pytest.approx([1.0, 1.0])
    assert path.starts_mm[:, 0].tolist() == [0.0, 20.0]
    assert path.ends_mm[:, :2].tolist() == [[0.0, 10.0], [30.0, 10.0]]
