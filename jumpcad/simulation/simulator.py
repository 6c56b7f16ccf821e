"""One simulated jump: the feasibility tests, then a run in an engine, then its verdict."""

from jumpcad.arguments import check_arguments
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.reflected import reflected_mass
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings as Settings
from jumpcad.settings import load_settings as load_settings
from jumpcad.simulation.chain import Chain, simulate_chain
from jumpcad.simulation.engines import BUNDLE_ENGINE, default_engine, engine_named
from jumpcad.simulation.jump import Jump
from jumpcad.simulation.run import Run

LEAST_STEP_S = 1e-6
"""Least time step that settings may have."""


@check_arguments
def simulate(mechanism: Mechanism | Chain, settings: Settings | None = None, engine: str | None = None) -> Jump:
    """Let a robot jump.

    Parameters
    ----------
    mechanism
        Its bodies, joints, loop and spring are simulated. A chain of hinges is MuJoCo's alone.
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

    Raises
    ------
    JumpcadError
        If the engine is unknown, is not installed, or cannot do what the settings ask; if the settings were changed to
        invalid values.
    """
    settings = (settings or Settings()).revalidated()
    if isinstance(mechanism, Chain):
        return simulate_chain(mechanism, settings, "mujoco" if engine is None else engine)
    engine = default_engine() if engine is None else engine
    mechanism = with_spring_factor(mechanism, settings.spring_efficiency)
    maker = engine_named(engine)
    findings = geometry_findings(mechanism.design)
    if not errors(findings):
        findings += statics_findings(mechanism, settings.gravity_m_s2)
    refused = errors(findings)
    if refused:
        first = refused[-1 if mechanism.roller_off else 0].name  # of printed robots `too_weak` comes before `tips`
        return Jump(first, engine, mechanism.mass_kg, mechanism.spring.energy_j, findings=tuple(findings))
    settings = divided(mechanism, settings)
    with maker.world(mechanism, settings) as world:
        run = maker.run(world, mechanism, settings)
        run.go()
        return _jump(run, engine, tuple(findings))


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
            refused[0].name,
            engine,
            mechanism.mass_kg,
            mechanism.spring.energy_j,
            trajectory=run.trajectory(),
            findings=findings if failed else (*findings, *refused),
        )
    path, offset_m = takeoff.ballistics, float(run.mechanics.centre_of_mass_m(run.loaded)[1])
    flown = vars(takeoff.flight)
    if run.touchdown_distance_m is not None:
        flown = flown | {"touchdown_distance_m": run.touchdown_distance_m}
    return Jump(
        "jump",
        engine,
        mechanism.mass_kg,
        mechanism.spring.energy_j,
        fitness=path.range_m / (mechanism.design.l_max_mm / 1000.0),
        ballistic_range_m=path.range_m,
        com_rise_m=path.rise_m,
        release_energy_ratio=1.0 - takeoff.energy.release_j / mechanism.spring.energy_j,
        takeoff_energy_ratio=takeoff.energy_ratio,
        takeoff_speed_m_s=path.speed_m_s,
        takeoff_angle_deg=path.angle_deg,
        takeoff_time_s=takeoff.time_s,
        **flown,
        touchdown_gap_m=path.range_m - flown["touchdown_distance_m"],
        lateral_offset_mm=1000.0 * offset_m,
        energy=takeoff.energy,
        trajectory=run.trajectory(),
        findings=findings,
    )
