"""ROS's own parser reads the URDF."""

import re

from support.clients import Case, run


def test_check_urdf_reads_the_tree(case: Case) -> None:
    said = run("check_urdf", case.bundle.urdf)
    assert "Successfully Parsed XML" in said
    assert f"robot name is: {case.robot.name}" in said
    assert re.findall(r"child\(\d+\):\s+(\w+)", said) == ["front_link", "main_leg", "foot"]
