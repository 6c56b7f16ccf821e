"""Rows of a study file are read as they were written, those of older versions too."""

import json
import math

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding, at_most
from jumpcad.search.stored import stored_evaluation

OLD = {"name": "loop", "severity": "info", "margin": 1.5, "unit": "mm", "message": "found", "remedy": "change"}


def record(*findings: dict[str, object]) -> dict[str, bytes]:
    return {"verdict": b"jump", "metrics": b"{}", "findings": json.dumps(findings).encode(), "detail": b""}


def test_findings_come_back_with_value_and_limit_or_without() -> None:
    new = at_most("leg_strength", 10.0, 40.0, "MPa", "found", "change", grows="leg")
    old, again = stored_evaluation(record(OLD, new.to_dict())).findings
    assert old == Finding("loop", "info", 1.5, "mm", "found", "change")
    assert again == new


@pytest.mark.parametrize("figure", ["margin", "value", "limit"])
def test_what_is_not_a_number_is_refused(figure: str) -> None:
    with pytest.raises(JumpcadError, match=f"the {figure} of loop is not a number"):
        stored_evaluation(record({**OLD, figure: math.nan}))
