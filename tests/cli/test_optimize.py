"""`jumpcad optimize`, with the capsule robot."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.commands import interruptible
from support.searches import NARROW, QUICK, data, refusal, run
from typer.testing import CliRunner

from jumpcad.cli import optimize
from jumpcad.cli.commands import app
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, limits_of, load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search import study
from jumpcad.search.fronts import find_cost
from jumpcad.search.models import robot_model
from jumpcad.search.objective import Evaluation, find_objective
from jumpcad.search.robust import NOT_EXAMINED, ActiveBound
from jumpcad.search.space import Space
from jumpcad.search.widening import Widened

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
    summary = data("study", "s.db")
    assert summary["evaluations"] == summary["planned"] == 36
    assert summary["evaluations"] + summary["other_evaluations"] == found["evaluations"]
    assert summary["best"]["score"] == found["best"]["score"]
    assert f"{found['best']['score']:.4f}" in run("study", "s.db")


@pytest.mark.parametrize(
    ("method", "words", "more"),
    [
        ("bo", ["--batch", 3, "--until", 1, "--widen"], {"batch": 3, "until_percent": 1.0, "widen": True}),
        ("ga", ["--screen", "--preset", "published"], {"screen": True, "preset": "published"}),
    ],
)
def test_each_option_reaches_the_search(folder, monkeypatch, method, words, more):
    """Every value is another than the usual one; the workshop's own spring is one to choose."""
    asked = []

    def stop(*given):
        asked.append(given[:3])
        raise JumpcadError("enough")

    monkeypatch.setattr(study, "run_study", stop)
    monkeypatch.setattr("jumpcad.search.pool.open_pool", lambda *how: nullcontext(how))
    Path("shop.toml").write_text('[springs.own]\nlike = "9271K619"\nsource = "a test"\n')
    words = [*words, "--evaluations", 60, "--seed", 4, "--from-study", "before.db"]
    words += ["--objective", "rise", "--around", "kenan-2.0", "--only", "c_coef, rest_angle_deg", "--within", 5]
    words += ["--hours", 2, "--workers", 3, "--limit", 7, "--engine", "planar", "--study", "mine.db"]
    if method == "bo":
        words += ["--workshop", "shop.toml", "--choose", "bought.spring=own,9271K619"]
    assert "enough" in refusal("optimize", method, *words)
    ((request, path, pool),) = asked
    more = more | {"evaluations": 60, "seed": 4, "prior": Path("before.db"), "hours": 2.0}
    more |= {"objective": "rise"}
    assert {name: getattr(request, name) for name in more} == more
    of_design = [one for one in request.space.free if one not in request.space.of_workshop]
    near = Space.make(around=load_design("kenan-2.0"), only=["c_coef", "rest_angle_deg"], within_percent=5)
    assert of_design == list(near.free)
    assert (request.method, request.model.engine, path, pool) == (method, "planar", Path("mine.db"), (3, None, 7.0))
    assert [one.names for one in request.space.of_workshop] == ([("own", "9271K619")] if method == "bo" else [])


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
    assert "ended before 45: in its last steps less than 20 % of the best score was gained; --until 0 goes on" in said
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


def test_robust_scores_stand_under_their_headings(capsys):
    one = SimpleNamespace(
        trial=SimpleNamespace(score=3.0), parameters_score=2.0, print_score=1.0, neighbours=16, rejections={"loop": 2}
    )
    trial = SimpleNamespace(design=load_design("kenan-2.0"), score=3.0, workshop={})
    request = SimpleNamespace(
        aim=find_objective("range"), searched=20, pick=30, space=SimpleNamespace(size=1000), is_front=False,
        objective="range", making=SimpleNamespace(words="lengths ±0.2 mm"),
    )  # fmt: skip
    result = SimpleNamespace(
        request=request, evaluations=20, trials=[trial] * 20, rejected={}, converged=False, notes=[], best=trial,
        winner=trial, candidates=[one], score=1.0, design=trial.design, widened=[], bounds=[],
    )  # fmt: skip
    optimize._print_result(result, Path("won.toml"))
    lines = capsys.readouterr().out.splitlines()
    head = next(number for number, line in enumerate(lines) if "itself" in line)
    for heading, score in (("itself", "3.0000"), ("±1 %", "2.0000"), ("as made", "1.0000")):
        end = lines[head].index(heading) + len(heading)
        assert lines[head + 1][:end].endswith(score)


def test_a_winner_that_cannot_be_made_is_told_with_its_workshop(capsys, monkeypatch):
    """Its limits are those that take seconds; what was searched in a workshop is built, or checked, in that one."""
    design = load_design("kenan-2.0")
    trial = SimpleNamespace(design=design, score=1.5, workshop={})
    request = SimpleNamespace(
        aim=find_objective("range"), searched=9, space=SimpleNamespace(size=1000), is_front=False,
        objective="range",
    )  # fmt: skip
    result = SimpleNamespace(
        request=request, evaluations=9, trials=[trial] * 9, rejected={}, converged=False, notes=[], best=trial,
        winner=trial, candidates=[], score=1.5, design=design, widened=[], bounds=[],
    )  # fmt: skip
    wrong = Finding("assembly_paths", "error", -1.0, "mm²", "a toe blocks the path", "raise d_coef")
    kept, built = Finding("walls", "info", 1.0, "mm", "", ""), []
    monkeypatch.setattr("jumpcad.building.build", lambda *given: built.append(given))
    monkeypatch.setattr("jumpcad.checks.costly_findings", lambda _: [kept, wrong])
    fine = robot_model("printed", "fine")
    assert optimize._violated(result, fine) == [wrong]
    assert built == [(design, fine.workshop)]
    assert optimize._violated(result, robot_model("capsule")) == []
    optimize._print_result(result, Path("won.toml"), [wrong], "fine")
    assert capsys.readouterr().out.splitlines()[-3:] == [
        "error: assembly_paths: a toe blocks the path; raise d_coef", "",
        "next: jumpcad check won.toml --workshop fine: do not build it as it is; a search does not look at these "
        "limits",
    ]  # fmt: skip
    optimize._print_result(result, Path("won.toml"), [], "fine")
    assert capsys.readouterr().out.splitlines()[-1] == "next: jumpcad build won.toml --workshop fine"


def test_a_result_tells_bounds_and_what_lies_beyond_them(capsys):
    """What a moved bound is worth, why it is not, and what was not looked at; the front by its springs' energy."""
    design = load_design("kenan-2.0")
    trial = SimpleNamespace(design=design, score=1.5, workshop={"body.plate_mm": 2.4, "bought.spring": ""})
    weaker = SimpleNamespace(design=load_design("kenan-1.0"), score=0.75)
    request = SimpleNamespace(
        aim=find_objective("range"), searched=180, until_percent=0.05, space=SimpleNamespace(size=1000), is_front=True,
        pick=3, objective="range", making=SimpleNamespace(words="lengths ±0.2 mm"), cost=find_cost("spring-energy"),
    )  # fmt: skip
    result = SimpleNamespace(
        request=request, evaluations=10, trials=[trial] * 7, rejected={"loop": 2, "tips": 1}, converged=True,
        notes=["a note"], best=trial, winner=trial, hypervolume=0.25, front=[trial, weaker], candidates=[], score=1.5,
        design=design,
        widened=[
            Widened("c_coef", "upper", 1.2, 1.3, 0.125), Widened("d_coef", "lower", 0.5, 0.4, None, "tips"),
            Widened("all", "", 0.0, 0.0, -0.5),
        ],
        bounds=[
            ActiveBound("c_coef", "upper", 1.2, 1.25, -0.0625), ActiveBound("d_coef", "lower", 0.5, 0.45, None, "loop"),
            ActiveBound("e_coef", "upper", 1.0, 1.1, None, NOT_EXAMINED),
        ],
    )  # fmt: skip
    optimize._print_result(result, Path("won.toml"))
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines() if line]
    assert told[:4] == [
        "7 designs evaluated, and 3 for the robust pick; rejected: loop 2, tips 1",
        "ended before 180: in its last steps less than 0.05 % of the best score was gained; --until 0 goes on",
        "note: a note",
        "range against energy in the springs; hypervolume 0.2500",
    ]
    assert told[4] == f"{design.spring_energy_j:.4f} J 1.5000 m"
    assert told[5] == f"{weaker.design.spring_energy_j:.4f} J 0.7500 m"
    assert told[6:8] == ["best range 1.5000 m", "won.toml: range 1.5000 m"]
    assert {"body.plate_mm 2.4", "bought.spring ''"} < set(told)
    assert told[-7:-1] == [
        "widened: c_coef, upper bound 1.2 to 1.3: +0.1250",
        "widened: d_coef, lower bound 0.5 to 0.4: rejected by tips",
        "widened: all together: -0.5000",
        "at its upper bound: c_coef = 1.2; 1.25 changes the score by -0.0625",
        "at its lower bound: d_coef = 0.5; 0.45 is rejected: loop",
        f"at its upper bound: e_coef = 1; 1.1 is {NOT_EXAMINED}",
    ]
    assert told[-1] == "next: jumpcad build won.toml --workshop won-workshop.toml"


def test_a_front_that_seeks_more_of_both_shows_the_figures_as_they_are(capsys):
    """Rises in m, not the negative ones that a search makes small."""
    design = load_design("kenan-2.0")
    front = [
        SimpleNamespace(design=design, score=score, workshop={}, evaluation=Evaluation("jump", {"com_rise_m": rise}))
        for rise, score in ((0.25, 0.5), (0.125, 0.75))
    ]
    request = SimpleNamespace(
        aim=find_objective("range"), space=SimpleNamespace(size=1000), is_front=True, objective="range",
        cost=find_cost("rise"),
    )  # fmt: skip
    result = SimpleNamespace(
        request=request, evaluations=2, trials=front, rejected={}, converged=False, notes=[], best=front[1],
        winner=front[1], hypervolume=0.125, front=front, candidates=[], score=0.75, design=design, widened=[],
        bounds=[],
    )  # fmt: skip
    optimize._print_result(result, Path("won.toml"))
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines() if line]
    assert told[1:4] == [
        "range against rise of the centre of mass; hypervolume 0.1250",
        "0.2500 m 0.5000 m",
        "0.1250 m 0.7500 m",
    ]


def test_a_winner_s_limits_are_looked_at_in_its_own_workshop(monkeypatch):
    """The values that the search varied too."""
    design, built = load_design("kenan-2.0"), []
    monkeypatch.setattr("jumpcad.building.build", lambda *given: built.append(given))
    monkeypatch.setattr("jumpcad.checks.costly_findings", lambda _: [])
    trial = SimpleNamespace(workshop={"body.plate_mm": 2.25})
    assert optimize._violated(SimpleNamespace(winner=trial, design=design), robot_model("printed", "fine")) == []
    ((asked, workshop),) = built
    fine = robot_model("printed", "fine").workshop
    assert asked == design
    assert workshop == fine.model_copy(update={"body": fine.body.model_copy(update={"plate_mm": 2.25})})


def test_the_heading_comes_once_before_the_first_trial(capsys):
    seen = []
    watch = optimize._headed("the heading", lambda *given: seen.append((capsys.readouterr().out, *given)))
    watch("one", True)
    watch("two", False)
    assert seen == [("the heading\n", "one", True), ("", "two", False)]


def test_the_document_names_files_and_violated_limits(folder, monkeypatch):
    """And all that the result says; a file of its own for the workshop only where the search varied it."""
    wrong = Finding("assembly_paths", "error", -1.0, "mm²", "a toe blocks the path", "raise d_coef")
    monkeypatch.setattr(optimize, "_violated", lambda result, robot: [wrong])
    found = data("optimize", "ga", *QUICK, *NARROW, "--evaluations", 12, "--study", "s.db", "-o", "b.toml")
    assert (found["study"], found["design_file"], found["pictures"]) == ("s.db", "b.toml", [])
    assert found["violated"] == [wrong.to_dict()]
    assert (found["method"], found["objective"], found["searched"]) == ("ga", "fitness", 12)
    assert "workshop_file" not in found
    assert found["winner"]["design"] == load_design("b.toml").model_dump()


@pytest.mark.parametrize("won", [True, False])
def test_the_document_names_the_workshop_s_file_where_the_search_varied_it(folder, monkeypatch, won):
    """Beside the design's file; null where no design jumps, so that no file is written."""
    saved = []
    winner = SimpleNamespace(workshop={"body.plate_mm": 2.0}) if won else None
    result = SimpleNamespace(winner=winner, save=lambda file, force: saved.append(file), to_dict=dict)
    monkeypatch.setattr(study, "run_study", lambda *_: result)
    monkeypatch.setattr(optimize, "_violated", lambda result, robot: [])
    asked = ["optimize", "--bound", "body.plate_mm=1.6:2.4", "--workers", "0", "-o", "far.toml", "--json"]
    done = CliRunner().invoke(app, asked, catch_exceptions=False)
    found = json.loads(done.stdout)
    assert (done.exit_code, saved) == ((0, [Path("far.toml")]) if won else (1, []))
    assert found["design_file"] == ("far.toml" if won else None)
    assert found["workshop_file"] == ("far-workshop.toml" if won else None)


def test_a_robust_winner_is_told_with_its_own_score_and_design_and_not_the_best_s(capsys):
    """All ten first candidates stand there, with their neighbours; notes and the number of all evaluations too."""
    best, winner = load_design("best-ga"), load_design("kenan-2.0")
    trials = [SimpleNamespace(design=one, score=score, workshop={}) for one, score in ((best, 3.0), (winner, 2.0))]
    candidates = [
        SimpleNamespace(
            trial=SimpleNamespace(score=2.0 + n), parameters_score=1.0 + n, print_score=0.5 + n, neighbours=16 - n,
            rejections={"loop": 2, "tips": 1} if n == 0 else {},
        )
        for n in range(12)
    ]  # fmt: skip
    request = SimpleNamespace(
        aim=find_objective("range"), searched=20, pick=30, space=SimpleNamespace(size=1000), is_front=False,
        objective="range", making=SimpleNamespace(words="lengths ±0.2 mm"),
    )  # fmt: skip
    result = SimpleNamespace(
        request=request, evaluations=30, trials=trials, rejected={}, converged=False, notes=["one", "two"],
        best=trials[0], winner=trials[1], candidates=candidates, score=2.0, design=winner, widened=[], bounds=[],
    )  # fmt: skip
    optimize._print_result(result, Path("won.toml"))
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines() if line]
    assert told[:5] == [
        "2 designs evaluated, and 28 of 30 for the robust pick; rejected: none", "note: one", "note: two",
        "best range 3.0000 m",
        "score that nine of ten neighbours reach, parameters ±1 %, or lengths ±0.2 mm:",
    ]  # fmt: skip
    assert told[6] == "2.0000 1.0000 0.5000 16, loop 2, tips 1"
    assert told[6:16] == [told[6], *(f"{2 + n}.0000 {1 + n}.0000 {n}.5000 {16 - n}, none" for n in range(1, 10))]
    assert told[16] == "won.toml: range 2.0000 m"
    assert told[17:25] == [f"{name} {value:.5g}" for name, value in winner.model_dump().items()]
    assert told[25:] == ["next: jumpcad build won.toml"]
    request.aim, request.searched = find_objective("p10-range"), 35
    optimize._print_result(result, Path("won.toml"))
    assert "2 designs evaluated, in 30 of 35 evaluations with their neighbours; rejected" in capsys.readouterr().out


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


def test_what_cannot_be_written_is_told_before_anything_is_evaluated(folder, monkeypatch):
    """Nor is a file replaced that is read, or that somebody made."""
    monkeypatch.setattr(study, "run_study", lambda *_: pytest.fail("begun"))
    (folder / "pics").mkdir()
    for name in ("pics/history.svg", "w.toml", "x-workshop.toml"):
        (folder / name).write_text("mine")
    (folder / "own.toml").write_text(load_design("best-ga").to_toml())
    (folder / "s.db").touch()
    varied = ("--bound", "body.plate_mm=1.6:2.4")
    for words, said in (
        (("--study", "s.sqlite", *QUICK), "a study file must end in .db"),
        (("-o", "w.toml", *QUICK), "w.toml: exists already"),
        (("-o", "w.txt", *QUICK), "w.txt: must end in .toml"),
        (("--plots", "pics", *QUICK), "pics/history.svg: exists already"),
        (("--from-study", "s.db", "--study", "s.db", *QUICK), "--study s.db: is --from-study itself"),
        (("--around", "own.toml", "-o", "own.toml", *QUICK), "own.toml: is --around itself"),
        (("-o", "x.toml", *varied), "x-workshop.toml: exists already"),
        (("--plots", "y-workshop.toml", "-o", "y.toml", *varied), "is --plots itself"),
    ):
        told = refusal("optimize", *words)
        assert said in told.replace("the study s.db: is", "--study s.db: is")
