"""Axles, springs and bearings: overloaded, and after many jumps."""

import pytest
from support.strengths import changed, margins

from jumpcad.building import build
from jumpcad.checks.strength import strength_findings
from jumpcad.robot import Robot


def test_hub_bearings_warn_when_the_springs_overload_them(strongest: Robot) -> None:
    weak = changed(strongest, "bought", leg_bearing="MR63")
    (finding,) = [found for found in strength_findings(build(weak.design, weak.workshop)) if "bearing" in found.name]
    assert (finding.name, finding.severity, finding.unit) == ("hub_bearing_load", "warning", "N")
    # an arm's force is torque over its length; the roller's middle is 6.5 mm from the leg's, the bearings 5.5 mm apart
    assert weak.layout is not None
    arms = 1000.0 * weak.design.peak_spring_torque_nm / weak.layout.drive.spring.arms.lever_mm
    cam = weak.layout.drive.cam.peak_contact_n
    assert finding.margin == pytest.approx(75.0 / 0.5 - (arms / 2.0 + cam * (0.5 + 6.5 / 5.5)), rel=0.06)


def test_what_lasts_too_few_jumps_warns(kenan: Robot, strongest: Robot) -> None:
    lasting = changed(kenan, "safety", jumps=1e6)
    (finding,) = [found for found in strength_findings(lasting) if found.severity == "warning"]
    assert finding.name == "spring_fatigue"
    assert "of 960 MPa for 1e+06 jumps; it lasts about 6" in finding.message  # half of 1920 MPa (EN 10270-1, 1.2 mm)
    soft = changed(changed(strongest, "safety", jumps=1e6), "safety", steel_yield_mpa=900.0)
    assert {"axle_fatigue"} <= {found.name for found in strength_findings(soft) if found.severity == "warning"}
    built_for_it = build(lasting.design, lasting.workshop)
    assert margins(built_for_it)["spring_fatigue"] > 0.0
    assert built_for_it.layout is not None
    assert built_for_it.layout.drive.spring.mass_g > kenan.layout.drive.spring.mass_g  # type: ignore[union-attr]
