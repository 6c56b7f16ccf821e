"""Robots that fall, are too weak or stay on the ground, whatever the error of an estimate: nothing of them is built.

Only one direction of each error can refuse wrongly: less energy is needed than estimated, or the centre of mass is
farther ahead. `benchmarks/refuse.py` measures the errors of robots that no other limit rejects; a reserve is added.
"""

from dataclasses import replace
from typing import NamedTuple

from jumpcad.design import Design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.findings import Finding
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search.estimate.quick_mass import known, quick_robot
from jumpcad.search.estimate.sized_robot import near, sized_robot
from jumpcad.settings import Settings
from jumpcad.simulation.planar import LACKING, PlanarRun, PlanarWorld
from jumpcad.workshop import Workshop


class EstimateErrors(NamedTuple):
    """Largest errors: by which share less energy may be needed, and how far ahead the centre of mass may be."""

    lighter: float
    ahead_mm: float


KNOWN = EstimateErrors(0.18, 16.0)
"""Of `quick_robot`: at most 13 % and 12.1 mm in 2,301 robots."""
NEAR = EstimateErrors(0.09, 6.0)
"""Of `sized_robot`: at most 7 % and 4.6 mm in 8,900 robots, 6 % and 2.8 mm in the 2,601 that it was not fitted to."""
STRENGTHS = (1.06, 1.04, 1.02)
"""Springs with which `sized_robot` stays on the ground too, over its own: several, for a robot that hops with some may
tip over with stronger ones. Of 1,795 robots that jump all estimates did so with 1.04, of 473 new ones with 1.03."""


def quick_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return which of `tips`, `too_weak` and `no_takeoff` are violated for certain; none where nothing can be said.

    The margins are those of the estimate. The design has passed the checks of its geometry.
    """
    if not known(design, workshop):
        return ()
    refused = _by_statics(quick_robot(design, workshop), settings, KNOWN)
    if refused or not near(design, workshop):
        return refused
    robot = sized_robot(design, workshop)
    return _by_statics(robot, settings, NEAR) or _by_push_off(robot, settings)


def _by_statics(robot: Mechanism, settings: Settings, bounds: EstimateErrors) -> tuple[Finding, ...]:
    """Return the findings of the statics that are certain."""
    findings = statics_findings(with_spring_factor(robot, settings.spring_efficiency), settings.gravity_m_s2)
    return tuple(_estimated(one, bounds) for one in findings if is_certain(one, bounds))


def is_certain(finding: Finding, bounds: EstimateErrors) -> bool:
    """Tell whether a limit of the statics is violated whatever the error of the estimate.

    The centre of mass is never too far ahead: the body hangs behind the ankle.
    """
    assert finding.value is not None
    assert finding.limit is not None
    if finding.name == "tips":
        return finding.margin < -bounds.ahead_mm
    return finding.value < (1.0 - bounds.lighter) * finding.limit


def _estimated(finding: Finding, bounds: EstimateErrors) -> Finding:
    lighter = f"{100.0 * bounds.lighter:g} % of what is needed"
    error = f"{bounds.ahead_mm:g} mm" if finding.name == "tips" else lighter
    return replace(finding, message=f"{finding.message}; by an estimate of the masses, at most {error} too strict")


def _by_push_off(robot: Mechanism, settings: Settings) -> tuple[Finding, ...]:
    """Return the finding of a robot that stays on the ground even with stronger springs than its own.

    Only on Earth or where weight is more, and with springs that give no more than they hold: the error was measured on
    robots that jump there.
    """
    helped = settings.spring_efficiency * GRAVITY_M_S2 > settings.gravity_m_s2
    if helped or any(getattr(settings, key) for key in LACKING):
        return ()
    robot = with_spring_factor(robot, settings.spring_efficiency)
    world = PlanarWorld(robot, settings.model_copy(update={"flight": "ballistic", "trajectory": False}))
    own = world.model
    for strength in STRENGTHS:
        stiffness, pins = strength * own.stiffness_nm_per_rad, strength * own.pins_nm
        world.model = own._replace(stiffness_nm_per_rad=stiffness, pins_nm=pins)
        if world.push_off().flown:
            return ()
    world.model = own
    run = PlanarRun(world, robot, world.settings)
    run.go()
    if run.takeoff is not None or not run.sound:
        return ()
    standing = run.standing()
    more = f"by an estimate of the masses, with springs of up to {100.0 * (max(STRENGTHS) - 1.0):.0f} % more energy too"
    return (replace(standing, message=f"{standing.message}; {more}"),)
