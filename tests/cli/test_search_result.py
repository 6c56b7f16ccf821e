"""What `jumpcad optimize` prints of a result that is made up."""

from pathlib import Path
from types import SimpleNamespace

from jumpcad.cli.search_result import print_result
from jumpcad.design import load_design
from jumpcad.search.fronts import find_cost
from jumpcad.search.pick.robust import NOT_EXAMINED, ActiveBound
from jumpcad.search.study.objective import Evaluation, find_objective


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
        winner=trial, candidates=[one], score=1.0, design=trial.design, bounds=[],
    )  # fmt: skip
    print_result(result, Path("won.toml"))
    lines = capsys.readouterr().out.splitlines()
    head = next(number for number, line in enumerate(lines) if "itself" in line)
    for heading, score in (("itself", "3.0000"), ("±1 %", "2.0000"), ("as made", "1.0000")):
        end = lines[head].index(heading) + len(heading)
        assert lines[head + 1][:end].endswith(score)


def test_a_result_tells_bounds_and_what_lies_beyond_them(capsys):
    """What lies beyond is worth, why it is not, and what was not looked at; the front by its springs' energy."""
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
        bounds=[
            ActiveBound("c_coef", "upper", 1.2, 1.25, -0.0625), ActiveBound("d_coef", "lower", 0.5, 0.45, None, "loop"),
            ActiveBound("e_coef", "upper", 1.0, 1.1, None, NOT_EXAMINED),
        ],
    )  # fmt: skip
    print_result(result, Path("won.toml"))
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
    assert told[-4:-1] == [
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
        winner=front[1], hypervolume=0.125, front=front, candidates=[], score=0.75, design=design,
        bounds=[],
    )  # fmt: skip
    print_result(result, Path("won.toml"))
    told = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines() if line]
    assert told[1:4] == [
        "range against rise of the centre of mass; hypervolume 0.1250",
        "0.2500 m 0.5000 m",
        "0.1250 m 0.7500 m",
    ]


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
        best=trials[0], winner=trials[1], candidates=candidates, score=2.0, design=winner, bounds=[],
    )  # fmt: skip
    print_result(result, Path("won.toml"))
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
