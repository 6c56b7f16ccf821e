"""What a search found."""

import pickle
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.hills import SMALL, Hill

import jumpcad
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.models import robot_model
from jumpcad.search.robust_pick import ActiveBound, Candidate
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.request import Request
from jumpcad.search.study.result import Result
from jumpcad.search.study.trial import Trial
from jumpcad.workshop import load_workshop

QUICK = {"model": "capsule", "settings": "screening", "workers": 0}


def test_a_front_has_its_trials_and_its_own_objective():
    found = jumpcad.optimize("nsga2", evaluations=40, **QUICK)
    energies = [trial.design.spring_energy_j for trial in found.front]
    assert found.request.aim.name == "range"
    assert energies == sorted(energies)
    assert found.hypervolume > 0.0
    assert len(found.trials) == 30
    assert found.evaluations == 40
    assert {one.trial.key for one in found.candidates} <= {trial.key for trial in found.front}
    assert found.winner is found.candidates[0].trial
    assert found.bounds == []


@pytest.mark.parametrize("objective", ["range", lambda figures: figures["mass_kg"]])
def test_what_a_search_found_can_come_from_another_process(objective):
    """One search a seed, in a pool of processes: results are pickled."""
    found = jumpcad.optimize("ga", evaluations=60, objective=objective, **QUICK)
    copied = pickle.loads(pickle.dumps(found))
    assert copied.trials == found.trials
    assert copied.score == found.score
    assert copied.design == found.design
    assert copied.to_dict() == found.to_dict()


@pytest.mark.thorough
@pytest.mark.parametrize("method", ["pareto", "nsga2"])
def test_a_front_without_a_score_above_0_is_what_nothing_dominates_too(method):
    """Of a mass that is to be small; its robust pick examines designs of the front."""
    found = jumpcad.optimize(method, evaluations=40, objective=lambda figures: -figures["mass_kg"], **QUICK)
    points = {(-trial.score, trial.design.spring_energy_j) for trial in found.trials if trial.score is not None}
    best = {one for one in points if not any(other != one and np.less_equal(other, one).all() for other in points)}
    assert {(-trial.score, trial.design.spring_energy_j) for trial in found.front} == best
    assert {one.trial.key for one in found.candidates} <= {trial.key for trial in found.front}
    assert found.winner is found.candidates[0].trial
    assert found.hypervolume == 0.0


def test_where_nothing_jumps_the_trials_are_kept_and_the_design_is_asked_for_in_vain(tmp_path):
    found = jumpcad.optimize(
        "ga", evaluations=12, fixed={"stiffness_nmm_per_deg": 5, "compression_ratio": 0.1}, **QUICK
    )
    assert len(found.trials) == 12
    assert found.winner is None
    assert found.rejected == Counter(reason for trial in found.trials for reason in trial.evaluation.reasons)
    assert sum(found.rejected.values()) >= 12
    for ask in (lambda: found.design, lambda: found.score, lambda: found.save(tmp_path / "w.toml")):
        with pytest.raises(CannotBuildError, match=r"none of 12 designs jumps \(.*: widen the bounds"):
            ask()
    assert not (tmp_path / "w.toml").exists()


def trial_of(score: float | None, place: int, **parameters: float) -> Trial:
    """Return a trial of best-ga with other parameters; a score of None is a linkage that comes apart."""
    design = load_design("best-ga").model_copy(update=parameters)
    if score is None:
        return Trial("ga", 2, place, design, Evaluation("loop"), None, "m", 0.25)
    figures = {"fitness": score / 2.0, "mass_kg": 0.125}
    margin = Finding("leg_flex", "info", 0.375, "mm", "bends", "stiffen it")
    return Trial("ga", 2, place, design, Evaluation("jump", figures, (margin,)), score, "m", 0.25)


def found(method: str = "ga", **changes: Any) -> Result:
    """Return a made-up result of five designs, of which the second is the most robust, and the third cannot be made."""
    weak = {"compression_ratio": 0.25}
    trials = [trial_of(5.0, 0), trial_of(4.0, 1, **weak), trial_of(None, 2), trial_of(2.0, 3), trial_of(None, 4)]
    fields: dict[str, Any] = {
        "request": Request(SMALL, Hill(), "range", method, 40),
        "trials": trials,
        "best": trials[0],
        "candidates": [
            Candidate(trials[1], 3.5, 3.25, {"tips": 2, "loop": 1}, 16), Candidate(trials[0], 1.5, 2.5, {}, 8)
        ],
        "bounds": [ActiveBound("c_coef", "upper", 1.2, 1.25, -0.5)],
        "notes": ["a worker was lost"],
        "evaluations": 31,
        "converged": True,
    }  # fmt: skip
    return Result(**{**fields, **changes})


def test_the_winner_is_the_most_robust_and_without_candidates_the_best() -> None:
    robust, plain = found(), found(candidates=[])
    assert (robust.winner, plain.winner) == (robust.trials[1], plain.trials[0])
    assert (robust.score, robust.fitness, robust.design.compression_ratio) == (4.0, 2.0, 0.25)
    assert (plain.score, plain.fitness, plain.design) == (5.0, 2.5, load_design("best-ga"))
    assert robust.workshop is None
    assert repr(robust) == "<Result ga: range 4, 5 trials, 2 candidates>"


def test_plain_data_has_every_figure_under_its_name() -> None:
    result = found()
    data = result.to_dict()
    assert data.pop("best") == result.trials[0].to_dict()
    assert data.pop("winner") == result.trials[1].to_dict()
    first, second = data.pop("candidates")
    assert first.pop("design") == result.trials[1].design.model_dump()
    assert first == {
        "score": 4.0, "robust_score": 3.25, "parameters_score": 3.5, "print_score": 3.25,
        "refusals": {"tips": 2, "loop": 1}, "neighbours": 16, "fails": False,
    }  # fmt: skip
    assert (second["score"], second["robust_score"], second["neighbours"]) == (5.0, 1.5, 8)
    assert data == {
        "method": "ga", "objective": "range", "evaluations": 31, "searched": 5, "converged": True,
        "refused": {"loop": 2}, "notes": ["a worker was lost"],
        "active_bounds": [
            {"name": "c_coef", "side": "upper", "value": 1.2, "beyond": 1.25, "worth": -0.5, "reason": ""}
        ],
    }  # fmt: skip
    nothing = found(best=None, candidates=[], trials=[result.trials[2]]).to_dict()
    assert (nothing["best"], nothing["winner"], nothing["searched"]) == (None, None, 1)


def test_of_a_front_the_trials_come_with_their_hypervolume() -> None:
    """Of two designs: the area below the first up to the second's energy, and below the second up to 1.5 J."""
    result = found("nsga2", candidates=[])
    weak, strong = result.trials[1], result.trials[0]
    low, high = weak.design.spring_energy_j, strong.design.spring_energy_j
    data = result.to_dict()
    assert low < high < 1.5
    assert data["front"] == [weak.to_dict(), strong.to_dict()]
    assert data["hypervolume"] == pytest.approx(4.0 * (high - low) + 5.0 * (1.5 - high))
    lines = dict(result._lines())
    assert lines["hypervolume"] == f"{data['hypervolume']:.4g}"
    assert lines[f"energy in the springs {low:.4g} J"] == "4"
    assert lines[f"energy in the springs {high:.4g} J"] == "5"


def test_a_front_that_seeks_more_of_both_is_shown_by_the_figures_themselves() -> None:
    """Range against fitness, which is half of the score here: of two designs the better one has more of both."""
    request = Request(SMALL, Hill(), "range", "nsga2", 40, against="fitness")
    lines = dict(found(request=request, candidates=[])._lines())
    assert lines["range over the longest link 2.5 link lengths"] == "5"
    assert not any("-" in name for name in lines)


def test_the_winners_design_is_written_and_its_workshop_beside_it(tmp_path: Path) -> None:
    """The files make the robot that won, and no other; a user's file is kept, unless it is to be replaced."""
    plain = found()
    assert plain.save(tmp_path / "plain.toml") == tmp_path / "plain.toml"
    printed = found(request=Request(SMALL, robot_model("printed"), "range", "ga", 40))
    assert (printed.workshop, printed.workshop_toml()) == (None, "")
    printed.save(tmp_path / "plain.toml")
    assert [file.name for file in tmp_path.iterdir()] == ["plain.toml"]
    assert load_design(tmp_path / "plain.toml") == plain.design
    thick = replace(plain.trials[1], workshop={"body.plate_mm": 2.75})
    request = Request(SMALL, robot_model("printed"), "range", "ga", 40)
    made = found(request=request, candidates=[replace(plain.candidates[0], trial=thick)])
    assert made.candidates[0].to_dict()["workshop"] == {"body.plate_mm": 2.75}
    assert made.workshop is not None
    assert made.workshop.body.plate_mm == 2.75
    made.save(tmp_path / "won.toml")
    assert load_workshop(tmp_path / "won-workshop.toml").body.plate_mm == 2.75
    assert load_design(tmp_path / "won.toml") == thick.design
    assert "# Found by jumpcad optimize: ga on the printed robot, range 4.\n" in (tmp_path / "won.toml").read_text()
    assert "in the file that ends in -workshop.toml" in (tmp_path / "won.toml").read_text()
    assert "Its workshop" not in (tmp_path / "plain.toml").read_text()
    assert "#   body.plate_mm = 2.75\n" in (tmp_path / "won-workshop.toml").read_text()
    made.save(tmp_path / "won.toml")  # again: what nobody has edited is replaced
    (tmp_path / "won-workshop.toml").write_text("# mine\n")
    (tmp_path / "won.toml").unlink()
    with pytest.raises(JumpcadError, match=r"won-workshop\.toml: exists already"):
        made.save(tmp_path / "won.toml")
    assert not (tmp_path / "won.toml").exists()
    made.save(tmp_path / "won.toml", force=True)
    assert load_workshop(tmp_path / "won-workshop.toml").body.plate_mm == 2.75
    with pytest.raises(JumpcadError, match=r"must end in \.toml"):
        plain.save(tmp_path / "won.txt")
