"""Which changes of code make another study: those of an own objective, and of the program."""

import importlib
import itertools
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jumpcad.search.models import CapsuleModel
from jumpcad.search.study import code_hash
from jumpcad.search.study.code_hash import PRESENTATION, code_digest, file_hash, function_hash

FILES = {
    "aims.py": "import json\nimport weights\nfrom shapes.round import area\n\ndef light(m):\n    return 1.0\n",
    "weights.py": "from inner import FACTOR\n", "inner.py": "FACTOR = 2.0\n", "other.py": "SEEN = 1\n",
    "shapes/__init__.py": "", "shapes/round.py": "from . import base\n", "shapes/base.py": "PI = 3\n",
    "shapes/square.py": "",
}  # fmt: skip


def test_a_file_counts_with_the_modules_beside_it_that_it_imports(tmp_path: Path) -> None:
    def write(name: str, text: str) -> str:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
        return file_hash(tmp_path / "aims.py", "light") if (tmp_path / "aims.py").exists() else ""

    plain = [write(name, text) for name, text in FILES.items()][-1]
    for name, text in FILES.items():
        changed = write(name, text + "# said\n")
        assert (changed != plain) == (name not in ("other.py", "shapes/square.py")), name
        assert write(name, text) == plain
    assert file_hash(tmp_path / "aims.py", "heavy") != plain
    assert write("inner.py", "def (\n") != plain  # what nothing needs may not run


def weighted(weight: Any) -> Any:
    return lambda m: weight * m["range"]


def default(weight: Any) -> Any:
    def light(m: Any, by: Any = weight) -> float:
        return by * m["range"]

    return light


def named_default(weight: Any) -> Any:
    def light(m: Any, *, by: Any = weight) -> float:
        return by * m["range"]

    return light


def through_another(weight: Any) -> Any:
    inner = weighted(weight)
    return lambda m: [inner(one) for one in m]


def test_values_of_closures_and_defaults_count_also_of_a_function_that_is_used() -> None:
    for make in (weighted, default, named_default, through_another):
        assert function_hash(make(1.0)) == function_hash(make(1.0)) != function_hash(make(2.0))


def test_equal_values_have_one_hash_and_others_another() -> None:
    within: list[Any] = []
    within.append(within)
    for one, same, other in (
        ({1, 2, 3}, {3, 2, 1}, {1, 2, 4}), (frozenset("ab"), frozenset("ba"), frozenset("a")), (1, 1, True),
        (1, 1, 1.0), ("a", "a", b"a"), ([1, 2], [1, 2], [2, 1]), ((1, 2), (1, 2), [1, 2]),
        ({"a": 1}, {"a": 1}, {"a": 2}), ({"a": 1}, {"a": 1}, {"b": 1}), (-0.0, -0.0, 0.0), (None, None, ...),
        ([[]], [[]], [[], []]), (10**9000, 10**9000, 10**9000 + 1), (within, within, []), (math, math, os),
        (np.array([1.0, 2.0]), np.array([1.0, 2.0]), np.array([1.0, 2.5])), (int, int, float),
    ):  # fmt: skip
        hashes = [function_hash(weighted(value)) for value in (one, same, other)]
        assert hashes[0] == hashes[1] != hashes[2], str(type(one))


def test_code_counts_and_names_and_comments_of_it_do_not() -> None:
    def of(text: str, **space: Any) -> str:
        exec(text, space)
        return function_hash(space["light"])

    text = "def light(m):\n    return sum(m[n] for n in {'a', 'b'}) - WEIGHT\n"
    plain = of(text, WEIGHT=1.0)
    assert of(f"# said\n\n{text}", WEIGHT=1.0) == plain
    others = [
        of(text, WEIGHT=2.0),
        of(text.replace("'b'", "'c'"), WEIGHT=1.0),
        of(text.replace(" - ", " + "), WEIGHT=1.0),
    ]
    assert len({plain, *others}) == 4


def test_a_module_of_ones_own_counts_and_a_library_counts_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    hashes = []
    for factor in (2.0, 2.0, 3.0):
        (tmp_path / "my_aims.py").write_text(f"FACTOR = {factor}\n")
        monkeypatch.delitem(sys.modules, "my_aims", raising=False)
        importlib.invalidate_caches()
        space: dict[str, Any] = {"my_aims": importlib.import_module("my_aims"), "np": np}
        exec("def light(m):\n    return np.sqrt(my_aims.FACTOR * m['range'])\n", space)
        hashes.append(function_hash(space["light"]))
    assert hashes[0] == hashes[1] != hashes[2]


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Return the folder of a small package that stands in for this one."""
    root = tmp_path / "jumpcad"
    for name in ("search/study/code_hash.py", "simulation/run.py", "cli/study.py", "search/report/page.py"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(f"# {name}\n")
    (tmp_path / "templates" / "hardware").mkdir(parents=True)
    monkeypatch.setattr(code_hash, "__file__", str(root / "search" / "study" / "code_hash.py"))
    monkeypatch.setattr(code_hash, "templates_folder", lambda: tmp_path / "templates")
    return root


def test_every_change_of_what_computes_is_noticed(package):
    """Of a file, of a new one, of as many letters, and of a name; nothing that is only shown counts."""
    files = (
        "simulation/run.py",
        "simulation/new.py",
        "../templates/hardware/wire.toml",
        "cli/study.py",
        "search/report/page.py",
    )
    for name in files:
        found = [code_digest.__wrapped__(), code_digest.__wrapped__()]
        for text in ("changed = True\n", "changed = None\n"):
            (package / name).write_text(text)
            found.append(code_digest.__wrapped__())
        (package / name).rename((package / name).with_stem("renamed"))
        found.append(code_digest.__wrapped__())
        changes = [one != other for one, other in itertools.pairwise(found)]
        assert changes == ([False] * 4 if name in files[3:] else [False, True, True, True]), name


def test_the_digest_is_part_of_what_a_study_is_about():
    assert CapsuleModel().versions()["code"] == code_digest()


@pytest.mark.thorough
def test_no_evaluation_imports_what_the_digest_leaves_out():
    code = f"""
import sys
from jumpcad.design import load_design
from jumpcad.search.propose import initial_designs
from jumpcad.search.study import run as study
from jumpcad.search.models import CapsuleModel, PrintedModel
from jumpcad.search.optimization import optimize
from jumpcad.workshop import load_workshop
initial_designs.SCREENED, initial_designs.GENERATIONS = 64, 2
for model in (PrintedModel(workshop=load_workshop("default")), CapsuleModel()):
    model.requiring(["com_rise_m>=0.01"])(load_design("kenan-2.0"))
optimize("ga", evaluations=24, model="capsule", workers=0)
optimize("ga", evaluations=6, workers=0, screen=True)
optimize("bo", evaluations=4, workers=0)
names = [f'{{name[8:].replace(".", "/")}}.py' for name in sys.modules if name.startswith("jumpcad.")]
print(*[name for name in names if name.startswith({PRESENTATION})])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stdout.split()) == (0, []), done.stderr
    root = Path(code_hash.__file__).parents[2]
    files = [path.relative_to(root).as_posix() for path in root.rglob("*.py")]
    assert [one for one in PRESENTATION if not any(file.startswith(one) for file in files)] == ["templates/"]


def test_versions_are_of_what_is_installed():
    """What is not there has none, so that a study knows where it was installed later."""
    found = code_hash.versions("numpy", "no-such-package-of-jumpcad")
    assert found == {"numpy": np.__version__, "no-such-package-of-jumpcad": "none"}
