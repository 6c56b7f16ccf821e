"""Why a search found nothing: the nearest design in any unit, numbers that admit it, bounds that a cure lies beyond."""

from dataclasses import replace

import numpy as np
from support.hills import SMALL, Hill

from jumpcad.design import Design, load_design
from jumpcad.findings import errors
from jumpcad.search.models import robot_model
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.requirement import Requirement, requirements_of, violations
from jumpcad.search.study.trial import Trial, nearest_to_required
from jumpcad.search.study.why_none import why_rejected, why_required

PLACES = SMALL.spread(24, np.random.default_rng(0))


def trials_in(pitch: float = 1.0, rise: float = 1.0) -> list[Trial]:
    """Return jumps that turn and rise the more the farther along an axis; nobody keeps both of what is required."""
    kept = [Requirement("touchdown_pitch_deg", None, 20.0 * pitch), Requirement("com_rise_m", 0.4 * rise, None)]
    found = []
    for place, (x, y, _) in enumerate(PLACES.tolist()):
        figures = {"touchdown_pitch_deg": (30.0 + 60.0 * x) * pitch, "com_rise_m": 0.3 * y * rise, "fitness": 1.0 + x}
        evaluation = Evaluation("jump", figures, tuple(violations(kept, figures, {})))
        found.append(Trial("bo", 0, place, SMALL.to_design(PLACES[place]), evaluation.bare, None, "m", 0.0))
    return found


def test_what_is_required_is_learned_alike_in_any_unit_also_where_no_design_keeps_it() -> None:
    points = SMALL.spread(64, np.random.default_rng(1))
    found = []
    for units in ((1.0, 1.0), (1e-3, 1e3), (60.0, 1e-4)):
        trials = trials_in(*units)
        posterior = SearchPosterior.from_trials(SMALL, trials, {}, True)
        found.append(posterior.log_feasible(points))
        best = points[found[-1].argmax()]
        assert best[0] < 0.2
        assert best[1] > 0.5
        assert [one.place for one in nearest_to_required(trials)] == [
            one.place for one in nearest_to_required(trials_in())
        ]
    for other in found[1:]:
        assert np.abs(other - found[0]).max() < 1e-2 * np.abs(found[0]).max()


def test_what_is_to_relax_admits_the_nearest_design() -> None:
    """With these figures it keeps the new requirements, however the numbers are rounded."""
    for units in ((1.0, 1.0), (7.7e-3, 333.3), (61.3, 1.7e-4)):
        trials = trials_in(*units)
        told = why_required(trials).partition(": relax ")[2].removesuffix(", or evaluate more designs")
        relaxed = [f"{one.split('=')[0]}={one.split(' to ')[1]}" for one in told.split(" and ")]
        asked = requirements_of(relaxed, ["touchdown_pitch_deg", "com_rise_m"])
        keeping = [one for one in trials if not errors(violations(asked, one.evaluation.metrics, {}))]
        assert nearest_to_required(trials)[0] in keeping
        assert len(keeping) < len(trials) / 2
    assert why_required([replace(trials[0], score=1.0), *trials[1:]]) == ""


def test_the_most_frequent_refusals_have_the_bound_that_a_cure_lies_beyond() -> None:
    """By two evaluations: wound by a tenth it stays on the ground; as far as is told, it does not."""
    model = robot_model()
    space = Space.parse(bound=["compression_ratio=0.1:0.2"], workshop=model.workshop)
    weak = load_design("kenan-2.0").model_copy(update={"compression_ratio": 0.1})
    trials = [Trial("bo", 0, place, weak, model(weak).bare, None, "m", 0.0) for place in range(3)]
    assert trials[0].evaluation.reasons == ("no_takeoff",)
    line = why_rejected(trials, space, model)[0]
    assert line.startswith("no_takeoff, 3 of 3: the robot stays on the ground: ")
    assert line.endswith("move what keeps it from that: compression_ratio at most 0.2")
    cured = float(line.partition("compression_ratio to ")[2].split(",")[0])
    assert "no_takeoff" not in model(Design(**weak.model_dump() | {"compression_ratio": cured})).reasons


def test_refused_layouts_are_told_apart_by_what_they_say() -> None:
    texts = ["no room for a motor of 12 mm: raise d_coef", "no room for a motor of 9.5 mm: raise d_coef", "odd"]
    design = SMALL.to_design(PLACES[0])
    trials = [Trial("ga", 0, 0, design, Evaluation("cannot_build", detail=one), None, "m", 0.0) for one in texts]
    lines = why_rejected(trials, SMALL, Hill())
    assert lines == [f"cannot_build, 2 of 3: {texts[0]}", "cannot_build, 1 of 3: odd"]
