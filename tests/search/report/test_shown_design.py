"""What a study's page says of a design: its links, its figures, and the command that shows it again."""

import re

from jumpcad.design import load_design
from jumpcad.search.report.shown_design import HEADLINES, shown_designs
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.trial import Trial

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


def test_all_designs_are_drawn_to_one_scale_in_which_the_largest_fits() -> None:
    large = DESIGN.model_copy(update={"carrying_link_mm": 1.5 * DESIGN.carrying_link_mm})
    trials = [Trial("bo", 1, n, one, Evaluation("jump"), 2.5, "m", 0.0) for n, one in enumerate((DESIGN, large))]
    text = "\n".join(shown_designs(trials, [1, 2], find_objective("range"), "s.db"))
    boxes = re.findall(r'class="side" viewBox="([^"]*)"', text)
    assert len(boxes) == 2
    assert len(set(boxes)) == 1
    left, top, width, height = map(float, boxes[0].split())
    joints = [(float(x), float(y)) for x, y in re.findall(r'<circle cx="([^"]*)" cy="([^"]*)"', text)]
    assert len(joints) == 16
    assert all(left < x < left + width and top < y < top + height for x, y in joints)


def test_headlines_come_first_and_nothing_twice() -> None:
    figures = {"a_share": 0.5, **dict.fromkeys(HEADLINES, 0.125)}
    text = told(**figures)
    first, others = text.split("more figures (1)")
    assert first.count("125 mm") == 2
    assert "125 g" in first
    assert "a share 0.5" in others


def test_every_number_stands_with_its_unit_and_the_energy_is_that_of_the_evaluation() -> None:
    """Of a study without that figure it follows from the design."""
    values = DESIGN.model_dump()
    text = told(spring_energy_j=0.125, mass_kg=0.1)
    assert f"carrying_link_mm {values['carrying_link_mm']:.5g} mm" in text
    assert f"rest_angle_deg {values['rest_angle_deg']:.5g}°" in text
    assert f"stiffness_nmm_per_deg {values['stiffness_nmm_per_deg']:.5g} N·mm/°" in text
    assert f"c_coef {values['c_coef']:.5g} d_coef" in text
    assert "energy in the springs 125 mJ" in text
    assert "more figures" not in text
    assert f"energy in the springs {1000.0 * DESIGN.spring_energy_j:.4g} mJ" in told()
