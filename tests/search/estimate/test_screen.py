"""The screen: what it guesses, and that a search with it is the same however it is run."""

import math
from dataclasses import replace
from operator import attrgetter
from types import SimpleNamespace

import numpy as np
import pytest
from support.quick import BEST, FIGURES, LIKE, SPACE, Quick, quick
from threadpoolctl import threadpool_info, threadpool_limits

from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.estimate.corrected_estimate import Expected, Tier
from jumpcad.search.estimate.estimate import Fit, Guess
from jumpcad.search.estimate.estimated_robot import LAID, stand_in
from jumpcad.search.estimate.fitting import MARK
from jumpcad.search.estimate.screen import LEAST, WORTH, Screen, leaves_out
from jumpcad.search.models import GUESS_STEP_S, robot_model
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.propose.task import Task
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.settings import load_settings
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop

LAYOUT = {name: FIGURES[name] for name in LAID}


@pytest.fixture(scope="module")
def model():
    return quick()


def search(model, path, evaluations=125, workers=0):
    request = Request(SPACE, model, "body_lengths", "ga", evaluations, screen=True)
    with StudyStore.write(path, request.identity([])) as store, local_pool(workers) as pool:
        evaluator = Evaluator(SPACE, request.aim, model, store, pool)
        run_genetic(evaluator, Task(evaluations, 0, screen=True))
        return evaluator.trials


@pytest.fixture(scope="module", autouse=True)
def no_builds():
    """The robots of `Quick` are like best-printable also where that could not be built."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jumpcad.search.estimate.estimate.build", lambda *_: LIKE)
        patch.setattr(Quick, "laid_out", lambda *_: LAYOUT)
        yield


@pytest.fixture(scope="module")
def trials(model, tmp_path_factory):
    return search(model, tmp_path_factory.mktemp("screen") / "whole.db")


def test_a_robot_stands_in_for_itself():
    other = stand_in(BEST, FIGURES, LIKE)
    exact, found = simulate(LIKE), simulate(other)
    assert found.ballistic_range_m == pytest.approx(exact.ballistic_range_m, rel=2e-3)  # left and right alike
    assert [one.margin for one in found.findings[:4]] == pytest.approx([one.margin for one in exact.findings[:4]])
    for name, body in other.bodies.items():
        like = LIKE.bodies[name]
        assert body.mass_kg == pytest.approx(like.mass_kg, rel=1e-5)
        assert body.com_m[[0, 2]] == pytest.approx(like.com_m[[0, 2]], rel=1e-5)
        assert body.inertia_kg_m2[1, 1] == pytest.approx(like.inertia_kg_m2[1, 1], rel=1e-5)
        assert [one.radius_m for one in body.contacts] == pytest.approx([one.radius_m for one in like.contacts])
    same = "stop.angle_rad", "stop.stiffness_nm_per_rad", "roller_off.leg_rad", "roller_off.leg_rad_s", "foot_depth_m"
    assert attrgetter(*same)(other) == pytest.approx(attrgetter(*same)(LIKE), rel=1e-4)


@pytest.mark.thorough
def test_a_guess_is_as_good_as_its_error_says_and_what_is_left_out_is_worse_than_the_best(model, trials):
    objective = find_objective("body_lengths")
    screen = Screen(SPACE, model, objective)
    assert screen.learn(trials[:60])
    assert not screen.learn(trials[:60])
    fresh = trials[60:]
    best = max(one.score or 0.0 for one in trials[:60])
    exact = np.array([objective.score(model(one.design)) or 0.0 for one in fresh])
    guesses = [screen.guess(one.variant) for one in fresh]
    known = np.array([guess.score is not None for guess in guesses])
    least, most = np.array([(guess.least, guess.most) for guess in guesses]).T
    left_out = np.array([leaves_out(guess, (1.0 + WORTH) * best) for guess in guesses])
    assert known.mean() > 0.8
    assert np.isfinite(most[known]).all()
    assert np.mean(exact <= most) > 0.9
    scores = np.array([guess.score or 0.0 for guess in guesses])
    assert np.mean(exact >= scores - 2.0 * (scores - least)) > 0.85  # the search moves on between two fits
    assert left_out.sum() > 10
    assert np.mean(exact[left_out] < (1.0 + WORTH) * best) > 0.95


def test_beside_a_robot_the_error_is_smaller(model, trials):
    """Of guesses beside the best robot, and of the same with another figure of its layout, as of another wire."""
    screen = Screen(SPACE, model, find_objective("body_lengths"))
    screen.learn(trials)
    best = best_trial(trials)
    layouts = (LAYOUT, LAYOUT | {"laid_coil_mm": LAYOUT["laid_coil_mm"] + 5.0})
    beside, other = (screen.guess(best.variant, layout) for layout in layouts)
    assert beside.score == pytest.approx(best.score, rel=0.01)
    assert beside.least <= beside.score <= beside.most
    assert 1.5 * math.log(beside.most / beside.least) < math.log(other.most / other.least)


@pytest.mark.thorough
def test_what_guesses_miss_is_learned_with_every_robot(model, trials):
    """Of robots that were built after the last fit, by so much that they have become the best."""
    built = [one for one in trials if one.evaluation.verdict != SCREENED]
    misses = []
    for place in range(LEAST + 1, len(built)):
        screen, new = Screen(SPACE, model, find_objective("body_lengths")), built[place]
        if (new.score or 0.0) > best_trial(built[:place]).score and screen.learn(built[:place]):
            before = screen.guess(new.variant)
            if not screen.learn(built[: place + 1]):
                after = screen.guess(new.variant)
                assert after.most / after.least < before.most / before.least
                misses.append([abs(one.score / new.score - 1.0) for one in (before, after)])
    assert len(misses) > 1
    assert np.mean(misses, axis=0)[1] < 0.2 * np.mean(misses, axis=0)[0]


def test_it_is_fitted_in_one_thread(model, trials, monkeypatch):
    seen = []

    def fitted(self, known):
        seen.extend(pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas")

    monkeypatch.setattr(Tier, "learn", fitted)
    monkeypatch.setattr(Tier, "correct", fitted)
    with threadpool_limits(2):
        Screen(SPACE, model, find_objective("body_lengths")).learn(trials[:80])
    assert seen
    assert set(seen) == {1}


def test_nothing_is_left_out_before_enough_is_known_and_no_guess_is_a_score(trials):
    left_out = [one for one in trials if one.evaluation.verdict == SCREENED]
    assert len(left_out) > 20
    assert all(one.evaluation.verdict != SCREENED for one in trials[:LEAST])
    assert all(one.score is None for one in left_out)
    assert all(one.duration_s == 0.0 for one in left_out)
    assert best_trial(trials).evaluation.verdict == "jump"


@pytest.mark.thorough
def test_a_search_that_ended_early_and_a_worker_give_the_same_rows(model, trials, tmp_path):
    path = tmp_path / "again.db"
    search(model, path, evaluations=84)
    again = search(model, path, workers=1)
    assert [replace(one, duration_s=0.0) for one in again] == [replace(one, duration_s=0.0) for one in trials]


@pytest.mark.parametrize(("name", "method"), [("printed", "bo"), ("capsule", "ga")])
def test_where_it_does_not_apply_it_is_refused(name, method):
    with pytest.raises(JumpcadError, match="screen: "):
        Request.make(SPACE, robot_model(name), method, screen=True)


@pytest.mark.parametrize(
    ("score", "margin", "left_out"),
    [
        (1.0, 0.0, False),
        (0.9, 0.0, True),
        (0.92, 0.0, False),
        (None, 0.0, True),
        (2.0, -0.21, True),
        (2.0, -0.19, False),
    ],
)
def test_a_guess_is_left_out_if_it_is_worse_by_more_than_its_error(
    score: float | None, margin: float, left_out: bool
) -> None:
    """Score known to a tenth, of a best of 1.0; a margin known to 0.2, and one of unknown error: it decides nothing."""
    margins = {"reach": margin, "unknown": -9.0}
    assert leaves_out(tier_of(Guess(score, margins)).guess(Variant(BEST), {}), 1.0) is left_out


@pytest.mark.parametrize(("margin", "left_out"), [(-0.1, False), (-0.3, True), (0.1, True)])
def test_what_tips_by_a_guess_is_left_out_only_beyond_the_error(margin: float, left_out: bool) -> None:
    """Known to 0.2 mm; what stands and has no score does not take off."""
    assert leaves_out(tier_of(Guess(None, {"tips": margin})).guess(Variant(BEST), {}), 1.0) is left_out


@pytest.mark.parametrize(("margin", "least"), [(0.0, 2.0 / 1.1**0.5), (-0.1, 0.0)])
def test_a_score_is_corrected_by_the_robots_beside_it_and_known_to_so_many_deviations(
    margin: float, least: float
) -> None:
    """They score twice what is guessed, and deviate by half of the unit of its error, a factor of 1.1.

    Where a limit may be violated it may be no score at all.
    """
    tier = tier_of(Guess(1.0, {"reach": margin}))
    tier._process = SimpleNamespace(  # type: ignore[assignment]
        predict=lambda _: (np.full(1, math.log(2.0)), np.full(1, 0.3)), scatter=0.4
    )
    found = tier.guess(Variant(BEST), {})
    assert found == Expected(pytest.approx(2.0), pytest.approx(least), pytest.approx(2.0 * 1.1**0.5), False)


def test_a_margin_s_error_is_twice_the_worst_of_robots_that_were_held_out() -> None:
    """Too high or too low by a guess; of robots that cannot be guessed, and of other margins, nothing is known."""
    found = {0.1: (0.5, 0.4, -9.0), 0.2: (0.2, 0.5, -9.0), 0.3: (-0.1, 0.15, -9.0), 0.4: (7.0, None, -9.0)}
    near, columns, guesses = [], [], {}
    for share, (exact, guessed, only) in found.items():
        design = SPACE.to_design(np.full(SPACE.dimension, share))
        margins = {"reach": exact, "tips": 1.0, "alone": only}
        findings = tuple(Finding(name, "info", margin, "", "", "") for name, margin in margins.items())
        near.append(Trial("ga", 0, len(near), design, Evaluation("jump", {}, findings), 1.0, "m", 0.1))
        columns.append({"held out": share})
        guesses[share] = None if guessed is None else Guess(None, {"reach": guessed, "tips": 1.01, "guessed": 5.0})
    guesser = SimpleNamespace(from_columns=lambda design, held: guesses[held["held out"]])
    table = SimpleNamespace(trials=near, held_out=lambda: columns)
    tier = Tier(SPACE, guesser, laid=False)  # type: ignore[arg-type]
    tier._ratios = {trial.key: None for trial in near}
    errors = tier._errors(table, near)  # type: ignore[arg-type]
    assert errors == pytest.approx({"reach": 2.0 * 0.3, "tips": 2.0 * 0.01})


def test_the_nearest_robots_are_those_that_differ_least_in_what_they_differ_most() -> None:
    """A tenth of the range in all is nearer than three tenths in one; the best itself comes first."""
    middle = np.full(SPACE.dimension, 0.5)
    one, far = middle.copy(), middle.copy()
    one[0], far[1] = 0.8, 0.0
    points = [far, one, middle + 0.1, middle, middle - 0.2]
    trials = [
        Trial("ga", 0, place, SPACE.to_design(point), Evaluation("jump"), 2.0 if place == 3 else 1.0, "m", 0.1)
        for place, point in enumerate(points)
    ]
    tier = Tier(SPACE, lambda *_: None, laid=False)  # type: ignore[arg-type]
    assert [trial.place for trial in tier._nearest(trials)] == [3, 2, 4, 1, 0]


def test_of_a_generation_those_are_built_that_may_be_better_than_another_s_least() -> None:
    """With its layout one scores 1.3 at least and 1.7 at most: 1.4 may be more, 1.2 cannot."""
    variants = [SPACE.to_variant(np.full(SPACE.dimension, share)) for share in (0.1, 0.2, 0.3)]
    *_, beaten = variants
    exact = dict(zip(variants_keys(variants), [offer(1.5, 0.2), offer(1.3, 0.1), offer(1.1, 0.1)], strict=True))
    screen = Screen.__new__(Screen)
    screen.model = SimpleNamespace(  # type: ignore[assignment]
        admits=lambda _: True, laid_out=lambda _: {"laid_coil_mm": 1.0}, refused_first=lambda _: None
    )
    rough = SimpleNamespace(guess=lambda *_: offer(2.0, 1.0))
    screen.tiers = {False: rough, True: SimpleNamespace(guess=lambda one, _: exact[one.key])}  # type: ignore[dict-item]
    assert set(screen.outcomes(variants, 1.0)) == {beaten.key}


def tier_of(guess: Guess) -> Tier:
    """Return a tier with always the same guess, whose deviation is one."""
    tier = Tier(SPACE, lambda *_: guess, laid=False)  # type: ignore[arg-type]
    tier.fit = Fit(1, {}, {"more": math.log(1.1), "less": -math.log(1.1), "reach": 0.2, "tips": 0.2})
    flat = SimpleNamespace(predict=lambda _: (np.zeros(1), np.ones(1)), scatter=0.0)
    tier._process = flat  # type: ignore[assignment]
    return tier


def offer(score: float, error: float, fails: bool = False) -> Expected:
    return Expected(score, score - error, score + error, fails)


def test_a_generation_is_laid_out_and_built_only_where_it_may_be_better() -> None:
    """Of a best of 1.0: one is worse for certain, one fails, one has no room, one is worse than another's least."""
    points = [np.full(SPACE.dimension, share) for share in (0.1, 0.2, 0.3, 0.4, 0.5)]
    worse, failing, crowded, good, beaten = variants = [SPACE.to_variant(point) for point in points]
    first = dict(zip(variants_keys(variants), [offer(0.8, 0.1), offer(2.0, 0.1, fails=True), offer(3.0, 1.0),
                                               offer(1.5, 0.6), offer(1.1, 0.2)], strict=True))  # fmt: skip
    tried = []

    def laid_out(one: Variant) -> object:
        tried.append(one.key)
        return Evaluation("no_room", detail="why") if one is crowded else {"laid_coil_mm": 1.0}

    screen = Screen.__new__(Screen)
    screen.model = SimpleNamespace(  # type: ignore[assignment]
        admits=lambda _: True, laid_out=laid_out, refused_first=lambda _: None
    )
    plain = SimpleNamespace(guess=lambda one, _: first[one.key])
    laid = SimpleNamespace(guess=lambda one, _: offer(1.5, 0.001))  # known well
    screen.tiers = {False: plain, True: laid}  # type: ignore[dict-item]
    found = screen.outcomes(variants, 1.0)
    assert tried == [crowded.key, good.key]
    assert {key: (one.verdict, dict(one.metrics)) for key, one in found.items()} == {
        worse.key: (SCREENED, {GUESSED: 0.8}),
        failing.key: (SCREENED, {}),
        crowded.key: ("no_room", {}),
        beaten.key: (SCREENED, {GUESSED: 1.1}),
    }


def variants_keys(variants: list[Variant]) -> list[Key]:
    return [one.key for one in variants]


def test_what_an_estimate_refuses_has_the_outcome_of_its_evaluation() -> None:
    """A robot with weak springs, before anything was built."""
    weak = BEST.model_copy(update={"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2})
    plain = robot_model()
    assert plain.stand_in is False
    found = Screen(Space.default(), plain, find_objective("body_lengths")).outcomes([Variant(weak)], 0.0)
    assert found == {Variant(weak).key: plain(weak).bare}
    assert found[Variant(weak).key].verdict == "too_weak"


def test_what_is_refused_is_refused_in_the_search_s_workshop_and_settings(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the steps of guesses, which are longer."""
    asked = []
    monkeypatch.setattr("jumpcad.search.estimate.quick_refusal.quick_refusal", lambda *given: asked.append(given) or ())
    screen = Screen(Space.default(), robot_model("printed", "light", "fine"), find_objective("body_lengths"))
    assert screen.outcomes([Variant(BEST)], 0.0) == {}
    settings = load_settings("fine")
    assert settings.dt_s < GUESS_STEP_S
    longer = settings.model_copy(update={"dt_s": GUESS_STEP_S})
    assert asked == [(BEST, load_workshop("light"), longer)]


def test_nothing_is_learned_where_too_few_were_built(model):
    """Of a hundred trials all but some were refused before anything was built, or all failed."""
    screen = Screen(SPACE, model, find_objective("body_lengths"))
    jump, stayed = Evaluation("jump", {"body_lengths": 1.0}), Evaluation("no_takeoff", {MARK: 1.0})
    refused = [Trial("ga", 0, place, BEST, jump, 1.0, "m", 0.0) for place in range(100)]
    failed = [Trial("ga", 0, place, BEST, stayed, None, "m", 0.0) for place in range(100)]
    few = [*refused, *(replace(trial, evaluation=Evaluation("jump", {MARK: 1.0})) for trial in refused[: LEAST - 1])]
    for trials in (refused, failed, few):
        assert screen.learn(trials) is False
        assert screen.tiers == {}
        assert screen.guess(trials[0].variant) is None


def test_what_a_model_does_not_admit_is_left_to_its_evaluation() -> None:
    """It is refused there at once, with its reason: no guess is asked for, and nothing is laid out."""
    unasked = SimpleNamespace(guess=None)
    screen = Screen.__new__(Screen)
    screen.model = SimpleNamespace(admits=lambda _: False, laid_out=None, refused_first=None)  # type: ignore[assignment]
    screen.tiers = {False: unasked, True: unasked}  # type: ignore[dict-item]
    assert screen.outcomes([Variant(BEST)], 9.0) == {}


@pytest.mark.parametrize(("most", "left_out"), [(1.0004, True), (1.0006, False)])
def test_what_can_gain_next_to_nothing_is_not_built(most: float, left_out: bool) -> None:
    """0.05 % of a best score of 1."""
    screen, variant = Screen.__new__(Screen), Variant(BEST)
    screen.model = SimpleNamespace(  # type: ignore[assignment]
        admits=lambda _: True, laid_out=lambda _: {"laid_coil_mm": 1.0}, refused_first=lambda _: None
    )
    known = SimpleNamespace(guess=lambda *_: Expected(1.0, 0.9, most, False))
    screen.tiers = {False: known, True: known}  # type: ignore[dict-item]
    assert (variant.key in screen.outcomes([variant], 1.0)) is left_out
