"""One simulated jump: the feasibility tests, then a run in an engine, then its verdict."""

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError
from jumpcad.exporters.mjcf import SUBSTEPS
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import Mechanism, Multibody
from jumpcad.mechanism.planar import reflected_mass
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings as Settings
from jumpcad.settings import load_settings as load_settings
from jumpcad.simulation.engines import BUNDLE_ENGINE, default_engine, engine_named
from jumpcad.simulation.jump import Jump
from jumpcad.simulation.mujoco import MujocoWorld
from jumpcad.simulation.run import Run

LEAST_STEP_S = 1e-6
"""Least time step that settings may have."""
SETTLED_SHARE, FINEST_S = 0.002, 5e-7
"""Of a chain: change of the take-off speed below which a step is fine enough; the finest step."""
FLIGHT_STEP_S, FLIGHT_STRIDE = 5e-5, 8
"""Step of a chain's flight, and at most how many of its push-off's: nothing hits the ground in it."""


@check_arguments
def simulate(mechanism: Multibody, settings: Settings | None = None, engine: str | None = None) -> Jump:
    """Let a robot jump.

    Parameters
    ----------
    mechanism
        Its bodies, joints, loops and springs are simulated. A chain of hinges that is no five-bar is MuJoCo's alone.
    settings
        Time step, friction and so on; what they leave open follows the robot, as all does if None. With a
        `spring_efficiency` other than 1 the springs have that much of their energy, and the jump's `spring_energy_j`
        is what they give.
    engine
        A name of `jumpcad.simulation.ENGINES`: `pybullet`, `mujoco` for an independent result to compare, or `planar`,
        the push-off in the plane in a fraction of their time. None: PyBullet where it is installed, else MuJoCo.

    Returns
    -------
    Jump
        With the verdict of feasibility, push-off or audit. The same robot and settings give the same bits,
        in any process and after any other robot.
    """
    settings = (settings or Settings()).revalidated()
    mechanism = with_spring_factor(mechanism, settings.spring_efficiency)
    if not isinstance(mechanism, Mechanism):
        if engine not in (None, "mujoco"):
            raise JumpcadError(f"--engine {engine}: {mechanism.name} is a chain of hinges, which only MuJoCo simulates")
        finer = settings.model_copy(update={"dt_s": settings.dt_s / SUBSTEPS})
        return _run(mechanism, finer, "mujoco", ())
    engine = default_engine() if engine is None else engine
    engine_named(engine)
    findings = geometry_findings(mechanism.design)
    if not errors(findings):
        findings += statics_findings(mechanism, settings.gravity_m_s2)
    refused = errors(findings)
    if refused:
        first = refused[-1 if mechanism.roller_off else 0].name  # of printed robots `too_weak` comes before `tips`
        return Jump(first, engine, mechanism.mass_kg, mechanism.spring.energy_j, findings=tuple(findings))
    return _run(mechanism, divided(mechanism, settings), engine, tuple(findings))


def _run(
    mechanism: Multibody, settings: Settings, engine: str, findings: tuple[Finding, ...], coarse: Run | None = None
) -> Jump:
    """Return a jump; that of a chain at a time step that is quartered until its take-off no longer depends on it."""
    maker = engine_named(engine)
    with maker.world(mechanism, settings) as world:
        run = maker.run(world, mechanism, settings)
        if isinstance(mechanism, Mechanism):
            run.go()
            return _jump(run, engine, findings)
        run.leave()
        if settings.dt_s > FINEST_S and not (coarse and _alike(coarse, run)):
            return _run(mechanism, settings.model_copy(update={"dt_s": settings.dt_s / 4.0}), engine, findings, run)
        assert isinstance(world, MujocoWorld)
        world.stride = min(max(1, round(FLIGHT_STEP_S / settings.dt_s)), FLIGHT_STRIDE)
        run.finish()
        return _jump(run, engine, findings)


def _alike(one: Run, other: Run) -> bool:
    """Tell whether two runs end alike: taking off as fast, or not at all and for the same reason."""
    if one.sound != other.sound or not (one.takeoff and other.takeoff):
        return one.sound == other.sound and one.takeoff is other.takeoff
    speeds = [run.ballistics.speed_m_s for run in (one.takeoff, other.takeoff)]
    return abs(speeds[1] / speeds[0] - 1.0) < SETTLED_SHARE


def headline(mechanism: Mechanism, trajectory: bool = False) -> Jump:
    """Return the jump that commands and pages tell of a robot: in the bundle's engine, flown to the touchdown."""
    return simulate(mechanism, Settings(flight="simulated", trajectory=trajectory), BUNDLE_ENGINE)


def divided(mechanism: Mechanism, settings: Settings) -> Settings:
    """Return settings whose time step is fine enough for the push-off of a robot.

    One that has n times fewer steps than `push_off_steps` gets n² times as many: what a step is wrong by grows with the
    forces of a short push-off.
    """
    if settings.push_off_steps == 0:
        return settings
    time_s = reflected_mass(mechanism.bodies, mechanism.linkage).push_off_s(mechanism.spring, 0.0)
    share = time_s / (settings.push_off_steps * settings.dt_s)
    return (
        settings if share >= 1.0 else settings.model_copy(update={"dt_s": max(share**2 * settings.dt_s, LEAST_STEP_S)})
    )


def _jump(run: Run, engine: str, findings: tuple[Finding, ...]) -> Jump:
    mechanism, takeoff = run.mechanism, run.takeoff
    audit = run.findings()
    findings = (*findings, *audit)
    failed = errors(audit)
    if failed or takeoff is None:
        refused = failed or [run.standing()]
        return Jump(
            refused[0].name, engine, mechanism.mass_kg, run.spring_energy_j, trajectory=run.trajectory(),
            findings=findings if failed else (*findings, *refused),
        )  # fmt: skip
    path, offset_m = takeoff.ballistics, float(run.mechanics.centre_of_mass_m(run.loaded)[1])
    flown = (vars(takeoff.flight) if takeoff.flight else {}) | run.touchdown
    return Jump(
        "jump", engine, mechanism.mass_kg, run.spring_energy_j, fitness=path.range_m / mechanism.length_m,
        ballistic_range_m=path.range_m, com_rise_m=path.rise_m,
        release_energy_ratio=1.0 - takeoff.energy.release_j / run.spring_energy_j,
        takeoff_energy_ratio=takeoff.energy_ratio, takeoff_speed_m_s=path.speed_m_s, takeoff_angle_deg=path.angle_deg,
        takeoff_time_s=takeoff.time_s, **flown,
        touchdown_gap_m=path.range_m - flown["touchdown_distance_m"] if flown else None,
        lateral_offset_mm=1000.0 * offset_m, energy=takeoff.energy, trajectory=run.trajectory(), findings=findings,
    )  # fmt: skip
