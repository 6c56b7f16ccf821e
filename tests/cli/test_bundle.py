"""`jumpcad build`, `render` and `verify`, and `simulate` of what was built."""

import json
import os
import re
import shutil
from pathlib import Path
from unittest.mock import ANY

import pytest
from support.built import built
from support.commands import Run
from support.pictures import with_few_pictures

from jumpcad.cli.bundle import _print_facts
from jumpcad.design import load_design
from jumpcad.mechanism.model import BODY_NAMES
from jumpcad.mechanism.variants import capsule_robot


def test_a_bundle_has_what_the_contract_says(bundle: Path) -> None:
    files = {str(path.relative_to(bundle)) for path in bundle.rglob("*") if path.is_file()}
    name = "kenan-2.0"
    assert {
        "design.toml", "workshop.toml", "manifest.json", f"urdf/{name}.urdf", f"urdf/{name}.loop.json",
        f"mjcf/{name}.xml", f"sdf/{name}.sdf", f"{name}.glb", "bom.csv", "assembly.md", "stl/main_leg.stl",
        "urdf/meshes/motor.stl", "dxf/body_plate_left.dxf",
    } <= files  # fmt: skip
    assert any(file.startswith("print/") and file.endswith(".3mf") for file in files)


@pytest.mark.thorough
def test_the_studys_masses_jump_with_the_springs_that_the_robot_has(run: Run, tmp_path: Path) -> None:
    """A lighter robot with the same energy, of springs from stock, goes farther."""
    _, out, _ = run("build", "first-robot", "-o", tmp_path / "b", "--no-pictures", "--json")
    jump, capsule = json.loads(out)["jump"], json.loads(out)["capsule_jump"]
    assert capsule["spring_energy_j"] == pytest.approx(jump["spring_energy_j"])
    assert capsule["mass_kg"] < jump["mass_kg"]
    assert capsule["ballistic_range_m"] > jump["ballistic_range_m"]


def test_build_says_how_far_it_jumps_and_what_it_weighs(
    run: Run, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, _ = run("build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures", "--json")
    facts = json.loads(out)
    assert code == 0
    assert facts["jump"]["verdict"] == facts["capsule_jump"]["verdict"] == "jump"
    assert facts["jump"]["mass_kg"] == pytest.approx(facts["mass_kg"])
    assert facts["capsule_jump"]["mass_kg"] == pytest.approx(capsule_robot(load_design("kenan-2.0")).mass_kg)
    assert facts["capsule_jump"]["mass_kg"] != pytest.approx(facts["mass_kg"])
    assert sum(line["quantity"] * line["mass_kg"] for line in facts["masses"]) == pytest.approx(facts["mass_kg"])
    # the battery gives motor and boards what they take; boards of 25 mA, as long as the motor winds
    winding = facts["winding"]
    assert winding["electrical_j"] == pytest.approx(winding["motor_j"] + winding["boards_j"])
    assert winding["time_s"] == built("kenan-2.0").layout.drive.train.winding_s
    assert winding["boards_j"] / winding["time_s"] == pytest.approx(0.025 * 3.7, rel=0.2)
    assert facts["winding"]["efficiency"] == pytest.approx(facts["spring_energy_j"] / facts["winding"]["electrical_j"])
    assert facts["violated"] == []
    _print_facts(facts, parts=True)
    table = {row[0]: row[1:] for row in map(str.split, capsys.readouterr().out.splitlines()) if row}
    for line in facts["masses"]:
        quantity, grams = line["quantity"], 1000.0 * line["mass_kg"]
        if " " not in line["name"]:
            row = table[line["name"]]
            assert row[0] == str(quantity)
            assert {f"{grams:.2f}", f"{quantity * grams:.2f}"} <= set(row[1:])
    assert table["all"] == [f"{1000.0 * facts['mass_kg']:.2f}"]
    assert table["springs"] == [f"{facts['spring_energy_j']:.4f}", "J"]


def test_build_of_a_robot_with_violated_limits_names_them_and_says_not_to_build_it(run: Run, tmp_path: Path) -> None:
    """The robot is written and jumps, but its steel is too soft; page, guide and command say the same."""
    soft = tmp_path / "soft.toml"
    soft.write_text("[safety]\nsteel_yield_mpa = 20.0\n", encoding="utf-8")
    code, out, _ = run("build", "kenan-2.0", "--workshop", soft, "-o", tmp_path / "b", "--no-pictures")
    out = out.replace("\n" + 15 * " ", " ")  # lines are as wide as 80 characters
    assert code == 0
    assert re.search(r"^printed robot +jumps \d+ mm far", out, re.MULTILINE)
    assert "main_leg" not in out  # parts are listed by --parts
    names = re.findall(r"^error +(\w+): ", out, re.MULTILINE)
    assert "leg_axle_strength" in names
    sentence = re.search(r"^next +(\d+ of its \d+ limits are violated: do not build it as it is); ", out, re.MULTILINE)
    assert sentence
    assert "how to print, order and assemble" not in out
    guide, page = ((tmp_path / "b" / name).read_text(encoding="utf-8") for name in ("assembly.md", "report.html"))
    assert sentence[1] in page
    warning = next(line for line in guide.splitlines() if "Do not build it as it is" in line)
    assert all(name in warning for name in names)


def test_simulating_the_bundle_gives_the_range_of_the_build(run: Run, bundle: Path) -> None:
    ranges = []
    for subject in ("kenan-2.0", bundle, bundle / "urdf" / "kenan-2.0.urdf"):
        code, out, _ = run("simulate", subject, "--json")
        assert code == 0
        ranges.append(json.loads(out)["ballistic_range_m"])
    assert ranges[1:] == pytest.approx([ranges[0]] * 2, rel=1e-9)


def test_a_bundle_builds_itself_again_from_the_inputs_that_it_keeps(run: Run, bundle: Path, tmp_path: Path) -> None:
    assert run("build", bundle, "-o", tmp_path / "again", "--no-pictures")[0] == 0
    assert (tmp_path / "again" / "manifest.json").read_bytes() == (bundle / "manifest.json").read_bytes()


def test_verify_finds_what_was_changed(run: Run, bundle: Path, tmp_path: Path) -> None:
    shutil.copytree(bundle, tmp_path / "b")
    assert run("verify", tmp_path / "b")[0] == 0
    (tmp_path / "b" / "design.toml").write_text("")
    (tmp_path / "b" / "notes.txt").write_text("mine")
    code, out, _ = run("verify", tmp_path / "b")
    assert (code, out) == (1, "design.toml: changed\nnotes.txt: added, not in the manifest\n")
    code, out, _ = run("verify", tmp_path / "b", "--json")
    assert (code, json.loads(out)["differences"]) == (1, ["design.toml: changed"])
    run("build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures", "--force")
    code, out, _ = run("verify", tmp_path / "b", "--json")
    assert code == 0
    assert json.loads(out) == {"bundle": str(tmp_path / "b"), "differences": [], "added": ["notes.txt"]}


@pytest.mark.thorough
def test_render_draws_stills_and_the_jump_of_a_bundle(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_few_pictures(monkeypatch)
    code, out, _ = run("render", bundle, "-o", tmp_path / "p", "--json")
    assert code == 0
    assert json.loads(out)["files"] == ["compressed.png", "exploded.png", "jump.gif", "rest.png"]
    assert sorted(path.name for path in (tmp_path / "p").iterdir()) == json.loads(out)["files"]


def test_a_folder_in_the_way_is_refused_in_one_line(run: Run, tmp_path: Path) -> None:
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "notes.txt").write_text("mine")
    code, out, err = run("build", "kenan-2.0", "-o", "b", "--no-pictures")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "not a bundle" in err
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["notes.txt"]


@pytest.mark.thorough
def test_pictures_belong_to_the_bundle_that_they_are_drawn_into(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_few_pictures(monkeypatch, 2)
    own = Path(shutil.copytree(bundle, tmp_path / "own"))
    (own / "pictures").mkdir()
    (own / "pictures" / "rest.png").write_bytes(b"mine")
    code, out, err = run("render", own)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "pictures/rest.png: edited or added" in err
    assert (own / "pictures" / "rest.png").read_bytes() == b"mine"
    (own / "pictures" / "rest.png").rename(own / "pictures" / "my own.png")
    for _ in range(2):
        assert run("render", own)[0] == 0
    code, out, _ = run("verify", own, "--json")
    assert json.loads(out)["added"] == ["pictures/my own.png"]
    assert code == 0


@pytest.mark.thorough
def test_a_design_is_edited_and_built_again_but_not_over_another_of_its_name(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its files are not what is shown: a bundle of the design alone is as good."""
    monkeypatch.setattr("jumpcad.bundle.export.contents", lambda robot, *_: [("design.toml", robot.design.to_toml())])
    monkeypatch.chdir(tmp_path)
    one, other = Path("one/robot.toml"), Path("other/robot.toml")
    for file, length in ((one, 100.0), (other, 104.0)):
        file.parent.mkdir()
        run("new", file)
        edit(file, length)
    assert run("build", one, "--no-pictures")[0] == 0
    bundle = Path("exports/robot")
    before = (bundle / "manifest.json").read_bytes()
    code, out, err = run("build", other, "--no-pictures")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "exports/robot: holds another design, built after other/robot.toml was last changed" in err
    assert run("build", other, "-o", bundle, "--no-pictures") == (2, "", err)  # also where the folder is named
    assert (bundle / "manifest.json").read_bytes() == before
    edit(one, 102.0)
    assert run("build", one, "--no-pictures")[0] == 0
    assert "carrying_link_mm = 102.0" in (bundle / "design.toml").read_text()
    assert run("build", other, "--no-pictures", "--force")[0] == 0
    assert "carrying_link_mm = 104.0" in (bundle / "design.toml").read_text()


def edit(file: Path, length_mm: float) -> None:
    """Change a design file, a while after everything else was written."""
    file.write_text(re.sub(r"carrying_link_mm = .*", f"carrying_link_mm = {length_mm}", file.read_text()))
    if Path("exports/robot/design.toml").exists():
        later = Path("exports/robot/design.toml").stat().st_mtime_ns + 1
        os.utime(file, ns=(later, later))


def test_the_bodies_of_the_manifest_are_the_robots(bundle: Path) -> None:
    manifest = json.loads((bundle / "manifest.json").read_text())
    assert tuple(manifest["bodies"]) == BODY_NAMES
    for body in manifest["bodies"].values():
        tensor = body["inertia_kg_m2"]
        moments = sorted(tensor[i][i] for i in range(3))
        assert moments[2] <= moments[0] + moments[1], "no rigid body breaks the triangle rule"


@pytest.mark.thorough
def test_a_robot_that_tips_is_refused_and_written_anyway(run: Run, tmp_path: Path) -> None:
    """Toes a third as long, turned outwards: the centre of mass with loaded springs is behind them."""
    short = load_design("kenan-2.0").model_copy(update={"e_coef": 0.3, "ground_link_angle_deg": 80.0, "d_coef": 0.5})
    (tmp_path / "short.toml").write_text(short.to_toml())
    command = ("build", tmp_path / "short.toml", "-o", tmp_path / "b", "--no-pictures")
    code, out, err = run(*command)
    assert (code, out) == (1, "")
    assert "does not jump (tips)" in err
    assert "raise e_coef (longer toes)" in err
    assert "--anyway" in err
    assert not (tmp_path / "b").exists()
    assert run(*command, "--anyway")[0] == 0
    assert (tmp_path / "b" / "manifest.json").is_file()


def test_a_ros2_package_is_part_of_the_bundle_where_it_is_asked_for(run: Run, bundle: Path, tmp_path: Path) -> None:
    assert not (bundle / "ros2").exists()
    assert run("build", bundle, "-o", tmp_path / "b", "--no-pictures", "--ros2")[0] == 0
    package = tmp_path / "b" / "ros2" / "kenan_2_0_description"
    assert {"package.xml", "CMakeLists.txt", "urdf", "launch", "meshes"} <= {path.name for path in package.iterdir()}
    assert run("verify", tmp_path / "b")[:2] == (0, ANY)
    assert run("build", bundle, "-o", tmp_path / "b", "--no-pictures")[0] == 0
    assert not package.exists()


@pytest.mark.thorough
def test_a_bundle_is_not_printed_elsewhere(run: Run, bundle: Path, tmp_path: Path) -> None:
    for option in (("--printer", "mk4"), ("--material", "PLA")):
        code, _, err = run("build", bundle, *option, "-o", tmp_path / "b")
        assert code == 2
        assert f"{' '.join(option)}: " in err
    assert run("build", "kenan-2.0", "--material", "PLA", "-o", tmp_path / "pla", "--no-pictures")[0] == 0
    assert {path.name for path in (tmp_path / "pla" / "print").glob("*.3mf")} == {"plate-1-PLA.3mf", "plate-2-PLA.3mf"}
