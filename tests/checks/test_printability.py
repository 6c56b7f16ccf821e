"""Printability on parts that are drawn to violate one limit each, and on a robot that violates none."""

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.each import each
from support.said import well_told

from jumpcad.checks.printability import _mesh_undersides, _undersides, bed_findings, printability_findings
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.mass import MassProperties
from jumpcad.mechanism.model import BODY
from jumpcad.parts.part import Drawing, Part, Placement
from jumpcad.robot.robot import Robot
from jumpcad.solids.blocks import Bar, Blocks
from jumpcad.solids.outline import Region, disc, hole, polygon, rectangle
from jumpcad.solids.stack import Stack
from jumpcad.workshop import load_workshop

Slabs = list[tuple[float, float, Region]]

BLOCK = rectangle((30.0, 20.0))
HOLE = rectangle((14.0, 14.0))


def robot_of(kenan: Robot, shape: Stack | Blocks) -> Robot:
    mass = MassProperties(0.01, np.zeros(3), 1e-6 * np.eye(3))
    return replace(kenan, parts=(Part("piece", "body", shape, (Placement(BODY, np.eye(4)),), "PLA", mass, "solid"),))


def found(kenan: Robot, shape: Stack | Blocks) -> dict[str, Finding]:
    return {finding.name: finding for finding in printability_findings(robot_of(kenan, shape))}


@each(
    ("name", "slabs", "margin"),
    [
        # 0.9 mm are the least wall, 1.6 mm the least hole, 3 mm the least column, 10 mm the longest bridge
        ("walls", [(0.0, 5.0, rectangle((30.0, 0.5)))], 0.5 - 0.9),
        ("walls", [(0.0, 5.0, BLOCK - hole(19.0))], 0.5 - 0.9),
        # too thin, and too short to be seen at twice the least wall
        ("walls", [(0.0, 5.0, BLOCK - rectangle((1.2, 30.0)) + rectangle((1.4, 0.6)))], 0.6 - 0.9),
        ("holes", [(0.0, 5.0, BLOCK - hole(1.2))], 1.2 - 1.6),
        ("pins", [(0.0, 2.0, BLOCK), (2.0, 12.0, disc(2.0))], 2.0 - 3.0),
        # up to three times as long as the least column is thick; what is longer is a wall
        ("pins", [(0.0, 2.0, BLOCK), (2.0, 12.0, rectangle((2.0, 8.0)))], 2.0 - 3.0),
        # beside a block of the same height
        ("pins", [(0.0, 2.0, BLOCK), (2.0, 12.0, disc(2.0, (-10.0, 0.0)) + rectangle((12.0, 12.0), (6.0, 0.0)))], -1.0),
        # a ledge of 5 mm beyond a column; two lines of 0.45 mm hold
        ("overhangs", [(0.0, 4.0, rectangle((10.0, 20.0))), (4.0, 6.0, rectangle((20.0, 20.0)))], 0.9 - 5.0),
        # a mushroom is held in its middle alone
        ("overhangs", [(0.0, 4.0, disc(20.0)), (4.0, 6.0, disc(30.0))], 0.9 - 5.0),
        # a tongue into a hole is held at its root alone
        (
            "overhangs",
            [(0.0, 4.0, BLOCK - HOLE), (4.0, 6.0, BLOCK - HOLE + rectangle((5.0, 4.0), (-4.5, 0.0)))],
            0.9 - 5.0,
        ),
        ("bridges", [(0.0, 5.0, BLOCK - rectangle((14.0, 30.0))), (5.0, 6.0, BLOCK)], 10.0 - 14.0),
        # held at both sides, though it stands out beyond them
        ("bridges", [(0.0, 5.0, BLOCK - rectangle((14.0, 30.0))), (5.0, 6.0, BLOCK + rectangle((14.0, 26.0)))], -4.0),
        ("bridges", [(0.0, 5.0, BLOCK - hole(13.0)), (5.0, 6.0, BLOCK)], 10.0 - 13.0),
    ],
)
def test_fires_alone_with_its_margin(kenan: Robot, name: str, slabs: Slabs, margin: float) -> None:
    findings = found(kenan, Stack.of(slabs))
    assert [finding.name for finding in errors(findings.values())] == [name]
    assert findings[name].margin == pytest.approx(margin, abs=0.08)
    assert "piece" in findings[name].message
    assert well_told(findings[name])


@pytest.mark.parametrize(
    "slabs",
    [
        [(0.0, 5.0, rectangle((30.0, 1.2)))],
        [(0.0, 5.0, BLOCK - hole(2.4))],
        [(0.0, 2.0, BLOCK), (2.0, 12.0, disc(4.0))],
        [(0.0, 2.0, BLOCK), (2.0, 12.0, rectangle((2.0, 9.0)))],
        [(0.0, 5.0, BLOCK - rectangle((8.0, 30.0))), (5.0, 6.0, BLOCK)],
    ],
)
def test_silent_on_what_prints(kenan: Robot, slabs: Slabs) -> None:
    findings = found(kenan, Stack.of(slabs))
    assert not errors(findings.values())
    for name, least_mm in (("walls", 0.9), ("holes", 1.6), ("pins", 3.0)):
        if findings[name].value is None:  # nothing as narrow as twice the least was found
            assert f"is under {2.0 * least_mm:.2f} mm" in findings[name].message
            assert findings[name].margin == pytest.approx(least_mm)
        else:
            assert findings[name].margin == pytest.approx(findings[name].value - least_mm)


@pytest.mark.parametrize(("high_mm", "seen"), [(0.89, False), (0.91, True), (2.4, True)])
def test_walls_are_looked_for_in_all_that_is_as_high_as_the_least_of_them(
    kenan: Robot, high_mm: float, seen: bool
) -> None:
    """0.9 mm: engravings and chamfers are lower, plates of 2.4 mm are not."""
    findings = found(kenan, Stack.of([(0.0, 5.0, BLOCK), (5.0, 5.0 + high_mm, rectangle((30.0, 0.5)))]))
    assert (findings["walls"].severity == "error") == seen


@pytest.mark.parametrize(("gap_mm", "name"), [(0.0, "bridges"), (0.15, "overhangs")])
def test_a_ledge_that_ends_beside_a_wall_hangs(kenan: Robot, gap_mm: float, name: str) -> None:
    """From one wall 5 mm towards another: on it is a bridge, 0.15 mm before it an overhang of more than two lines."""
    walls = rectangle((8.0, 20.0), (-4.0, 0.0)) + rectangle((8.0, 20.0), (9.0, 0.0))
    ledge = rectangle((8.0 + 5.0 - gap_mm, 20.0), ((5.0 - gap_mm - 8.0) / 2.0, 0.0))
    findings = found(
        kenan, Stack.of([(0.0, 1.0, rectangle((25.0, 20.0), (4.5, 0.0))), (1.0, 5.0, walls), (5.0, 6.0, ledge)])
    )
    assert (findings["bridges"].value or 0.0) == pytest.approx(5.0 if name == "bridges" else 0.0, abs=0.06)
    assert (findings["overhangs"].severity == "error") == (name == "overhangs")


def test_steps_of_45_degrees_are_no_overhang_and_steeper_ones_are(kenan: Robot) -> None:
    def steps(out_mm: float) -> Stack:
        return Stack.of([(0.2 * step, 0.2 * step + 0.2, disc(10.0 + 2.0 * out_mm * step)) for step in range(10)])

    assert found(kenan, steps(0.2))["overhangs"].margin == pytest.approx(0.9)
    assert found(kenan, steps(0.3))["overhangs"].margin == pytest.approx(0.9 - 0.3, abs=0.05)
    assert found(kenan, steps(1.0))["overhangs"].margin == pytest.approx(0.9 - 1.0, abs=0.05)


def test_limits_of_holes_and_overhangs_are_the_workshops_own(kenan: Robot) -> None:
    """The smaller of a hole and a screw's tap; two lines."""
    shop = kenan.workshop
    fits, process = {"m2_tap_mm": 1.3, "hole_min_mm": 1.9}, {"line_width_mm": 0.6}
    tables = {"fits": shop.fits.model_copy(update=fits), "process": shop.process.model_copy(update=process)}
    findings = found(replace(kenan, workshop=shop.model_copy(update=tables)), Stack.of([(0.0, 5.0, BLOCK)]))
    assert (findings["holes"].limit, findings["overhangs"].limit) == (1.3, pytest.approx(1.2))


def test_solids_that_are_no_stacks(kenan: Robot) -> None:
    block = Bar(rectangle((30.0, 10.0), (15.0, 5.0)), ((0.0, 20.0),))
    tunnel = Bar(rectangle((14.0, 4.0), (15.0, 4.0)), ((-5.0, 35.0),))
    assert [finding.name for finding in errors(found(kenan, Blocks((block,), (tunnel,))).values())] == ["bridges"]
    roof = Bar(rectangle((30.0, 10.0), (15.0, 5.0)).rotate(-30.0), ((0.0, 20.0),))
    names = [finding.name for finding in errors(found(kenan, Blocks((block, roof))).values())]
    assert "overhangs" in names
    assert not errors(found(kenan, Blocks((block,))).values())


def test_two_pieces_are_no_part(kenan: Robot) -> None:
    two = Stack.of([(0.0, 5.0, rectangle((10.0, 10.0)) + rectangle((10.0, 10.0), (20.0, 0.0)))])
    findings = found(kenan, two)
    assert [finding.name for finding in errors(findings.values())] == ["solid"]
    assert "2 pieces" in findings["solid"].message


@pytest.mark.parametrize(
    ("size", "margin"), [((179.0, 100.0, 5.0), 1.0), ((100.0, 185.0, 5.0), -5.0), ((20.0, 20.0, 200.0), -20.0)]
)
def test_bed(kenan: Robot, size: tuple[float, float, float], margin: float) -> None:
    # Prusa MINI: 180 x 180 x 180 mm
    mini = load_workshop("fine")
    assert mini.printer.bed_mm == (180.0, 180.0, 180.0)
    robot = replace(robot_of(kenan, Stack.of([(0.0, size[2], rectangle(size[:2]))])), workshop=mini)
    (finding,) = bed_findings(robot)
    assert finding.margin == pytest.approx(margin)
    assert finding.severity == ("info" if margin >= 0 else "error")


def test_undersides_of_a_mesh_that_a_wall_parts_are_looked_at_apart() -> None:
    """A post with a ledge of 5 mm on its left and, higher, one of 3 mm on its right."""
    post = Bar(rectangle((10.0, 30.0), (0.0, 15.0)), ((0.0, 12.0),))
    left, right = rectangle((5.0, 2.0), (-7.5, 9.0)), rectangle((3.0, 2.0), (6.5, 15.0))
    ledges = tuple(Bar(one, ((0.0, 12.0),)) for one in (left, right))
    drawing = Drawing("piece", "body", Blocks((post, *ledges)), (Placement(BODY, np.eye(4)),))
    found = sorted(_mesh_undersides(drawing.mesh, math.radians(45.0)))
    assert found == [(True, pytest.approx(3.0)), (True, pytest.approx(5.0))]


@pytest.mark.parametrize("lean_deg", [20.0, 40.0, 60.0])
def test_a_meshs_wall_hangs_over_where_it_leans_more_than_the_printer_can(lean_deg: float) -> None:
    """The angle is that from upright, whatever it is: at 45° alone its sine and cosine are one."""
    lean = 10.0 * math.tan(math.radians(lean_deg))
    floor = [(x, y, 0.0) for x in (0.0, 20.0) for y in (0.0, 8.0)]
    top = [(x, y, 10.0) for x in (0.0, 20.0 + lean) for y in (0.0, 8.0)]
    mesh = trimesh.Trimesh([*floor, *top]).convex_hull
    for most_deg in (lean_deg - 2.0, lean_deg, lean_deg + 2.0):
        found = list(_mesh_undersides(mesh, math.radians(most_deg)))
        assert len(found) == (most_deg < lean_deg)
        assert all(span == (False, pytest.approx(min(8.0, lean), abs=1e-6)) for span in found)


@pytest.mark.parametrize("up", [0.0, 7.0])
def test_a_level_roof_that_ends_in_a_slope_is_no_bridge(up: float) -> None:
    """A wedge on a post: 4 mm level, then 6 mm that rise by 2 mm. Level alone it is one; wherever the bed is."""
    post = Bar(rectangle((10.0, 12.0), (0.0, 6.0 + up)), ((0.0, 12.0),))
    roofs = {True: [(5.0, 8.0), (9.0, 8.0), (9.0, 11.0), (5.0, 11.0)]}
    roofs[False] = [*roofs[True][:2], (15.0, 10.0), (15.0, 11.0), (5.0, 11.0)]
    for level, corners in roofs.items():
        wedge = Bar(polygon(np.array(corners) + np.array([0.0, up])), ((0.0, 12.0),))
        mesh = Drawing("piece", "body", Blocks((post, wedge)), (Placement(BODY, np.eye(4)),)).mesh
        assert list(_mesh_undersides(mesh, math.radians(45.0))) == [(level, pytest.approx(4.0 if level else 10.0))]


@pytest.mark.parametrize(("beyond_mm", "bridge", "size_mm"), [(0.0, True, 8.0), (5.0, False, math.hypot(5.0, 4.0))])
def test_the_roof_of_a_socket_that_is_open_at_one_end_is_a_bridge(
    beyond_mm: float, bridge: bool, size_mm: float
) -> None:
    """Between walls 8 mm apart, as far as they reach; what stands out before them hangs, its middle from both."""
    walls = rectangle((20.0, 12.0), (10.0, 0.0)) - rectangle((18.0, 8.0), (11.0, 0.0))
    roof = rectangle((20.0 + beyond_mm, 12.0), (10.0 + beyond_mm / 2.0, 0.0))
    drawing = Drawing("socket", "links", Stack.of([(0.0, 4.0, walls), (4.0, 5.0, roof)]), ())
    shop = load_workshop()
    found = list(_undersides(drawing, shop.fits, shop.process))
    assert found == [(bridge, pytest.approx(size_mm, abs=0.05))]
