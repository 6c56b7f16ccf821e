"""A finding's margin and use follow from its value and limit."""

import math

import pytest
from support.each import each

from jumpcad.findings import Change, at_least, at_most, choose, higher, lower, nearer_to_1


@each(
    ("value", "allowed", "margin", "use", "severity"),
    [
        (10.0, 40.0, 30.0, 0.25, "info"), (40.0, 40.0, 0.0, 1.0, "info"), (50.0, 40.0, -10.0, 1.25, "error"),
        (0.0, 40.0, 40.0, 0.0, "info"), (-5.0, 40.0, 45.0, None, "info"), (1.0, 0.0, -1.0, None, "error"),
        (5.0, math.inf, math.inf, 0.0, "info"), (math.inf, 5.0, -math.inf, math.inf, "error"),
    ],
)  # fmt: skip
def test_use_is_the_value_over_a_maximum(
    value: float, allowed: float, margin: float, use: float | None, severity: str
) -> None:
    finding = at_most("stress", value, allowed, "MPa", "found", "remedy")
    assert (finding.margin, finding.use, finding.severity) == (margin, use, severity)
    assert (finding.value, finding.limit) == (value, allowed)


@pytest.mark.parametrize(
    ("value", "needed", "margin", "use", "severity"),
    [
        (2.0, 0.5, 1.5, 0.25, "info"),
        (0.5, 0.5, 0.0, 1.0, "info"),
        (0.4, 0.5, 0.4 - 0.5, 1.25, "warning"),
        (-0.4, 0.5, -0.9, None, "warning"),
        (3.0, 0.0, 3.0, None, "info"),
    ],
)
def test_use_is_a_minimum_over_the_value(
    value: float, needed: float, margin: float, use: float | None, severity: str
) -> None:
    finding = at_least("gap", value, needed, "mm", "found", "remedy", "warning")
    assert (finding.margin, finding.use, finding.severity) == (margin, use, severity)


def test_plain_data_has_the_remedy_in_words() -> None:
    """Neighbours that are changed alike stand in a row, a number with its own parameter."""
    ways = higher("d_coef", "c_coef", note="a longer body") + lower("e_coef") + nearer_to_1("l1")
    for remedy, words in (
        ("drill it", "drill it"),
        (ways, "raise d_coef or c_coef (a longer body), or lower e_coef, or bring l1 nearer to 1"),
        (
            (Change("a", "raise", "softer", 1.25), *higher("a", "b", "c")),
            "raise a to 1.25 (softer), or raise a, b or c",
        ),
        ((Change("l1", "bring nearer to 1", value=0.5), "drill it"), "bring l1 to 0.5, or drill it"),
        (choose("a smaller", "bought.a", "bought.b"), "choose a smaller bought.a, or choose a smaller bought.b"),
    ):
        data = at_most("stress", 10.0, 40.0, "MPa", "found", remedy, grows="leg").to_dict()
        assert list(data)[:6] == ["name", "severity", "margin", "unit", "message", "remedy"]
        assert data["remedy"] == words
