"""`jumpcad check`: whether the robot jumps, then violated limits, then tight ones; words for it of other commands."""

import sys
from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from typing import Annotated, Any

import typer

import jumpcad
from jumpcad import simulation
from jumpcad.cli import subjects
from jumpcad.cli.output import JsonFlag, console, print_json, table, wrapped
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.findings import SHOWN_AS, Finding, errors

STYLES = {"error": "bold red", "warning": "yellow", "info": "green"}
WORDS = {"error": "error", "warning": "warning", "info": "holds"}
TIGHT = 0.8
"""Use of a limit from which it is shown also without --all."""
COUNTED = "", "faults", "mm³"
"""Units of counts and of quantities that must be 0: a margin of 0 is not tight."""
SAID = "verdict", "touchdown_distance_m", "ballistic_range_m", "com_rise_m"
SMALL = 0.005
"""Margins below this, in the printed unit, are "at the limit" or "just beyond"."""
NEXT = "Say what each limit costs in range, and a gram of the body: seconds of work."
NextFlag = Annotated[bool, subjects.option(NEXT, None, "--next")]


def jump_in_words(jump: dict[str, Any], made_m: float | None = None) -> str:
    """Return touchdown, also in the median of robots as made, rise and mass of a jump, or why there is none."""
    if jump["verdict"] == "jump":
        made = f" ({1000.0 * made_m:.0f} as made, in the median)" if made_m else ""
        return (
            f"jumps {1000.0 * (jump.get('touchdown_distance_m') or jump['ballistic_range_m']):.0f} mm far{made} and "
            f"{1000.0 * jump['com_rise_m']:.0f} mm high with {1000.0 * jump['mass_kg']:.1f} g"
        )
    wrong = [finding for finding in jump["findings"] if finding["severity"] == "error"]
    why = "".join(f": {finding['message']}; {finding['remedy']}" for finding in wrong[:1])
    return f"does not jump ({jump['verdict']}){why}"


def warn_of_no_jump(robot: "jumpcad.Robot") -> None:
    """Print on standard error why a robot does not jump, if so."""
    jump = simulation.headline(robot)
    if jump.verdict != "jump":
        print(f"jumpcad: {robot.name} {jump_in_words(jump.to_dict())}", file=sys.stderr)


def notes(robot: "jumpcad.Robot", findings: Sequence[Finding]) -> Iterator[str]:
    """Yield what became of a robot by itself: sections that grew, and what bought springs do to its stiffness."""
    if asked := [f"strength.{part} = {more:g}" for part, more in robot.workshop.strength if more != 1.0]:
        yield f"{', '.join(asked)}: {_cost(robot)}"
    if robot.grown:
        most = max((one.use for one in robot.grown if one.use is not None), default=None)
        load = "" if most is None else f" to carry {most:.1f} times the load of their first sizing"
        each = (f"{one.what} by {100.0 * (one.factor - 1.0):.0f} % ({one.limit})" for one in robot.grown)
        yield f"sections grew{load}: {', '.join(each)}"
    yield from (finding.message for finding in findings if finding.is_note)


def _cost(robot: "jumpcad.Robot") -> str:
    """Return what the strength that was asked for costs in mass and distance."""
    from jumpcad.building import build
    from jumpcad.workshop import varied

    plain = {f"strength.{part}": 1.0 for part, _ in robot.workshop.strength}
    before = build(robot.design, varied(robot.workshop, plain), robot.name)
    far = [1000.0 * (simulation.headline(one).touchdown_distance_m or 0.0) for one in (robot, before)]
    return f"{1000.0 * (robot.mass_kg - before.mass_kg):+.1f} g and {far[0] - far[1]:+.0f} mm of touchdown"


def check(
    design: subjects.OwnDesignArgument,
    workshop: subjects.WorkshopOption = None,
    printer: subjects.PrinterOption = None,
    material: subjects.MaterialOption = None,
    every: Annotated[bool, typer.Option("--all", help="Show every limit, also those with a large margin.")] = False,
    explain: Annotated[str, subjects.option("Show one limit alone, with formula and source.", "NAME")] = "",
    what_next: NextFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Check the robot of a design: its jump, printing, strength, drive, clearances.

    Says whether and how far it jumps, then shows violated limits, and those
    used by 80 % or more. Remedies have numbers where trying a few finds one.

    The exit code is 1 if it does not jump, or a limit of severity "error" is
    violated.
    """
    from jumpcad.building import build
    from jumpcad.building.bom import bill_of_materials
    from jumpcad.bundle.limits import counted_limits, limits_of, ordered, violation, with_verdict
    from jumpcad.checks import CHECKS, basis_of
    from jumpcad.remedy_numbers import Remedies, next_steps, steps_in_words

    subjects.note_template(design)
    if explain and basis_of(explain) is None:
        hint = did_you_mean(explain, [name for one in CHECKS for name in one.basis])
        raise JumpcadError(f"no check makes a finding {explain!r}{hint}: jumpcad check DESIGN --all lists them")
    asked = jumpcad.load_design(design)
    workshop = workshop or asked.workshop_name
    shop = jumpcad.load_workshop(workshop, printer, material)
    remedies = Remedies(asked, shop)
    try:
        robot = build(asked, shop, subjects.name_of(design))
    except CannotBuildError as refusal:
        raise remedies.of_refusal(refusal) from None
    bill_of_materials(robot)  # rejects prices of what it does not have
    jump = simulation.headline(robot)
    findings = remedies.of_findings(ordered(with_verdict(limits_of(robot), jump)))
    count = counted_limits(findings)
    steps, usual_mm = next_steps(robot, findings) if what_next else ([], 0.0)
    if explain:
        findings = [finding for finding in findings if fnmatchcase(finding.name, explain)]
    if as_json:
        data = [finding.to_dict() | {"use": finding.use} for finding in findings]
        said = {name: getattr(jump, name) for name in SAID}
        said |= {"mass_kg": robot.mass_kg, "limits": count, "grown": [vars(one) for one in robot.grown]}
        if what_next:
            said |= {"next": [vars(one) for one in steps], "within_limits_mm": usual_mm}
        print_json({"design": design, "workshop": workshop, **said, "findings": data})
    elif explain:
        _print_explained(explain, findings)
    else:
        words = jump_in_words(jump.to_dict() | {"findings": []})
        print(wrapped(f"{words}; {violation(findings) or f'all {count} limits are kept'}", 2))
        for note in notes(robot, findings):
            print(wrapped(f"note: {note}", 6))
        _print_findings(findings, every)
        for line in steps_in_words(steps, usual_mm):
            print(wrapped(line, 2))
    if jump.verdict != "jump" or errors(findings):
        raise typer.Exit(1)


def is_tight(finding: Finding) -> bool:
    """Tell whether a limit that holds is nearly reached: used by `TIGHT` or more, or without a margin."""
    return margin_in_words(finding) == "at the limit" if finding.use is None else finding.use >= TIGHT


def margin_in_words(finding: Finding) -> str:
    """Return a margin in its printed unit; below `SMALL` it is "at the limit" or "just beyond"."""
    unit, factor = SHOWN_AS.get(finding.unit, (finding.unit, 1.0))
    margin = factor * finding.margin
    if unit in COUNTED and margin == 0.0:
        return ""
    if unit not in COUNTED and abs(margin) < SMALL:
        return "at the limit" if margin >= 0.0 else "just beyond"
    return f"{margin:+.3g} {unit}".rstrip()


def _print_explained(name: str, findings: list[Finding]) -> None:
    """Print formula and source of a limit, and what was found in this robot."""
    from jumpcad.checks import SYMBOLS, basis_of

    basis = basis_of(name)
    assert basis is not None
    told = table("name", "words", wraps="words", show_header=False)
    for words in (("formula", basis.formula), ("symbols", SYMBOLS), ("source", basis.source)):
        told.add_row(*words)
    for finding in findings:
        use = "" if finding.use is None else f"{100.0 * finding.use:.0f} % used, "
        state = f"{WORDS[finding.severity]}, {use}{margin_in_words(finding)}".removesuffix(", ")
        told.add_row(finding.name, f"{state}: {finding.message}")
        told.add_row("remedy", finding.remedy)
    console().print(told)
    if not findings:
        console().print(f"{name}: not a limit of this robot, or reported only where it fails")


def _print_findings(findings: list[Finding], every: bool) -> None:
    from rich.text import Text

    limits = [finding for finding in findings if not finding.is_note]
    shown = [finding for finding in limits if every or finding.severity != "info" or is_tight(finding)]
    screen = console()
    for finding in shown:
        kept = finding.severity == "info"
        word = ("tight", "warning") if kept and is_tight(finding) else (WORDS[finding.severity], finding.severity)
        use = "" if finding.use is None else f"{100.0 * finding.use:.0f} %"
        told = ", ".join(filter(None, (use, margin_in_words(finding))))
        screen.print(Text(word[0], STYLES[word[1]]), f"{finding.name}:", told)
        print(wrapped(f"  {finding.message}{'' if kept else f' → {finding.remedy}'}", 2))
    if left := sum(finding.counts for finding in limits) - sum(finding.counts for finding in shown):
        screen.print(f"{left} more are kept with more than {100.0 - 100.0 * TIGHT:.0f} % to spare: --all shows them")
