"""A small study that the studio opens."""

from pathlib import Path

import pytest
from support.studies import IDENTITY

from jumpcad.design import load_design
from jumpcad.search.study.objective import CANNOT_BUILD, Evaluation
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial

CHANGES = (
    {"carrying_link_mm": 140.0},  # the best
    {"compression_ratio": 0.9},  # no cam winds that far
    {},
    {"stiffness_nmm_per_deg": 6.0},  # least energy
)
SCORES = (2.0, None, 1.5, 1.0)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four trials about kenan-2.0, the second of which cannot be built."""
    file, centre = tmp_path_factory.mktemp("study") / "four.db", load_design("kenan-2.0")
    trials = [
        Trial(
            "ga", 0, place, centre.model_copy(update=change),
            Evaluation(CANNOT_BUILD if score is None else "jump", {} if score is None else {"fitness": score}),
            score, "m", 0.1,
        )
        for place, (change, score) in enumerate(zip(CHANGES, SCORES, strict=True))
    ]  # fmt: skip
    with StudyStore.write(file, IDENTITY) as store:
        store.append(trials)
    return file
