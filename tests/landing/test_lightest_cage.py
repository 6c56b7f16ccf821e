"""The lightest cage: a search whose answer is known by hand, a robot that none rights, and best-jumper's."""

from pathlib import Path

import pytest
from support.commands import exit_code_of

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.landing import lightest_cage as module
from jumpcad.landing.lightest_cage import Cost, lightest_cage, searched
from jumpcad.workshop import Workshop, load_workshop

START = {"lean_deg": 24.0, "arc_deg": 270.0, "rear_behind_mm": 30.0, "front_ahead_mm": 60.0, "rear_radius_mm": 80.0,
         "front_radius_mm": 130.0}  # fmt: skip


def test_the_search_finds_the_least_mass_that_lacks_nothing() -> None:
    """Both radii must be 100 mm or more, and only they weigh: 1 g a millimetre. The last steps are 4 mm."""
    shop, asked = load_workshop(), list[tuple[float, ...]]()

    def judged(sizes: dict[str, float]) -> tuple[Cost, Workshop]:
        asked.append(tuple(sizes.values()))
        radii = sizes["rear_radius_mm"], sizes["front_radius_mm"]
        return (sum(max(0.0, 100.0 - radius) for radius in radii), sum(radii)), shop

    (lacking, mass), _ = min(searched(START, judged), key=lambda one: one[0])
    assert lacking == 0.0
    assert 200.0 <= mass < 208.0
    assert len(asked) == len(set(asked)) <= module.MOST


def test_a_robot_that_no_cage_rights_is_one_line_and_no_file(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Kenan 2.0 crouches too high (docs/decisions/cage.md)."""
    monkeypatch.setattr(module, "MOST", 2)
    words = r"none rights it: .* in \d\d % of its stable poses, 95 % .*: raise compression_ratio"
    with pytest.raises(CannotBuildError, match=words) as refusal:
        lightest_cage(load_design("kenan-2.0"), load_workshop())
    assert "\n" not in str(refusal.value)
    assert refusal.value.margin < -0.5
    assert exit_code_of("cage", "kenan-2.0", "-o", str(tmp_path / "caged.toml")) == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.thorough
def test_the_cage_found_for_best_jumper_is_no_heavier_than_the_templates(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """What the command writes is a workshop, in which the robot keeps all limits of the cage."""
    pytest.importorskip("mujoco")
    monkeypatch.setattr(module, "TRIES", 15)
    path = tmp_path / "caged.toml"
    assert exit_code_of("cage", "best-jumper", "-o", str(path)) == 0
    assert capsys.readouterr().out.startswith(text := path.read_text(encoding="utf-8").split("base = ")[0])
    assert text.startswith("# best-jumper")
    design = load_design("best-jumper")
    found, usual = build(design, load_workshop(str(path)), ""), build(design, load_workshop("best-jumper"), "")
    assert found.mass_kg <= usual.mass_kg
