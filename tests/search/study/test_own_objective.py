"""Objectives that users write: what counts as the same function, and one line for each that fails."""

import importlib.util
import json
import os
import random
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.hills import SMALL, Hill
from support.searches import NARROW, QUICK, data, refusal

from jumpcad.errors import JumpcadError
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore

JUMP = Evaluation("jump", {"fitness": 4.0, "mass_kg": 0.1})
FILE = "WEIGHT = 2.0\n\ndef light(m):\n    return m['fitness'] - WEIGHT * m['mass_kg']\n"


def weighted(weight):
    return lambda m: m["fitness"] - weight * m["mass_kg"]


def request(function, **changes):
    aim = find_objective(function)
    return replace(Request(SMALL, Hill(), aim.name, "ga", evaluations=12, own=aim), **changes)


def run(asked, path=None):
    with local_pool(0) as pool:
        return run_study(asked, path, pool)


def test_a_function_and_one_of_a_file_score_alike(tmp_path):
    (tmp_path / "aims.py").write_text(FILE)
    own = find_objective(f"{tmp_path}/aims.py:light")
    assert own.score(JUMP) == find_objective(weighted(2.0)).score(JUMP) == pytest.approx(3.8)
    assert own.score(Evaluation("tips")) is None
    assert own.describe() == {"objective": "light", "objective_code": own.code}


def test_a_file_finds_the_modules_beside_it_from_any_folder(tmp_path, monkeypatch):
    """As a script does that Python runs."""
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "weights_beside.py").write_text("MASS = 2.0\n")
    (tmp_path / "aims.py").write_text(f"from weights_beside import MASS as WEIGHT\n{FILE.partition(chr(10))[2]}")
    (tmp_path / "colorsys.py").write_text("")  # of a name that Python has itself: the search's own is not hidden
    assert find_objective(f"{tmp_path}/aims.py:light").score(JUMP) == pytest.approx(3.8)
    found = importlib.util.find_spec("colorsys")
    assert found is not None
    assert found.origin is not None
    assert not found.origin.startswith(str(tmp_path))


def test_a_study_of_another_function_is_another_study(tmp_path):
    found = run(request(weighted(1.0)), tmp_path / "s.db")
    again = run(request(weighted(1.0)), tmp_path / "s.db")
    assert [trial.score for trial in found.trials] == [trial.score for trial in again.trials]
    with pytest.raises(JumpcadError, match=r"code of own, or of what it uses.*`--from-study .*s\.db`"):
        run(request(weighted(2.0)), tmp_path / "s.db")


def test_a_score_below_zero_is_better_than_a_rejected_design():
    """The lightest of what jumps: a genetic algorithm must not prefer what does not jump at all."""
    result = run(request(lambda m: m["fitness"] - 100.0, evaluations=200))
    plain = run(replace(request(lambda m: m["fitness"]), evaluations=200))
    assert [trial.key for trial in result.trials] == [trial.key for trial in plain.trials]


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda m: m["fitnes"], "asks for 'fitnes'; a jump of this model has fitness, mass_kg"),
        (lambda m: 1 / 0, "fails for a design that jumps: ZeroDivisionError: division by zero"),
        (lambda m: sys.exit("bye"), "SystemExit: bye"),
        (lambda m: float("nan"), "returns nan"),
        (lambda m: float("inf"), "returns inf"),
        (lambda m: 10**400, "returns (a value too long|1000).*not a number within ±1e"),
        (lambda m: "far", r"returns 'far' \(str\), not a number"),
        (lambda m: True, r"returns True \(bool\)"),
        (lambda m: None, "returns None"),
        (lambda m: json.loads("{\n"), "JSONDecodeError"),
    ],
)
def test_a_function_that_fails_is_one_line(function, message):
    with pytest.raises(JumpcadError, match=message) as error:
        find_objective(function).score(JUMP)
    assert "\n" not in str(error.value)
    assert "--from-study" in str(error.value)


@pytest.mark.parametrize("function", [len, print, Hill(), 5, weighted])
def test_what_is_no_function_of_a_users_is_refused(function):
    if function is weighted:
        with pytest.raises(JumpcadError, match=r"returns <function .* \(function\), not a number"):
            find_objective(function).score(JUMP)
    else:
        wanted = "takes a text or a function" if function == 5 else "made by `def` or `lambda`"
        with pytest.raises(JumpcadError, match=wanted):
            find_objective(function)


def test_functions_that_only_promise_a_number_are_refused():
    def yields(m):
        yield m["fitness"]

    async def waits(m):
        return m["fitness"]

    for function in (yields, waits):
        with pytest.raises(JumpcadError, match=f"the objective {function.__name__} returns no number: leave out"):
            find_objective(function)


def test_what_was_evaluated_before_the_failure_is_kept_and_learned_from(tmp_path):
    def picky(m):
        return 1.0 / (m["fitness"] < 9.0)

    with pytest.raises(JumpcadError, match="ZeroDivisionError"):
        run(request(picky, evaluations=60), tmp_path / "s.db")
    with StudyStore.read(tmp_path / "s.db") as store:
        kept = store.trials()
    assert 0 < len(kept) < 60
    mended = run(request(weighted(1.0), prior=tmp_path / "s.db"))
    assert len(mended.trials) == 12


@pytest.mark.thorough
def test_an_own_objective_on_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = tmp_path
    (folder / "aims.py").write_text(FILE.replace("fitness", "ballistic_range_m"))
    found = data(
        "optimize", "bo", *QUICK, *NARROW, "--evaluations", 12, "--objective", "aims.py:light", "--plots", "pics"
    )
    assert found["objective"] == "light"
    assert found["best"]["score"] == pytest.approx(
        found["best"]["metrics"]["ballistic_range_m"] - 2.0 * found["best"]["metrics"]["mass_kg"]
    )
    (folder / "broken.py").write_text("def light(m)\n")
    for place, message in (
        ("aims.py:ligth", "defines no ligth (did you mean light?)"),
        ("none.py:light", "no such file"),
        ("broken.py:light", "does not run: SyntaxError"),
        ("aims.py:", "FILE.py:FUNCTION"),
        ("aims.py:WEIGHT", "made by `def` or `lambda`"),
        ("hight", "an own one is FILE.py:FUNCTION"),
    ):
        assert message in refusal("optimize", "bo", *QUICK, "--evaluations", 12, "--objective", place)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_score_is_a_number_within_ten_to_the_twelfth(sign):
    """A study file holds no larger figure; the message names the limit."""
    assert find_objective(lambda m: sign * 1e12).score(JUMP) == sign * 1e12
    with pytest.raises(JumpcadError, match=r"not a number within ±1e\+12"):
        find_objective(lambda m: sign * 1.001e12).score(JUMP)


def test_a_users_function_changes_nothing_outside(tmp_path, monkeypatch, capsys):
    """Its prints are no part of the output, its folder and its random numbers not those of the search."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "inner").mkdir()

    def untidy(m):
        os.chdir("inner")
        print("hello")
        random.seed(0)
        np.random.seed(0)  # noqa: NPY002
        m.clear()
        return np.float64(2.5)

    random.seed(7)
    np.random.seed(7)  # noqa: NPY002
    expected = random.Random(7).random(), np.random.RandomState(7).random_sample()
    assert find_objective(untidy).score(JUMP) == 2.5
    assert (random.random(), np.random.random()) == expected  # noqa: NPY002
    assert Path.cwd() == tmp_path
    assert capsys.readouterr() == ("", "hello\n")
    assert JUMP.metrics
    assert find_objective(lambda m: np.int64(3)).score(JUMP) == 3.0


def test_a_function_is_named_by_its_name_and_a_nameless_one_own():
    def reach(m):
        return 1.0

    assert find_objective(reach).name == "reach"
    assert find_objective(lambda m: 1.0).name == "own"


class Mute(Exception):
    """An error that cannot say what it is."""

    def __str__(self):
        raise RuntimeError


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (ValueError(), "fails for a design that jumps: ValueError; mend it"),
        (Mute(), "fails for a design that jumps: Mute; mend it"),
        (ValueError("a\x1b[31m\nb"), r"fails for a design that jumps: ValueError: a\x1b[31m\nb; mend it"),
        (ValueError("x" * 500), f"fails for a design that jumps: ValueError: {'x' * 108}; mend it"),
        (KeyError(), "asks for ''; a jump of this model has fitness, mass_kg; mend it"),
    ],
    ids=["no text", "no words", "controls", "long", "no key"],
)
def test_whatever_an_error_says_it_is_told_in_one_short_line(tmp_path, error, said):
    """To 120 letters of its own; an error of a file that does not run too."""

    def failing(m):
        raise error

    with pytest.raises(JumpcadError) as caught:
        find_objective(failing).score(JUMP)
    assert str(caught.value).startswith(f"the objective failing {said}")
    (tmp_path / "aims.py").write_text("raise ValueError('x' * 500)\n")
    with pytest.raises(JumpcadError, match=rf"does not run: ValueError: {'x' * 108}$"):
        find_objective(f"{tmp_path}/aims.py:light")


def test_an_interrupt_in_a_users_function_is_one(tmp_path):
    def interrupted(m):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        find_objective(interrupted).score(JUMP)
    (tmp_path / "aims.py").write_text("raise KeyboardInterrupt\n")
    with pytest.raises(KeyboardInterrupt):
        find_objective(f"{tmp_path / 'aims.py'}:light")
