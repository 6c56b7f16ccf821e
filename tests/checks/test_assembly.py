"""Assembly: in the guide's order all paths are free and tools reach their fasteners; in another they do not."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from manifold3d import Manifold, Mesh
from support.built import LONG_TOES, built, checked, of_kit, placed

from jumpcad.building import assembly, build
from jumpcad.checks import assembly as checked_assembly
from jumpcad.checks.assembly import Blocked, _tool, assembly_findings, assembly_ways, paths, tools
from jumpcad.checks.interference import Piece, may_share
from jumpcad.checks.printability import printability_findings
from jumpcad.design import Design, load_design
from jumpcad.findings import errors
from jumpcad.mechanism.model import BODY
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack
from jumpcad.steps import assembly_steps
from jumpcad.steps.assembly_steps import Tool

STEEP_TOES = Design.from_vector([135.2, 0.88, 0.71, 1.25, 0.22, 59.6, 28.0, 66.4])
SHORT_BODY = Design.from_vector([79.2, 0.8807, 0.4388, 1.2223, 0.7436, 55.55, 28.06, 15.0])
"""Straight ahead of the springs' pin in its leg, on its stop, is the front axle's spacer."""
FOUND = {
    "kenan-2.0": lambda: checked("kenan-2.0"),
    LONG_TOES: lambda: checked(LONG_TOES),
    "strong-2s, screws as axles, two pairs of gears": lambda: assembly_findings(
        of_kit("strong-2s", "best-bo", retention="nuts", motors=("n20-50",))
    ),
    "toes, steep, whose screws are beside the ankle's pin": lambda: assembly_findings(build(STEEP_TOES)),
    "a short body, whose front axle is ahead of the springs' pin": lambda: assembly_findings(build(SHORT_BODY)),
    "clips": lambda: assembly_findings(built("best-printable", axle="silver-steel", retention="clips")),
}


@pytest.mark.thorough
@pytest.mark.parametrize("name", FOUND)
def test_everything_reaches_its_place_and_every_tool_its_fastener(name: str) -> None:
    names = ["assembly_paths", "tool_access"]
    findings = [finding for finding in FOUND[name]() if finding.name in names]
    assert [finding.name for finding in findings] == names
    assert not errors(findings), [finding.message for finding in errors(findings)]


def _reordered(monkeypatch: pytest.MonkeyPatch, first: str, then: str) -> None:
    """Put one step before another."""
    plans = list(assembly_steps.ORDER)
    keys = [plan.key for plan in plans]
    plan = plans.pop(keys.index(first))
    plans.insert([plan.key for plan in plans].index(then), plan)
    monkeypatch.setattr(assembly_steps, "ORDER", tuple(plans))


@pytest.mark.parametrize(
    ("first", "then", "blocked"),
    [
        ("close", "legs", "leg_axle"),  # a plate over the bores: nothing gets between the plates
        ("arm", "legs", "main_leg"),  # the pin stands where the leg goes
        ("cam", "legs", "main_leg"),  # the cam gear covers the roller's lever
    ],
)
def test_another_order_is_blocked(monkeypatch: pytest.MonkeyPatch, first: str, then: str, blocked: str) -> None:
    _reordered(monkeypatch, first, then)
    found = [stop.name for _, stop in paths(assembly_ways(replace(built("kenan-2.0")))) if stop]
    if blocked == "main_leg":
        assert {"roller", "roller_screw", "main_leg"} & set(found)
    else:
        assert blocked in found


def test_a_pin_whose_head_is_wider_than_its_hole_is_blocked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its head has 5 mm (ISO 2341)."""
    monkeypatch.setattr(assembly, "pin_head_mm", lambda *_: 4.0)
    found = [blocked for _, blocked in paths(assembly_ways(build(load_design("kenan-2.0")))) if blocked]
    assert {(blocked.name, blocked.by) for blocked in found} == {("leg_spring_pin", "body_plate_left")}


def test_a_thick_tool_does_not_reach_the_motors_cap(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its screws are 9.6 mm from the motor's axis, so a tool of 20 mm meets the shaft."""
    broom, plans = Tool("broomstick", 20.0, 40.0), []
    for plan in assembly_steps.ORDER:
        moves = (replace(one, tool=broom) if one.parts.startswith("cap_screw") else one for one in plan.moves)
        plans.append(replace(plan, moves=tuple(moves)))
    monkeypatch.setattr(assembly_steps, "ORDER", tuple(plans))
    stops = [stop for *_, stop in tools(assembly_ways(replace(built("kenan-2.0")))) if stop]
    assert {stop.name for stop in stops} == {"cap_screw_1", "cap_screw_2"}
    assert {stop.by for stop in stops} <= {"motor_shaft", "motor_pinion", "body_plate_right", "standoff_1"}


def test_the_left_plate_meets_nothing_on_its_way_down() -> None:
    """The same path by another program: trimesh's meshes, moved to the left in steps."""
    robot = built("kenan-2.0")

    def solid(name: str) -> Manifold:
        mesh = placed(robot, name)
        return Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))

    plate = solid("body_plate_left")
    for name in ("cam_gear", "cam", "stop_bar", "motor_cap", "electronics_tray_upper"):
        other = solid(name)
        assert min(plate.volume(), other.volume()) > 100.0
        for away in np.linspace(0.5, 40.0, 12):
            assert (plate.translate([0.0, float(away), 0.0]) ^ other).volume() < 0.05, (name, away)


def block(name: str, size: tuple[float, float, float], low: tuple[float, float, float]) -> Piece:
    """A box with its lowest corner at a place."""
    stack = Stack.of([(0.0, size[2], rectangle(size[:2], (size[0] / 2.0, size[1] / 2.0)))])
    pose = np.eye(4)
    pose[:3, 3] = low
    return Piece(name, BODY, stack, pose)


@pytest.mark.parametrize("side", [(0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (0.6, 0.0, -0.8)])
def test_a_tool_stands_on_the_middle_of_its_fasteners_face(side: tuple[float, float, float]) -> None:
    """It touches the farthest of the corners of a cube of 6 mm, and is as long and wide as it is said to be."""
    shaft = _tool(Tool("key", 4.0, 50.0), block("head", (6.0, 6.0, 6.0), (7.0, -3.0, 1.0)), np.array(side))
    middle, low = np.array([10.0, 0.0, 4.0]), shaft.T_body_part[:3, 3]
    reach = 3.0 * np.abs(side).sum()
    np.testing.assert_allclose(low, middle + reach * np.array(side), atol=1e-9)
    np.testing.assert_allclose(shaft.T_body_part[:3, 2], side, atol=1e-9)
    np.testing.assert_allclose(shaft.T_body_part[:3, :3].T @ shaft.T_body_part[:3, :3], np.eye(3), atol=1e-9)
    assert shaft.shape.moments[0] == pytest.approx(50.0 * np.pi * 4.0, rel=0.01)


@pytest.mark.thorough
@pytest.mark.parametrize("angle_deg", [66.0, 76.0, 88.0])
def test_toes_that_point_sideways_leave_the_ankles_pin_its_way(angle_deg: float) -> None:
    """They begin behind it, so that pin, split pin and pliers pass them."""
    sideways = Design.from_vector([134.6, 0.909, 0.846, 1.202, 0.491, 60.6, 23.7, angle_deg])
    robot = build(sideways)
    assert errors(assembly_findings(robot)) == []
    assert errors([one for one in printability_findings(robot) if one.name == "walls"]) == []


@pytest.mark.parametrize(("path", "tool"), [(False, True), (True, False)])
def test_a_blocked_path_is_no_blocked_tool(monkeypatch: pytest.MonkeyPatch, path: bool, tool: bool) -> None:
    """Each finding tells of its own, and what is free how many there are: a move, and two fasteners."""
    stop = Blocked(SimpleNamespace(title="Close the body"), "standoff_screw_1", "body_plate_left", 2.5)
    monkeypatch.setattr(checked_assembly, "assembly_ways", lambda _: [])
    monkeypatch.setattr(checked_assembly, "paths", lambda _: iter([("move", stop if path else None)]))
    monkeypatch.setattr(checked_assembly, "tools", lambda _: iter([(1, 1, None), (2, 1, stop if tool else None)]))
    found = {one.name: one for one in assembly_findings(built("kenan-2.0"))}
    assert [found[name].severity == "error" for name in ("assembly_paths", "tool_access")] == [path, tool]
    free, said = ("assembly_paths", "all 1 moves") if tool else ("tool_access", "all 2 fasteners")
    assert said in found[free].message


@pytest.mark.parametrize(
    ("one", "other", "meet"),
    [
        ("cap_screw_2", "body_plate_right", True), ("motor_pinion", "motor_shaft", True),
        ("toe_left_screw_1", "foot", True), ("stop_pad", "main_leg", True),
        ("cap_screw_2", "body_plate_left", False), ("motor_pinion", "cam_gear", False), ("battery", "foot", False),
    ],
)  # fmt: skip
def test_what_may_meet_may_do_so_whichever_of_the_two_moves(one: str, other: str, meet: bool) -> None:
    """A screw cuts its thread, whether it comes to the plate or the plate to it."""
    assert may_share(one, other) == may_share(other, one) == meet
