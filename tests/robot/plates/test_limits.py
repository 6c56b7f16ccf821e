"""A name with letters that cannot be engraved is a warning that shows them."""

from dataclasses import replace

import pytest

from jumpcad.robot.plates.limits import engraving_findings
from jumpcad.robot.robot import Robot


@pytest.mark.parametrize(("name", "lacking"), [("Käfer-机器人", "机器人"), ("🐸\t", "🐸\t"), ("人人", "人")])
def test_letters_that_the_font_lacks_are_said(kenan: Robot, name: str, lacking: str) -> None:
    """The engraving's font has Latin letters, but neither Chinese nor emoji nor control characters."""
    [finding] = engraving_findings(replace(kenan, name=name))
    assert (finding.severity, finding.margin) == ("warning", -len(lacking))
    assert repr(lacking) in finding.message


def test_greek_and_cyrillic_can_be_engraved(kenan: Robot) -> None:
    assert engraving_findings(replace(kenan, name="Жук αβ")) == []
