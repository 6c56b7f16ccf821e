"""Details of steps: of a step that there is, with parts that are on the robot then, and what is framed in view."""

import re

import pytest
from support.built import built

from jumpcad.scene.renderer import View
from jumpcad.steps.assembly_steps import ORDER, Inset, assembly_steps

INSETS = {inset.name: (plan.key, inset) for plan in ORDER for inset in plan.insets}


@pytest.mark.parametrize(("key", "inset"), INSETS.values(), ids=INSETS)
def test_a_detail_shows_what_it_frames_of_parts_that_are_there(key: str, inset: Inset) -> None:
    there: set[str] = set()
    robot = built(*(("best-jumper", "best-jumper") if key == "cage" else ("kenan-2.0",)))
    for step in assembly_steps(robot):
        there |= {thing.name for thing in step.added}
        if step.key == key:
            break
    framed = {name for name in there if re.fullmatch(inset.framed, name)}
    assert framed
    assert all(re.fullmatch(inset.shown, name) for name in framed)
    assert inset.room >= 1.0


@pytest.mark.parametrize("inset", [inset for _, inset in INSETS.values()], ids=INSETS)
def test_a_detail_is_seen_from_where_its_title_says(inset: Inset) -> None:
    """The camera is where the picture's third axis points: y to the left, z up."""
    _, y, z = View(*inset.view_deg).axes[2]
    for words, towards in (("from the left", y), ("from the right", -y), ("from below", -z)):
        assert words not in inset.title or towards > 0.4
