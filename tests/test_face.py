"""`jumpcad` and `jumpcad.search` show their public names only, and load nothing before it is used."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from support.places import ROOT

import jumpcad
from jumpcad import files, search, simulation

SHOW = """
import sys
import jumpcad
heavy = {"numpy", "scipy", "pydantic", "trimesh", "typer", "matplotlib", "sklearn"}
loaded = heavy & set(sys.modules)
import jumpcad.search
loaded |= heavy & set(sys.modules)
import jumpcad.building, jumpcad.cli.commands, jumpcad.search.report.plots, jumpcad.simulation
print(sorted(loaded))
for package in (jumpcad, jumpcad.search):
    print(dir(package) == sorted(package.__all__), *dir(package))
"""


def test_only_public_names_are_shown_and_nothing_loads_before_its_use():
    done = subprocess.run([sys.executable, "-c", SHOW], capture_output=True, text=True, cwd=ROOT)
    loaded, *faces = done.stdout.splitlines()
    assert loaded == "[]", done.stdout + done.stderr
    for face, package in zip(faces, [jumpcad, search], strict=True):
        alone, *shown = face.split()
        assert alone == "True"
        assert shown == sorted(package.__all__)
        assert {"optimize"} <= set(shown)
        assert not {"simulation", "cli", "face", "TYPE_CHECKING"} & set(shown)


@pytest.mark.parametrize("package", [jumpcad, search, files, simulation])
def test_every_public_name_is_there_also_for_type_checkers_and_others_are_not(package):
    checked = re.findall(r"^ *from \S+ import (\S+) as \1$", Path(package.__file__).read_text(), re.M)
    assert sorted(checked) == sorted(package.__all__) == dir(package)
    for name in package.__all__:
        assert getattr(package, name) is not None
    with pytest.raises(AttributeError, match=f"module '{package.__name__}' has no attribute 'robots'"):
        _ = package.robots


def test_examples_import_the_public_names_only():
    for path in (ROOT / "examples").glob("*.py"):
        imported = set(re.findall(r"^(?:from|import) (jumpcad[\w.]*)", path.read_text(), re.M))
        assert imported <= {"jumpcad", "jumpcad.search"}, path.name
