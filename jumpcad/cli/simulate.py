"""`jumpcad simulate`: simulate one jump."""

import csv
import io
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, print_text, status
from jumpcad.cli.subjects import WorkshopOption, note_template, printed_robot, reject_workshop, robot_from_file
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.plural import counted
from jumpcad.simulation.engines import ENGINES, GENERAL, default_engine, engine_help, in_words

if TYPE_CHECKING:
    from jumpcad.design import Design
    from jumpcad.robot import Robot
    from jumpcad.simulation import Jump, Settings
    from jumpcad.simulation.jump import Trajectory

TRAJECTORY_SUFFIXES = (".csv", ".json")
DEFAULT_SETTINGS = "default"
TRIES = 20
"""Landings that are tried unless asked for more."""


def simulate(
    design: Annotated[
        str,
        typer.Argument(
            help="A template, a design file, a bundle, a URDF file, a TOML file with bodies.", metavar="DESIGN|BUNDLE"
        ),
    ],
    capsule: Annotated[bool, typer.Option("--capsule", help="The published masses instead of printed parts.")] = False,
    published: Annotated[bool, typer.Option("--published", help="The published study's simulation.")] = False,
    workshop: WorkshopOption = None,
    engine: Annotated[str | None, typer.Option(help=engine_help())] = None,
    settings: Annotated[str, typer.Option(help="Settings: a template's name or a TOML file.")] = DEFAULT_SETTINGS,
    flight: Annotated[bool, typer.Option("--flight", help="Simulate the flight up to the first touchdown.")] = False,
    trajectory: Annotated[Path | None, typer.Option(help="Write poses and energies to FILE.csv or FILE.json.")] = None,
    uncertain: Annotated[
        bool,
        typer.Option("--uncertain", help="Also the uncertainty: 10, 50, 90 % quantiles of range and rise, by source."),
    ] = False,
    landing: Annotated[
        bool, typer.Option("--landing", help="How it lands, on what it rests, whether winding rights it (MuJoCo).")
    ] = False,
    tries: Annotated[int, typer.Option(help="Landings of --landing.", min=1, max=10_000)] = TRIES,
    row: Annotated[
        int | None,
        typer.Option("--jumps", help="Jumps in a row, each from where the last one ended (MuJoCo).", min=1, max=1000),
    ] = None,
    seed: Annotated[
        int, typer.Option(help="Random seed of --uncertain, --landing, --jumps.", min=0, max=2**32 - 1)
    ] = 0,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Simulate one jump: gate, release, take-off, flight.

    The exit code is 0 for a jump, and 1 if the design is rejected or does not
    jump.
    """
    from jumpcad.design import load_design
    from jumpcad.files.outputs import require_apart, require_target
    from jumpcad.mechanism.capsule import capsule_robot
    from jumpcad.simulation import simulate as simulate_jump
    from jumpcad.simulation.chain import Chain

    if capsule and published:
        raise JumpcadError("--capsule and --published exclude each other: choose one model")
    if capsule or published:
        reject_workshop(workshop, "cannot apply to a robot that is not printed; leave it out")
    if uncertain and (capsule or published):
        raise JumpcadError("--uncertain is for printed robots: leave --capsule and --published out")
    if published and (flight or trajectory):
        raise JumpcadError("--flight and --trajectory cannot apply to --published; leave them out")
    if published and settings != DEFAULT_SETTINGS:
        raise JumpcadError(f"--settings {settings}: --published has the study's own; leave one of them out")
    if seed and not (uncertain or landing or row):
        raise JumpcadError(f"--seed {seed}: is that of --uncertain, --landing or --jumps; leave it out, or add one")
    if tries != TRIES and not landing:
        raise JumpcadError(f"--tries {tries}: is that of --landing; leave it out, or add --landing")
    if landing or row:
        given = {"--landing and --jumps": landing and row, "--capsule": capsule, "--published": published,
                 f"--engine {engine}": engine not in (None, "mujoco"), "--flight": flight,
                 "--trajectory": trajectory and landing, "--uncertain": uncertain}  # fmt: skip
        if wrong := next((name for name, value in given.items() if value), None):
            raise JumpcadError(f"{wrong}: a landing is simulated alone, of a printed robot, in MuJoCo: leave it out")
    require_apart({"--trajectory": trajectory}, {"the design": design, "--workshop": workshop, "--settings": settings})
    if trajectory:
        require_target(trajectory, TRAJECTORY_SUFFIXES, force)
    note_template(design)
    written = robot_from_file(design, workshop)
    if isinstance(written, Chain):
        if capsule or published or trajectory or flight:
            raise JumpcadError(f"{design}: is no five-bar: leave --capsule, --published, --flight and --trajectory out")
        engine = engine or "mujoco"
    subject: Any = None if isinstance(written, Chain) else written.design if written else load_design(design)
    if published:
        _published(subject, {"design": design, "model": "published"}, engine, as_json)
        return
    engines = _engines(engine)
    if trajectory and len(engines) > 1:
        raise JumpcadError(f"--trajectory records one engine: choose --engine {in_words(ENGINES, 'or')}")
    if uncertain and len(engines) > 1:
        raise JumpcadError(f"--uncertain takes one engine: choose --engine {in_words(ENGINES, 'or')}")
    if uncertain and written and not Path(design).is_dir():
        raise JumpcadError(f"{design}: --uncertain is for printed robots: give the design, or its bundle")
    asked = _settings(settings, flight, trajectory is not None)
    robot = capsule_robot(subject) if capsule else written or printed_robot(design, workshop)
    model = "capsule" if capsule else "printed"
    if written and not capsule:
        model = "chain" if isinstance(written, Chain) else "own bodies" if Path(design).suffix == ".toml" else "URDF"
    heading = {"design": design, "model": model, "settings": settings}
    if landing or row:
        from jumpcad.cli.landing import report_jumps, report_landing
        from jumpcad.robot import Robot

        if not isinstance(robot, Robot):
            raise JumpcadError(
                f"{design}: --landing and --jumps are for printed robots: give the design, or its bundle"
            )
        if row:
            series = report_jumps(robot, heading, asked, row, seed, as_json, trajectory is not None)
            if trajectory and series.trajectory:
                write_trajectory(trajectory, series.trajectory)
        else:
            report_landing(robot, heading, asked, tries, seed, as_json)
        return
    jumps = [simulate_jump(robot, asked, engine) for engine in engines]
    if trajectory:
        _write_trajectory(trajectory, jumps[0])
    spread = _uncertain(printed_robot(design, workshop), settings, engines[0], seed) if uncertain else None
    _report(heading, jumps, as_json, spread)
    if any(jump.verdict != "jump" for jump in jumps):
        raise typer.Exit(1)


def _published(design: "Design", heading: dict[str, str], engine: str | None, as_json: bool) -> None:
    """Print the quantities of the published study, which a `Jump` does not have."""
    if engine not in (None, "pybullet"):
        raise JumpcadError(f"--engine {engine}: the published simulation exists in pybullet alone")
    from jumpcad.paper import published

    result = asdict(published.simulate(design))
    if as_json:
        print_json(heading | result)
        return
    print(f"published distance  {result['distance_m']:.6f} m   where the body is at the first contact after 0.5 s")
    print(f"published height    {result['base_height_m']:.6f} m   the body's height above ground, not its rise")
    print(f"energy              {result['energy_j']:.6f} J")


def _engines(asked: str | None) -> list[str]:
    """Return the engines to use: by default the first installed, with a message if it is not PyBullet."""
    if asked == "both":
        return list(GENERAL)
    if asked is not None:
        return [asked]
    engine = default_engine()
    if engine != GENERAL[0]:
        print(f"jumpcad: {GENERAL[0]} is not installed; simulated with {engine}", file=sys.stderr)
    return [engine]


def _settings(name: str, flight: bool, trajectory: bool) -> "Settings":
    from jumpcad.simulation import load_settings

    settings = load_settings(name)
    changes: dict[str, Any] = {"flight": "simulated"} if flight else {}
    if trajectory:
        changes["trajectory"] = True
    return settings.model_copy(update=changes)


def _uncertain(robot: "Robot", settings: str, engine: str, seed: int) -> dict[str, Any]:
    """Return quantiles of a jump and its sensitivity to each uncertain input, as plain data."""
    from jumpcad.simulation import uncertain_jump

    with status("simulating samples of the uncertain inputs …"):
        return uncertain_jump(robot, _settings(settings, False, False), engine, seed).to_dict()


def _report(heading: dict[str, str], jumps: "list[Jump]", as_json: bool, spread: dict[str, Any] | None) -> None:
    if as_json:
        results = [jump.to_dict() for jump in jumps]
        if len(jumps) == 1:
            print_json(heading | results[0] | ({"uncertain": spread} if spread else {}))
        else:
            engines = {jump.engine: result for jump, result in zip(jumps, results, strict=True)}
            print_json({**heading, "engines": engines, "range_difference_percent": _difference_percent(jumps)})
        return
    from jumpcad.simulation.jump import ACCOUNT
    from jumpcad.simulation.published_robots import efficiency_band
    from jumpcad.simulation.uncertain import FIGURES

    difference = _difference_percent(jumps)
    print_text(
        "simulate", **heading, jumps=jumps, account=ACCOUNT, spread=spread, figures=FIGURES,
        difference=difference, counted=counted, band=efficiency_band(),
    )  # fmt: skip


def _difference_percent(jumps: "list[Jump]") -> float | None:
    """Return the difference of the second engine's range from the first's (%), if both jump."""
    ranges = [jump.ballistic_range_m for jump in jumps]
    if len(ranges) != 2 or ranges[0] is None or ranges[1] is None:
        return None
    return 100.0 * (ranges[1] / ranges[0] - 1.0)


def _write_trajectory(path: Path, jump: "Jump") -> None:
    """Write the trajectory of a jump; a design that the gate rejects has none."""
    if jump.trajectory is None:
        reason = f"{jump.verdict}: a robot that is rejected before its release does not move"
        print(f"jumpcad: {without_controls(str(path))}: not written; {reason}", file=sys.stderr)
        return
    write_trajectory(path, jump.trajectory)


def write_trajectory(path: Path, trajectory: "Trajectory") -> None:
    """Write a trajectory, one row per moment, as CSV or JSON."""
    from jumpcad.files.outputs import write_atomically

    if path.suffix == ".json":
        columns = {name: values.tolist() for name, values in trajectory.columns().items()}
        write_atomically(path, json.dumps(columns, indent=1) + "\n")
        return
    text = io.StringIO()
    table = csv.DictWriter(text, fieldnames=list(trajectory.columns()), lineterminator="\n")
    table.writeheader()
    table.writerows(trajectory.rows())
    write_atomically(path, text.getvalue())
