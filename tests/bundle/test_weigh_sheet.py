"""The sheet for the kitchen scale corrects the jump as building the robot anew with the weighed masses does."""

import csv
import io

import pytest
from support.built import built
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.bundle.weigh_sheet import weigh_sheet
from jumpcad.design import load_design
from jumpcad.simulation import simulate


def test_a_part_weighed_heavier_costs_what_the_sheet_says() -> None:
    """A gram on any body, in a robot built with it; the sheet has nearly all of the robot's mass."""
    robot = built("kenan-2.0")
    rows = {row["part"]: row for row in csv.DictReader(io.StringIO(weigh_sheet(robot).lstrip("\ufeff")))}
    assert sum(float(row["computed_g"]) for row in rows.values()) == pytest.approx(1000.0 * robot.mass_kg, rel=0.06)
    plain = simulate(robot, engine="planar")
    assert plain.touchdown_distance_m is not None
    assert plain.com_rise_m is not None
    for part in (one for one in robot.parts if one.name in ("main_leg", "foot", "electronics_tray_lower")):
        grams = {part.name: 1000.0 * part.mass_kg + 1.0}
        jump = simulate(build(load_design("kenan-2.0"), workshop_with(mass={"weighed_g": grams})), engine="planar")
        assert jump.touchdown_distance_m is not None
        assert jump.com_rise_m is not None
        changes = jump.touchdown_distance_m - plain.touchdown_distance_m, jump.com_rise_m - plain.com_rise_m
        told = float(rows[part.name]["touchdown_mm_per_g"]), float(rows[part.name]["rise_mm_per_g"])
        assert [1000.0 * one for one in changes] == pytest.approx(told, abs=0.03), part.name
