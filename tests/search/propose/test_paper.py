"""The published study's stages."""

from dataclasses import replace

import pytest
from support.hills import SMALL, Hill, Shaped
from support.pictures import with_plain_figures
from support.stages import stage

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.search.propose.paper import FEW, LINKS, NEAR_PERCENT, RUNS, run_paper
from jumpcad.search.report.page import plot_study
from jumpcad.search.space import Space
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore

pytestmark = pytest.mark.usefixtures("quick_proposals")


@pytest.fixture(scope="module")
def searched(quick_proposals, kept_evaluator):
    """Return the evaluator of a search with seed 3."""
    one = kept_evaluator(space=Space.default())
    run_paper(one, stage(140, 3))
    return one


@pytest.mark.thorough
def test_each_stage_moves_what_it_should(searched):
    space, trials = Space.default(), searched.trials
    assert len(trials) <= 140
    assert searched.space == space
    assert {trial.run for trial in trials if trial.phase == "ga"} == set(range(RUNS))

    def moved(mode):
        some = [trial for trial in trials if trial.phase == "bo" and trial.run == mode]
        return some, {name for name in PARAMETERS if len({getattr(t.design, name) for t in some}) > 1}

    few, names = moved(0)
    assert names == set(FEW)
    near, _ = moved(1)
    for parameter in space.free:
        values = [getattr(trial.design, parameter.name) for trial in near]
        assert max(values) - min(values) <= 2.0 * NEAR_PERCENT / 100.0 * parameter.width * (1.0 + 1e-9)
    last, names = moved(2)
    assert names <= set(LINKS)
    assert min(len(few), len(near), len(last)) >= 10


def test_it_takes_the_largest_seed(evaluator):
    one = evaluator(space=Space.default())
    run_paper(one, stage(40, 2**32 - 1))
    assert {trial.run for trial in one.trials if trial.phase == "ga"} == set(range(RUNS))


@pytest.mark.thorough
def test_it_resumes_and_its_study_is_read(tmp_path, monkeypatch):
    with_plain_figures(monkeypatch)

    def rows(path, evaluations):
        with local_pool(0) as pool:
            run_study(Request(SMALL, Hill(), method="paper", evaluations=evaluations), path, pool)
        with StudyStore.read(path) as store:
            return [(trial.position, trial.key) for trial in store.trials()]

    whole = rows(tmp_path / "a.db", 80)
    assert rows(tmp_path / "a.db", 80) == whole
    with StudyStore.read(tmp_path / "a.db") as store:
        assert plot_study(store, tmp_path / "a")


def test_its_stages_share_the_evaluations_so_a_longer_search_is_another_one(tmp_path):
    short, path = Request(SMALL, Hill(), method="paper", evaluations=20), tmp_path / "a.db"
    longer = replace(short, evaluations=40)
    with local_pool(0) as pool:
        first = run_study(short, path, pool)
        with pytest.raises(JumpcadError, match="planned for 20 evaluations and does not go on with 30: name another"):
            run_study(longer, path, pool)
        assert [one.key for one in run_study(short, path, pool).trials] == [one.key for one in first.trials]
    assert longer.default_name() != short.default_name()


@pytest.mark.thorough
def test_the_gain_at_which_other_searches_end_does_not_apply_to_it():
    with local_pool(0) as pool:
        default, none = (
            run_study(Request(SMALL, Hill(), method="paper", evaluations=200, **until), None, pool)
            for until in ({}, {"until_percent": 0.0})
        )
    assert [trial.key for trial in default.trials] == [trial.key for trial in none.trials]


def test_without_a_jumper_it_ends():
    never = Shaped(height=lambda design: None)
    with local_pool(0) as pool:
        result = run_study(Request(SMALL, never, method="paper", evaluations=60), None, pool)
    assert result.winner is None
