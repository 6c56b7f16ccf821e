"""`jumpcad report`: the page of a bundle and of a template, and what it refuses."""

import json
import shutil
from pathlib import Path

import pytest
from support.built import built
from support.commands import Run
from support.searches import QUICK

import jumpcad
from jumpcad import checks, comparison
from jumpcad.errors import JumpcadError


@pytest.mark.thorough
def test_the_page_of_a_bundle_takes_its_place_and_is_in_the_manifest(run: Run, bundle: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(bundle, tmp_path / "kenan-2.0")
    code, out, _ = run("report", copy)
    assert (code, out.strip()) == (0, str(copy / "report.html"))
    assert 'id="viewer-glb"' in (copy / "report.html").read_text()  # built without pictures it had none
    assert run("verify", copy)[0] == 0
    asked = run("check", "kenan-2.0", "--next", "--json")[1]
    assert run("report", copy, "--next")[0] == 0
    assert json.loads(asked)["next"][0]["limit"] in (copy / "report.html").read_text().partition("next step")[2]


def test_what_a_study_has_not_is_refused_with_its_value(run: Run) -> None:
    for asked in (["--jumps", "3"], ["--to", "3,0"], ["--course", "c.toml"], ["--next"]):
        code, _, err = run("report", "s.db", *asked)
        assert (code, err.count("\n")) == (2, 1)
        assert f"{' '.join(asked)}: s.db is a study" in err


def test_an_edited_page_of_a_bundle_is_not_replaced(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is refused before the robot is built and drawn."""

    def built(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.cli.subjects.printed_robot", built)
    copy = shutil.copytree(bundle, tmp_path / "kenan-2.0")
    page = copy / "report.html"
    page.write_text(page.read_text() + "mine" if page.exists() else "mine")
    code, _, err = run("report", copy)
    assert (code, err.count("\n")) == (2, 1)
    assert "report.html" in err
    assert "--force" in err
    assert run("report", copy, "--force")[2] == "jumpcad: begun\n"


@pytest.mark.parametrize(("name", "more"), [("kenan-2.0-report.html", ()), ("own.html", ("-o", "own.html"))])
def test_a_users_page_is_not_replaced(run: Run, tmp_path: Path, name: str, more: tuple[str, ...]) -> None:
    (tmp_path / name).write_text("mine")
    code, _, err = run("report", "kenan-2.0", *more)
    assert code == 2
    assert "--force" in err
    assert (tmp_path / name).read_text() == "mine"


def test_the_page_of_a_study_is_a_file_of_its_own_and_is_renewed(run: Run, tmp_path: Path) -> None:
    assert run("optimize", "ga", *QUICK, "--evaluations", 30, "--study", "s.db")[0] == 0
    code, out, _ = run("report", "s.db")
    assert (code, out) == (0, "s-report.html\n")
    page = (tmp_path / "s-report.html").read_text()
    assert "What was asked" in page
    assert "too_weak" in page or "0 of" in page
    assert run("report", "s.db")[0] == 0  # nobody has changed it
    (tmp_path / "s-report.html").write_text(page + "mine")
    code, _, err = run("report", "s.db")
    assert (code, err.count("\n")) == (2, 1)
    assert "--force" in err


LOOP = [100.0, 1.1596, 0.6455, 0.6, 0.8, 70.0, 30.0, 10.0]
"""Numbers whose links cannot close when loaded."""


def test_figures_are_those_of_the_robots_and_what_differs_is_named(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    monkeypatch.setattr(comparison, "HOPS", 1)
    kenan = jumpcad.load_design("kenan-2.0")
    (tmp_path / "stiff.toml").write_text(
        kenan.model_copy(update={"stiffness_nmm_per_deg": 12.0}).to_toml(), encoding="utf-8"
    )
    code, out, err = run("compare", "kenan-2.0", tmp_path / "stiff.toml", "-o", tmp_path / "c.html", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["differs"] == {"stiffness_nmm_per_deg": [9.2, 12.0]}
    first, second = found["robots"]
    assert second["spring_energy_j"] / first["spring_energy_j"] == pytest.approx(12.0 / 9.2)  # U = k·δ²/2
    flown = jumpcad.Settings(flight="simulated")  # in MuJoCo, as `build` tells it
    jump, way = jumpcad.simulate(built("kenan-2.0"), flown, "mujoco"), jumpcad.jumps(built("kenan-2.0"), 1)
    assert first["touchdown_distance_m"] == pytest.approx(jump.touchdown_distance_m)
    assert first["as_made_m"] < first["touchdown_distance_m"]  # springs give 95 % of their energy in the middle
    assert first["metres_per_charge"] == pytest.approx(way.metres_per_charge)
    assert "<h2>kenan-2.0</h2>" in (tmp_path / "c.html").read_text(encoding="utf-8")


def test_one_that_cannot_be_built_leaves_the_others_their_table(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    monkeypatch.setattr(comparison, "HOPS", 1)
    bad = tmp_path / "bad.toml"
    bad.write_text(jumpcad.Design.from_vector(LOOP).to_toml(), encoding="utf-8")
    refused = run("build", bad, "-o", tmp_path / "b")[2].removeprefix("jumpcad: ").strip()
    code, out, err = run("compare", bad, "kenan-2.0", "-o", tmp_path / "c.html", "--json")
    assert (code, err) == (1, "")
    found = json.loads(out)
    assert [one["name"] for one in found["robots"]] == ["kenan-2.0"]
    assert found["refused"] == {str(bad): refused}
    assert "cannot be built: " in (tmp_path / "c.html").read_text(encoding="utf-8")
    assert run("compare", bad, bad, "-o", tmp_path / "d.html")[:2] == (1, "")
    assert not (tmp_path / "d.html").exists()


def test_limits_are_counted_and_named_as_by_check(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A robot that stays on the ground violates one more, which its jump finds and no check of the robot."""
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))
    monkeypatch.setattr(comparison, "HOPS", 1)
    flat = tmp_path / "flat.toml"
    kenan = jumpcad.load_design("kenan-2.0")
    flat.write_text(kenan.model_copy(update={"compression_ratio": 0.05}).to_toml(), encoding="utf-8")
    code, out, _ = run("compare", "kenan-2.0", flat, "-o", tmp_path / "c.html", "--json")
    told = {}
    for robot, one in zip(("kenan-2.0", flat), json.loads(out)["robots"], strict=True):
        told[robot], said, _ = run("check", robot, "--json")
        findings = json.loads(said)["findings"]
        assert one["violated"] == [found["name"] for found in findings if found["severity"] != "info"], robot
        assert one["tightest"] == findings[0]["name"], robot
    assert list(told.values()) == [0, code] == [0, 1]
    assert one["violated"] == ["no_takeoff"]
