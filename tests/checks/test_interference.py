"""Interference: none in the templates, and exact for parts that are pushed into one another."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import checked

from jumpcad.checks.interference import Component, interference_findings, shared_volume_mm3
from jumpcad.findings import errors
from jumpcad.mechanism.model import BODY
from jumpcad.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_silent_on_kenan_and_on_the_strongest(name: str) -> None:
    assert {found.severity for found in checked(name) if found.name == "interference"} == {"info"}


def test_fires_on_a_lever_that_meets_a_misplaced_motor(kenan: Robot) -> None:
    assert kenan.layout is not None
    shift = kenan.layout.hub_mm - kenan.layout.motor_mm
    hardware = []
    for item in kenan.hardware:
        pose = item.T_body_part.copy()
        if item.name == "motor":
            pose[[0, 2], 3] += shift
        hardware.append(replace(item, T_body_part=pose))
    found = errors(interference_findings(replace(kenan, hardware=tuple(hardware))))
    assert any("motor" in finding.message and "main_leg" in finding.message for finding in found)
    assert all(finding.margin < 0 for finding in found)


@pytest.mark.parametrize("turned", [False, True])
def test_volume_of_two_boxes(turned: bool) -> None:
    box = Stack.of([(0.0, 4.0, rectangle((10.0, 6.0)))])
    piece = Component("box", BODY, box, np.eye(4))
    pose = np.eye(4)
    pose[:3, 3] = 8.0, 1.0, 1.5
    if turned:  # about x by a quarter turn: y becomes z, z becomes -y
        pose[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
        # y from -3 to 1 + 0, z from -1.5 to 4.5: shares 2 x 4 x 4 mm of the first box
        assert shared_volume_mm3(piece, np.eye(4), piece, pose) == pytest.approx(2.0 * 4.0 * 4.0, rel=1e-5)
    else:
        assert shared_volume_mm3(piece, np.eye(4), piece, pose) == pytest.approx(2.0 * 5.0 * 2.5, rel=1e-5)
