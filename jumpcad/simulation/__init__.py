"""Simulated jumps of a `Robot`: gate, exact release, push-off, take-off, flight, audit.

The engines load when they are first used.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import cache
from typing import Any, Protocol

from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings, load_settings
from jumpcad.simulation.engines import ENGINES
from jumpcad.simulation.jump import Jump
from jumpcad.simulation.run import Run, World

__all__ = ["Jump", "Settings", "load_settings", "simulate"]


class Engine(Protocol):
    """Makes worlds for robots."""

    def world(self, mechanism: Mechanism, settings: Settings) -> AbstractContextManager[World]:
        """Put a robot on the ground, ready for release, and take it away afterwards."""


def simulate(mechanism: Mechanism, settings: Settings | None = None, engine: str = "pybullet") -> Jump:
    """Let a robot jump.

    Parameters
    ----------
    mechanism
        Its bodies, joints, loop and spring are simulated.
    settings
        Time step, friction and so on; the default settings if None.
    engine
        `pybullet`, `mujoco` as an independent second opinion, or `planar`, the push-off in the plane in a fraction of
        their time.

    Returns
    -------
    Jump
        With the verdict of the gate, of the push-off, or of the audit. The same robot and settings give the same bits,
        in any process and after any other robot.

    Raises
    ------
    JumpcadError
        If the engine is unknown, is not installed, or cannot do what the settings ask.
    """
    settings = settings or Settings()
    maker = _engine(engine)
    findings = geometry_findings(mechanism.design)
    if not errors(findings):
        findings += statics_findings(mechanism, settings.gravity_m_s2)
    refused = errors(findings)
    if refused:
        return Jump(refused[0].name, engine, mechanism.mass_kg, mechanism.spring.energy_j, findings=tuple(findings))
    with maker.world(mechanism, settings) as world:
        run = _runner(engine)(world, mechanism, settings)
        run.go()
        return _jump(run, engine, tuple(findings))


@cache
def _engine(name: str) -> Engine:
    """Return the one engine of a name that this process has."""
    if name == "pybullet":
        from jumpcad.simulation.bullet import BulletEngine

        return BulletEngine()
    if name == "mujoco":
        from jumpcad.simulation.mujoco import MujocoEngine

        return MujocoEngine()
    if name == "planar":
        from jumpcad.simulation.planar import PlanarEngine

        return PlanarEngine()
    raise JumpcadError(f"{name!r} is not an engine; there are {', '.join(ENGINES)}{did_you_mean(name, ENGINES)}")


def _runner(engine: str) -> Callable[[Any, Mechanism, Settings], Run]:
    """Return what carries out an engine's runs."""
    if engine == "planar":
        from jumpcad.simulation.planar import PlanarRun

        return PlanarRun
    return Run


def _jump(run: Run, engine: str, findings: tuple[Finding, ...]) -> Jump:
    mechanism, takeoff = run.mechanism, run.takeoff
    audit = run.findings()
    findings = (*findings, *audit)
    failed = errors(audit)
    if failed or takeoff is None:
        verdict = failed[0].name if failed else "no_takeoff"
        return Jump(
            verdict,
            engine,
            mechanism.mass_kg,
            mechanism.spring.energy_j,
            trajectory=run.trajectory(),
            findings=findings,
        )
    flight = takeoff.flight
    return Jump(
        "jump",
        engine,
        mechanism.mass_kg,
        mechanism.spring.energy_j,
        fitness=flight.range_m / (mechanism.design.l_max_mm / 1000.0),
        ballistic_range_m=flight.range_m,
        com_rise_m=flight.rise_m,
        takeoff_energy_ratio=takeoff.energy_ratio,
        takeoff_speed_m_s=flight.speed_m_s,
        takeoff_angle_deg=flight.angle_deg,
        takeoff_time_s=takeoff.time_s,
        touchdown_distance_m=run.touchdown_distance_m,
        energy=takeoff.energy,
        published=run.published,
        trajectory=run.trajectory(),
        findings=findings,
    )
