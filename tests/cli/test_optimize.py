"""`jumpcad optimize`, with the capsule robot."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from support.commands import interruptible
from support.searches import NARROW, QUICK, data, run
from typer.testing import CliRunner

from jumpcad.cli.commands import app
from jumpcad.design import PARAMETERS, load_design

JUMPCAD = [sys.executable, "-m", "jumpcad"]


def test_optimize_finds_a_jumper_and_writes_it(folder):
    found = data("optimize", *QUICK, "--study", "s.db", "--evaluations", 48, "-o", "best.toml")
    assert found["searched"] == 36
    assert 36 < found["evaluations"] <= 48
    prototype = data("simulate", "kenan-2.0", "--capsule", "--settings", "screening")
    assert found["best"]["fitness"] == found["best"]["score"] > 1.5 * prototype["fitness"]
    assert set(found["best"]["design"]) == set(PARAMETERS)
    winner = load_design("best.toml")
    assert winner.model_dump() == found["winner"]["design"] == found["candidates"][0]["design"]
    neighbours = [candidate["neighbours"] for candidate in found["candidates"]]
    assert neighbours == sorted(neighbours, reverse=True)
    assert found["active_bounds"]
    shown = run("optimize", *QUICK, "--study", "s.db", "--evaluations", 48, "-o", "best.toml")
    assert "next: jumpcad build best.toml" in shown
    assert "evaluations: 36 for the search, 12 for the robust pick" in shown
    summary = data("study", "s.db")
    assert summary["evaluations"] == summary["planned"] == 36
    assert summary["evaluations"] + summary["other_evaluations"] == found["evaluations"]
    assert summary["best"]["score"] == found["best"]["score"]
    assert f"{found['best']['score']:.4f}" in run("study", "s.db")


def test_what_optimize_finds_jumps_like_that(folder):
    found = data("optimize", "bo", *QUICK, "--evaluations", 16, "-o", "best.toml")
    jump = data("simulate", "best.toml", "--capsule", "--settings", "screening")
    assert json.dumps(found["winner"]["score"]) in json.dumps(jump)


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


def test_says_that_all_designs_of_a_small_space_were_tried(folder):
    fixed = {"c_coef": 1, "d_coef": 0.7, "e_coef": 1, "compression_ratio": 0.5, "rest_angle_deg": 45}
    fixed |= {"stiffness_nmm_per_deg": 20, "ground_link_angle_deg": 30}
    few = [part for name, value in fixed.items() for part in ("--fix", f"{name}={value}")]
    said = run("optimize", *QUICK, *few, "--choose", "carrying_link_mm=100,120,140", "--evaluations", 20)
    assert "3 designs evaluated" in said
    assert "these are all designs of the space" in said


def test_says_that_it_ended_early_and_how_it_goes_on(folder):
    asked = ("optimize", *QUICK, *NARROW, "--evaluations", 60, "--study", "s.db", "-o", "best.toml")
    said = run(*asked, "--until", 20)
    assert "ended before 45: in its last steps less than 20 % of the best score was gained or promised" in said
    longer = run(*asked, "--until", 0, "--force")
    assert "45 designs evaluated" in longer
    assert "ended before" not in longer


def test_ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on(folder):
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
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does it: to the workers too
    out, err = process.communicate()
    assert process.returncode == 130
    assert out == ""
    assert err.strip() == "jumpcad: interrupted"
    kept = data("study", "s.db")["evaluations"]
    assert 0 < kept < 400


def data_or_none(path):
    """Return how many trials a study has, 0 while it has none."""
    result = CliRunner().invoke(app, ["study", path, "--json"])
    return json.loads(result.stdout)["evaluations"] if result.exit_code == 0 and not result.exception else 0
