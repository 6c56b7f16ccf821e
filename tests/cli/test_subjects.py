"""What an argument stands for: a template, a bundle, or a URDF file."""

import json
import shutil
from pathlib import Path

import pytest
from support.commands import Run
from typer.main import get_command

from jumpcad.cli.commands import app
from jumpcad.files import template_names
from jumpcad.workshop import DEFAULT, own_workshop


def test_a_bare_name_is_the_template_and_a_path_the_bundle(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(bundle, "kenan-2.0")
    shutil.copytree(bundle, "mine")
    note = "jumpcad: kenan-2.0 is the template; write ./kenan-2.0 for the bundle of this name\n"
    for subject, model, told in (("kenan-2.0", "printed", note), ("./kenan-2.0", "URDF", ""), ("mine", "URDF", "")):
        code, out, err = run("simulate", subject, "--json")
        assert (code, err) == (0, told)
        assert json.loads(out)["model"] == model
    light = json.loads(run("simulate", "kenan-2.0", "--workshop", "light", "--json")[1])
    assert light["mass_kg"] != json.loads(out)["mass_kg"]


@pytest.mark.parametrize("command", ["simulate", "build", "render"])
def test_a_workshop_cannot_apply_to_a_bundle(
    run: Run, bundle: Path, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = run(command, bundle, "--workshop", "fine")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert f"--workshop fine: {bundle} is a bundle" in err
    if command == "simulate":
        assert "leave --workshop out" in run(command, bundle / "urdf/kenan-2.0.urdf", "--workshop", "fine")[2]
    assert list(tmp_path.iterdir()) == []


def test_links_in_a_bundle_are_not_read(run: Run, bundle: Path, tmp_path: Path) -> None:
    for command, path in (
        ("simulate", "urdf/kenan-2.0.urdf"), ("simulate", "urdf/kenan-2.0.loop.json"), ("build", "design.toml"),
        ("render", "workshop.toml"),
    ):  # fmt: skip
        own = Path(shutil.copytree(bundle, tmp_path / "own"))
        (own / path).rename(tmp_path / "moved")
        (own / path).symlink_to("/dev/zero")
        code, out, err = run(command, own)
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert f"{path}: a link" in err
        shutil.rmtree(own)


def test_the_help_names_the_templates_that_have_a_workshop_of_their_own() -> None:
    (option,) = (one for one in get_command(app).commands["check"].params if one.name == "workshop")
    named = [name for name in template_names("robots") if name in option.show_default]
    assert named == [name for name in template_names("robots") if own_workshop(name) != DEFAULT]
