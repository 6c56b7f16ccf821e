"""What a study's page says of a design: its links, its figures, and the command that shows it again."""

import re

from jumpcad.design import load_design
from jumpcad.search.objective import Evaluation, find_objective
from jumpcad.search.shown_design import HEADLINES, shown_designs
from jumpcad.search.trial import Trial

DESIGN = load_design("best-ga")


def told(**metrics: float) -> str:
    """Return a section of the page as text: the study's seventh trial, shown as the first."""
    trial = Trial("bo", 1, 0, DESIGN, Evaluation("jump", metrics), 2.5, "m", 0.0, {}, {"body.plate_mm": 3.0})
    page = "\n".join(shown_designs([trial], [7], find_objective("fitness"), "my study.db"))
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"<wbr ?/?>", "", page)).split())


def test_a_design_is_told_by_its_number_in_the_study() -> None:
    text = told(ballistic_range_m=0.25)
    assert "Design 1 (trial 7): 2.5" in text
    assert "jumpcad studio &#x27;my study.db&#x27; --trial 7" in text or "'my study.db' --trial 7" in text


def test_links_are_told_from_the_hub_to_the_toe() -> None:
    l2 = DESIGN.carrying_link_mm
    lengths = (l2, DESIGN.c_coef * l2, DESIGN.d_coef * l2, DESIGN.e_coef * l2)
    text = told()
    assert "main leg, front link, foot, toe " + ", ".join(f"{one:.1f}" for one in lengths) + " mm" in text
    assert "body.plate_mm 3 mm" in text


def test_headlines_come_first_and_nothing_twice() -> None:
    figures = {"a_share": 0.5, **dict.fromkeys(HEADLINES, 0.125)}
    text = told(**figures)
    first, others = text.split("more figures (1)")
    assert first.count("125 mm") == 2
    assert "125 g" in first
    assert "a share 0.5" in others
