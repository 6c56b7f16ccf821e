"""The page of all checks."""

import re
import sys
import tempfile
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path

from reference_page import EXAMPLE, page, table

import jumpcad
from jumpcad import checks
from jumpcad.files import template_names
from jumpcad.findings import Finding
from jumpcad.mechanism.model import Mechanism
from jumpcad.workshop import load_workshop

VARIANTS = {
    'bought.leg = "carbon-tube-4x2"': "kenan-2.0",
    'bought.kit = "strong-2s"': "kenan-2.0",
    'bought.spring = "9271K589"': "kenan-2.0",
    "body.toe_half_width_mm = 60": "best-ga",
}
"""What a workshop says that has other limits than the default one, and a design that can be built in it."""


def check_glossary() -> str:
    """Return the page of all checks: what each found in the example, what it compares, and what to change."""
    robot = jumpcad.build(jumpcad.load_design(EXAMPLE))
    quick = [*_templates(), *_variants()]
    found: dict[str, list[Finding]] = {}
    for check in checks.CHECKS:
        subjects = [robot, *quick] if check.cheap else [robot]
        found.setdefault(check.find.__module__, []).extend(chain.from_iterable(map(check.find, subjects)))
    met = {finding.name for finding in chain.from_iterable(found.values())}
    listed = re.findall(r"\b[a-z]+(?:_[a-z]+)*(?=,|;|\.$)", (checks.__doc__ or "").split("by module:")[1])
    missing = [f"`{name}`" for name in listed if name not in met]
    words = (
        f"Every limit that `jumpcad check` knows. The column “found” is what it says of `{EXAMPLE}` in the default "
        "workshop, or of the first template or other workshop that has the limit: figures show what is compared. The "
        "remedy is what it advises where the limit is violated, with figures of that robot. Formula and source are in "
        "the module named, and in those that it imports."
    )
    rest = f"Not met in any of these robots, since they are reported only where they fail: {', '.join(missing)}."
    blocks = [_checks_of(module, findings) for module, findings in found.items()]
    return page("Checks", words, *blocks, *([rest] if missing else []))


def _templates() -> Iterator[Mechanism]:
    for name in template_names("robots"):
        yield jumpcad.build(jumpcad.load_design(name))


def _variants() -> Iterator[Mechanism]:
    with tempfile.TemporaryDirectory() as folder:
        for variant, name in VARIANTS.items():
            path = Path(folder) / "variant.toml"
            path.write_text(variant, encoding="utf-8")
            yield jumpcad.build(jumpcad.load_design(name), load_workshop(path))


def _first_of_each(findings: Iterable[Finding]) -> Iterator[Finding]:
    seen = set()
    for finding in findings:
        if finding.name not in seen:
            seen.add(finding.name)
            yield finding


def _checks_of(module: str, findings: list[Finding]) -> str:
    doc = (sys.modules[module].__doc__ or "").strip()
    rows = [(f"`{one.name}`", one.unit, one.message, one.remedy) for one in _first_of_each(findings)]
    heading = f"## `{module.replace('.', '/')}.py`"
    return "\n\n".join([heading, doc, *([table(("check", "unit", "found", "remedy"), rows)] if rows else [])])
