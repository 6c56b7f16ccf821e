"""Bars of use: words and widths at their ends, and the order in which limits stand."""

import re

import pytest

from jumpcad.bundle.limits import limit_values, ordered, tightest, violation
from jumpcad.files.templates import fill
from jumpcad.findings import Finding, at_least, at_most, bare, limit


def page(*findings: Finding) -> str:
    return fill("report/limits.html.j2", limit_values(findings))


def used(finding: Finding) -> str:
    """Return the words of a limit's use."""
    found = re.search(r"<td>one</td><td>(?:<span class=\"bar\">.*</span></span> )?(.*?)</td>", page(finding))
    assert found is not None
    return found[1]


@pytest.mark.parametrize(
    ("share", "words"),
    [
        (1.0004, "at the limit"), (0.9996, "at the limit"), (1.0006, "100 % used"), (0.9994, "100 % used"),
        (0.5, "50 % used"), (0.004, "0 % used"), (1.3, "130 % used"),
    ],
)  # fmt: skip
def test_a_use_is_said_in_whole_percent(share: float, words: str) -> None:
    """Within 0.05 % sizing ended there: "at the limit"."""
    assert used(at_most("one", 40.0 * share, 40.0, "MPa", "", "")) == words
    assert used(at_least("one", 40.0 / share, 40.0, "MPa", "", "")) == words


@pytest.mark.parametrize(
    ("margin", "unit", "words"),
    [
        (0.0004, "mm", "at the limit"), (-0.0004, "mm", "at the limit"), (0.0006, "mm", "margin 0.0006 mm"),
        (0.25, "J", "margin 250 mJ"), (0.1, "rad", "margin 5.73 °"), (-2.0, "", "margin -2"),
        (0.0, "mm", "margin 0 mm"), (0.0, "", "holds"),
    ],
)  # fmt: skip
def test_without_a_share_the_margin_is_said_in_units_that_people_read(margin: float, unit: str, words: str) -> None:
    assert used(limit("one", margin, unit, "", "")) == words
    for severity in ("error", "warning"):
        assert used(bare("one", severity, 0.0, "")) == "does not hold"


def test_what_has_no_share_is_folded_unless_it_is_just_kept() -> None:
    """The fold holds one of two; that just kept stands in the first table."""
    table, fold = page(limit("just", 1e-4, "mm", "", ""), limit("far", 3.0, "mm", "", "")).split("<details>")
    assert ("just" in table, "far" in table, "far" in fold, "just" in fold) == (True, False, True, False)


def test_the_worst_limit_stands_first() -> None:
    """Errors by their use, then warnings, then kept ones; without a share last, but for what is just kept."""
    in_order = [
        at_most("twice", 2.0, 1.0, "mm", "", ""), limit("violated", -1.0, "mm", "", ""),
        at_most("more", 2.1, 1.0, "mm", "", "", violated="warning"), limit("just", 1e-4, "mm", "", ""),
        at_most("tight", 0.9, 1.0, "mm", "", ""), at_most("loose", 0.01, 1.0, "mm", "", ""),
        limit("far", 3.0, "mm", "", ""),
    ]  # fmt: skip
    assert [one.name for one in tightest(in_order[::-1])] == ["twice", "violated", "more", "just", "tight", "far"]
    assert ordered(in_order[::-1]) == in_order
    assert violation(in_order) == "3 of its 6 limits are violated: do not build it as it is"
    warned = [in_order[2], *in_order[3:]]
    assert violation(warned) == "1 of its 4 limits is violated: it can be built, but read the warnings first"
    assert violation(in_order[3:]) == ""
    assert violation([bare("one", "error", 0.0, "")]) == "1 of its 1 limits is violated: do not build it as it is"
