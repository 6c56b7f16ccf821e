"""Gazebo's library reads the SDF: valid, and the same masses after its own parsing and printing."""

import re
import xml.etree.ElementTree as ET

import pytest
from support.clients import Case, run


def test_check_finds_it_valid(case: Case) -> None:
    said = run("ign", "sdf", "--check", case.sdf)
    assert "Valid." in said
    assert not re.search(r"warning|error \[|error code", said, re.IGNORECASE)


def test_prints_what_was_written(case: Case) -> None:
    said = run("ign", "sdf", "--print", case.sdf)
    model = ET.fromstring(said[said.index("<sdf") : said.rindex("</sdf>") + 6])[0]
    masses = {link.get("name"): float(link.find("inertial/mass").text) for link in model.findall("link")}  # type: ignore
    assert masses == {name: pytest.approx(body.mass_kg, rel=1e-5) for name, body in case.robot.bodies.items()}
    ends = {(j.find("parent").text, j.find("child").text) for j in model.findall("joint")}  # type: ignore
    loop = (case.robot.loop.body_a, case.robot.loop.body_b)
    assert ends == {loop, *((joint.parent, joint.child) for joint in case.robot.joints)}
