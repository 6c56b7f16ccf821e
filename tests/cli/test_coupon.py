"""`jumpcad coupon`: from the coupon through its readings to a workshop that robots are built in."""

import json
from pathlib import Path

import numpy as np
import pytest
from support.commands import Run
from support.fits import measured

from jumpcad.building import build
from jumpcad.bundle.manifest import verify
from jumpcad.design import load_design
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
