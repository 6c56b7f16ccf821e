"""Formula and source of every limit: each finding has them, and the formulas by hand give the findings' figures."""

import json
import math
import re
import tomllib
from collections.abc import Iterator
from fnmatch import fnmatchcase

import pytest
from support.built import LONG_TOES, built, checked
from support.documented import documented_bases
from support.each import each
from support.places import ROOT

from jumpcad import checks
from jumpcad.checks import basis_of, quick_findings
from jumpcad.findings import SHOWN_AS, Basis, Finding
from jumpcad.simulation import planar
from jumpcad.workshop import load_workshop

TABLES = (*(check.basis for check in checks.CHECKS), planar.BASIS)
BASES = {name: basis for table in TABLES for name, basis in table.items()}
NOT_MET = {"winding", "toe_joint_strength", "idler_axle_strength", "engraving", "no_takeoff", "body_contact",
           "cage_rights", "stop_creep"}  # fmt: skip
"""In the robots of the reference; they are told of others."""
YES_OR_NO = {"wiring_pins", "wiring_strapping", "wiring_ground", "wiring_cut_off", "wiring_capacitor", "wiring_diode"}
NOTHING = {"interference", "assembly_paths", "tool_access", "solid"}
"""Limits of what must not be there at all."""
BUNDLE = ROOT / "exports" / "kenan-2.0"


def test_every_finding_has_formula_and_source() -> None:
    found = {finding.name for finding in (*checked("kenan-2.0"), *quick_findings(built(LONG_TOES)))}
    assert len(found) > 80
    assert {name for name in found if basis_of(name) is None} == set()


def test_they_stand_with_the_check_that_makes_the_finding() -> None:
    for check in checks.CHECKS:
        if check.cheap:
            names = {finding.name for finding in check.find(built("kenan-2.0"))}
            assert {name for name in names if not any(fnmatchcase(name, known) for known in check.basis)} == set()


def test_the_reference_tells_each_once() -> None:
    assert documented_bases(BASES) == BASES
    page = (ROOT / "docs" / "reference" / "checks.md").read_text(encoding="utf-8")
    blocks = dict(re.findall(r"^### `([^`]+)`\n(.*?)(?=^##|\Z)", page, re.S | re.M))
    assert set(blocks) == set(BASES)
    assert {name for name, block in blocks.items() if "Not met" in block} == NOT_MET


@each("name", BASES)
def test_formula_and_source_name_what_there_is(name: str) -> None:
    basis, workshop = BASES[name], load_workshop("default")
    assert basis.formula.strip(" .") == basis.formula
    assert basis.source.strip(" .") == basis.source != ""
    for table, key in re.findall(r"\b(safety|fits|seats|process|release|body)\.([a-z_0-9]+)", basis.formula):
        assert hasattr(getattr(workshop, table), key)
    for path in re.findall(r"\b(?:jumpcad|templates|tests)/[\w/]+(?:\.\w+)?", f"{basis.formula} {basis.source}"):
        assert (ROOT / path).exists()


def test_value_and_limit_stand_in_the_text() -> None:
    found = (*checked("kenan-2.0"), *quick_findings(built(LONG_TOES)))
    findings = [finding for finding in found if finding.name not in YES_OR_NO | NOTHING]
    assert [finding.message for finding in findings if len([*_numbers(finding)]) < 2] == []
    missing = [
        (finding.name, figure, finding.message)
        for finding in findings
        for figure in (finding.value, finding.limit)
        if figure is not None
        and not any(math.isclose(figure, number, abs_tol=off) for number, off in _numbers(finding))
    ]
    assert missing == []


def _numbers(finding: Finding) -> Iterator[tuple[float, float]]:
    """Yield the numbers of a text in the finding's unit, with what rounding takes."""
    shown, factor = SHOWN_AS.get(finding.unit, ("", 1.0))
    for text in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?", finding.message):
        decimals = len(text.partition(".")[2])
        scale = factor if shown and shown in finding.message else 1.0
        yield float(text) / scale, 0.51 * 10.0**-decimals / scale


@pytest.fixture(scope="module")
def by_hand() -> dict[str, tuple[float | None, float | None]]:
    """Return value and limit of some findings from the figures of Kenan 2.0's manifest, by the formulas."""
    manifest = json.loads((BUNDLE / "manifest.json").read_text(encoding="utf-8"))
    design = tomllib.loads((BUNDLE / "design.toml").read_text(encoding="utf-8"))
    spring, released, stop = manifest["drive"]["springs"][0], manifest["drive"]["release"], manifest["stop"]
    reserve = 1.10 * 1.05
    s, mass, degree = 3.0 * reserve, manifest["mass_kg"], math.radians(1.0)
    loaded_deg = design["compression_ratio"] * design["rest_angle_deg"]  # c_coef = 1: the body stands level
    energy_j = 0.5 * design["stiffness_nmm_per_deg"] / degree / 1000.0 * (loaded_deg * degree) ** 2
    landing_n = mass * 9.81 + energy_j / 0.020
    wire, index = spring["wire_mm"], spring["inside_diameter_mm"] / spring["wire_mm"] + 1.0
    stress = (index + 0.07) / (index - 0.75) * 32.0 * spring["rate_nmm_per_deg"] * loaded_deg / (math.pi * wire**3)
    lasting = 0.78 * (3000.0 / 1e3) ** (math.log(0.53 / 0.78) / math.log(1e5 / 1e3))
    # front link of 6 x 6 mm: three walls of 0.45 mm, 0.9 mm of layers, and 0.5 x 40 % of infill in the core
    second = (6.0 * 6.0**3 - 0.8 * (6.0 - 1.8) * (6.0 - 2.7) ** 3) / 12.0
    turned_deg = released["assumed"][0]["cam_rad_s"] * released["push_off_s"] / degree
    landing = manifest["joints"]["roll_deg"]["landing"]
    return {
        "too_weak": (energy_j, None),
        "front_link_buckling": (landing_n, math.pi**2 * 2000.0 * second / (100.0**2 * s)),
        "spring_stress": (stress, 0.7 * 1900.0 / 1.05),
        "spring_fatigue": (stress, lasting * 1900.0),
        "axle_retention": (0.8 * landing_n, math.pi * 3.0 * 0.8 * 54.0 / math.sqrt(3.0) / s),
        "electronics_hold": (2.0 * 0.008 * landing_n / mass, 25.0 / 3.0),
        "stop_pad": (stop["radius_mm"] * stop["give_deg"] * degree, 0.5 * 2.0),
        "stop_clearance": (math.degrees(0.82 * 2.0 * stop["blow_j"] / stop["torque_nm"]), None),
        "sideways_tipping": (landing["stance"] - landing["play"], 2.0),
        "release_kick": (1100.0 * released["kick_nm"], 1000.0 * released["kick_limit_nm"]),
        "release_window": (released["free_play_deg"] + turned_deg + 3.0, released["window_deg"][1]),
        "motor_torque": (energy_j / (295.0 * degree) / (released["gear_ratio"] * 0.85 * 0.9), None),
        "wiring_contact": (3.3 / 2.2, 1.0),
    }


def test_formulas_by_hand_give_the_figures(by_hand: dict[str, tuple[float | None, float | None]]) -> None:
    found = {finding.name: finding for finding in checked("kenan-2.0")}
    for name, (value, limit) in by_hand.items():
        assert value is None or found[name].value == pytest.approx(value, rel=2e-4), name
        assert limit is None or found[name].limit == pytest.approx(limit, rel=2e-4), name


def test_a_check_without_them_is_no_check() -> None:
    with pytest.raises(TypeError, match="basis"):
        checks.Check(lambda robot: [])  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="source"):
        Basis("F ≤ 1 N")  # type: ignore[call-arg]
