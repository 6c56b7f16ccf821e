"""What a study file cannot have been written is refused."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.store import StudyStore


@pytest.mark.parametrize(
    ("made", "message"),
    [
        ({"made.spring_factor": 1e300, "made.friction_factor": 1.0}, "must be a number of 0.01 to 100"),
        ({"made.spring_factor": -1.0, "made.friction_factor": 1.0}, "made.spring_factor = -1"),
        ({"made.spring_factor": 1.0, "made.friction_factor": "x"}, "made.friction_factor = 'x'"),
        ({"made.spring_factor": 1.0}, "made.friction_factor: missing"),
        ({"made.carrying_link_mm": 1e300}, "made.carrying_link_mm = 1e+300"),
        ({"made.stiffness_nmm_per_deg": "x"}, "made.stiffness_nmm_per_deg = 'x'"),
    ],
)
def test_what_cannot_be_made_is_a_damaged_row(tmp_path: Path, made: dict[str, object], message: str) -> None:
    (trial,) = trials(1, phase="robust")
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([replace(trial, workshop=made)])
        with pytest.raises(JumpcadError, match=f"is damaged: row 'robust' 0 0: .*{re.escape(message)}"):
            store.trials()
