"""`jumpcad optimize --seeds`, with the capsule robot."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from support.searches import NARROW, QUICK, data, refusal, run

from jumpcad.cli import main
from jumpcad.cli.seeds import seeds_facts
from jumpcad.design import load_design
from jumpcad.search.report.page import best_so_far
from jumpcad.search.study import run as study
from jumpcad.search.study.objective import find_objective
from jumpcad.search.study.pool import Pool

SEARCH = (*QUICK, *NARROW, "--evaluations", 24)
COMPARED = ("optimize", "ga", "bo", *SEARCH, "--seeds", "3:5", "--study", "F.db")


@pytest.mark.thorough
def test_searches_with_seeds_are_those_alone_and_the_most_robust_winner_is_written(folder, monkeypatch):
    found = data(*COMPARED, "--plots", "pics")
    alone = [
        data("optimize", method, *SEARCH, "--seed", seed, "--study", f"{method}{seed}.db", "-o", "alone.toml")
        for method in ("ga", "bo")
        for seed in (3, 4)
    ]
    assert [(one["study"], one["best"], one["winner"]) for one in found["seeds"]["searches"]] == [
        (f"F-{name}.db", one["best"]["score"], one["winner"]["score"])
        for name, one in zip(("ga-seed3", "ga-seed4", "bo-seed3", "bo-seed4"), alone, strict=True)
    ]
    winner = max(alone, key=lambda one: one["candidates"][0]["robust_score"])["winner"]["design"]
    assert load_design("F.toml").model_dump() == winner == found["winner"]["design"]
    assert {"pics/seeds.svg", "pics/history.svg"} <= set(found["pictures"])

    def nothing(pool, model, designs):
        assert not designs, "what is finished is run again"
        return iter(())

    monkeypatch.setattr(Pool, "evaluate", nothing)
    assert data(*COMPARED, "--plots", "pics") == found
    assert f"{max(one['best']['score'] for one in alone):.6g}" in run(*COMPARED)


def test_ctrl_c_keeps_the_searches_that_are_finished(folder, monkeypatch):
    search = study.run_study

    def interrupted(request, *given):
        if request.seed == 1:
            raise KeyboardInterrupt
        return search(request, *given)

    monkeypatch.setattr(study, "run_study", interrupted)
    monkeypatch.setattr("sys.argv", ["jumpcad", "optimize", *map(str, SEARCH), "--seeds", "0:2", "--study", "F.db"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 130
    assert data("study", "F-seed0.db")["ended"] is not None
    assert not Path("F-seed1.db").exists()


def test_wrong_seeds_are_one_line(folder):
    for words, said in (
        ("--seeds 5:2", "seeds = '5:2' must be"), ("--seeds x", "seeds = 'x' must be"), ("--seeds 0:2000", "1 to 1000"),
        ("--seeds 4294967295:4294967297", "must be"), ("--seeds 0:2 --seed 0", "exclude each other"),
        ("ga bo", "add --seeds"), ("ga ga --seeds 0:2", "each method once"), ("pareto --seeds 0:2", "no front"),
    ):  # fmt: skip
        assert said in refusal("optimize", *words.split(), "--model", "capsule"), words
    assert not list(folder.iterdir())


def test_intervals_and_p_are_those_of_counting():
    """Medians are left by 6 seeds with 2/2⁶, by 9 on a side with 1/2⁹ and 9/2⁹; 5 of 5 stand apart by 2 of 252 ways."""

    def facts(**scores):
        results = [
            SimpleNamespace(request=SimpleNamespace(method=method, seed=seed), best=SimpleNamespace(score=score),
                            winner=None, trials=[], candidates=[])
            for method, found in scores.items() for seed, score in enumerate(found)
        ]  # fmt: skip
        return seeds_facts(results, [Path("s.db")] * len(results))["methods"]

    five, other, third = facts(bo=[5.0, 4.0, 6.0, 8.0, 7.0], ga=[1.0, 0.0, 3.0, 2.0, 3.5], paper=[None] * 5)
    assert (five["median_from"], five["median_to"], five["p"]) == (None, None, None)
    assert (other["p"], third["p"]) == pytest.approx((2 * 2 / 252, 2 * 2 / 252), rel=0.3)  # the last by ties
    for count, place in ((6, 1), (8, 1), (9, 2)):
        (found,) = facts(bo=[float(one) for one in range(1, count + 1)])
        assert (found["median_from"], found["median_to"]) == (place, count + 1 - place)
    (found,) = facts(bo=[None, *map(float, range(8))])
    assert (found["median_from"], found["median_to"]) == (0.0, 6.0)


def test_a_search_without_a_jump_so_far_counts_as_the_worst():
    request = SimpleNamespace(method="ga", seed=0, aim=find_objective("fitness"))
    results = []
    for scores in ((1.0, None, 3.0), (None, 2.0), (None, None, 0.5)):
        trials = [SimpleNamespace(score=one) for one in scores]
        results.append(SimpleNamespace(request=request, trials=trials, best=trials[-1], winner=None, candidates=[]))
    (axes,) = best_so_far(results).axes
    assert np.array_equal(axes.lines[0].get_ydata(), [np.nan, 1.0, 2.0], equal_nan=True)
    corners = {tuple(point) for point in axes.collections[0].get_paths()[0].vertices}
    assert {(3.0, 0.5), (3.0, 3.0)} <= corners
    (facts,) = seeds_facts(results, "abc")["methods"]
    told = {"method": "ga", "searches": 3, "median": 2.0, "best": 3.0, "least": 0.5, "spread": 2.5}
    assert facts | told == facts
    results[1].best = results[2].best = None
    (facts,) = seeds_facts(results, "abc")["methods"]
    assert (facts["best"], facts["median"], facts["least"]) == (3.0, -np.inf, -np.inf)
