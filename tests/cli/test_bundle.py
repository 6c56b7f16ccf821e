"""`jumpcad build`, `render` and `verify`, and `simulate` of what was built."""

import inspect
import json
import os
import re
import shutil
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import ANY

import pytest
from support.built import built
from support.commands import Run
from support.pictures import with_few_pictures

from jumpcad import checks
from jumpcad.bundle import export as bundle_export
from jumpcad.checks import COSTLY
from jumpcad.cli.bundle import LABEL, _facts, _print_facts, _require_same_design_file, _say
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import at_most
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.model import BODY_NAMES, Mechanism
from jumpcad.robot import Robot
from jumpcad.simulation import Jump, Settings


def test_a_bundle_has_what_the_contract_says(bundle: Path) -> None:
    files = {str(path.relative_to(bundle)) for path in bundle.rglob("*") if path.is_file()}
    name = "kenan-2.0"
    assert {
        "design.toml", "workshop.toml", "manifest.json", f"urdf/{name}.urdf", f"urdf/{name}.loop.json",
        f"mjcf/{name}.xml", f"sdf/{name}.sdf", f"{name}.glb", "bom.csv", "assembly.md", "stl/main_leg.stl",
        "urdf/meshes/motor.stl", "dxf/body_plate_left.dxf",
    } <= files  # fmt: skip
    assert any(file.startswith("print/") and file.endswith(".3mf") for file in files)


def test_what_is_drawn_is_built_in_the_workshop_that_is_named_and_flies_in_the_first_engine(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    jumped, robot = [], SimpleNamespace(name="frog")
    jump = Jump("tips", "mujoco", 0.1, 0.2)
    monkeypatch.setattr("jumpcad.cli.bundle.printed_robot", lambda *given: jumped.append(given) or robot)
    monkeypatch.setattr("jumpcad.bundle.renders.renders", lambda _: {"rest": b"png"})
    monkeypatch.setattr("jumpcad.simulation.simulate", lambda *given: jumped.append(given) or jump)
    monkeypatch.setattr("jumpcad.simulation.engines.default_engine", lambda: "mujoco")
    document = json.loads(run("render", "kenan-2.0", "--workshop", "light", "--json")[1])
    assert jumped == [("kenan-2.0", "light"), (robot, Settings(flight="simulated", trajectory=True), "mujoco")]
    assert document == {"folder": "frog-pictures", "files": ["rest.png"], "verdict": "tips"}


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
    _print_facts(facts)
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
    assert code == 0
    assert re.search(r"^printed robot +jumps \d+ mm far", out, re.MULTILINE)
    assert "main_leg" in out
    names = re.findall(r"^error +(\w+): ", out, re.MULTILINE)
    assert "leg_axle_strength" in names
    sentence = re.search(r"^next +(\d+ of its \d+ limits are violated: do not build it as it is); ", out, re.MULTILINE)
    assert sentence
    assert "how to print, order and assemble" not in out
    guide, page = ((tmp_path / "b" / name).read_text(encoding="utf-8") for name in ("assembly.md", "report.html"))
    assert sentence[1] in page
    warning = next(line for line in guide.splitlines() if "Do not build it as it is" in line)
    assert all(name in warning for name in names)


def test_build_tells_of_warnings_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is violated: first what is used most, warnings among the errors, and nothing that holds."""
    found = [
        at_most("holds", 1.0, 2.0, "mm", "", ""), at_most("warns", 3.0, 2.0, "mm", "", "", "warning"),
        at_most("fails", 2.5, 2.0, "mm", "", ""),
    ]  # fmt: skip
    monkeypatch.setattr(checks, "quick_findings", lambda _: found)
    bundle, jump = SimpleNamespace(folder="b", files={}, manifest={"masses": []}), SimpleNamespace(to_dict=dict)
    facts = _facts(built("kenan-2.0"), bundle, jump, jump)  # type: ignore[arg-type]
    assert [one["name"] for one in facts["violated"]] == ["warns", "fails"]
    assert facts["violation"].startswith("2 of its 3 limits are violated")


def test_notes_of_a_build_are_sentences(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "quick_findings", lambda _: [at_most("holds", 1.0, 2.0, "mm", "", "")])
    note = at_most("engraving", 1.0, 2.0, "mm", "the plate has no room for its name", "")
    monkeypatch.setattr("jumpcad.checks.engraving.engraving_findings", lambda _: [note])
    bundle, jump = SimpleNamespace(folder="b", files={}, manifest={"masses": []}), SimpleNamespace(to_dict=dict)
    facts = _facts(built("kenan-2.0"), bundle, jump, jump)  # type: ignore[arg-type]
    assert facts["notes"] == ["the plate has no room for its name"]


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


def test_render_draws_stills_and_the_jump_of_a_bundle(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_few_pictures(monkeypatch)
    code, out, _ = run("render", bundle, "-o", tmp_path / "p", "--json")
    assert code == 0
    assert json.loads(out)["files"] == ["compressed.png", "exploded.png", "jump.gif", "rest.png"]
    assert sorted(path.name for path in (tmp_path / "p").iterdir()) == json.loads(out)["files"]


@pytest.mark.parametrize(("columns", "longest"), [(60, 60), (LABEL + 1, 2 * LABEL)])
def test_on_a_terminal_text_is_folded_beside_its_label(
    columns: int, longest: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where there is hardly room, a line still has some words."""
    words = "the foot is long-winded and " * 8
    screen = SimpleNamespace(is_terminal=True, width=columns)
    monkeypatch.setattr("jumpcad.cli.bundle.console", lambda: screen)
    _say("note", words)
    first, *others = capsys.readouterr().out.splitlines()
    assert first.startswith("note" + " " * (LABEL - len("note")) + "the foot")
    assert others
    assert all(line[:LABEL].isspace() and line[LABEL] != " " for line in others)
    assert longest - len("long-winded") - 1 <= max(map(len, (first, *others))) <= longest
    assert " ".join(line[LABEL:] for line in (first, *others)).split() == words.split()
    screen.is_terminal = False
    _say("note", words)
    assert capsys.readouterr().out.count("\n") == 1


def test_a_folder_in_the_way_is_refused_in_one_line(run: Run, tmp_path: Path) -> None:
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "notes.txt").write_text("mine")
    code, out, err = run("build", "kenan-2.0", "-o", "b", "--no-pictures")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "not a bundle" in err
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["notes.txt"]


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


def test_pictures_elsewhere_replace_nothing(run: Run, bundle: Path, tmp_path: Path) -> None:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "rest.png").write_bytes(b"mine")
    code, out, err = run("render", bundle, "-o", tmp_path / "p")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "rest.png: exists already" in err
    linked = Path(shutil.copytree(bundle, tmp_path / "linked"))
    (linked / "pictures").symlink_to("../p")
    assert "pictures: must be a folder" in run("render", linked, "--force")[2]
    assert [path.name for path in (tmp_path / "p").iterdir()] == ["rest.png"]
    assert (tmp_path / "p" / "rest.png").read_bytes() == b"mine"


def test_another_web_site_is_no_bundle(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    site = tmp_path / "site"
    (site / "src").mkdir(parents=True)
    (site / "manifest.json").write_text('{"name":"PWA"}')
    (site / "src" / "thesis.md").write_text("x")
    for here, folder in ((site, "."), (tmp_path, "site")):
        monkeypatch.chdir(here)
        for command in (["build", "kenan-2.0", "--no-pictures"], ["coupon"], ["build", "kenan-2.0", "--force"]):
            code, out, err = run(*command, "-o", folder)
            assert (code, out, err.count("\n")) == (2, "", 1)
    assert (site / "src" / "thesis.md").read_text() == "x"
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["manifest.json", "site", "src", "thesis.md"]


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


@pytest.mark.parametrize(
    ("name", "design", "age_s", "refused"),
    [
        ("kenan-2.0", "best-ga", 60, True), ("kenan-2.0", "best-ga", -60, False), ("kenan-2.0", "best-ga", 0, False),
        ("kenan-2.0", "kenan-2.0", 60, False), ("frog", "best-ga", 60, False),
    ],
)  # fmt: skip
def test_an_older_file_of_another_design_is_not_built_over_the_robot_of_its_name(
    bundle: Path, tmp_path: Path, name: str, design: str, age_s: int, refused: bool
) -> None:
    """One that was edited since is; of a robot of another name the export says that its place is taken."""
    file, kept = tmp_path / "robot.toml", (bundle / "design.toml").stat().st_mtime_ns
    file.touch()
    os.utime(file, ns=(kept, kept - 10**9 * age_s))
    robot = SimpleNamespace(name=name, design=load_design(design))
    with pytest.raises(JumpcadError, match="holds another design, built after") if refused else nullcontext():
        _require_same_design_file(robot, file, bundle)  # type: ignore[arg-type]


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


def test_a_robot_that_tips_is_refused_and_written_anyway(run: Run, tmp_path: Path) -> None:
    """Toes a third as long, turned outwards: the centre of mass with loaded springs is behind them."""
    short = load_design("kenan-2.0").model_copy(update={"e_coef": 0.3, "ground_link_angle_deg": 80.0, "d_coef": 0.5})
    (tmp_path / "short.toml").write_text(short.to_toml())
    command = ("build", tmp_path / "short.toml", "-o", tmp_path / "b", "--no-pictures")
    code, out, err = run(*command)
    assert (code, out) == (1, "")
    assert "does not jump (tips)" in err
    assert "lengthen the toes" in err
    assert "--anyway" in err
    assert not (tmp_path / "b").exists()
    assert run(*command, "--anyway")[0] == 0
    assert (tmp_path / "b" / "manifest.json").is_file()


@pytest.mark.parametrize(("printed", "capsule"), [("jump", "no_takeoff"), ("no_takeoff", "jump")])
def test_whether_the_printed_robot_jumps_decides(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, printed: str, capsule: str
) -> None:
    """Not the one with the study's masses."""

    def jump(robot: Mechanism, engine: str) -> Jump:
        return Jump(printed if isinstance(robot, Robot) else capsule, engine, robot.mass_kg, robot.spring.energy_j)

    def export(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.simulation.simulate", jump)
    monkeypatch.setattr("jumpcad.bundle.export.export", export)
    code, _, err = run("build", "kenan-2.0", "-o", tmp_path / "b")
    if printed == "jump":
        assert (code, err) == (2, "jumpcad: begun\n")
    else:
        assert code == 1
        assert "does not jump (no_takeoff)" in err


@pytest.mark.parametrize(("name", "option"), [("ender-3", "--printer ender-3"), ("PLA", "--material PLA")])
def test_a_printer_or_a_material_is_no_workshop(run: Run, name: str, option: str) -> None:
    code, _, err = run("check", "kenan-2.0", "--workshop", name)
    assert code == 2
    assert option in err


@pytest.mark.parametrize("option", ["--no-pictures", "--step", "--ros2", "--force"])
def test_every_option_of_build_is_that_of_the_export(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, option: str
) -> None:
    """Each option changes what it is named after, and nothing else."""
    asked = {}

    def export(robot: object, folder: Path, *options: bool) -> None:
        asked.update(zip(inspect.signature(real).parameters, (robot, folder, *options), strict=True))
        raise JumpcadError("enough")

    real = bundle_export.export
    monkeypatch.setattr(bundle_export, "export", export)
    assert run("build", "kenan-2.0", "-o", tmp_path / "b", option)[0] == 2
    assert asked["folder"] == tmp_path / "b"
    usual = {"pictures": True, "step": False, "force": False, "ros2": False}
    name = option.removeprefix("--").removeprefix("no-")
    assert {key: asked[key] for key in usual} == usual | {name: not option.startswith("--no-")}


def test_a_ros2_package_is_part_of_the_bundle_where_it_is_asked_for(run: Run, bundle: Path, tmp_path: Path) -> None:
    assert not (bundle / "ros2").exists()
    assert run("build", bundle, "-o", tmp_path / "b", "--no-pictures", "--ros2")[0] == 0
    package = tmp_path / "b" / "ros2" / "kenan_2_0_description"
    assert {"package.xml", "CMakeLists.txt", "urdf", "launch", "meshes"} <= {path.name for path in package.iterdir()}
    assert run("verify", tmp_path / "b")[:2] == (0, ANY)
    assert run("build", bundle, "-o", tmp_path / "b", "--no-pictures")[0] == 0
    assert not package.exists()


def test_a_bundle_is_not_printed_elsewhere(run: Run, bundle: Path, tmp_path: Path) -> None:
    for option in (("--printer", "mk4"), ("--material", "PLA")):
        code, _, err = run("build", bundle, *option, "-o", tmp_path / "b")
        assert code == 2
        assert f"{' '.join(option)}: " in err
    assert run("build", "kenan-2.0", "--material", "PLA", "-o", tmp_path / "pla", "--no-pictures")[0] == 0
    assert {path.name for path in (tmp_path / "pla" / "print").glob("*.3mf")} == {
        "plate-1-PLA.3mf",
        "plate-2-PLA.3mf",
    }


def test_build_prints_grams_percent_and_millimetres(capsys: pytest.CaptureFixture[str]) -> None:
    """Two parts of 1.5 g, half of the battery's joules in the springs, three quarters of those at take-off."""
    jump = {
        "verdict": "jump", "ballistic_range_m": 0.2214, "com_rise_m": 0.0806, "mass_kg": 0.1032,
        "takeoff_energy_ratio": 0.75, "findings": [],
    }  # fmt: skip
    wrong = {"severity": "error", "name": "tips", "message": "falls over", "remedy": "longer toes"}
    facts = {
        "masses": [{"name": "toe", "quantity": 2, "mass_kg": 0.0015, "material": "PLA", "source": "printed"}],
        "mass_kg": 0.1032, "spring_energy_j": 0.13251,
        "winding": {"electrical_j": 0.26502, "time_s": 2.345, "motor": "n20", "ratio": 3.456, "efficiency": 0.5},
        "notes": ["no room for the name"], "jump": jump, "folder": "frog", "files": ["a", "b"],
        "capsule_jump": jump | {"verdict": "tips", "findings": [{"severity": "info"}, wrong, wrong]},
        "violated": [], "violation": "",
    }  # fmt: skip
    _print_facts(facts)
    lines = capsys.readouterr().out.splitlines()
    labels = (
        "toe",
        "all",
        "springs",
        "winding",
        "take-off",
        "printed robot",
        "study's masses",
        "written",
        "note",
        "next",
    )
    rows = {label: next(line for line in lines if line.startswith(label)) for label in labels}
    assert rows["toe"].split() == ["toe", "2", "PLA", "1.50", "3.00", "printed"]
    assert rows["all"].split() == ["all", "103.20"]
    assert rows["springs"].split() == ["springs", "0.1325", "J"]
    assert rows["winding"].endswith("0.27 J electrical in 2.35 s (n20, 3.46:1), 50.0 % of it in the springs")
    assert rows["take-off"].endswith("75.0 % of the springs' energy")
    assert rows["printed robot"].endswith("jumps 221 mm far and 81 mm high with 103.2 g")
    assert rows["study's masses"].endswith("does not jump (tips): falls over; longer toes")
    assert rows["written"].endswith("3 files in frog")  # with the manifest
    assert rows["note"].endswith("no room for the name")
    assert "open its report.html: its figures;" in rows["next"]
    assert lines[-1].strip() == f"jumpcad check frog/design.toml --workshop frog/workshop.toml also looks at {COSTLY}"
    _print_facts(facts | {"files": ["a", "pictures/rest.png"]})
    assert "report.html: the jump in 3-D;" in capsys.readouterr().out
    _print_facts(facts | {"violated": [wrong], "violation": "1 of its 9 limits is violated"})
    said = capsys.readouterr().out
    assert "error" in said
    assert "tips: falls over; longer toes" in said
    assert "1 of its 9 limits is violated; jumpcad check says more" in said
    assert "open its report.html" not in said


@pytest.mark.parametrize("verdict", ["jump", "tips"])
def test_a_robot_that_does_not_jump_is_drawn_and_its_jump_is_not(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, verdict: str
) -> None:
    jumps = verdict == "jump"
    monkeypatch.setattr("jumpcad.cli.bundle.printed_robot", lambda *_: SimpleNamespace(name="frog"))
    monkeypatch.setattr("jumpcad.bundle.renders.renders", lambda _: {"rest": b"still", "exploded": b"apart"})
    monkeypatch.setattr("jumpcad.bundle.renders.jump_gif", lambda robot, path: b"moving " + path)
    jump = SimpleNamespace(verdict=verdict, trajectory=b"path" if jumps else None)
    monkeypatch.setattr("jumpcad.simulation.simulate", lambda *_: jump)
    code, out, err = run("render", "kenan-2.0", "--json")
    files = ["exploded.png", *(["jump.gif"] if jumps else []), "rest.png"]
    assert (code, err) == (0, "")
    assert json.loads(out) == {"folder": "frog-pictures", "files": files, "verdict": verdict}
    drawn = {file.name: file.read_bytes() for file in (tmp_path / "frog-pictures").iterdir()}
    assert drawn == {"rest.png": b"still", "exploded.png": b"apart"} | ({"jump.gif": b"moving path"} if jumps else {})
    _, out, _ = run("render", "kenan-2.0", "-o", "other")
    assert out.splitlines() == [*(f"other/{name}" for name in files), *([] if jumps else ["no jump.gif: tips"])]


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the work of a command end where it begins."""

    def stop(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.cli.bundle.printed_robot", stop)


@pytest.mark.usefixtures("inputs", "begun")
@pytest.mark.parametrize("command", ["build", "render"])
def test_an_output_that_is_an_input_is_told_before_the_work(run: Run, command: str) -> None:
    for words, itself in (
        (("own.toml", "-o", "own.toml"), "the design"),
        (("kenan-2.0", "--workshop", "shop.toml", "-o", "shop.toml"), "--workshop"),
    ):
        assert f"is {itself} itself; choose another name" in run(command, *words)[2]


@pytest.mark.usefixtures("read_only", "begun")
@pytest.mark.parametrize("words", [("build",), ("build", "-o", "new"), ("render", "-o", "new")])
def test_a_folder_in_which_no_file_can_be_made_is_told_before_the_work(run: Run, words: tuple[str, ...]) -> None:
    command, *options = words
    code, _, said = run(command, "kenan-2.0", *options)
    assert (code, said.count("\n")) == (2, 1)
    assert "cannot be written: no file can be made in" in said


@pytest.mark.usefixtures("read_only")
def test_pictures_that_cannot_be_written_are_not_drawn(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    robot = SimpleNamespace(name="frog")
    monkeypatch.setattr("jumpcad.cli.bundle.printed_robot", lambda *_: robot)
    monkeypatch.setattr("jumpcad.bundle.renders.renders", lambda _: pytest.fail("drawn"))
    assert "frog-pictures: cannot be written" in run("render", "kenan-2.0")[2]


@pytest.mark.usefixtures("inputs", "begun")
@pytest.mark.parametrize("command", ["build", "render"])
def test_a_bare_name_beside_a_bundle_of_that_name_is_noted(run: Run, command: str) -> None:
    note = "jumpcad: kenan-2.0 is the template; write ./kenan-2.0 for the bundle of this name\n"
    assert run(command, "kenan-2.0")[2] == f"{note}jumpcad: begun\n"
    assert run(command, "kenan-1.0")[2] == "jumpcad: begun\n"
