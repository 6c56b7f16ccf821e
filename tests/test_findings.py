"""A finding's margin and use follow from its value and limit."""

import math
from collections.abc import Callable

import pytest

from jumpcad.findings import SHOWN_AS, Finding, at_least, at_most, bare, is_bare, limit


@pytest.mark.parametrize(
    ("value", "allowed", "margin", "use", "severity"),
    [
        (10.0, 40.0, 30.0, 0.25, "info"),
        (40.0, 40.0, 0.0, 1.0, "info"),
        (50.0, 40.0, -10.0, 1.25, "error"),
        (0.0, 40.0, 40.0, 0.0, "info"),
        (-5.0, 40.0, 45.0, None, "info"),
        (1.0, 0.0, -1.0, None, "error"),
        (5.0, math.inf, math.inf, 0.0, "info"),
        (math.inf, 5.0, -math.inf, math.inf, "error"),
    ],
)
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


@pytest.mark.parametrize("make", [at_most, at_least])
def test_what_is_not_a_number_keeps_no_limit(make: Callable[..., Finding]) -> None:
    """A computation that failed says nothing about the robot: no comparison with it is true."""
    assert make("stress", math.nan, 40.0, "MPa", "found", "remedy").severity == "error"
    assert make("stress", 10.0, math.nan, "MPa", "found", "remedy").severity == "error"


def test_a_margin_alone_has_no_use() -> None:
    finding = limit("walls", 0.1, "mm", "found", "remedy")
    assert (finding.value, finding.limit, finding.use, finding.grows) == (None, None, None, "")


def test_plain_data_gives_the_finding_back() -> None:
    finding = at_most("stress", 10.0, 40.0, "MPa", "found", "remedy", grows="leg")
    data = finding.to_dict()
    assert list(data)[:6] == ["name", "severity", "margin", "unit", "message", "remedy"]
    assert Finding(**data) == finding


@pytest.mark.parametrize(
    ("unit", "read", "shown"),
    [("rad", "°", 180.0), ("rad/s", "°/s", 180.0), ("J", "mJ", 1000.0 * math.pi), ("N·m", "mN·m", 1000.0 * math.pi)],
)
def test_people_read_degrees_and_thousandths(unit: str, read: str, shown: float) -> None:
    """Of π radians, joules or newton metres."""
    word, factor = SHOWN_AS[unit]
    assert (word, factor * math.pi) == (read, pytest.approx(shown))


def test_a_finding_is_bare_without_words_and_figures() -> None:
    kept = bare("walls", "error", -0.1, "mm")
    assert is_bare(kept)
    assert not is_bare(limit("walls", -0.1, "mm", "found", "remedy"))
    assert not is_bare(at_most("stress", 50.0, 40.0, "MPa", "", ""))
