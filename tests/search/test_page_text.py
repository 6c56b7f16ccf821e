"""Tables of a study's page, and one design's figures in the units of its names."""

import pytest

from jumpcad.search.page_text import broken, table, written
from jumpcad.search.shown_design import _figure


def test_texts_are_escaped_and_break_after_underscores() -> None:
    assert written("<b> & c") == "&lt;b&gt; &amp; c"
    assert broken("body_joint_mm") == "body_<wbr />joint_<wbr />mm"


def test_columns_of_numbers_and_bars_are_marked() -> None:
    _, head, row, _ = table(("name", "", "n"), [("a", "b", "3")], numbers=(2,), bars=1)
    assert head == '<tr><th>name</th><th class="bars"></th><th class="number">n</th></tr>'
    assert row == '<tr><td>a</td><td class="bars">b</td><td class="number">3</td></tr>'
    _, plain, *_ = table(("name", "n"), [])
    assert "class" not in plain


@pytest.mark.parametrize(
    ("name", "value", "label", "text"),
    [
        ("range_m", 0.25, "range", "250 mm"), ("width_mm", 3.25, "width", "3.25 mm"), ("mass_kg", 0.1, "mass", "100 g"),
        ("speed_m_s", 2.0, "speed", "2 m/s"), ("spring_energy_j", 0.125, "spring energy", "125 mJ"),
        ("winding_s", 3.0, "winding", "3 s"), ("force_n", 4.0, "force", "4 N"), ("peak_a", 0.5, "peak", "0.5 A"),
        ("angle_deg", 30.0, "angle", "30 °"), ("inertia_kg_m2", 2e-4, "inertia", "0.0002 kg·m²"),
        ("takeoff_ratio", 0.98765, "takeoff ratio", "0.9877"),
    ],
)  # fmt: skip
def test_a_figure_has_the_unit_of_its_name(name: str, value: float, label: str, text: str) -> None:
    assert _figure(name, value) == (label, text)
