"""`jumpcad coupon`: from the coupon through its readings to a workshop that robots are built in."""

import csv
import hashlib
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.commands import Run
from support.fits import measured
from support.slicers import OBEDIENT, pretend_slicer, three_parts, with_seams_behind

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.bundle.manifest import open_bundle, verify
from jumpcad.design import load_design
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop


@pytest.mark.thorough
def test_a_coupon_is_printed_tried_and_built_with(run: Run, tmp_path: Path) -> None:
    code, out, err = run("coupon", "--json")
    assert (code, err) == (0, "")
    folder = tmp_path / "exports" / "coupon"
    files = json.loads(out)["files"]
    assert {"stl/gauge_PETG.stl", "stl/gauge_PLA.stl", "stl/gear_wheel.stl", "print/plate-1-PETG.3mf"} <= set(files)
    assert verify(folder) == []
    assert load_workshop(folder / "workshop.toml") == load_workshop("default")

    guide, template = (folder / "coupon.md").read_text(), (folder / "readings.toml").read_text()
    keys = {line.split()[1] for line in template.splitlines() if line.startswith("# ") and " = " in line}
    assert keys == {key for key in keys if f"`{key}`" in guide}
    assert "{" not in guide

    filled = template.replace("# axle_press_mm = 0.10", "axle_press_mm = 0.15").replace(
        "# turns_freely", "turns_freely"
    )
    (tmp_path / "readings.toml").write_text(filled)
    code, out, err = run("coupon", "--measured", "readings.toml", "--json")
    assert (code, err) == (0, "")
    assert json.loads(out)["fits"]["holes_small_mm"] == {"before": 0.0, "after": 0.1}
    workshop = load_workshop(tmp_path / "my-workshop.toml")
    robot = build(load_design("kenan-2.0"), workshop)
    found = measured(robot, "main_leg", 0.0, np.array([robot.layout.leg_pin_mm, 0.0]))
    assert found == pytest.approx(3.0 + 2.0 * 0.15, abs=0.01)


def test_a_workshop_keeps_its_comments_with_measured_values(run: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        'base = "default"\n[fits]  # by Ada\npress_mm = 0.12  # old nozzle\n\n[body]\nplate_mm = 2.8  # stiffer\n',
        encoding="utf-8",
    )
    (tmp_path / "inline.toml").write_text('base = "default"\nfits = {press_mm = 0.12}\n', encoding="utf-8")
    (tmp_path / "r.toml").write_text(
        "axle_mm = 3\n[gauge.PETG]\naxle_press_mm = 0.15\naxle_sliding_mm = 0.25\n", encoding="utf-8"
    )
    for name in ("mine", "inline"):
        shop, out = tmp_path / f"{name}.toml", tmp_path / f"{name}-measured.toml"
        code, _, err = run("coupon", "--measured", tmp_path / "r.toml", "--workshop", shop, "-o", out)
        assert (code, err) == (0, "")
        fits = load_workshop(out).fits.drawn
        assert (fits.press_mm, fits.sliding_mm) == (0.15, 0.25), name
    text = (tmp_path / "mine-measured.toml").read_text(encoding="utf-8")
    assert text.startswith('base = "default"\n[fits]  # by Ada\npress_mm = 0.12  # old nozzle\nsliding_mm = 0.22\n')
    assert "plate_mm = 2.8  # stiffer" in text


needs_slicer = needs.without("prusa-slicer")


@pytest.fixture(scope="module")
def built(small_robot: Robot, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bundle of three kinds of parts."""
    return export(three_parts(small_robot), tmp_path_factory.mktemp("bundles") / "frog", pictures=False).folder


@pytest.fixture
def bundle(built: Path, tmp_path: Path) -> Path:
    """A copy, since slicing writes times into it."""
    return Path(shutil.copytree(built, tmp_path / "frog"))


@pytest.fixture
def pretend(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Put a Python program in the slicer's place."""
    return lambda program: pretend_slicer(program, tmp_path, monkeypatch)


@pytest.mark.thorough
@needs_slicer
def test_sliced_masses_agree_with_the_model_and_become_weighed_ones(
    run: Run, bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_seams_behind(monkeypatch)
    code, out, err = run("slice", str(bundle), "--write-masses", "weighed.toml", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert found["ignored"] == {}
    parts = {part["name"]: part for part in found["parts"]}
    assert set(parts) == {"body_plate_left", "front_link", "ring"}
    assert all(abs(part["difference"]) < 0.06 for part in parts.values())
    for plate in found["plates"]:  # sliced as a whole: the same plastic; small parts need not cool while others print
        on_it = [part for part in parts.values() if part["material"] == plate["material"]]
        assert plate["grams"] == pytest.approx(sum(part["quantity"] * part["grams"] for part in on_it), rel=0.005)
        assert plate["time_s"] > 0.95 * max(part["time_s"] for part in on_it)
        assert plate["time_s"] < 1.05 * sum(part["quantity"] * part["time_s"] for part in on_it)
    assert [plate["material"] for plate in found["plates"]] == ["PETG", "PLA"]

    before, after = load_workshop(bundle / "workshop.toml"), load_workshop(tmp_path / "weighed.toml")
    assert after.mass.weighed_g == {name: pytest.approx(part["grams"], abs=6e-4) for name, part in parts.items()}
    assert after.model_copy(update={"mass": before.mass}) == before


def test_times_go_into_bill_and_guide(run: Run, built: Path, bundle: Path, pretend: Callable[[str], None]) -> None:
    pretend(OBEDIENT.replace("TAMPER", ""))
    code, out, err = run("slice", "frog")
    assert (code, err) == (0, "")
    assert "written   the times, into bom.csv and order.md of frog" in out
    lines = {line["item"]: line for line in csv.DictReader((bundle / "bom.csv").open(encoding="utf-8-sig"))}
    assert lines["ring"]["print_time_s"] == lines["plate-1-PLA"]["print_time_s"] == "3750"
    assert {line["print_time_s"] for line in lines.values() if line["kind"] == "bought"} == {""}
    assert [line["print_time_s"] for line in lines.values() if line["kind"] == "total"] == ["7500"]
    assert "| plate-1-PLA | 1:02 h |" in (bundle / "order.md").read_text()
    assert verify(bundle) == []
    before, after = (open_bundle(folder).manifest for folder in (built, bundle))
    changed = {path for path in after["files"] if after["files"][path] != before["files"][path]}
    assert changed == {"bom.csv", "order.md"}
    assert after["versions"] == before["versions"] | {"PrusaSlicer": "2.9.1"}


def test_changed_and_missing_files_are_named(run: Run, bundle: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken"
    shutil.copytree(bundle, broken)
    (broken / "stl" / "ring.stl").unlink()
    (broken / "workshop.toml").write_text("")
    code, out, err = run("slice", "broken")
    assert (code, out) == (2, "")
    assert "stl/ring.stl: missing" in err
    assert "workshop.toml: changed" in err
    assert err.count("\n") == 1


def test_nothing_is_written_or_read_outside_of_a_bundle(
    run: Run, bundle: Path, pretend: Callable[[str], None], tmp_path: Path
) -> None:
    pretend(OBEDIENT.replace("TAMPER", ""))
    home = tmp_path / "home"
    home.mkdir()
    (home / ".bashrc").write_text("precious")
    (bundle / "lnk").symlink_to(bundle / "stl")
    good = (bundle / "manifest.json").read_text()
    manifest = json.loads(good)
    manifest["files"]["lnk/../../home/.bashrc"] = hashlib.sha256(b"precious").hexdigest()
    (bundle / "manifest.json").write_text(json.dumps(manifest))
    code, out, err = run("slice", "frog")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "is not the manifest of a bundle" in err

    (bundle / "manifest.json").write_text(good)
    (bundle / "bom.csv").rename(home / "bom.csv")
    (bundle / "bom.csv").symlink_to(home / "bom.csv")
    before = (home / "bom.csv").read_bytes()
    code, out, err = run("slice", "frog")
    assert (code, out) == (2, "")
    assert "bom.csv: a link" in err
    assert (home / "bom.csv").read_bytes() == before
    assert (home / ".bashrc").read_text() == "precious"
