"""The search on the command line, with the capsule robot."""

import contextlib
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from support.places import ROOT
from typer.testing import CliRunner

from jumpcad.cli import commands
from jumpcad.cli.commands import app
from jumpcad.design import PARAMETERS, load_design

JUMPCAD = [sys.executable, "-m", "jumpcad"]
QUICK = ["--model", "capsule", "--workers", "0", "--settings", "screening"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*arguments, code=0):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments], catch_exceptions=True)
    assert result.exit_code == code, result.output + repr(result.exception)
    return result.stdout


def data(*arguments, code=0):
    return json.loads(run(*arguments, "--json", code=code))


def refusal(*arguments):
    """Return the one line on standard error with which a wrong request ends."""
    with contextlib.redirect_stderr(io.StringIO()) as said:
        assert commands.run([str(argument) for argument in arguments]) == 2
    (line,) = said.getvalue().splitlines()
    return line


def test_optimize_finds_a_jumper_and_writes_it(folder):
    found = data("optimize", *QUICK, "--study", "s.db", "--evaluations", 60, "-o", "best.toml")
    assert found["evaluations"] == 60
    assert found["best"]["fitness"] == found["best"]["score"] > 5.0
    assert set(found["best"]["design"]) == set(PARAMETERS)
    winner = load_design("best.toml")
    assert winner.model_dump() == found["winner"]["design"] == found["candidates"][0]["design"]
    robust = [candidate["robust_score"] for candidate in found["candidates"]]
    assert robust == sorted(robust, reverse=True)
    assert found["active_bounds"]
    shown = run("optimize", *QUICK, "--study", "s.db", "--evaluations", 60, "-o", "best.toml")
    assert "next: jumpcad build best.toml" in shown
    summary = data("study", "s.db")
    assert summary["evaluations"] == summary["planned"] == 60
    assert summary["best"]["score"] == found["best"]["score"]
    assert f"{found['best']['score']:.4f}" in run("study", "s.db")


def test_what_optimize_finds_jumps_like_that(folder):
    found = data("optimize", "bo", *QUICK, "--evaluations", 30, "-o", "best.toml")
    jump = data("simulate", "best.toml", "--capsule", "--settings", "screening")
    assert json.dumps(found["winner"]["score"]) in json.dumps(jump)


def test_without_a_study_file_each_request_has_its_own(folder):
    first = data("optimize", "ga", *QUICK, "--evaluations", 20)["study"]
    assert data("optimize", "ga", *QUICK, "--evaluations", 20)["study"] == first
    assert data("optimize", "ga", *QUICK, "--evaluations", 20, "--seed", 1)["study"] != first


def test_options_of_the_space_arrive(folder):
    found = data(
        "optimize", "ga", *QUICK, "--evaluations", 20, "--fix", "stiffness_nmm_per_deg=9.2",
        "--fix", "rest_angle_deg=88.2", "--bound", "carrying_link_mm=90:110", "--choose", "d_coef=0.7,0.8",
    )  # fmt: skip
    space = data("study", found["study"])["identity"]["space"]
    assert space["stiffness_nmm_per_deg"] == {"fixed": 9.2}
    assert space["carrying_link_mm"] == {"lower": 90.0, "upper": 110.0}
    assert space["d_coef"] == {"choices": [0.7, 0.8]}
    near = data("optimize", "bo", *QUICK, "--evaluations", 10, "--around", "best-bo", "--within", 5)
    assert near["best"]["score"] > 8.0
    only = data("optimize", "bo", *QUICK, "--evaluations", 6, "--around", "best-bo", "--only", "rest_angle_deg")
    assert only["best"]["design"]["e_coef"] == load_design("best-bo").e_coef


def test_pareto_reports_its_front(folder):
    found = data("optimize", "pareto", *QUICK, "--evaluations", 40, "--study", "p.db", "--plots", "pics")
    energies = [trial["metrics"]["spring_energy_j"] for trial in found["front"]]
    ranges = [trial["metrics"]["ballistic_range_m"] for trial in found["front"]]
    assert energies == sorted(energies)
    assert ranges == sorted(ranges)
    assert found["hypervolume"] > 0.0
    assert {Path(picture).name for picture in found["pictures"]} >= {"pareto.svg", "history.svg", "slices.svg"}


def test_studies_compare_and_export(folder):
    for seed in (0, 1):
        run("optimize", "ga", *QUICK, "--evaluations", 20, "--seed", seed, "--study", f"{seed}.db")
    assert len(run("study", "0.db", "1.db").strip().splitlines()) == 2
    assert [one["identity"]["seed"] for one in data("study", "0.db", "1.db")["studies"]] == [0, 1]
    run("study", "0.db", "--export", "t.csv")
    assert (folder / "t.csv").read_text().count("\n") > 20
    assert "one study" in refusal("study", "0.db", "1.db", "--export", "u.csv")


def test_views_of_the_space(folder):
    views = {
        "sweep": ["--points", 3],
        "pca": ["--samples", 200],
        "importance": ["--samples", 200],
        "feasibility": ["--points", 4],
    }
    for view, options in views.items():
        found = data("explore", view, *QUICK, *options, "--plots", "pics")
        assert all(Path(picture).is_file() for picture in found["pictures"])
    assert re.search(r"feasible at \d of 3 values", run("explore", "sweep", *QUICK, "--points", 3))
    assert "equal by construction" in run("explore", "pca", *QUICK, "--samples", 200)
    assert "did you mean sweep" in refusal("explore", "sweeps", *QUICK)


def test_nothing_jumps_is_exit_code_1(folder):
    weak = ["--fix", "stiffness_nmm_per_deg=5", "--fix", "compression_ratio=0.1"]
    assert data("optimize", "ga", *QUICK, *weak, "--evaluations", 20, code=1)["best"] is None
    assert "no design jumps" in run("optimize", "ga", *QUICK, *weak, "--evaluations", 20, code=1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["optimize", "--evaluations", "0"], "evaluations = 0 must be at least 1"),
        (["optimize", "gaa"], "did you mean ga"),
        (["optimize", "--model", "capsul"], "did you mean capsule"),
        (["optimize", "--fix", "stifness_nmm_per_deg=9"], "did you mean stiffness_nmm_per_deg"),
        (["optimize", "--bound", "c_coef=1.2:0.8"], "empty range"),
        (["optimize", "--workers", "-1"], "workers = -1"),
        (["optimize", "--workers", "1", "--dask", "tcp://x"], "exclude each other"),
        (["optimize", "--engine", "ode"], "is not an engine; there are pybullet, mujoco and planar"),
        (["optimize", "--settings", "defalt"], "default"),
        (["optimize", "--around", "nobody"], "neither a TOML file nor one of"),
        (["optimize", "--from-study", "none.db"], "no such study file"),
        (["optimize", "-o", "mine.toml"], "exists already; choose another name, or replace it with --force"),
        (["optimize", "--study", "mine.toml"], "a study file must end in .db"),
        (["optimize", "--study", ":memory:"], "a study file must end in .db"),
        (["optimize", "--study", "."], "is a directory"),
        (["explore", "sweep", "--study", "mine.toml"], "a study file must end in .db"),
        (["optimize", "--study", "nowhere/s.db"], "there is no folder nowhere"),
        (["optimize", "--study", "folder.db"], "is a directory"),
        (["optimize", "--study", "dangling.db", "-o", "aim.toml"], "is no file"),
        (["optimize", "-o", "nowhere/best.toml"], "there is no folder nowhere"),
        (["optimize", "-o", "best.db"], "must end in .toml"),
        (["optimize", "--study", "hard.db", "-o", "mine.toml"], "is the study file itself"),
        (["optimize", "--study", "soft.db", "-o", "mine.toml"], "is the study file itself"),
        (["optimize", "--study", "s.db", "--from-study", "./folder.db/../s.db"], "is the study file itself"),
        (["optimize", "--plots", "mine.toml"], "'mine.toml' is a file"),
        (["optimize", "--plots", "pictures"], "pictures/history.svg: exists already"),
        (["explore", "sweep", "--plots", "pictures"], "pictures/sweeps.svg: exists already"),
        (["study", "none.db"], "no such study file"),
    ],
)
def test_wrong_requests_are_one_line_and_leave_no_study(folder, arguments, message):
    (folder / "mine.toml").write_text("# my own\n" * 100)
    os.link("mine.toml", "hard.db")
    os.symlink("mine.toml", "soft.db")
    os.symlink("aim.toml", "dangling.db")
    (folder / "folder.db").mkdir()
    (folder / "pictures").mkdir()
    (folder / "pictures" / ("history.svg" if arguments[0] == "optimize" else "sweeps.svg")).write_text("mine")
    before = sorted(folder.rglob("*"))
    if arguments[0] == "optimize" and "--model" not in arguments:
        arguments = [*arguments, "--model", "capsule", *(["-o", "other.toml"] if "-o" not in arguments else [])]
    assert message in refusal(*arguments)
    assert (folder / "mine.toml").read_text() == "# my own\n" * 100
    assert sorted(folder.rglob("*")) == before


def test_a_winner_that_somebody_edited_is_kept(folder):
    search = ["optimize", "ga", *QUICK, "--evaluations", 10, "--study", "s.db", "-o", "best.toml", "--plots", "pics"]
    run(*search)
    run(*search[:-2], "--plots", "pics", "--evaluations", 12)  # what jumpcad wrote itself is written again
    winner = (folder / "best.toml").read_text()
    mine = winner.replace("c_coef = ", "c_coef = 1.0 # my own; it was ")
    (folder / "best.toml").write_text(mine)
    assert "best.toml: exists already" in refusal(*search[:-2], "--evaluations", 12)
    assert (folder / "best.toml").read_text() == mine
    run(*search[:-2], "--evaluations", 12, "--force")
    assert (folder / "best.toml").read_text() == winner
    (folder / "pics" / "history.svg").write_text("<svg/>")
    assert "history.svg: exists already" in refusal("study", "s.db", "--plots", "pics")
    assert (folder / "pics" / "history.svg").read_text() == "<svg/>"


def test_ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on(folder):
    command = [*JUMPCAD, "optimize", "ga", "--model", "capsule", "--evaluations", "400", "--study", "s.db", "--json",
               "--settings", "fine"]  # fmt: skip
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        time.sleep(0.2)
        if Path("s.db").exists() and data_or_none("s.db"):
            break
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does it: to the workers too
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert out == ""
    assert err.strip() == "jumpcad: interrupted"
    kept = data("study", "s.db")["evaluations"]
    assert 0 < kept < 400


def data_or_none(path):
    """Return how many trials a study has, 0 while it has none."""
    result = CliRunner().invoke(app, ["study", path, "--json"])
    return json.loads(result.stdout)["evaluations"] if result.exit_code == 0 and not result.exception else 0
