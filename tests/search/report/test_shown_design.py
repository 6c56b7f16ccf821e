"""The designs that a study's page shows: points that are links, side views, figures, and the command of each."""

import math
import re

import numpy as np
import pytest

from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.search.fronts import SPRING_ENERGY, find_cost
from jumpcad.search.report.drawings import Axes, scale
from jumpcad.search.report.figures import with_unit
from jumpcad.search.report.shown_design import HEADLINES, box_mm, chart, joints_mm, shown_design
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial

DESIGN = load_design("best-ga")
LINKAGE = Design.from_vector([100.0, 0.9, 0.8, 0.7, 0.6, 50.0, 20.0, 30.0])


def trial(score: float | None, ratio: float, **metrics: float) -> Trial:
    design = DESIGN.model_copy(update={"compression_ratio": ratio})
    return Trial("ga", 0, 0, design, Evaluation("tips" if score is None else "jump", metrics), score, "m", 0.0)


def told(**metrics: float) -> tuple[dict[str, str], dict[str, str]]:
    """Return what is shown at once and on a click of the study's seventh trial."""
    one = Trial("bo", 1, 0, DESIGN, Evaluation("jump", metrics), 2.5, "m", 0.0, {}, {"body.plate_mm": 3.0})
    found = shown_design(one, 7, "my study.db")
    assert found["command"] == "jumpcad studio 'my study.db' --trial 7"
    return dict(found["first"]), dict(found["others"])


def test_every_design_is_a_point_at_its_energy_and_score() -> None:
    trials = [trial(1.0, 0.3), trial(None, 0.4), trial(0.5, 0.5), trial(4.0, 0.6)]
    for is_front in (True, False):
        found = chart(trials, [trials[0], trials[3]], [7, 12], SPRING_ENERGY, is_front, "s.db")
        energies = [one.design.spring_energy_j for one in (trials[0], trials[2], trials[3])]
        axes = Axes(scale(energies), scale([1.0, 0.5, 4.0]))
        places = [(axes.x(energy), axes.y(score)) for energy, score in zip(energies, (1.0, 0.5, 4.0), strict=True)]
        dots = re.findall(r"M([\d.]+) ([\d.]+)h0", found["others"])
        assert [(float(x), float(y)) for x, y in dots] == [pytest.approx(one, abs=0.051) for one in places]
        assert [one["place"] for one in found["shown"]] == [places[0], places[2]]
        assert [(one["number"], one["of_study"], one["cost"]) for one in found["shown"]] == [
            (1, 7, energies[0]), (2, 12, energies[2])
        ]  # fmt: skip
        assert bool(found["line"]) == is_front


def test_a_chart_of_more_of_both_has_the_figure_itself() -> None:
    """Rises to the right of 0, and the design that rises most farthest to the right."""
    rises, scores = (0.5, 0.125, 0.25), (1.0, 3.0, 2.0)
    trials = [trial(score, 0.5, com_rise_m=rise) for rise, score in zip(rises, scores, strict=True)]
    found = chart(trials, trials, [1, 2, 3], find_cost("rise"), True, "s.db")
    assert [one["cost"] for one in found["shown"]] == list(rises)
    axes = Axes(scale(rises), scale(scores))
    assert [one["place"][0] for one in found["shown"]] == pytest.approx([axes.x(rise) for rise in rises])
    assert axes.x(0.5) > axes.x(0.125)


def test_links_are_told_from_the_hub_to_the_toe() -> None:
    l2 = DESIGN.carrying_link_mm
    lengths = (l2, DESIGN.c_coef * l2, DESIGN.d_coef * l2, DESIGN.e_coef * l2)
    first, _ = told()
    assert first["main leg, front link, foot, toe"] == ", ".join(f"{one:.1f}" for one in lengths) + " mm"
    assert first["body.plate_mm"] == "3 mm"


def test_headlines_come_first_and_nothing_twice() -> None:
    """Figures of estimates alone are not shown."""
    first, others = told(laid_coil_mm=0.5, turn_rate_deg_s=90.0, **dict.fromkeys(HEADLINES, 0.125))
    assert list(first.values()).count("125 mm") == 3  # touchdown, range, rise
    assert "125 g" in first.values()
    assert others == {"rate of that turn": "90 °/s"}


def test_every_number_stands_with_its_unit_and_the_energy_is_that_of_the_evaluation() -> None:
    """Of a study without that figure it follows from the design."""
    first, others = told(spring_energy_j=0.125, mass_kg=0.1)
    for name, value in DESIGN.model_dump().items():
        assert first[name] == with_unit(f"{value:.5g}", name)
    assert (first["rest_angle_deg"][-1], first["carrying_link_mm"][-3:]) == ("°", " mm")
    assert first["energy in the springs"] == "125 mJ"
    assert others == {}
    assert told()[0]["energy in the springs"] == f"{1000.0 * DESIGN.spring_energy_j:.4g} mJ"


def angle(vector):
    return math.atan2(vector[1], vector[0])


@pytest.mark.parametrize("design", [LINKAGE, load_design("kenan-2.0"), load_design("best-printable")])
def test_links_have_their_lengths_and_the_foot_is_flat(design):
    for joints in joints_mm(design).values():
        at = {name: np.array(place) for name, place in joints.items()}
        lengths = {
            ("ankle", "back pivot"): design.l2_mm,
            ("front eye", "front pivot"): design.l3_mm,
            ("ankle", "front eye"): design.l4_mm,
            ("back pivot", "front pivot"): design.l1_mm,
            ("toe tip", "ankle"): design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg)),
        }
        for (one, other), length in lengths.items():
            assert np.hypot(*(at[one] - at[other])) == pytest.approx(length, abs=0.15)
        assert [at[name][1] for name in ("toe tip", "ankle", "front eye")] == [0.0] * 3
        assert at["toe tip"][0] < at["ankle"][0] == 0.0 < at["front eye"][0]


def test_legs_are_parallel_at_rest_and_turn_by_the_loaded_angle():
    poses = {name: {point: np.array(at) for point, at in pose.items()} for name, pose in joints_mm(LINKAGE).items()}
    rest, loaded = poses["rest"], poses["loaded"]
    front, back = (rest[f"{end} pivot"] - rest[joint] for end, joint in (("front", "front eye"), ("back", "ankle")))
    assert angle(front) == pytest.approx(angle(back), abs=0.003)
    turned = [
        angle(at["front pivot"] - at["back pivot"]) - angle(at["ankle"] - at["back pivot"]) for at in (rest, loaded)
    ]
    assert turned[0] == pytest.approx(math.radians(50.0), abs=0.003)
    assert turned[0] - turned[1] == pytest.approx(LINKAGE.compression_rad, abs=0.004)


def test_all_points_of_both_poses_lie_in_the_box():
    designs = [LINKAGE, load_design("kenan-2.0")]
    left, low, right, high = box_mm(designs)
    for design in designs:
        for pose in joints_mm(design).values():
            assert all(left < x < right and low < z < high for x, z in pose.values())


def test_a_design_without_a_pose_leaves_the_box_to_others():
    impossible = Design.from_vector([100.0, 1.4, 0.2, 0.7, 0.6, 80.0, 20.0, 30.0])
    with pytest.raises(CannotBuildError, match="no assembled pose"):
        joints_mm(impossible)
    assert box_mm([impossible, LINKAGE]) == box_mm([LINKAGE])
