"""The page of all checks."""

import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatchcase
from itertools import chain
from pathlib import Path

from reference_page import EXAMPLE, page

import jumpcad
from jumpcad import checks
from jumpcad.files import template_names
from jumpcad.findings import SHOWN_AS, Basis, Finding
from jumpcad.mechanism.model import Mechanism
from jumpcad.simulation import planar
from jumpcad.workshop import load_workshop

VARIANTS = {
    'bought.leg = "carbon-tube-4x2"': "kenan-2.0",
    'bought.kit = "strong-2s"': "kenan-2.0",
    'bought.spring = "9271K589"': "kenan-2.0",
    "body.toe_half_width_mm = 60": "best-ga",
    'cage.rod = "glass-1.5"': "best-printable",
    "safety.lateral_offset_mm = 2": "best-printable",
}
"""What a workshop says that has other limits than the default one, and a design that can be built in it."""


def check_glossary() -> str:
    """Return the page of all checks: formula and source, what each found in the example, and what to change."""
    robot = jumpcad.build(jumpcad.load_design(EXAMPLE))
    quick = [*_templates(), *_variants()]
    found: dict[str, list[Finding]] = {}
    bases: dict[str, Mapping[str, Basis]] = {}
    for check in checks.CHECKS:
        subjects = [robot, *quick] if check.cheap else [robot]
        found.setdefault(check.find.__module__, []).extend(chain.from_iterable(map(check.find, subjects)))
        bases[check.find.__module__] = {**bases.get(check.find.__module__, {}), **check.basis}
    found[planar.__name__], bases[planar.__name__] = [*jumpcad.simulate(robot, engine="planar").findings], planar.BASIS
    words = (
        "Every limit that `jumpcad check` knows, and those of a simulated jump. “Found” is what it says of "
        f"`{EXAMPLE}` in the default workshop, or of the first template or other workshop that has the limit. The "
        "remedy is what it advises where the limit is violated, with figures of that robot. `jumpcad check DESIGN "
        "--explain NAME` shows the same for your robot."
    )
    blocks = [_checks_of(module, bases[module], findings) for module, findings in found.items()]
    return page("Checks", words, f"Symbols: {checks.SYMBOLS}.", *blocks)


def _templates() -> Iterator[Mechanism]:
    for name in template_names("robots"):
        yield jumpcad.build(jumpcad.load_design(name))


def _variants() -> Iterator[Mechanism]:
    with tempfile.TemporaryDirectory() as folder:
        for variant, name in VARIANTS.items():
            path = Path(folder) / "variant.toml"
            path.write_text(variant, encoding="utf-8")
            yield jumpcad.build(jumpcad.load_design(name), load_workshop(path))


def _checks_of(module: str, bases: Mapping[str, Basis], findings: list[Finding]) -> str:
    """Return the section of a module; a finding belongs to the first name that it matches."""
    blocks = [f"## `{module.replace('.', '/')}.py`", (sys.modules[module].__doc__ or "").strip()]
    left = {one.name: one for one in reversed(findings)}
    for name, basis in bases.items():
        own = {met: left.pop(met) for met in dict.fromkeys(one.name for one in findings)
               if met in left and fnmatchcase(met, name)}  # fmt: skip
        blocks.append("\n".join(_lines(name, basis, own.values())))
    return "\n\n".join(blocks)


def _lines(name: str, basis: Basis, findings: Iterable[Finding]) -> Iterator[str]:
    yield f"### `{name}`\n"
    yield f"- **Formula**: {basis.formula}"
    yield f"- **Source**: {basis.source}"
    shown = [*findings]
    for one in shown:
        which = "" if one.name == name else f"`{one.name}`, "
        yield f"- **Found** ({which}{_unit(one)}): {one.message}"
        yield f"- **Remedy**: {one.remedy}"
    if not shown:
        yield "- Not met in any of these robots."


def _unit(finding: Finding) -> str:
    """Return the unit of margin, value and limit, and that in which it is shown."""
    if finding.unit not in SHOWN_AS:
        return finding.unit or "no unit"
    return f"{finding.unit}, shown in {SHOWN_AS[finding.unit][0]}"
