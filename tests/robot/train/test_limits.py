"""The drive's findings: those of its synthesis, an error where a limit is violated."""

import math
from dataclasses import replace

import pytest
from support.built import built
from support.each import each

from jumpcad.findings import errors
from jumpcad.robot.robot import Robot
from jumpcad.robot.train.limits import drive_findings


def test_a_margin_that_is_not_a_number_is_an_error(kenan: Robot) -> None:
    lost = replace(kenan.release.findings[0], margin=math.nan)
    release = replace(kenan.release, findings=(lost, *kenan.release.findings[1:]))
    (error,) = errors(drive_findings(replace(kenan, release=release)))
    assert error.name == lost.name


@each("name", sorted({finding.name for finding in built("kenan-2.0").layout.drive.findings}))
def test_what_the_drive_violates_is_an_error(kenan: Robot, name: str) -> None:
    assert kenan.layout is not None
    drive = kenan.layout.drive
    findings = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.train.findings)
    spring = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.spring.findings)
    cam = tuple(replace(found, margin=-1.0) if found.name == name else found for found in drive.cam.findings)
    violated = replace(
        drive,
        spring=replace(drive.spring, findings=spring),
        cam=replace(drive.cam, findings=cam),
        train=replace(drive.train, findings=findings),
    )
    robot = replace(kenan, layout=replace(kenan.layout, drive=violated))
    assert [finding.name for finding in errors(drive_findings(robot))] == [name]


@pytest.mark.parametrize(
    ("margin", "told", "severity"),
    [(1e-9, 0.0, "info"), (-1e-9, 0.0, "info"), (-1e-5, -1e-5, "error"), (1e-5, 1e-5, "info"), (0.3, 0.3, "info")],
)
def test_a_cam_that_ends_on_its_limit_has_nothing_left_and_is_no_error(
    kenan: Robot, margin: float, told: float, severity: str
) -> None:
    """The cam's search ends on its limits, within 1e-9 of them."""
    cam = kenan.layout.drive.cam
    findings = (replace(cam.findings[0], margin=margin), *cam.findings[1:])
    drive = replace(kenan.layout.drive, cam=replace(cam, findings=findings))
    found = drive_findings(replace(kenan, layout=replace(kenan.layout, drive=drive)))
    (limit,) = (one for one in found if one.name == cam.findings[0].name)
    assert (limit.margin, limit.severity) == (told, severity)
