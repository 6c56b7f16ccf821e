"""Robots of others: published figures with their sources, flights, families of geometries, and what is judged."""

import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.calibrations import with_coarse_calibration
from support.pictures import with_plain_figures

from jumpcad.cli.commands import run
from jumpcad.errors import JumpcadError
from jumpcad.simulation.published_robots import load_facts
from jumpcad.validation import table
from jumpcad.validation.family import family
from jumpcad.validation.table import TIERS, thrown, validate

ENERGY = "kovac-2008.spring_energy_j"
SMALL = partial(family, members=4, generations=1, draws=60)
G = 9.81


def test_throws_without_air_are_parabolas() -> None:
    for speed, angle in ((1.6, 90.0), (5.96, 75.0), (3.0, 20.0)):
        up = speed * math.sin(math.radians(angle))
        flight = thrown(speed, angle, 0.0, 7.0)
        assert flight.rise_m == pytest.approx(up**2 / 2.0 / G)
        assert flight.deepest_s == pytest.approx(2.0 * up / G)
        assert flight.range_m == pytest.approx(4.0 * flight.rise_m / math.tan(math.radians(angle)))


def test_air_takes_what_the_closed_form_says() -> None:
    """Straight up through quadratic drag: rise = ln(1 + k·v²/g) / 2k, k = ½·ρ·c_d·A/m."""
    per_m = 0.5 * 1.2 * 15.6e-4 / 7e-3
    assert thrown(5.96, 90.0, 15.6e-4, 7.0).rise_m == pytest.approx(math.log1p(per_m * 5.96**2 / G) / (2.0 * per_m))


@pytest.mark.thorough
def test_members_have_the_published_mass_and_energy_and_take_off_as_published() -> None:
    known: dict[str, float] = {"mass_g": 7.0, "spring_energy_j": 0.154, "takeoff_angle_deg": 75.0, "pushoff_ms": 15.0}
    members, again = (SMALL(**known, seed=3) for _ in range(2))  # type: ignore[arg-type]
    assert [one.values.tolist() for one in members] == [one.values.tolist() for one in again]
    for one in members:
        jump = one.jump
        assert jump is not None
        assert jump.mass_kg == pytest.approx(0.007)
        assert jump.spring_energy_j == pytest.approx(0.154 * one.values[-1], rel=1e-6)
        assert one.efficiency == pytest.approx(0.5 * 0.007 * jump.takeoff_speed_m_s**2 / 0.154, rel=1e-6)
        assert jump.takeoff_angle_deg == pytest.approx(75.0, abs=15.0)
        assert 1e3 * jump.takeoff_time_s == pytest.approx(15.0, abs=7.5)


def test_no_geometry_is_one_line() -> None:
    with pytest.raises(JumpcadError, match=r"no geometry of 7 g and 0\.001 J takes off at 75° after 15 ms"):
        SMALL(mass_g=7.0, spring_energy_j=0.001, takeoff_angle_deg=75.0, pushoff_ms=15.0, seed=0)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few robots, few flights."""
    with_plain_figures(monkeypatch)
    with_coarse_calibration(monkeypatch)
    monkeypatch.setattr(table, "family", SMALL)
    monkeypatch.setattr(table, "DRAWS", 4)


def rows(robots: list[dict[str, Any]], key: str) -> dict[str, dict[str, Any]]:
    return {row["name"]: row for one in robots if one["key"] == key for row in one["figures"]}


@pytest.mark.thorough
@pytest.mark.usefixtures("quick")
def test_a_remembered_figure_judges_nothing_until_it_is_entered(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    by_energy = [("kovac-2008", "takeoff_speed_m_s"), ("kovac-2008", "efficiency"), ("kovac-2009", "height_m"),
                 ("kovac-2010", "height_m")]  # fmt: skip
    assert run(["validate", "--json"]) == 0
    robots = json.loads(capsys.readouterr().out)["robots"]
    assert {rows(robots, key)[name]["verdict"] for key, name in by_energy} == {"not judged"}
    assert rows(robots, "msu-2013")["distance_m"]["verdict"] == "agrees"
    assert rows(robots, "seu-2012")["distance_m"]["verdict"] == "differs"
    strider = rows(robots, "strider-2015")["height_m"]
    assert strider["measured"] > 1.65**2 / (2.0 * G) >= strider["high"]  # without air, of 1.6 m/s as rounded
    assert strider["verdict"] == "above the bound"
    assert len({one["key"] for one in robots}) >= 10
    assert [one["tier"] for one in robots] == sorted((one["tier"] for one in robots), key=TIERS.index)
    for one in robots:
        for row in one["figures"]:
            assert {"name", "measured", "confidence", "source", "low", "median", "high"} <= set(row)
            assert row["low"] is None or row["low"] <= row["median"] <= row["high"]
    entered = validate({ENERGY: 0.154})
    verdicts = [rows(entered, key)[name]["verdict"] for key, name in by_energy]
    assert set(verdicts) <= {"agrees", "differs", "below the bound", "above the bound"}
    assert rows(entered, "kovac-2008")["efficiency"]["measured"] == pytest.approx(0.0035 * 5.96**2 / 0.154)
    capsys.readouterr()
    assert run(["validate", "--plots", str(tmp_path)]) == 0
    assert (tmp_path / "validation.png").exists()
    assert "differs: a parabola of 0.90 m height" in capsys.readouterr().out


@pytest.mark.thorough
@pytest.mark.usefixtures("quick")
def test_entered_figures_that_disagree_are_not_computed() -> None:
    """No flight of 5.96 m/s reaches 5 m, and no cage makes the robot of 2009 lighter than that of 2008."""
    robots = validate({"kovac-2008.height_m": 5.0, "kovac-2009.mass_g": 3.0})
    assert rows(robots, "kovac-2008")["jump_s"]["low"] is None
    assert rows(robots, "kovac-2009")["height_m"]["verdict"] == "not judged"


def test_a_wrong_figure_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    for given, said in (
        (f"{ENERGY}=0.1", "would be an efficiency of 1.24, above 1: check mass, speed and spring energy"),
        (f"{ENERGY}=154", "the file has 0.154: give it in the unit of its name"),
        ("kovac-2008.springs_energy_j=0.154", f"no robot has this figure (did you mean {ENERGY}?)"),
        (ENERGY, "give ROBOT.NAME=VALUE, as kovac-2008.spring_energy_j=0.154"),
        ("kovac-2008.takeoff_angle_deg=100", "the file has 75: give it in the unit of its name"),
        (f"{ENERGY}=nan", "give it in the unit of its name"),
    ):
        assert run(["validate", "--figure", given]) == 2
        error = capsys.readouterr().err
        assert said in error, error
        assert error.count("\n") == 1
        assert str(Path.cwd()) not in error


def test_published_figures_that_follow_from_each_other_do() -> None:
    """Kinetic energies and efficiencies as their notes say; the flea's published 0.055 J."""
    facts = load_facts().robots
    epfl, flea = facts["kovac-2008"], facts["flea-2013"]
    kinetic = 0.5 * epfl.value("mass_g") / 1e3 * epfl.value("takeoff_speed_m_s") ** 2
    assert kinetic / epfl.value("spring_energy_j") == pytest.approx(epfl.value("efficiency"), abs=0.005)
    assert 0.5 * flea.value("mass_g") / 1e3 * flea.value("takeoff_speed_m_s") ** 2 == pytest.approx(0.055, abs=5e-4)
    assert not epfl.sure("efficiency")
    assert np.isfinite([figure.value for one in facts.values() for figure in one.figures.values()]).all()
