"""Every example runs, at a small budget, and prints what it promises.

One runs as its user runs it, in a process with a worker; the others in this process, where imports are paid for.
"""

import os
import re
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.pictures import with_plain_figures
from support.places import ROOT
from support.proposals import with_less_work

EXAMPLES = {
    "paper_pipeline": ["--model", "capsule", "--evaluations", "20", "--points", "3", "--folder", "out"],
    "one_spring": ["--model", "capsule", "--evaluations", "60"],
    "pareto_front": ["--model", "capsule", "--evaluations", "24", "--folder", "out"],
    "custom_printer": ["--folder", "out"],
    "when_to_release": ["--episodes", "2"],
    "learn_to_steer": ["--rounds", "1", "--episodes", "1", "--candidates", "2", "--workers", "1"],
    "remote": ["wind", "turn 30", "jump", "turn 30", "--port", "/dev/ttyACM0"],
}


def test_every_example_is_run():
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == set(EXAMPLES)


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[[str], str]:
    """Return a function that runs an example here and returns what it prints; designs are evaluated here, too.

    Proposals and plots are made with less work.
    """
    with_less_work(monkeypatch)
    with_plain_figures(monkeypatch)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: set(), raising=False)  # no core for a worker

    def call(name: str) -> str:
        monkeypatch.setattr(sys, "argv", [name, *EXAMPLES[name]])
        runpy.run_path(str(ROOT / "examples" / f"{name}.py"), run_name="__main__")
        return capsys.readouterr().out

    return call


def test_paper_pipeline(run, tmp_path):
    assert "robust pick" in run("paper_pipeline")
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written >= {"sweeps.svg", "history.svg", "slices.svg", "parallel.svg", "winner.toml", "study.db"}


def test_one_spring_is_used_better_than_by_the_prototypes(run):
    shown = run("one_spring")
    scores = [float(score) for score in re.findall(r": ([\d.]+) of the longest link", shown)]
    assert len(scores) == 3
    assert scores[2] >= scores[1] > scores[0]  # as the study found: 2.0 beats 1.0, and its links are not the best
    assert "stiffness_nmm_per_deg = 9.2" in shown


def one_core() -> None:
    """Leave a process one core, so that it starts one worker."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:1])


def test_pareto_front_rises_in_a_process_with_a_worker(tmp_path):
    command = [sys.executable, str(ROOT / "examples" / "pareto_front.py"), *EXAMPLES["pareto_front"]]
    surroundings = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, env=surroundings, preexec_fn=one_core, check=False
    )
    assert done.returncode == 0, done.stderr
    rows = re.findall(r"^ +([\d.]+) +([\d.]+)$", done.stdout, re.M)
    ranges = [float(score) for _, score in rows]
    assert len(rows) > 3
    assert ranges == sorted(ranges)
    assert (tmp_path / "out" / "front.svg").is_file()


@pytest.mark.usefixtures("checked_once")
def test_custom_printer(run):
    shown = run("custom_printer")
    assert "a small printer in the corner" in shown
    assert "Original Prusa" in shown


def test_a_rule_jumps_farther_than_chance(run):
    pytest.importorskip("gymnasium")
    ways = dict(re.findall(r"^(\S[\w ]+?) +(-?\d+) mm in 30 s", run("when_to_release"), re.M))
    assert len(ways) == 4
    assert int(ways["at once"]) > int(ways["by chance"])


@pytest.mark.thorough
def test_learning_to_steer_tries_new_points():
    pytest.importorskip("gymnasium")
    command = [sys.executable, str(ROOT / "examples" / "learn_to_steer.py"), *EXAMPLES["learn_to_steer"]]
    said = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(ROOT)}).stdout
    assert len(re.findall(r"\d of 5 new points at 1\.3 m reached", said)) == 2


def test_remote_sends_each_command_once_the_one_before_has_ended(run, monkeypatch: pytest.MonkeyPatch):
    """A cable at whose end a robot answers as the firmware does; the last turn is refused, since it is not wound."""
    answers = {
        "wind": ["winding: winding; 0 jumps", "", "ready: keep away from the leg; 0 jumps"],
        "turn 30": ["turning by 30 degrees, 1.5 s", "", "turned"],
        "jump": ["releasing: releasing; 0 jumps", "idle: jump 1; 1 jumps"],
    }
    sent, coming = list[str](), list[str]()

    def write(data: bytes) -> None:
        assert not coming, "the last command has not ended"
        sent.append(data.decode().strip())
        coming.extend(["it turns only while it is wound: wind first"] if sent[-1] in sent[:-1] else answers[sent[-1]])

    port = SimpleNamespace(write=write, readline=lambda: coming.pop(0).encode())
    monkeypatch.setitem(sys.modules, "serial", SimpleNamespace(Serial=lambda *_, **__: port))
    monkeypatch.setattr("time.sleep", lambda _: None)
    with pytest.raises(SystemExit):
        run("remote")
    assert sent == EXAMPLES["remote"][:4]
