"""The rest stop against textbook beams and the energy of a spring; each of its limits is violated once."""

import math
from dataclasses import replace

import pytest
from support.strengths import changed

from jumpcad.checks.stop import stop_findings
from jumpcad.findings import Finding
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot import Robot

LINKS, BODY = 45.0, 54.0
"""Strengths of PETG and PLA in their layers, without a safety factor: the blow counts twice instead (MPa)."""


def of_stop(robot: Robot) -> dict[str, Finding]:
    return {found.name: found for found in stop_findings(robot)}


def harder(robot: Robot, times: float) -> Robot:
    """Return a robot whose leg comes to its stop quicker: force, torque and give grow alike."""
    blow = robot.stop_blow
    figures = {name: times * getattr(blow, name) for name in ("torque_nm", "force_n", "give_rad", "give_mm")}
    return replace(robot, stop_blow=replace(blow, energy_j=times**2 * blow.energy_j, **figures))


def solid(robot: Robot) -> Robot:
    return changed(robot, "process", infill=1.0)


def test_the_pad_takes_the_energy_of_the_blow(strongest: Robot) -> None:
    """A spring without loss: ½·k·x² is the energy; a pad that loses all of it peaks at 0.82 of k·x."""
    blow, stop = strongest.stop_blow, strongest.layout.stop
    newton_per_metre = 1000.0 * stop.pad_n_per_mm(strongest.layout.sections.thickness_mm)
    assert 0.5 * newton_per_metre * (blow.give_mm / 1000.0) ** 2 == pytest.approx(blow.energy_j, rel=1e-4)
    assert blow.force_n == pytest.approx(0.82 * newton_per_metre * blow.give_mm / 1000.0, rel=1e-4)
    assert blow.torque_nm == pytest.approx(blow.force_n * stop.radius_mm / 1000.0, rel=1e-4)
    assert 0.0 < blow.energy_j < strongest.spring.energy_j


def test_bar_ears_and_leg_are_textbook_beams_at_twice_the_blow(strongest: Robot) -> None:
    """Solid rectangles, 6·M/(b·h²): a force over the leg's width amid the bar, cantilevers for ears and leg."""
    robot = solid(strongest)
    found, layout = of_stop(robot), robot.layout
    force, stop, sections = 2.0 * robot.stop_blow.force_n, layout.stop, layout.sections
    span, width = layout.lateral.inside[1] - layout.lateral.inside[0], sections.thickness_mm
    # half of the force at either end, less the half that is spread over a quarter of the width
    bar = force / 2.0 * span / 2.0 - force / 2.0 * width / 4.0
    deep = stop.depth_mm - 0.6  # below the pad's seat
    assert found["stop_strength"].value == pytest.approx(6.0 * bar / (8.0 * deep**2))
    ear = force / 2.0 * stop.radius_mm
    plate = layout.lateral.left_plate[1] - layout.lateral.left_plate[0]
    assert found["stop_plates"].value == pytest.approx(6.0 * ear / (plate * 16.0**2))
    along = stop.radius_mm / robot.design.l2_mm
    high = (1.0 - along) * sections.leg_root_mm + along * sections.leg_tip_mm
    leg = force * stop.radius_mm
    assert found["stop_leg"].value == pytest.approx(6.0 * leg / (width * high**2), rel=1e-4)
    limits = [found[name].limit for name in ("stop_strength", "stop_plates", "stop_leg")]
    assert limits == pytest.approx([LINKS, BODY, LINKS])


@pytest.mark.parametrize("name", ["stop_strength", "stop_plates", "stop_leg", "stop_pad", "stop_clearance"])
def test_a_leg_that_hits_hard_enough_breaks_every_limit(strongest: Robot, name: str) -> None:
    usual = of_stop(strongest)[name]
    assert usual.severity == "info"
    assert usual.value is not None
    assert usual.limit is not None
    just, beyond = (of_stop(harder(strongest, share * usual.limit / usual.value))[name] for share in (0.99, 1.01))
    assert (just.severity, beyond.severity) == ("info", "error")
    assert beyond.remedy


def test_the_pad_is_pressed_to_half_and_the_leg_has_the_room_that_it_needs(strongest: Robot) -> None:
    found, pad = of_stop(strongest), strongest.layout.stop.pad
    assert found["stop_pad"].limit == pytest.approx(pad.thickness_mm / 2.0)
    assert found["stop_pad"].value == pytest.approx(strongest.stop_blow.give_mm)
    assert found["stop_clearance"].value == pytest.approx(math.degrees(strongest.stop_blow.give_rad))
    # the loop still closes, and the links still pass each other, as far past rest
    past = strongest.layout.stop.angle_rad + strongest.stop_blow.give_rad
    linkage = Linkage(strongest.design)
    assert float(linkage.diagonal_mm(past)) < linkage.l3 + linkage.l4
