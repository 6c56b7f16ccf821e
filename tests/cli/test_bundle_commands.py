"""`jumpcad build`, `render`, `verify`, and `simulate` of what was built."""

import json
import os
import re
import shutil
from pathlib import Path

import pytest

from jumpcad.cli import main
from jumpcad.mechanism.model import BODY_NAMES


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, str, str]:
    """Return exit code, standard output and standard error of a command."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["jumpcad", *map(str, arguments)])
        with pytest.raises(SystemExit) as stop:
            main()
    said = capsys.readouterr()
    return int(stop.value.code or 0), said.out, said.err


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("exports") / "kenan-2.0"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["jumpcad", "build", "kenan-2.0", "-o", str(folder), "--no-pictures"])
        with pytest.raises(SystemExit):
            main()
    return folder


def test_a_bundle_has_what_the_contract_says(bundle: Path) -> None:
    files = {str(path.relative_to(bundle)) for path in bundle.rglob("*") if path.is_file()}
    name = "kenan-2.0"
    assert {
        "design.toml", "workshop.toml", "manifest.json", f"urdf/{name}.urdf", f"urdf/{name}.loop.json",
        f"mjcf/{name}.xml", f"sdf/{name}.sdf", f"{name}.glb", "bom.csv", "assembly.md", "stl/main_leg.stl",
        "urdf/meshes/motor.stl", "dxf/body_plate_left.dxf",
    } <= files  # fmt: skip
    assert any(file.startswith("print/") and file.endswith(".3mf") for file in files)


def test_build_says_how_far_it_jumps_and_what_it_weighs(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    code, out, _ = run(capsys, "build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures", "--json")
    facts = json.loads(out)
    assert code == 0
    assert facts["jump"]["verdict"] == facts["capsule_jump"]["verdict"] == "jump"
    assert sum(line["quantity"] * line["mass_kg"] for line in facts["masses"]) == pytest.approx(facts["mass_kg"])
    assert facts["winding"]["efficiency"] == pytest.approx(facts["spring_energy_j"] / facts["winding"]["electrical_j"])
    code, out, _ = run(capsys, "build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures")
    assert code == 0
    assert f"{1000 * facts['jump']['ballistic_range_m']:.0f} mm far" in out
    assert "main_leg" in out


def test_simulating_the_bundle_gives_the_range_of_the_build(capsys: pytest.CaptureFixture[str], bundle: Path) -> None:
    ranges = []
    for subject in ("kenan-2.0", bundle, bundle / "urdf" / "kenan-2.0.urdf"):
        code, out, _ = run(capsys, "simulate", subject, "--json")
        assert code == 0
        ranges.append(json.loads(out)["ballistic_range_m"])
    assert ranges[1:] == pytest.approx([ranges[0]] * 2, rel=1e-9)


def test_a_bundle_builds_itself_again_from_the_inputs_that_it_keeps(
    capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path
) -> None:
    assert run(capsys, "build", bundle, "-o", tmp_path / "again", "--no-pictures")[0] == 0
    assert (tmp_path / "again" / "manifest.json").read_bytes() == (bundle / "manifest.json").read_bytes()


def test_verify_finds_what_was_changed(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    run(capsys, "build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures")
    assert run(capsys, "verify", tmp_path / "b")[0] == 0
    (tmp_path / "b" / "design.toml").write_text("")
    (tmp_path / "b" / "notes.txt").write_text("mine")
    code, out, _ = run(capsys, "verify", tmp_path / "b")
    assert (code, out) == (1, "design.toml: changed\nnotes.txt: added, not in the manifest\n")
    run(capsys, "build", "kenan-2.0", "-o", tmp_path / "b", "--no-pictures", "--force")
    code, out, _ = run(capsys, "verify", tmp_path / "b", "--json")
    assert code == 0
    assert json.loads(out) == {"bundle": str(tmp_path / "b"), "differences": [], "added": ["notes.txt"]}


def test_render_draws_stills_and_the_jump_of_a_bundle(
    capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("jumpcad.bundle.renders.JUMP_FRAMES", 3)
    code, out, _ = run(capsys, "render", bundle, "-o", tmp_path / "p", "--json")
    assert code == 0
    assert json.loads(out)["files"] == ["compressed.png", "exploded.png", "jump.gif", "rest.png"]
    assert sorted(path.name for path in (tmp_path / "p").iterdir()) == json.loads(out)["files"]


def test_a_folder_in_the_way_is_refused_in_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    code, out, err = run(capsys, "build", "kenan-2.0", "-o", tmp_path, "--no-pictures")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "not a bundle" in err
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_pictures_belong_to_the_bundle_that_they_are_drawn_into(
    capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("jumpcad.bundle.renders.JUMP_FRAMES", 2)
    own = Path(shutil.copytree(bundle, tmp_path / "own"))
    (own / "pictures").mkdir()
    (own / "pictures" / "rest.png").write_bytes(b"mine")
    code, out, err = run(capsys, "render", own)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "pictures/rest.png: edited or added" in err
    assert (own / "pictures" / "rest.png").read_bytes() == b"mine"
    (own / "pictures" / "rest.png").rename(own / "pictures" / "my own.png")
    for _ in range(2):
        assert run(capsys, "render", own)[0] == 0
    code, out, _ = run(capsys, "verify", own, "--json")
    assert json.loads(out)["added"] == ["pictures/my own.png"]
    assert code == 0


def test_pictures_elsewhere_replace_nothing(capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path) -> None:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "rest.png").write_bytes(b"mine")
    code, out, err = run(capsys, "render", bundle, "-o", tmp_path / "p")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "rest.png: exists already" in err
    linked = Path(shutil.copytree(bundle, tmp_path / "linked"))
    (linked / "pictures").symlink_to("../p")
    assert "pictures: is no folder" in run(capsys, "render", linked, "--force")[2]
    assert [path.name for path in (tmp_path / "p").iterdir()] == ["rest.png"]
    assert (tmp_path / "p" / "rest.png").read_bytes() == b"mine"


def test_another_web_site_is_no_bundle(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = tmp_path / "site"
    (site / "src").mkdir(parents=True)
    (site / "manifest.json").write_text('{"name":"PWA"}')
    (site / "src" / "thesis.md").write_text("x")
    for here, folder in ((site, "."), (tmp_path, "site")):
        monkeypatch.chdir(here)
        for command in (["build", "kenan-2.0", "--no-pictures"], ["coupon"], ["build", "kenan-2.0", "--force"]):
            code, out, err = run(capsys, *command, "-o", folder)
            assert (code, out, err.count("\n")) == (2, "", 1)
    assert (site / "src" / "thesis.md").read_text() == "x"
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["manifest.json", "site", "src", "thesis.md"]


def test_a_design_is_edited_and_built_again_but_not_over_another_of_its_name(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    one, other = Path("one/robot.toml"), Path("other/robot.toml")
    for file, length in ((one, 100.0), (other, 104.0)):
        file.parent.mkdir()
        run(capsys, "new", file)
        edit(file, length)
    assert run(capsys, "build", one, "--no-pictures")[0] == 0
    bundle = Path("exports/robot")
    before = (bundle / "manifest.json").read_bytes()
    code, out, err = run(capsys, "build", other, "--no-pictures")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "exports/robot: holds another design, built after other/robot.toml was last changed" in err
    assert (bundle / "manifest.json").read_bytes() == before
    edit(one, 102.0)
    assert run(capsys, "build", one, "--no-pictures")[0] == 0
    assert "carrying_link_mm = 102.0" in (bundle / "design.toml").read_text()
    assert run(capsys, "build", other, "--no-pictures", "--force")[0] == 0
    assert "carrying_link_mm = 104.0" in (bundle / "design.toml").read_text()


def edit(file: Path, length_mm: float) -> None:
    """Change a design file, a while after everything else was written."""
    file.write_text(re.sub(r"carrying_link_mm = .*", f"carrying_link_mm = {length_mm}", file.read_text()))
    if Path("exports/robot/design.toml").exists():
        later = Path("exports/robot/design.toml").stat().st_mtime_ns + 1
        os.utime(file, ns=(later, later))


def test_a_bare_name_is_the_template_and_a_path_the_bundle(
    capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(bundle, "kenan-2.0")
    shutil.copytree(bundle, "mine")
    note = "jumpcad: kenan-2.0 is the template; write ./kenan-2.0 for the bundle of this name\n"
    for subject, model, told in (("kenan-2.0", "printed", note), ("./kenan-2.0", "URDF", ""), ("mine", "URDF", "")):
        code, out, err = run(capsys, "simulate", subject, "--json")
        assert (code, err) == (0, told)
        assert json.loads(out)["model"] == model
    light = json.loads(run(capsys, "simulate", "kenan-2.0", "--workshop", "light", "--json")[1])
    assert light["mass_kg"] != json.loads(out)["mass_kg"]


@pytest.mark.parametrize("command", ["simulate", "build", "render"])
def test_a_workshop_cannot_apply_to_a_bundle(
    capsys: pytest.CaptureFixture[str], bundle: Path, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, command, bundle, "--workshop", "fine")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert f"--workshop fine: {bundle} is a bundle" in err
    if command == "simulate":
        assert "leave --workshop out" in run(capsys, command, bundle / "urdf/kenan-2.0.urdf", "--workshop", "fine")[2]
    assert list(tmp_path.iterdir()) == []


def test_links_in_a_bundle_are_not_read(capsys: pytest.CaptureFixture[str], bundle: Path, tmp_path: Path) -> None:
    for command, path in (
        ("simulate", "urdf/kenan-2.0.urdf"), ("simulate", "urdf/kenan-2.0.loop.json"), ("build", "design.toml"),
        ("render", "workshop.toml"),
    ):  # fmt: skip
        own = Path(shutil.copytree(bundle, tmp_path / "own"))
        (own / path).rename(tmp_path / "moved")
        (own / path).symlink_to("/dev/zero")
        code, out, err = run(capsys, command, own)
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert f"{path}: a link" in err
        shutil.rmtree(own)


def test_a_new_file_is_as_open_as_the_umask_says(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        assert run(capsys, "new", tmp_path / "a.toml")[0] == 0
    finally:
        os.umask(before)
    assert (tmp_path / "a.toml").stat().st_mode & 0o777 == 0o640
    (tmp_path / "a.toml").write_text("mine")
    assert "a.toml: exists already" in run(capsys, "new", tmp_path / "a.toml")[2]
    assert (tmp_path / "a.toml").read_text() == "mine"
    assert run(capsys, "new", tmp_path / "a.toml", "--force")[0] == 0


def test_the_bodies_of_the_manifest_are_the_robots(bundle: Path) -> None:
    manifest = json.loads((bundle / "manifest.json").read_text())
    assert tuple(manifest["bodies"]) == BODY_NAMES
    for body in manifest["bodies"].values():
        tensor = body["inertia_kg_m2"]
        moments = sorted(tensor[i][i] for i in range(3))
        assert moments[2] <= moments[0] + moments[1], "no rigid body breaks the triangle rule"
