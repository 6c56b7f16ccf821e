"""The committed bundle and report are what the program makes today.

`jumpcad build kenan-2.0 -o exports/kenan-2.0` and `jumpcad report best-printable -o
examples/best-printable-report.html` refresh them.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from support.places import ROOT

from jumpcad.building import build
from jumpcad.bundle.export import report_page
from jumpcad.design import load_design

COMMITTED = ROOT / "exports" / "kenan-2.0"


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@pytest.mark.thorough
def test_the_committed_bundle_is_made_again_byte_for_byte(bundle_of: Callable[..., Path]) -> None:
    committed, made = contents(COMMITTED), contents(bundle_of("kenan-2.0", pictures=True))
    assert sorted(committed) == sorted(made)
    assert [name for name in committed if committed[name] != made[name]] == []


@pytest.mark.thorough
def test_the_committed_report_is_made_again() -> None:
    made = report_page(build(load_design("best-printable"), name="best-printable"))
    assert made == (ROOT / "examples" / "best-printable-report.html").read_text(encoding="utf-8")
