"""Axles, springs and bearings: overloaded, and after many jumps."""

import math
import re
from dataclasses import replace

import pytest
from support.fits import LOADS
from support.strengths import changed, helped, margins, strength_findings

from jumpcad.building import build
from jumpcad.robot.axles import steel
from jumpcad.robot.load_case import load_case
from jumpcad.robot.robot import Robot


def test_hub_bearings_warn_when_the_springs_overload_them(strongest: Robot) -> None:
    weak = changed(strongest, "bought", leg_bearing="MR63")
    (finding,) = [found for found in strength_findings(build(weak.design, weak.workshop)) if "bearing" in found.name]
    assert (finding.name, finding.severity, finding.unit) == ("hub_bearing_load", "warning", "N")
    # an arm's force is torque over its length; the roller's middle is 6.5 mm from the leg's, the bearings 5.5 mm apart
    assert weak.layout is not None
    arms = 1000.0 * weak.design.peak_spring_torque_nm / weak.layout.drive.spring.arms.lever_mm
    cam = weak.layout.drive.cam.peak_contact_n
    assert finding.margin == pytest.approx(75.0 / 0.5 / LOADS - (arms / 2.0 + cam * (0.5 + 6.5 / 5.5)), rel=0.06)


def test_what_lasts_too_few_jumps_warns(kenan: Robot, strongest: Robot) -> None:
    lasting = changed(kenan, "safety", jumps=1e6)
    (finding,) = [found for found in strength_findings(lasting) if found.severity == "warning"]
    assert finding.name == "spring_fatigue"
    life = re.search(r"of 950 MPa for 1e\+06 jumps; its life is about (\S+)", finding.message)
    assert life is not None  # half of 1900 MPa (EN 10270-1, 1.3 mm)
    assert 9e4 < float(life[1]) < 1e5  # 1008 MPa; 53 % of the strength, 1007 MPa, last 1e5 (Shigley 10-10)
    soft = changed(changed(strongest, "safety", jumps=1e6), "safety", steel_yield_mpa=900.0)
    assert {"axle_fatigue"} <= {found.name for found in strength_findings(soft) if found.severity == "warning"}
    built_for_it = build(lasting.design, lasting.workshop)
    assert margins(built_for_it)["spring_fatigue"] > 0.0
    assert built_for_it.layout is not None
    assert built_for_it.layout.drive.spring.mass_g > kenan.layout.drive.spring.mass_g  # type: ignore[union-attr]


def test_axles_and_pins_stay_in_a_landing_sideways(kenan: Robot) -> None:
    """All of the landing's friction, 0.8 of its force, along one axle; floors of 0.8 mm PLA shear off around 3 mm."""
    usual = {found.name: found for found in strength_findings(kenan)}
    force = 0.8 * usual["front_link_buckling"].value
    strength = kenan.workshop.materials["PLA"].strength_in_plane_mpa / (3.0 * LOADS)
    floor = math.pi * 3.0 * 0.8 * strength / math.sqrt(3.0)
    assert (usual["axle_retention"].value, usual["axle_retention"].limit) == pytest.approx((force, floor))
    assert usual["pin_retention"].limit == pytest.approx(80.0 / 1.5 / LOADS)
    hard = changed(kenan, "safety", landing_stop_mm=0.5)
    worse = {found.name for found in strength_findings(hard) if found.severity == "error"}
    assert {"axle_retention", "pin_retention"} <= worse


def test_the_legs_pin_is_a_cantilever_beside_the_leg(kenan: Robot) -> None:
    """The arm pushes half a wire and 0.5 mm beside the leg; the pin is held in it, from a quarter of its width on."""
    (pin,) = (found for found in strength_findings(kenan) if found.name == "leg_pin_strength")
    spring = kenan.layout.drive.spring
    lever = 0.5 + spring.wire_mm / 2.0 + kenan.layout.sections.thickness_mm / 4.0
    assert pin.value == pytest.approx(32.0 * spring.pin_force_n * lever / (math.pi * 27.0))
    assert pin.limit == pytest.approx(400.0 / 1.5 / LOADS)


def test_what_an_axle_is_made_of_counts(kenan: Robot) -> None:
    """A bore of two thirds leaves 1 - (2/3)^4 of the section modulus; a lighter metal yields earlier."""
    solid = {found.name: found for found in strength_findings(kenan)}["leg_axle_strength"]
    tube = {f.name: f for f in strength_findings(changed(kenan, "bought", axle="steel-tube"))}["leg_axle_strength"]
    assert tube.value == pytest.approx(solid.value / (1.0 - 0.6667**4))
    assert tube.limit == pytest.approx(solid.limit * 210.0 / 1370.0)


def test_what_is_advised_for_a_weak_axle_holds(kenan: Robot) -> None:
    """The yield stress that is named is enough, and so is the diameter: the stress falls with its cube."""
    weak = changed(kenan, "bought", axle="steel-tube")
    found = {one.name: one for one in strength_findings(weak)}["leg_axle_strength"]
    assert found.severity == "error"
    needed = float(found.remedy.partition(" MPa")[0])
    assert needed / 1.5 / LOADS == pytest.approx(found.value, rel=0.01)
    assert "silver-steel" not in found.remedy.partition("bought.axle_mm")[0] or needed <= 400.0
    diameter = float(found.remedy.partition("bought.axle_mm of ")[2].partition(" ")[0])
    assert found.value * (3.0 / diameter) ** 3 <= 1.02 * found.limit


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_what_tires_first_is_not_what_bears_the_largest_stress(robot: str, request: pytest.FixtureRequest) -> None:
    """Pins of 400 MPa beside axles of 1370 MPa, here a tenth as strong: the nearest to its yield stress."""
    strong = request.getfixturevalue(robot)
    for pins_mpa in (1370.0, 137.0):
        case = load_case(replace(strong))
        weak = {name: replace(case.bars[name], yield_mpa=pins_mpa) for name in ("foot_pin", "leg_pin")}
        case.__dict__["bars"] = case.bars | weak
        used = {name: stress / case.bars[name].yield_mpa for name, stress in case.steel_stresses_mpa.items()}
        worst = max(used, key=used.__getitem__)
        (axle,) = (found for found in steel.steel_findings(case.robot) if found.name == "axle_fatigue")
        assert axle.message.startswith(f"the {worst.replace('_', ' ')}: ")
        assert axle.value == case.steel_stresses_mpa[worst]


def test_the_axle_nearest_to_its_own_fatigue_limit_counts(kenan: Robot) -> None:
    """Hard steel loses more of its yield stress to a million jumps than soft steel does."""
    case = load_case(changed(kenan, "safety", jumps=1e6))
    hard, soft = (case.bars[name].yield_mpa for name in ("leg_axle", "leg_pin"))
    assert hard > 2.0 * soft
    vars(case)["steel_stresses_mpa"] = {"leg_axle": 0.49 * hard, "leg_pin": 0.50 * soft}
    (finding,) = (found for found in steel.steel_findings(case.robot) if found.name == "axle_fatigue")
    assert (finding.severity, finding.value) == ("warning", pytest.approx(0.49 * hard))


@pytest.mark.parametrize("robot", ["kenan", "strongest"])
def test_the_rollers_screw_is_a_cantilever_beside_the_lever(robot: str, request: pytest.FixtureRequest) -> None:
    """The roller's middle, 2 mm behind a washer of 0.5 mm; an M3 has a core of 2.39 mm (ISO 724)."""
    strong = request.getfixturevalue(robot)
    (screw,) = (found for found in strength_findings(strong) if found.name == "roller_screw_strength")
    force = strong.layout.drive.cam.peak_contact_n
    assert screw.value == pytest.approx(32.0 * force * 2.5 / (math.pi * 2.387**3), rel=0.01)
    assert screw.limit == pytest.approx(640.0 / 1.5 / LOADS)  # property class 8.8


def test_what_is_advised_to_lower_or_to_raise_helps_the_steel(strongest: Robot) -> None:
    """Of what the landing's force bends; the springs' own arms and the cam stay as they are."""
    assert "foot_pin_strength" in helped(strongest, steel.steel_findings)


@pytest.mark.parametrize("jumps", [1e3, 3000.0, 1e6])
def test_a_rod_has_its_yield_stress_over_0_78_as_tensile_strength(kenan: Robot, jumps: float) -> None:
    """Goodman's line by hand, for a stress that is half mean, half amplitude (Shigley 6-12, figure 6-18)."""
    case = load_case(changed(kenan, "safety", jumps=jumps))
    (finding,) = (found for found in steel.steel_findings(case.robot) if found.name == "axle_fatigue")
    name = finding.message.removeprefix("the ").partition(":")[0].replace(" ", "_")
    tensile = case.bars[name].yield_mpa / 0.78
    endless = min(tensile / 2.0, 700.0) * min(1.0, 4.51 * tensile**-0.265)
    of_way = (math.log10(jumps) - 3.0) / 3.0
    lasts = math.exp((1.0 - of_way) * math.log(0.77 * tensile) + of_way * math.log(endless))
    allowed = min(2.0 / (1.0 / lasts + 1.0 / tensile), 0.78 * tensile)
    assert finding.limit == pytest.approx(allowed / LOADS)
