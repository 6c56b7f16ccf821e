"""Tables of a study's page, and one design's figures in the units of its names."""

from xml.etree import ElementTree

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.search.report.text import broken, escape_html, table
from jumpcad.search.report.words import figure_words


def test_texts_are_escaped_and_break_after_underscores() -> None:
    assert escape_html("<b> & c") == "&lt;b&gt; &amp; c"
    with pytest.raises(JumpcadError):  # XML has no way to write it
        escape_html("bell\x07")
    assert broken("body_joint_mm") == "body_<wbr />joint_<wbr />mm"


def test_columns_of_numbers_and_bars_are_marked() -> None:
    _, head, row, _ = table(("name", "", "n"), [("a", "b", "3")], numbers=(2,), bars=1)
    titles, cells = (ElementTree.fromstring(line) for line in (head, row))
    assert [(one.tag, one.get("class"), one.text) for one in titles] == [
        ("th", None, "name"), ("th", "bars", None), ("th", "number", "n")
    ]  # fmt: skip
    assert [(one.get("class"), one.get("data-head"), one.text) for one in cells] == [
        (None, "name", "a"), ("bars", "", "b"), ("number", "n", "3")
    ]  # fmt: skip
    _, plain, *_ = table(("name", "n"), [])
    assert "class" not in plain


def test_on_a_phone_a_table_leaves_out_columns_or_has_its_cells_below_each_other() -> None:
    """As the style says of both kinds: what has columns to leave out keeps its rows."""
    whole, *_ = table(("name", "n"), [])
    opening, head, *_ = table(("name", "n"), [], extra=(1,))
    assert whole == '<div class="wide stacked"><table>'
    assert opening == '<div class="wide"><table>'
    assert [one.get("class") for one in ElementTree.fromstring(head)] == [None, "extra"]


@pytest.mark.parametrize(
    ("name", "value", "label", "text"),
    [
        ("range_m", 0.25, "range", "250 mm"), ("width_mm", 3.25, "width", "3.25 mm"), ("mass_kg", 0.1, "mass", "100 g"),
        ("speed_m_s", 2.0, "speed", "2 m/s"), ("some_energy_j", 0.125, "some energy", "125 mJ"),
        ("winding_s", 3.0, "winding", "3 s"), ("force_n", 4.0, "force", "4 N"), ("peak_a", 0.5, "peak", "0.5 A"),
        ("angle_deg", 30.0, "angle", "30°"), ("inertia_kg_m2", 2e-4, "inertia", "0.0002 kg·m²"),
        ("takeoff_ratio", 0.98765, "takeoff ratio", "0.9877"),
    ],
)  # fmt: skip
def test_a_figure_has_the_unit_of_its_name(name: str, value: float, label: str, text: str) -> None:
    assert figure_words(name, value) == (label, text)
