"""What `jumpcad optimize` prints of a result that is made up."""

from pathlib import Path
from types import SimpleNamespace

from jumpcad.cli.search_result import print_result
from jumpcad.design import load_design
from jumpcad.search.fronts import find_cost
from jumpcad.search.pick.robust import NOT_EXAMINED, ActiveBound
from jumpcad.search.study.objective import find_objective


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
