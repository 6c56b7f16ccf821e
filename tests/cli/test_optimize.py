"""`jumpcad optimize`, with the capsule robot."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from support.commands import interruptible
from support.searches import NARROW, QUICK, data, refusal, run
from typer.testing import CliRunner

import jumpcad.search.optimization  # noqa: F401  # before its pool is replaced
from jumpcad.cli.commands import app
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, limits_of, load_design
from jumpcad.search.models import robot_model
from jumpcad.search.study import run as study

JUMPCAD = [sys.executable, "-m", "jumpcad"]


@pytest.mark.thorough
def test_optimize_finds_a_jumper_and_writes_it(folder):
    found = data("optimize", *QUICK, "--study", "s.db", "--evaluations", 48, "-o", "best.toml")
    assert found["searched"] == 36
    assert 36 < found["evaluations"] <= 48
    prototype = data("simulate", "kenan-2.0", "--capsule", "--settings", "screening")
    assert found["best"]["fitness"] == found["best"]["score"] > 1.5 * prototype["fitness"]
    assert set(found["best"]["design"]) == set(PARAMETERS)
    winner = load_design("best.toml")
    assert winner.model_dump() == found["winner"]["design"] == found["candidates"][0]["design"]
    design, box = found["winner"]["design"], SEARCH_BOUNDS.items()
    on_a_bound = {
        (name, side)
        for name, bound in box
        for side, limit, end in zip(("lower", "upper"), (bound.lower, bound.upper), limits_of(name), strict=True)
        if abs(design[name] - limit) <= 1e-3 * (bound.upper - bound.lower) and limit != end
    }
    assert {(one["name"], one["side"]) for one in found["active_bounds"]} == on_a_bound
    shown = run("optimize", *QUICK, "--study", "s.db", "--evaluations", 48, "-o", "best.toml")
    assert "next: jumpcad build best.toml" in shown
    assert "evaluations: 36 for the search, 12 for the robust pick" in shown
    assert f"study s.db: {found['method']} on the capsule robot, free parameters: {len(PARAMETERS)}\n" in shown
    summary = data("study", "s.db")
    assert summary["evaluations"] == summary["planned"] == 36
    assert summary["evaluations"] + summary["other_evaluations"] == found["evaluations"]
    assert summary["best"]["score"] == found["best"]["score"]
    assert f"{found['best']['score']:.6g}" in run("study", "s.db")


def test_what_optimize_finds_jumps_like_that(folder):
    found = data("optimize", "bo", *QUICK, "--evaluations", 16, "-o", "best.toml")
    jump = data("simulate", "best.toml", "--capsule", "--settings", "screening")
    assert json.dumps(found["winner"]["score"]) in json.dumps(jump)


@pytest.mark.thorough
def test_what_a_search_began_with_has_the_figures_of_the_robot_alone(folder):
    """None that a search adds to learn from."""
    near = ("--around", "best-printable", "--only", "c_coef", "--within", 1)
    found = data("optimize", "bo", *near, "--evaluations", 1, "--workers", 0)
    assert found["began_with"].keys() == robot_model()(load_design("best-printable")).metrics.keys()


@pytest.mark.thorough
def test_pareto_reports_its_front(folder):
    found = data("optimize", "pareto", *QUICK, *NARROW, "--evaluations", 16, "--study", "p.db", "--plots", "pics")
    energies = [trial["metrics"]["spring_energy_j"] for trial in found["front"]]
    ranges = [trial["metrics"]["ballistic_range_m"] for trial in found["front"]]
    assert energies == sorted(energies)
    assert ranges == sorted(ranges)
    assert found["hypervolume"] > 0.0
    assert {Path(picture).name for picture in found["pictures"]} >= {"pareto.svg", "history.svg", "slices.svg"}


def test_nothing_jumps_is_exit_code_1(folder):
    weak = ["--fix", "stiffness_nmm_per_deg=5", "--fix", "compression_ratio=0.1"]
    assert data("optimize", "ga", *QUICK, *weak, "--evaluations", 20, code=1)["best"] is None
    assert "no design jumps" in run("optimize", "ga", *QUICK, *weak, "--evaluations", 20, code=1)


def test_an_objective_that_tells_nothing_apart_is_exit_code_1_and_no_file(folder):
    """Equal scores have not converged: the search goes on to its end, and makes no pick among them."""
    Path("flat.py").write_text("def flat(figures):\n    return 2.0\n")
    asked = ("optimize", *QUICK, *NARROW, "--evaluations", 32, "--until", 100, "--objective", "flat.py:flat")
    said = run(*asked, code=1)
    assert "every design that jumps scores 2: flat tells none apart; choose another objective; rejected: " in said
    assert "next:" not in said
    found = data(*asked, code=1)
    assert (found["winner"], found["design_file"], found["converged"], found["searched"]) == (None, None, False, 24)
    assert found["candidates"] == []
    assert "tells none apart" in found["notes"][-1]
    assert not list(Path().glob("*.toml"))


@pytest.mark.thorough
def test_says_that_it_ended_early_and_how_it_goes_on(folder):
    asked = ("optimize", *QUICK, *NARROW, "--evaluations", 60, "--study", "s.db", "-o", "best.toml")
    said = run(*asked, "--until", 20)
    assert "ended before 45: in its last steps less than 20 % of the best score was gained; --until 0 goes on" in said
    longer = run(*asked, "--until", 0, "--force")
    assert "45 designs evaluated" in longer
    assert "ended before" not in longer


@pytest.mark.thorough
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_or_sigterm_keeps_what_is_finished_and_the_same_command_goes_on(folder, number):
    command = [*JUMPCAD, "optimize", "ga", "--model", "capsule", "--evaluations", "400", "--study", "s.db", "--json",
               "--settings", "fine", "--workers", "1"]  # fmt: skip
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=interruptible,
    )
    while process.poll() is None and not (Path("s.db").exists() and data_or_none("s.db")):
        time.sleep(0.2)
    if number == signal.SIGINT:
        os.killpg(process.pid, number)  # as a terminal does it: to the workers too
    else:
        os.kill(process.pid, number)  # as queues and `kill` do it
    out, err = process.communicate()
    assert process.returncode == 128 + number
    assert out == ""
    assert err.splitlines() == [
        "jumpcad: s.db keeps all evaluations that ended; the same command goes on", "jumpcad: interrupted",
    ]  # fmt: skip
    kept = data("study", "s.db")["evaluations"]
    assert 0 < kept < 400


def data_or_none(path):
    """Return how many trials a study has, 0 while it has none."""
    result = CliRunner().invoke(app, ["study", path, "--json"])
    return json.loads(result.stdout)["evaluations"] if result.exit_code == 0 and not result.exception else 0


def test_a_design_that_is_edited_while_the_search_runs_is_kept_unless_it_is_to_be_replaced(folder, monkeypatch):
    search = study.run_study

    def edited(*given):
        Path("best.toml").write_text("# mine\n")
        return search(*given)

    monkeypatch.setattr(study, "run_study", edited)
    asked = ("optimize", "ga", *QUICK, *NARROW, "--evaluations", 12, "--study", "s.db", "-o", "best.toml")
    assert "best.toml: exists already" in refusal(*asked)
    assert Path("best.toml").read_text() == "# mine\n"
    assert "next: jumpcad build best.toml" in run(*asked, "--force")
    assert load_design("best.toml").c_coef == 1.0
