"""Objectives that users write: what counts as the same function, and one line for each that fails."""

import importlib.util
import sys
from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL, Hill
from support.searches import NARROW, QUICK, data, refusal

from jumpcad.errors import JumpcadError
from jumpcad.search.models import robot_model
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
    return replace(Request(SMALL, Hill(), aim, "ga", evaluations=12), **changes)


def run(asked, path=None):
    with local_pool(0) as pool:
        return run_study(asked, path, pool)


def test_a_function_and_one_of_a_file_score_alike(tmp_path, capsys):
    (tmp_path / "aims.py").write_text(FILE)
    own = find_objective(f"{tmp_path}/aims.py:light")
    assert own.score(JUMP) == find_objective(weighted(2.0)).score(JUMP) == pytest.approx(3.8)
    assert own.score(Evaluation("tips")) is None
    assert find_objective(weighted(2.0)).name == "own"
    assert find_objective(lambda m: print("hello") or np.float64(2.5)).score(JUMP) == 2.5
    assert capsys.readouterr() == ("", "hello\n")  # standard output may hold one JSON document
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


def test_names_are_checked_before_the_first_evaluation_and_nothing_is_left(tmp_path, monkeypatch):
    """A function is tried on figures of 1 and of 0; what else it does with these is no fault."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "aims.py").write_text("def far(m):\n    return m['ballistic_rangem'] - m['com_rise_m']\n")
    said = refusal("optimize", "ga", *QUICK, "--evaluations", 12, "--objective", "aims.py:far")
    assert "the objective far needs ballistic_rangem" in said
    assert "did you mean ballistic_range_m?" in said
    assert [path.name for path in tmp_path.iterdir() if path.suffix in (".db", ".toml")] == []
    with pytest.raises(JumpcadError, match="own needs nosuch"):
        find_objective(lambda m: m["a"] if m["a"] > 0.5 else m["nosuch"]).require(["a"])
    with pytest.raises(JumpcadError, match=r"jumps-per-joule needs electrical_energy_j.*printed robots alone have it"):
        find_objective("jumps-per-joule").require(["fitness"])
    find_objective(lambda m: 1.0 / (m["a"] - m["b"])).require(["a", "b"])
    find_objective(lambda m: m.get("c", 0.0)).require(["a"])
    with pytest.raises(JumpcadError, match="own needs laid_coil_mm"):
        find_objective(lambda m: m["laid_coil_mm"]).require(robot_model("printed").figure_names)


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


def test_a_function_that_fails_or_is_none_is_one_line():
    for function, message in (
        (lambda m: m["fitnes"], "asks for 'fitnes'; a jump of this model has fitness, mass_kg"),
        (lambda m: 1 / 0, "fails for a design that jumps: ZeroDivisionError: division by zero"),
        (lambda m: (_ for _ in ()).throw(GeneratorExit), "fails for a design that jumps: GeneratorExit"),
        (lambda m: sys.exit("bye"), "SystemExit: bye"), (lambda m: float("nan"), "returns nan"),
        (lambda m: True, r"returns True \(bool\), not a number"), (lambda m: 1.001e12, r"within ±1e\+12"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=message) as error:
            find_objective(function).score(JUMP)
        assert "\n" not in str(error.value)
        assert "--from-study" in str(error.value)
    for other, message in ((len, "made by `def` or `lambda`"), (5, "takes a text or a function")):
        with pytest.raises(JumpcadError, match=message):
            find_objective(other)


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
    (tmp_path / "aims.py").write_text(FILE.replace("fitness", "ballistic_range_m"))
    found = data(
        "optimize", "bo", *QUICK, *NARROW, "--evaluations", 12, "--objective", "aims.py:light", "--plots", "pics"
    )
    assert found["objective"] == "light"
    assert found["best"]["score"] == pytest.approx(
        found["best"]["metrics"]["ballistic_range_m"] - 2.0 * found["best"]["metrics"]["mass_kg"]
    )
    for place, message in (
        ("aims.py:ligth", "defines no ligth (did you mean light?)"), ("none.py:light", "no such file"),
        ("aims.py:WEIGHT", "made by `def` or `lambda`"), ("hight", "an own one is FILE.py:FUNCTION"),
    ):  # fmt: skip
        assert message in refusal("optimize", "bo", *QUICK, "--evaluations", 12, "--objective", place)
