"""Every example runs, at a small budget, and prints what it promises."""

import os
import re
import subprocess
import sys

from support.places import ROOT

EXAMPLES = {
    "paper_pipeline": ["--model", "capsule", "--evaluations", "20", "--points", "3", "--folder", "out"],
    "one_spring": ["--model", "capsule", "--evaluations", "60"],
    "pareto_front": ["--model", "capsule", "--evaluations", "24", "--folder", "out"],
    "custom_printer": ["--folder", "out"],
}


def test_every_example_is_run():
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == set(EXAMPLES)


def run(name, folder):
    command = [sys.executable, str(ROOT / "examples" / f"{name}.py"), *EXAMPLES[name]]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(ROOT)}
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_paper_pipeline(tmp_path):
    assert "robust pick" in run("paper_pipeline", tmp_path)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written >= {"sweeps.svg", "history.svg", "slices.svg", "parallel.svg", "winner.toml", "study.db"}


def test_one_spring_is_used_better_than_by_the_prototypes(tmp_path):
    shown = run("one_spring", tmp_path)
    scores = [float(score) for score in re.findall(r": ([\d.]+) of the longest link", shown)]
    assert len(scores) == 3
    assert scores[2] >= scores[1] > scores[0]  # as the study found: 2.0 beats 1.0, and its links are not the best
    assert "stiffness_nmm_per_deg = 9.2" in shown


def test_pareto_front_rises(tmp_path):
    rows = re.findall(r"^ +([\d.]+) +([\d.]+)$", run("pareto_front", tmp_path), re.M)
    ranges = [float(score) for _, score in rows]
    assert len(rows) > 3
    assert ranges == sorted(ranges)
    assert (tmp_path / "out" / "front.svg").is_file()


def test_custom_printer(tmp_path):
    shown = run("custom_printer", tmp_path)
    assert "a small printer in the corner" in shown
    assert "Original Prusa" in shown
