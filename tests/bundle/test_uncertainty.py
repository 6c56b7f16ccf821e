"""How sure a page's figures are: quantiles in millimetres, shares as bars, and when there is nothing to say."""

import xml.etree.ElementTree as ET

from jumpcad.files.templates import fill
from jumpcad.simulation.uncertain import FIGURES, Uncertainty

SHARES = {
    "mass": {"touchdown_distance_m": 0.25, "com_rise_m": 0.5},
    "floor": {"touchdown_distance_m": 0.624, "com_rise_m": 0.0},
    "lengths": {"touchdown_distance_m": 0.01, "com_rise_m": 0.9},
}
FOUND = Uncertainty(
    {"touchdown_distance_m": [0.1771, 0.196, 0.2134], "com_rise_m": [0.0574, 0.0649, 0.0741]},
    SHARES,
    {},
    128,
    1.0,
    False,
)


def section(found: Uncertainty) -> ET.Element:
    """Return the section's tree; any tag that is not closed is an error."""
    values = {"sure": found, "sure_figures": FIGURES}
    return ET.fromstring(f"<section>{fill('report/uncertainty.html.j2', values)}</section>")


def cells(row: ET.Element) -> list[str]:
    """Return the words of a row's cells."""
    return ["".join(cell.itertext()).strip() for cell in row]


def test_quantiles_are_told_in_whole_millimetres_below_what_they_are_of() -> None:
    """Of ten robots one stays below the 10 % quantile, half below the median, nine below the 90 % quantile."""
    first, _ = section(FOUND).iter("table")
    heads, *rows = (cells(row) for row in first.iter("tr"))
    assert heads == ["of ten robots", "one stays below", "half", "nine"]
    assert rows == [["touchdown", "177 mm", "196 mm", "213 mm"], ["rise", "57 mm", "65 mm", "74 mm"]]
    assert {cell.get("class") for cell in first.iter("td")} == {None, "number"}
    for row in list(first.iter("tr"))[1:]:
        assert [cell.get("class") for cell in row] == [None, "number", "number", "number"]


def test_what_explains_most_of_the_range_comes_first() -> None:
    """Whatever it explains of the rise; shares in whole percent, a column for either."""
    _, second = section(FOUND).iter("table")
    heads, *rows = (cells(row) for row in second.iter("tr"))
    assert heads == ["not known exactly", "of touchdown", "of rise"]
    assert rows == [
        ["friction of the floor", "62 %", "0 %"],
        ["mass", "25 %", "50 %"],
        ["lengths of the links, as printed", "1 %", "90 %"],
    ]
