"""How sure a page's figures are: quantiles in millimetres, shares as bars, and when there is nothing to say."""

import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Any

import pytest
from support.built import built

from jumpcad.bundle import uncertainty as module
from jumpcad.bundle.uncertainty import GROUPS, JUMPS, uncertainty_of
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files.rendering import fill
from jumpcad.settings import Settings
from jumpcad.simulation.engines import ENGINES
from jumpcad.simulation.uncertain import FIGURES, Uncertainty, _groups

SHARES = {
    "mass": {"ballistic_range_m": 0.25, "com_rise_m": 0.5},
    "floor": {"ballistic_range_m": 0.624, "com_rise_m": 0.0},
    "lengths": {"ballistic_range_m": 0.01, "com_rise_m": 0.9},
}
FOUND = Uncertainty(
    {"ballistic_range_m": [0.1771, 0.196, 0.2134], "com_rise_m": [0.0574, 0.0649, 0.0741]}, SHARES, {}, 128, 1.0, False
)


def section(found: Uncertainty) -> ET.Element:
    """Return the section's tree; any tag that is not closed is an error."""
    values = {"sure": found, "sure_figures": FIGURES, "uncertain_inputs": GROUPS}
    return ET.fromstring(f"<section>{fill('report/uncertainty.html.j2', values)}</section>")


def cells(row: ET.Element) -> list[str]:
    """Return the words of a row's cells."""
    return ["".join(cell.itertext()).strip() for cell in row]


def test_quantiles_are_told_in_whole_millimetres_below_what_they_are_of() -> None:
    """Of ten robots one stays below the 10 % quantile, half below the median, nine below the 90 % quantile."""
    first, _ = section(FOUND).iter("table")
    heads, *rows = (cells(row) for row in first.iter("tr"))
    assert heads == ["of ten robots", "one stays below", "half", "nine"]
    assert rows == [["range", "177 mm", "196 mm", "213 mm"], ["rise", "57 mm", "65 mm", "74 mm"]]
    assert {cell.get("class") for cell in first.iter("td")} == {None, "number"}
    for row in list(first.iter("tr"))[1:]:
        assert [cell.get("class") for cell in row] == [None, "number", "number", "number"]


def test_what_explains_most_of_the_range_comes_first() -> None:
    """Whatever it explains of the rise; shares in whole percent, a column for either."""
    _, second = section(FOUND).iter("table")
    heads, *rows = (cells(row) for row in second.iter("tr"))
    assert heads == ["not known exactly", "of range", "of rise"]
    assert rows == [
        ["friction of the floor", "62 %", "0 %"],
        ["mass", "25 %", "50 %"],
        ["lengths of the links, as printed", "1 %", "90 %"],
    ]


@pytest.mark.parametrize(("share", "percent"), [(0.0, "0"), (0.004, "0"), (0.25, "25"), (0.996, "100"), (1.0, "100")])
def test_a_bar_is_as_long_as_its_share(share: float, percent: str) -> None:
    shares = {"mass": {"ballistic_range_m": share, "com_rise_m": 0.5}}
    _, second = section(replace(FOUND, first_order=shares)).iter("table")
    bar = list(second.iter("td"))[1]
    (outer,) = bar
    (inner,) = outer
    assert outer.get("class") == "bar"
    assert inner.get("style") == f"width: {percent}%"
    assert "".join(bar.itertext()).strip() == f"{percent} %"


@pytest.mark.parametrize(("share", "told"), [(1.0, None), (0.999, "100"), (0.953, "95"), (0.0, "0")])
def test_jumps_that_fail_are_warned_of(share: float, told: str | None) -> None:
    """Before the tables, in whose quantiles they count as jumps of 0 mm; where all jump, nothing is said."""
    root = section(replace(FOUND, jumps_share=share))
    warnings = [one.text for one in root if one.get("class") == "warning"]
    assert warnings == ([] if told is None else [f"It jumps in {told} % of them."])
    if told is not None:
        tags = [(one.tag, one.get("class")) for one in root]
        assert tags.index(("p", "warning")) < tags.index(("table", "sure"))


@pytest.mark.parametrize(("jumps", "words"), [(128, "128 jumps by"), (1, "1 jump by")])
def test_the_section_begins_with_how_many_jumps_it_is_of(jumps: int, words: str) -> None:
    heading, first, *_ = section(replace(FOUND, jumps=jumps))
    assert (heading.tag, heading.text) == ("h2", "How sure this is")
    assert (first.text or "").startswith(words)
    assert [code.text for code in first.iter("code")] == ["jumpcad simulate --uncertain"]
    assert [table.get("class") for table in section(FOUND).iter("table")] == ["sure", "sure"]


def test_every_group_of_uncertain_inputs_has_its_words() -> None:
    assert GROUPS.keys() == _groups(built("kenan-2.0"), Settings()).keys()
    assert len(set(GROUPS.values())) == len(GROUPS)
    rows = section(replace(FOUND, first_order=dict.fromkeys(GROUPS, SHARES["mass"])))
    _, second = rows.iter("table")
    assert [cells(row)[0] for row in second.iter("tr")][1:] == list(GROUPS.values())


def test_the_engine_is_one_that_needs_no_package_and_jumps_are_a_power_of_two(monkeypatch: pytest.MonkeyPatch) -> None:
    """As Sobol's points want it; settings are the usual ones, and the seed is always the same."""
    asked: list[tuple[tuple[Any, ...], dict[str, Any]]] = []
    monkeypatch.setattr(module, "uncertain_jump", lambda *given, **named: asked.append((given, named)) or FOUND)
    assert uncertainty_of("robot") is FOUND  # type: ignore[arg-type]
    assert asked == [(("robot", Settings(), "planar"), {"samples": JUMPS})]
    assert ENGINES["planar"].package in ("", None)
    assert JUMPS.bit_count() == 1
    assert 64 <= JUMPS <= 1024


@pytest.mark.parametrize("error", [JumpcadError("no"), CannotBuildError("no")])
def test_where_the_engine_cannot_simulate_a_robot_nothing_is_known(
    monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    """An error of the user's is no fault of the page; one of the program's is."""

    def refuse(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr(module, "uncertain_jump", refuse)
    assert uncertainty_of("robot") is None  # type: ignore[arg-type]


def test_an_error_of_the_program_is_not_hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(module, "uncertain_jump", fail)
    with pytest.raises(ZeroDivisionError):
        uncertainty_of("robot")  # type: ignore[arg-type]
