"""`jumpcad build`, `render`, `verify`, and `simulate` of what was built."""

import json
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
    code, out, _ = run(capsys, "verify", tmp_path / "b")
    assert (code, out) == (1, "design.toml: changed\n")


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


def test_the_bodies_of_the_manifest_are_the_robots(bundle: Path) -> None:
    manifest = json.loads((bundle / "manifest.json").read_text())
    assert tuple(manifest["bodies"]) == BODY_NAMES
    for body in manifest["bodies"].values():
        tensor = body["inertia_kg_m2"]
        moments = sorted(tensor[i][i] for i in range(3))
        assert moments[2] <= moments[0] + moments[1], "no rigid body breaks the triangle rule"
