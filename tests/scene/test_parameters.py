"""The drawing of the eight parameters: its angle is the design's, and no label lies across a link."""

import cmath
import math
import xml.etree.ElementTree as ET

import pytest
import shapely

from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.scene.parameters import parameter_drawing

SVG = "{http://www.w3.org/2000/svg}"
LETTER_PX = 0.66
"""Width of a bold letter over the font's size: a little more than DejaVu Sans has on average."""
LINK_PX = 3.0
"""Least width of a link's line."""


def panels(name: str) -> list[ET.Element]:
    return ET.fromstring(parameter_drawing(load_design(name))).findall(f"{SVG}g")


def links(panel: ET.Element) -> list[tuple[complex, complex]]:
    lines = [one.attrib for one in panel.findall(f"{SVG}line") if float(one.get("stroke-width", "0")) >= LINK_PX]
    return [(complex(float(at["x1"]), float(at["y1"])), complex(float(at["x2"]), float(at["y2"]))) for at in lines]


@pytest.mark.parametrize("name", template_names("robots"))
def test_no_label_lies_across_a_link(name: str) -> None:
    for panel in panels(name):
        lines = shapely.MultiLineString([[(p.real, p.imag) for p in line] for line in links(panel)])
        for text in panel.findall(f"{SVG}text"):
            x, y, size = (float(text.get(key, "12")) for key in ("x", "y", "font-size"))
            wide = LETTER_PX * size * len(text.text or "")
            left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[text.get("text-anchor", "")] * wide
            assert not lines.intersects(shapely.box(left, y - 0.75 * size, left + wide, y)), text.text


@pytest.mark.parametrize("name", template_names("robots"))
def test_the_angle_that_is_drawn_is_the_rest_angle(name: str) -> None:
    """Between the front link and the body's line beyond it: at rest both legs are parallel."""
    _, _, (front, eye), (back, ankle), body = links(panels(name)[0])
    assert body == (back, front)
    below = cmath.phase((eye - front) / (front - back)), cmath.phase((ankle - back) / (front - back))
    assert [math.degrees(angle) for angle in below] == pytest.approx([load_design(name).rest_angle_deg] * 2, abs=0.1)
