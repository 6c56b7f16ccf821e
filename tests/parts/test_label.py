"""A plate's name is engraved where there is material for all of it."""

import numpy as np
import pytest

from jumpcad.building import build
from jumpcad.checks.engraving import engraving_findings
from jumpcad.design import load_design
from jumpcad.parts.body_plate import ENGRAVING_MM, TEXT_HEIGHTS_MM
from jumpcad.robot import Robot
from jumpcad.solids.text import engravable, text


def engraved_mm2(name: str, label: str) -> dict[str, float]:
    """Return what a label takes from each plate's section, just above its chamfer."""
    plain, named = (build(load_design(name), name=label) for label in ("", label))

    def areas(robot: Robot) -> dict[str, float]:
        height = np.array([0.98 * ENGRAVING_MM])
        plates = [part for part in robot.parts if "plate" in part.name]
        return {part.name: part.drawing.shape.regions_at(height)[0].area() for part in plates}

    return {part: area - areas(named)[part] for part, area in areas(plain).items()}


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"])
def test_the_whole_label_is_cut_from_the_plate(name: str) -> None:
    """What is lost is the letters' area: no letter hangs over a hole or an edge."""
    for part, lost in engraved_mm2(name, name).items():
        areas = [text(f"{name} {part.split('_')[-1][0].upper()}", height).area() for height in TEXT_HEIGHTS_MM]
        assert min(abs(lost / area - 1.0) for area in areas) < 1e-6


def test_a_label_that_finds_no_room_is_its_last_letter() -> None:
    lost = engraved_mm2("kenan-2.0", "a name that is far too long for any plate of a robot as small as this one")
    for part, letter in (("body_plate_left", "L"), ("body_plate_right", "R")):
        assert lost[part] == pytest.approx(text(letter, TEXT_HEIGHTS_MM[0]).area(), rel=1e-6)


@pytest.mark.parametrize(("name", "shown", "lacking"), [("Käfer-机器人", "Käfer-", "机器人"), ("🐸\t", "", "🐸\t")])
def test_letters_that_the_font_lacks_are_left_out_and_said(name: str, shown: str, lacking: str) -> None:
    """The engraving's font has Latin letters, but neither Chinese nor emoji nor control characters."""
    assert engravable(name) == shown
    for part, lost in engraved_mm2("kenan-2.0", name).items():
        areas = [text(f"{shown} {part.split('_')[-1][0].upper()}".strip(), height).area() for height in TEXT_HEIGHTS_MM]
        assert min(abs(lost / area - 1.0) for area in areas) < 1e-6
    [finding] = engraving_findings(build(load_design("kenan-2.0"), name=name))
    assert (finding.severity, finding.margin) == ("warning", -len(lacking))
    assert repr(lacking) in finding.message
    assert engraving_findings(build(load_design("kenan-2.0"), name="Жук αβ")) == []
