"""`jumpcad list`: every name that it gives is taken where it says."""

import json
import re

import pytest
from support.commands import Run
from typer.main import get_command

from jumpcad.cli import listing
from jumpcad.cli.commands import app
from jumpcad.cli.listing import USED_AS, described
from jumpcad.files import template_names
from jumpcad.workshop import load_workshop


def names(run: Run, kind: str) -> list[str]:
    code, out, err = run("list", kind, "--json")
    assert (code, err) == (0, "")
    rows = json.loads(out)[kind]
    assert all(row["description"] for row in rows)
    return [row["name"] for row in rows]


def test_everything_is_listed_with_its_kind(run: Run) -> None:
    code, out, _ = run("list")
    assert code == 0
    for kind in USED_AS:
        assert f"\n{kind} (" in f"\n{out}"
    assert {"kenan-2.0", "best-bo"} <= set(out.split())
    blank = [not line.strip() for line in out.splitlines()]
    assert sum(blank) == len(USED_AS) - 1  # between the kinds


@pytest.mark.parametrize("kind", ["printers", "materials", "workshops"])
def test_listed_names_are_taken(run: Run, kind: str, tmp_path) -> None:
    for name in names(run, kind):
        option = f"--{kind.removesuffix('s')}"
        code, _, err = run("new", tmp_path / "w.toml", option, name, "--force")
        if name == "PA12":
            assert "strength_in_plane_mpa" in err
        else:
            assert (code, err) == (0, "")


def test_kits_and_parts_are_those_of_the_catalogue(run: Run) -> None:
    bought, catalogue = load_workshop().bought, load_workshop().catalogue
    assert bought.kit in names(run, "kits")
    assert names(run, "motors") == list(catalogue.motors)
    assert bought.sensor in names(run, "components")
    assert names(run, "templates") == template_names("robots")


def test_names_are_used_under_keys_and_options_that_there_are() -> None:
    """Keys of the default workshop, whose values are names of that kind; options of commands that take them."""
    shop, commands = load_workshop(), get_command(app).commands  # type: ignore[attr-defined]
    seen = 0
    for kind, use in USED_AS.items():
        for section, keys in re.findall(r"\[(bought|body|ground)\] (\w+(?:, \w+)*)", use):
            table, known = getattr(shop, section), {"", "any", *described(kind)}
            for key in keys.split(", "):
                value = getattr(table, key)
                assert known.issuperset([value] if isinstance(value, str) else value), key
                seen += 1
        for command, option in re.findall(r"jumpcad (\w+) .*?(--\w+) NAME", use):
            assert any(option in parameter.opts for parameter in commands[command].params), use
            seen += 1
    assert seen > 20


def test_an_unknown_kind_is_refused_with_a_hint(run: Run) -> None:
    code, out, err = run("list", "printer")
    assert (code, out) == (2, "")
    assert "did you mean printers?" in err


def test_parts_are_described_by_their_data_sheets_figures() -> None:
    """Pololu 2371: 297.92:1 at 6 V, 73 rpm, 2.4 kg·cm stalled, which are 235 mN·m; a 623 is 3 x 10 x 4 mm (ISO 15)."""
    motor = described("motors")["n20-298-mp"]
    assert motor.startswith("297.92:1, 6 V, 73/min, 235 mN·m stalled, ")
    assert described("bearings")["623"].startswith("3 x 10 x 4 mm, ")
    catalogue = load_workshop().catalogue
    assert motor.endswith(f" stalled, {catalogue.motors['n20-298-mp'].mass_g:g} g")
    for name, words in described("bearings").items():
        bearing = catalogue.bearings[name]
        assert words.endswith(f" mm, {bearing.static_load_n:g} N, {bearing.mass_g:g} g")
    for name, words in described("springs").items():
        spring = catalogue.springs[name]
        assert words == (
            f"wire {spring.wire_mm:g} mm, inside {spring.inside_diameter_mm:g} mm, {spring.turns:g} turns, "
            f"{spring.rate_nmm_per_deg:g} N·mm/°"
        )
    for name, words in described("batteries").items():
        assert words.endswith(f", {catalogue.batteries[name].mass_g:g} g")
    mk4 = load_workshop(printer="mk4").printer
    assert described("printers")["mk4"] == f"{mk4.name}: bed 250 x 210 x 220 mm, nozzle 0.4 mm"
    assert described("materials")["PETG"].startswith("1.27 g/cm³, 45 MPa along its layers")
    assert "to be entered in the workshop" in described("materials")["PA12"]


def test_a_template_is_described_by_one_sentence() -> None:
    for kind in ("templates", "workshops", "settings"):
        for words in described(kind).values():
            assert words
            assert "#" not in words
            assert ". " not in words
            assert not words.endswith(".")
    text = "# A small robot,\n# for a small printer. It has no sensor.\n#\n# Made in May.\nbed_mm = 1\n"
    assert listing._first_sentence(text) == "A small robot, for a small printer"
    assert listing._first_sentence("# One sentence.\n") == "One sentence"


def test_engines_are_installed_where_their_package_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The planar engine needs none."""
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "mujoco" else name)
    assert described("engines") == {"pybullet": "installed", "mujoco": "not installed", "planar": "installed"}


def test_what_can_be_bought_or_aimed_at_is_described() -> None:
    """Kits by their parts, objectives by meaning and unit, all other parts as the catalogue does."""
    catalogue = load_workshop().catalogue
    kit = catalogue.kits[load_workshop().bought.kit]
    words = described("kits")[load_workshop().bought.kit]
    assert words == f"{', '.join(kit.motors)}; {kit.battery}; {kit.controller}; {kit.driver}"
    assert described("objectives")["rise"] == "rise of the centre of mass (m)"
    for kind in ("boards", "components", "rods", "pads"):
        parts = getattr(catalogue, kind)
        assert described(kind) == {name: part.description.rstrip(",") for name, part in parts.items()}
        assert all(described(kind).values())


def test_every_kind_is_told_once_with_where_it_is_used(run: Run) -> None:
    _, out, _ = run("list")
    assert [line for line in out.splitlines() if line and not line.startswith(" ")] == [
        f"{kind} ({use})" for kind, use in USED_AS.items()
    ]
    _, out, _ = run("list", "engines", "--json")
    assert json.loads(out) == {
        "engines": [{"name": name, "description": words} for name, words in described("engines").items()]
    }
