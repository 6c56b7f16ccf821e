"""Blows of a landing: energies against the fall's, forces against the work that they do."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq
from support.strengths import strength_findings

from jumpcad.findings import Finding
from jumpcad.landing.arena import Arena, Floor
from jumpcad.landing.blows import NOSE, TOE, Blow, Blows, hard_n, landing_strength, part_forces
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot

pytest.importorskip("mujoco")
HEIGHT_M = 0.2


def test_blows_take_the_energy_of_the_fall_on_any_floor(strongest: Robot) -> None:
    """On its back it rocks, so that the first blow leaves a part; flat on its foot nose and toes share all."""
    arena, fall_j = Arena(strongest), strongest.mass_kg * 9.81 * HEIGHT_M
    for quaternion, low, high in (((0.0, 1.0, 0.0, 0.0), 0.75, 1.0), ((1.0, 0.0, 0.0, 0.0), 0.9, 1.1)):
        for softness_s in (0.0005, 0.005):
            arena.stand_on(Floor(1.0, softness_s))
            arena.put(np.array(quaternion), HEIGHT_M, np.zeros(3), np.zeros(3))
            arena.watch = blows = Blows(arena)
            arena.step(0.25)
            arena.watch = None
            first = {blow.part: blow.energy_j for blow in reversed(blows.all)}
            assert low < sum(first.values()) / fall_j < high, (quaternion, softness_s, first)
            assert blows.all[0].speed_m_s == pytest.approx((2.0 * 9.81 * HEIGHT_M) ** 0.5, rel=0.02)


def test_a_blow_does_the_work_of_its_force(strongest: Robot) -> None:
    """E = ∫F·ds: F²/(2·k) of what springs back, 2/3·F·d of a dent, which grows as F²; a hard floor bears more."""
    case = LoadCase(strongest)
    for part, power in ((NOSE, 0.5), (TOE, 0.5), ("body", 1.0 / 3.0)):
        assert hard_n(case, part, 800.0) / hard_n(case, part, 100.0) == pytest.approx(8.0**power), part
    plates = 2.0 * float(np.diff(strongest.layout.lateral.left_plate)[0])
    force = hard_n(case, "body", 500.0)
    chord = force / (plates * strongest.workshop.material("body").strength_in_plane_mpa)
    assert 2.0 / 3.0 * force * (chord / 2.0) ** 2 / (2.0 * 6.0) == pytest.approx(500.0)


def test_a_hard_blow_on_the_nose_needs_a_floor_that_does_its_work(strongest: Robot) -> None:
    """With the force that the front link bears (Euler); a light blow is borne on any floor."""
    borne = next(one.limit for one in strength_findings(strongest) if one.name == "front_link_buckling")
    assert borne is not None
    margins = []
    for impulse in (1e-3, 0.4, 4.0):
        blow = Blow(NOSE, 2.4, 0.0, impulse)
        found = landing_strength(strongest, part_forces(strongest, [blow]))
        assert found is not None
        assert found.value == pytest.approx(1000.0 * blow.energy_j / borne if impulse > 0.1 else 0.0, rel=0.03)
        margins.append(found.margin)
    case = LoadCase(strongest)
    for part in (NOSE, TOE, "body"):  # the part itself takes the energy whose hard blow has the force at its limit
        at_limit = re.findall(r"at the ([\d.]+) N", _strength(strongest, part, 2400.0).message)[0]
        own = brentq(lambda energy, part=part, force=float(at_limit): hard_n(case, part, energy) - force, 1e-6, 1e4)
        energy = max(3.0 * own, 1.1)
        found = _strength(strongest, part, energy)
        assert found.value == pytest.approx((energy - own) / float(at_limit), rel=0.02), part
    assert margins[1] > 0.0 > margins[2]
    assert landing_strength(strongest, part_forces(strongest, [Blow("main_leg", 1.0, 0.0, 0.1)])) is None


def _strength(robot: Robot, part: str, energy_nmm: float) -> Finding:
    found = landing_strength(robot, part_forces(robot, [Blow(part, 2.0, 0.0, energy_nmm / 1000.0)]))
    assert found is not None
    return found
