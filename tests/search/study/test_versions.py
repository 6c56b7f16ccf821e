"""What a study knows of the program that made it."""

import itertools
import subprocess
import sys

import numpy as np
import pytest

from jumpcad.search.models import CapsuleModel
from jumpcad.search.study import code_hash
from jumpcad.search.study.code_hash import PRESENTATION, code_digest


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Return the folder of a small package that stands in for this one."""
    root = tmp_path / "jumpcad"
    for name in ("search/study/code_hash.py", "simulation/run.py", "cli/study.py"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(f"# {name}\n")
    (tmp_path / "templates" / "hardware").mkdir(parents=True)
    monkeypatch.setattr(code_hash, "__file__", str(root / "search" / "study" / "code_hash.py"))
    monkeypatch.setattr(code_hash, "templates_folder", lambda: tmp_path / "templates")
    return root


def test_every_change_of_what_computes_is_noticed(package):
    """Of a file, of a new one, of as many letters, and of a name; nothing that is only shown counts."""
    files = ("simulation/run.py", "simulation/new.py", "../templates/hardware/wire.toml", "cli/study.py")
    for name in files:
        found = [code_digest.__wrapped__(), code_digest.__wrapped__()]
        for text in ("changed = True\n", "changed = None\n"):
            (package / name).write_text(text)
            found.append(code_digest.__wrapped__())
        (package / name).rename((package / name).with_stem("renamed"))
        found.append(code_digest.__wrapped__())
        changes = [one != other for one, other in itertools.pairwise(found)]
        assert changes == ([False] * 4 if name == "cli/study.py" else [False, True, True, True]), name


def test_the_digest_is_part_of_what_a_study_is_about():
    assert CapsuleModel().versions()["code"] == code_digest()


@pytest.mark.thorough
def test_no_evaluation_imports_what_the_digest_leaves_out():
    code = f"""
import sys
from jumpcad.design import load_design
from jumpcad.search.study import run as study
from jumpcad.search.models import CapsuleModel, PrintedModel
from jumpcad.workshop import load_workshop
for model in (PrintedModel(workshop=load_workshop("default")), CapsuleModel()):
    model(load_design("kenan-2.0"))
print(*[name for name in sys.modules if name.split(".")[:2] in [["jumpcad", part] for part in {PRESENTATION}]])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.split() == [], done.stderr


def test_versions_are_of_what_is_installed():
    """What is not there has none, so that a study knows where it was installed later."""
    found = code_hash.versions("numpy", "no-such-package-of-jumpcad")
    assert found == {"numpy": np.__version__, "no-such-package-of-jumpcad": "none"}
