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
    "no evaluations": (*SEARCH, "--evaluations", "0"),
    "fewer evaluations": (*SEARCH, "--evaluations", "-5"),
    "half an evaluation": (*SEARCH, "--evaluations", "1.5"),
    "digits": (*SEARCH, "--evaluations", "9" * 5000),
    "negative seed": (*SEARCH, "--seed", "-1"),
    "huge seed": (*SEARCH, "--seed", str(2**64)),
    "limit of nothing": (*SEARCH, "--limit", "0"),
    "limit backwards": (*SEARCH, "--limit", "-1"),
    "limit that is none": (*SEARCH, "--limit", "nan"),
    "limit of words": (*SEARCH, "--limit", "soon"),
    "workers below none": ("optimize", "--model", "capsule", "--workers", "-1"),
    "batch of none": (*SEARCH, "--batch", "0"),
    "within what": (*SEARCH, "--around", "kenan-2.0", "--within", "nan"),
    "within less": (*SEARCH, "--around", "kenan-2.0", "--within", "-10"),
    "within infinity": (*SEARCH, "--around", "kenan-2.0", "--within", "inf"),
    "only nobody": (*SEARCH, "--around", "kenan-2.0", "--only", "[/x]"),
    "fixed to what": (*SEARCH, "--fix", "c_coef=nan"),
    "fixed to infinity": (*SEARCH, "--fix", "c_coef=inf"),
    "fixed to nothing": (*SEARCH, "--fix", "c_coef"),
    "fixed nobody": (*SEARCH, "--fix", "\x1b[31m=1"),
    "bound backwards": (*SEARCH, "--bound", "c_coef=1.2:0.8"),
    "bound of one": (*SEARCH, "--bound", "c_coef=1"),
    "bound of what": (*SEARCH, "--bound", "c_coef=nan:nan"),
    "bound beyond": (*SEARCH, "--bound", "c_coef=-1e300:1e300"),
    "choice of none": (*SEARCH, "--choose", "c_coef="),
    "choice of what": (*SEARCH, "--choose", "c_coef=nan,1"),
    "a model of air": ("optimize", "--model", "[/x]", "--study", "s.db"),
    "an objective of air": (*SEARCH, "--objective", "a\nb"),
    "a preset of air": (*SEARCH, "--preset", ""),
    "a method of air": ("optimize", "\x1b[2J", "--study", "s.db"),
    "an engine of air": (*SEARCH, "--engine", "[/x]"),
    "processes and a scheduler": ("optimize", "--workers", "2", "--dask", "tcp://127.0.0.1:1"),
    "points of none": (*EXPLORE, "sweep", "--points", "0"),
    "points below none": (*EXPLORE, "sweep", "--points", "-1"),
    "one point": (*EXPLORE, "sweep", "--points", "1"),
    "a map of none": (*EXPLORE, "feasibility", "--points", "0"),
    "a map of one": (*EXPLORE, "feasibility", "--points", "1"),
    "a map of less": (*EXPLORE, "feasibility", "--points", "-1"),
    "a map of one way": (*EXPLORE, "feasibility", "--over", "c_coef,c_coef"),
    "a map of nobody": (*EXPLORE, "feasibility", "--over", "[/x],c_coef"),
    "no samples": (*EXPLORE, "pca", "--samples", "0"),
    "fewer samples": (*EXPLORE, "pca", "--samples", "-1"),
    "a view of air": (*EXPLORE, "a\nb"),
    "capsule and published": ("simulate", "kenan-2.0", "--capsule", "--published"),
    "engine of air": ("simulate", "kenan-2.0", "--capsule", "--engine", "\x1b[31m"),
    "both trajectories": ("simulate", "kenan-2.0", "--capsule", "--engine", "both", "--trajectory", "t.csv"),
    "a command of air": ("\x1b[31m",),
    "an option of air": ("list", "--\x1b[31m"),
    "a command of lines": ("a\nb",),
    "nothing": ("",),
    "a workshop for a bundle": ("build", "robot", "--workshop", "light", "-o", "again", "--no-pictures"),
    "a workshop for a simulated bundle": ("simulate", "robot", "--workshop", "light"),
    "a bundle drawn in a workshop": ("render", "robot", "--workshop", "light", "-o", "drawn"),
}


@each("case", REFUSED)
def test_what_cannot_be_asked_is_refused(sandbox: Sandbox, originals: Originals, case: str) -> None:
    if "robot" in REFUSED[case]:
        shutil.copytree(originals.bundle, sandbox.work / "robot")
    sandbox.run(*REFUSED[case], exits=(2,))


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
