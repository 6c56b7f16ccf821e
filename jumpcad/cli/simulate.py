"""`jumpcad simulate`: one jump; with `--landing`, `--jumps`, `--to` how it lands, jumps again, goes somewhere."""

import csv
import io
import json
import os
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import jumpcad
from jumpcad.cli import subjects
from jumpcad.cli.going import CourseOption, ToOption, print_going, target_of, tries_of
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, print_json, print_text, status
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.simulation.engines import ENGINE_HELP, GENERAL, default_engine

if TYPE_CHECKING:
    from jumpcad.landing.course import Course
    from jumpcad.simulation.jump import Trajectory
    from jumpcad.simulation.uncertain import Uncertainty

DEFAULT_SETTINGS = "default"
TRIES = 20
"""Landings that are tried unless asked for more."""
DESIGN = "A template, a design file, a bundle, a URDF file, a TOML file with bodies."
UNCERTAIN = "Also the uncertainty: 10, 50, 90 % quantiles of touchdown and rise, by source."
LANDING = "How it lands, on what it rests, whether winding rights it (MuJoCo)."
JUMPS = "Jumps in a row, each from where the last one ended (MuJoCo)."
NOISE = "How well its heading is known for --to, --course: a standard deviation (°)."
SEED = "Random seed of --uncertain, --landing, --jumps, --to, --course."


def simulate(
    design: Annotated[str, subjects.argument(DESIGN, "DESIGN|BUNDLE")],
    capsule: Annotated[bool, typer.Option("--capsule", help="The published masses instead of printed parts.")] = False,
    published: Annotated[bool, typer.Option("--published", help="The published study's simulation.")] = False,
    workshop: subjects.WorkshopOption = None,
    engine: Annotated[subjects.Text, subjects.option(ENGINE_HELP)] = None,
    settings: Annotated[str, typer.Option(help="Settings: a template's name or a TOML file.")] = DEFAULT_SETTINGS,
    flight: Annotated[bool, typer.Option("--flight", help="Simulate the flight up to the first touchdown.")] = False,
    trajectory: Annotated[subjects.File, subjects.option("Write poses and energies to FILE.csv or FILE.json.")] = None,
    uncertain: Annotated[bool, subjects.option(UNCERTAIN, None, "--uncertain")] = False,
    landing: Annotated[bool, subjects.option(LANDING, None, "--landing")] = False,
    tries: Annotated[int, subjects.option("Of --landing, --to, --course.", min=1, max=10_000)] = TRIES,
    row: Annotated[int | None, subjects.option(JUMPS, None, "--jumps", min=1, max=1000)] = None,
    to: ToOption = None,
    course: CourseOption = None,
    heading_noise: Annotated[float | None, subjects.option(NOISE, shown="3", min=0, max=180)] = None,
    seed: Annotated[int, subjects.option(SEED, min=0, max=2**32 - 1)] = 0,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Simulate one jump: gate, release, take-off, flight.

    The exit code is 0 for a jump, and 1 if the design is rejected or does not
    jump.
    """
    from jumpcad.files.outputs import require_apart, require_target
    from jumpcad.mechanism.model import Mechanism
    from jumpcad.simulation import simulate as simulate_jump
    from jumpcad.simulation.uncertain import uncertain_jump, uncertainty_of

    target = target_of(to, course)
    asked_for = {"--landing": landing, f"--jumps {row}": row, f"--to {to}": to, f"--course {course}": course}
    landings, *others = [*(option for option, given in asked_for.items() if given), ""]
    alone = f"{{}} and {landings} exclude each other: {landings} is of a printed robot in MuJoCo; leave one out"
    landed, plain = bool(landings), capsule or published
    for wrong, why in (
        (capsule and published, "--capsule and --published exclude each other: choose one model"),
        (plain and workshop is not None,
         f"--workshop {workshop}: cannot apply to a robot that is not printed; leave it out"),
        (plain and uncertain, "--uncertain is for printed robots: leave --capsule and --published out"),
        (published and (flight or trajectory),
         "--flight and --trajectory cannot apply to --published; leave them out"),
        (published and settings != DEFAULT_SETTINGS,
         f"--settings {settings}: --published has the study's own; leave one of them out"),
        (seed and not (uncertain or landed),
         f"--seed {seed}: is that of --uncertain, --landing, --jumps, --to or --course; leave it out, or add one"),
        (tries != TRIES and not (landing or target),
         f"--tries {tries}: is that of --landing, --to and --course; leave it out, or add one"),
        (heading_noise is not None and not target,
         f"--heading-noise {heading_noise}: is that of --to and --course; leave it out, or add one"),
        (any(others), f"{others[0] if others else ''} and {landings} exclude each other: leave one out"),
        (landed and capsule, alone.format("--capsule")),
        (landed and published, alone.format("--published")),
        (landed and engine not in (None, "mujoco"), alone.format(f"--engine {engine}")),
        (landed and flight, alone.format("--flight")),
        (landing and trajectory, alone.format("--trajectory")),
        (landed and uncertain, alone.format("--uncertain")),
    ):  # fmt: skip
        if wrong:
            raise JumpcadError(why)
    require_apart({"--trajectory": trajectory}, {"the design": design, "--workshop": workshop, "--settings": settings})
    if trajectory:
        require_target(trajectory, (".csv", ".json"), force)
    subjects.note_template(design)
    written = subjects.robot_from_file(design, workshop)
    chain = written and not isinstance(written, Mechanism)
    if chain and plain:
        raise JumpcadError(f"{design}: is no five-bar: leave --capsule and --published out")
    subject: Any = getattr(written, "design", None) if written else jumpcad.load_design(design)
    if published:
        _published(subject, {"design": design, "model": "published"}, engine, as_json)
        return
    engines = list(GENERAL) if engine == "both" else [engine or ("mujoco" if chain else default_engine())]
    for option, words in (("--trajectory", "records"), ("--uncertain", "takes")):
        if len(engines) > 1 and (trajectory if option == "--trajectory" else uncertain):
            raise JumpcadError(f"{option} {words} one engine: choose --engine pybullet, mujoco or planar")
    if (uncertain or landed) and written and not os.path.isdir(design):
        option = "--uncertain" if uncertain else landings
        raise JumpcadError(f"{design}: {option} is for printed robots: give the design, or its bundle")
    changes = ({"flight": "simulated"} if flight or chain else {}) | ({"trajectory": True} if trajectory else {})
    plain_settings = jumpcad.load_settings(settings)
    asked = plain_settings.model_copy(update=changes)
    written = None if capsule or landed else written
    robot = jumpcad.capsule_robot(subject) if capsule else written or subjects.printed_robot(design, workshop)
    model = "capsule" if capsule else "printed"
    if written:
        model = "chain" if chain else "own bodies" if Path(design).suffix == ".toml" else "URDF"
    heading = {"design": design, "model": model, "settings": settings}
    if landed and isinstance(robot, jumpcad.Robot):
        alone_jump = simulate_jump(robot, asked, "mujoco")
        if alone_jump.verdict != "jump":
            _report(heading, [alone_jump], as_json)
            raise typer.Exit(1)
        if target is not None:
            _go(robot, heading, asked, target, tries, seed, heading_noise, as_json, trajectory, force)
        elif row is None:
            _land(robot, heading, asked, tries, seed, as_json)
        else:
            _jump_on(robot, heading, asked, row, seed, as_json, trajectory, force)
        return
    jumps = [simulate_jump(robot, asked, one) for one in engines]
    made = None
    if isinstance(robot, jumpcad.Robot) and not written and jumps[0].verdict == "jump":
        made = uncertainty_of(robot, plain_settings)
    if trajectory and (path := jumps[0].trajectory):
        _write_trajectory(trajectory, path, force)
    elif trajectory:
        reason = f"{jumps[0].verdict}: a robot that is rejected before its release does not move"
        print(f"jumpcad: {without_controls(str(trajectory))}: not written; {reason}", file=sys.stderr)
    spread = made if uncertain and not (engine or seed) else None
    if uncertain and not spread:
        with status("simulating samples of the uncertain inputs …"):
            spread = uncertain_jump(subjects.printed_robot(design, workshop), plain_settings, engines[0], seed)
    _report(heading, jumps, as_json, spread, made)
    if any(jump.verdict != "jump" for jump in jumps):
        raise typer.Exit(1)


def _published(design: "jumpcad.Design", heading: dict[str, str], engine: str | None, as_json: bool) -> None:
    """Print the quantities of the published study, which a `Jump` does not have."""
    if engine not in (None, "pybullet"):
        raise JumpcadError(f"--engine {engine}: the published simulation exists in pybullet alone")
    result = jumpcad.published.simulate(design)
    told = (
        f"published distance  {result.distance_m:.6f} m   where the body is at the first contact after 0.5 s\n"
        f"published height    {result.base_height_m:.6f} m   the body's height above ground, not its rise\n"
        f"energy              {result.energy_j:.6f} J"
    )
    answer(as_json, heading | asdict(result), print, told)


def _land(
    robot: "jumpcad.Robot", heading: dict[str, str], settings: "jumpcad.Settings", tries: int, seed: int, as_json: bool
) -> None:
    """Let a robot land a number of times, and print where it rests, on what, and whether winding rights it."""
    import numpy as np

    found = jumpcad.land(robot, tries, seed, settings)
    names = {"touches down at": "touchdown_m", "rests at": "rest_m"}
    distances = {
        label: np.quantile([getattr(one, name) for one in found.tries], [0.0, 0.5, 1.0])
        for label, name in names.items()
    }
    values = {"design": heading["design"], "tries": tries, "distances": distances, "found": found}
    stop_mm = robot.workshop.safety.landing_stop_mm
    answer(as_json, heading | {"landing": found.to_dict()}, print_text, "landing", **values, stop_mm=stop_mm)


def _jump_on(
    robot: "jumpcad.Robot", heading: dict[str, str], settings: "jumpcad.Settings", count: int, seed: int,
    as_json: bool, trajectory: Path | None, force: bool,
) -> None:  # fmt: skip
    """Let a robot jump a number of times in a row, print a line each and the sums, and write its way if asked."""
    series = jumpcad.jumps(robot, count, seed, settings, trajectory is not None)
    if trajectory and series.trajectory:
        _write_trajectory(trajectory, series.trajectory, force)
    values = {"design": heading["design"], "count": count, "series": series}
    answer(as_json, heading | {"series": series.to_dict()}, print_text, "jumps", **values)


def _go(
    robot: "jumpcad.Robot", heading: dict[str, str], settings: "jumpcad.Settings",
    to: "float | tuple[float, ...] | Course", tries: int, seed: int, noise_deg: float | None, as_json: bool,
    trajectory: Path | None, force: bool,
) -> None:  # fmt: skip
    """Send a robot somewhere a number of times; of an interrupted command, print what was finished.

    The exit code is 1 if it never arrives.
    """
    from jumpcad.landing.course import HEADING_NOISE_DEG

    noise = HEADING_NOISE_DEG if noise_deg is None else noise_deg
    found, whole = tries_of(robot, to, tries, seed, settings, noise, trajectory is not None)
    if found:
        if trajectory and found[0].trajectory:
            _write_trajectory(trajectory, found[0].trajectory, force)
        print_going(to, found, heading, noise, as_json)
    if not whole:
        raise KeyboardInterrupt
    if not any(one.arrived for one in found):
        raise typer.Exit(1)


def _report(
    heading: dict[str, str], jumps: "list[jumpcad.Jump]", as_json: bool, spread: "Uncertainty | None" = None,
    made: "Uncertainty | None" = None,
) -> None:  # fmt: skip
    if as_json:
        results = [jump.to_dict() for jump in jumps]
        if len(jumps) == 1:
            more = {"as_made": made and made.quantiles, "uncertain": spread and spread.to_dict()}
            print_json(heading | results[0] | {name: value for name, value in more.items() if value})
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
        made_m=made and made.quantiles["touchdown_distance_m"][1],
    )  # fmt: skip


def _difference_percent(jumps: "list[jumpcad.Jump]") -> float | None:
    """Return the difference of the second engine's range from the first's (%), if both jump."""
    ranges = [jump.ballistic_range_m for jump in jumps]
    if len(ranges) != 2 or ranges[0] is None or ranges[1] is None:
        return None
    return 100.0 * (ranges[1] / ranges[0] - 1.0)


def _write_trajectory(path: Path, trajectory: "Trajectory", force: bool) -> None:
    """Write a trajectory, one row per moment, as CSV or JSON."""
    from jumpcad.files.outputs import write_atomically

    columns = {name: values.tolist() for name, values in trajectory.columns().items()}
    text = io.StringIO()
    if path.suffix == ".json":
        text.write(json.dumps(columns, indent=1) + "\n")
    else:
        csv.writer(text, lineterminator="\n").writerows([columns, *zip(*columns.values(), strict=True)])
    write_atomically(path, text.getvalue(), force)
