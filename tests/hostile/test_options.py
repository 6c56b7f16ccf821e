"""Options out of all bounds: numbers, names, and options that cannot go together."""

import shutil

import loky
import pytest
from support.each import each
from support.sandbox import Sandbox

from hostile.conftest import Originals

SEARCH = ("optimize", "nsga2", "--model", "capsule", "--workers", "0", "--study", "s.db", "--settings", "screening")
EXPLORE = ("explore", "--model", "capsule", "--workers", "0", "--settings", "screening")
REFUSED = {
    "no time": ("optimize", "--model", "capsule", "--limit", "1e-9", "--workers", "1", "--study", "s.db"),
    "no such parameter": (*EXPLORE, "feasibility", "--over", "foo,bar"),
    "centre outside": (*EXPLORE, "sweep", "--fix", "c_coef=7"),
    "half an evaluation": (*SEARCH, "--evaluations", "1.5"),
    "digits": (*SEARCH, "--evaluations", "9" * 5000),
    "huge seed": (*SEARCH, "--seed", str(2**64)),
    "limit of nothing": (*SEARCH, "--limit", "0"),
    "limit that is none": (*SEARCH, "--limit", "nan"),
    "limit of words": (*SEARCH, "--limit", "soon"),
    "batch of none": (*SEARCH, "--batch", "0"),
    "within what": (*SEARCH, "--around", "kenan-2.0", "--within", "nan"),
    "within less": (*SEARCH, "--around", "kenan-2.0", "--within", "-10"),
    "within infinity": (*SEARCH, "--around", "kenan-2.0", "--within", "inf"),
    "only nobody": (*SEARCH, "--around", "kenan-2.0", "--only", "[/x]"),
    "fixed to what": (*SEARCH, "--fix", "c_coef=nan"),
    "fixed to infinity": (*SEARCH, "--fix", "c_coef=inf"),
    "fixed nobody": (*SEARCH, "--fix", "\x1b[31m=1"),
    "bound of what": (*SEARCH, "--bound", "c_coef=nan:nan"),
    "bound beyond": (*SEARCH, "--bound", "c_coef=-1e300:1e300"),
    "choice of none": (*SEARCH, "--choose", "c_coef="),
    "choice of what": (*SEARCH, "--choose", "c_coef=nan,1"),
    "an objective of air": (*SEARCH, "--objective", "a\nb"),
    "a preset of air": (*SEARCH, "--preset", ""),
    "a method of air": ("optimize", "\x1b[2J", "--study", "s.db"),
    "an engine of air": (*SEARCH, "--engine", "[/x]"),
    "a map of one way": (*EXPLORE, "feasibility", "--over", "c_coef,c_coef"),
    "a map of nobody": (*EXPLORE, "feasibility", "--over", "[/x],c_coef"),
    "a view of air": (*EXPLORE, "a\nb"),
    "a command of air": ("\x1b[31m",),
    "an option of air": ("list", "--\x1b[31m"),
    "a command of lines": ("a\nb",),
    "nothing": ("",),
}


@each("case", REFUSED)
def test_what_cannot_be_asked_is_refused(sandbox: Sandbox, case: str) -> None:
    assert sandbox.run(*REFUSED[case], exits=(2,)).out == ""


BORNE = {
    "no rows": ("study", "study.db", "--list", "0", "--json"),
    "rows below none": ("study", "study.db", "--list", "-1", "--json"),
    "all rows": ("study", "study.db", "--list", str(2**70), "--json"),
    "twice the same": ("study", "study.db", "study.db", "--json"),
    "few samples": (*EXPLORE, "pca", "--samples", "1", "--json"),
    "two samples": (*EXPLORE, "importance", "--samples", "2", "--json"),
    "one evaluation": (*SEARCH, "--evaluations", "1", "--json"),
    "a bundle": ("build", "robot", "-o", "again", "--no-pictures", "--json"),
}


@each("case", BORNE)
def test_little_or_much_is_borne_or_refused(sandbox: Sandbox, originals: Originals, case: str) -> None:
    shutil.copy(originals.study, sandbox.work / "study.db")
    shutil.copytree(originals.bundle, sandbox.work / "robot")
    sandbox.run(*BORNE[case], writes=["s.db", "s.toml", "again"])


def test_nobody_starts_a_hundred_thousand_processes(sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are as many as there is work for, or the number is refused."""
    started = []

    def start(workers: int, *_: object, **__: object) -> None:
        started.append(workers)
        raise KeyboardInterrupt

    monkeypatch.setattr(loky, "ProcessPoolExecutor", start)
    search = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "2", "--study", "s.db")
    sandbox.run(*search, "--workers", "100000", exits=(2, 130), writes=["s.db"])
    assert all(workers <= 1000 for workers in started)


def test_a_folder_of_a_templates_name_does_not_take_its_place(sandbox: Sandbox, originals: Originals) -> None:
    """Either the template is built, or it is said that the folder was."""
    shutil.copytree(originals.bundle, sandbox.work / "best-bo")
    done = sandbox.run("build", "best-bo", "-o", "again", "--no-pictures", "--json", writes=["again"])
    assert done.code == 2 or done.data["name"] == "best-bo" or "best-bo" in done.err
