"""The committed bundle is what the program makes today. `jumpcad build kenan-2.0 -o exports/kenan-2.0` refreshes it."""

from pathlib import Path

from support.places import ROOT

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.design import load_design

COMMITTED = ROOT / "exports" / "kenan-2.0"


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_the_committed_bundle_is_made_again_byte_for_byte(tmp_path: Path) -> None:
    again = export(build(load_design("kenan-2.0"), name="kenan-2.0"), tmp_path / "kenan-2.0")
    committed, made = contents(COMMITTED), contents(again.folder)
    assert sorted(committed) == sorted(made)
    assert [name for name in committed if committed[name] != made[name]] == []
