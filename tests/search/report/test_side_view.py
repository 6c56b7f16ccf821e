"""The drawn linkage has the design's lengths and angles."""

import itertools
import math
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from jumpcad.design import Design, load_design
from jumpcad.search.report.side_view import LINKS, POINTS, box_mm, joints_mm, side_view

DESIGN = Design.from_vector([100.0, 0.9, 0.8, 0.7, 0.6, 50.0, 20.0, 30.0])


def angle(vector):
    return math.atan2(vector[1], vector[0])


@pytest.mark.parametrize("design", [DESIGN, load_design("kenan-2.0"), load_design("best-printable")])
def test_links_have_their_lengths_and_the_foot_is_flat(design):
    for points in joints_mm(design).values():
        at = dict(zip(POINTS, points, strict=True))
        lengths = {
            ("ankle", "back pivot"): design.l2_mm,
            ("front eye", "front pivot"): design.l3_mm,
            ("ankle", "front eye"): design.l4_mm,
            ("back pivot", "front pivot"): design.l1_mm,
            ("toe tip", "ankle"): design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg)),
        }
        for (one, other), length in lengths.items():
            assert np.hypot(*(at[one] - at[other])) == pytest.approx(length, abs=0.15)
        assert [at[name][1] for name in ("toe tip", "ankle", "front eye")] == [0.0] * 3
        assert at["toe tip"][0] < at["ankle"][0] == 0.0 < at["front eye"][0]


def test_legs_are_parallel_at_rest_and_turn_by_the_loaded_angle():
    poses = {name: dict(zip(POINTS, points, strict=True)) for name, points in joints_mm(DESIGN).items()}
    rest, loaded = poses["rest"], poses["loaded"]
    front, back = (rest[f"{end} pivot"] - rest[joint] for end, joint in (("front", "front eye"), ("back", "ankle")))
    assert angle(front) == pytest.approx(angle(back), abs=0.003)
    turned = [
        angle(at["front pivot"] - at["back pivot"]) - angle(at["ankle"] - at["back pivot"]) for at in (rest, loaded)
    ]
    assert turned[0] == pytest.approx(math.radians(50.0), abs=0.003)
    assert turned[0] - turned[1] == pytest.approx(DESIGN.compression_rad, abs=0.004)


def test_the_drawing_is_xml_and_lies_in_its_box():
    designs = [DESIGN, load_design("kenan-2.0")]
    box = box_mm(designs)
    for design in designs:
        root = ElementTree.fromstring(side_view(design, box))
        circles = [(float(one.get("cx")), -float(one.get("cy"))) for one in root.iter("circle")]
        assert len(circles) == 8
        assert all(box[0] < x < box[2] and box[1] < z < box[3] for x, z in circles)
        left, top, width, height = map(float, root.get("viewBox").split())
        words = [(float(one.get("x")), float(one.get("y"))) for one in root.iter("text")]
        assert len(words) == 1  # below the ground, at the scale
        assert all(left < x < left + width and top < y < top + height for x, y in words)
        assert {one.text for one in root.iter("title")} >= {"at rest", "springs loaded", "main leg, at rest"}


def test_a_design_without_a_pose_is_told():
    impossible = Design.from_vector([100.0, 1.4, 0.2, 0.7, 0.6, 80.0, 20.0, 30.0])
    said = side_view(impossible, box_mm([impossible]))
    assert "no assembled pose" in said
    assert list(itertools.chain(*ElementTree.fromstring(said).iter("svg"))) == []


def test_every_link_is_a_line_between_its_joints_and_the_scale_is_50_mm_long():
    """In millimetres, upwards counted down as SVG does; the scale lies below the ground."""
    box = box_mm([DESIGN])
    root = ElementTree.fromstring(side_view(DESIGN, box))
    for pose, joints in joints_mm(DESIGN).items():
        (group,) = (one for one in root.iter("g") if one.get("class") == pose)
        at = dict(zip(POINTS, joints, strict=True))
        lines = {one.get("class"): re.findall(r"-?[\d.]+", one.get("d")) for one in group.iter("path")}
        assert set(lines) == {link.replace(" ", "-") for link in LINKS}
        for link, ends in LINKS.items():
            wanted = [number for end in ends for number in (at[end][0], -at[end][1])]
            assert [float(number) for number in lines[link.replace(" ", "-")]] == pytest.approx(wanted, abs=0.051)
        circles = [(float(one.get("cx")), -float(one.get("cy"))) for one in group.iter("circle")]
        assert np.array(circles) == pytest.approx(np.array(joints[1:]), abs=0.051)  # toes end without a joint
    (scale,) = (one.get("d") for one in root.iter("path") if one.get("class") == "scale")
    x, y, length = map(float, re.findall(r"-?[\d.]+", scale))
    assert length == 50.0
    assert [one.text for one in root.iter("text")] == ["50 mm"]
    assert box[0] < x < x + length < box[2]
    assert 0.0 < y < -box[1] + 16.0
