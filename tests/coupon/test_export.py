"""The coupon's folder: the same bytes for the same workshop, and no readings lost."""

import re
import shutil
import tomllib
from pathlib import Path

import pytest
from support.fits import with_fits_apart

from jumpcad.coupon import export
from jumpcad.coupon.export import _guide, _template, export_coupon
from jumpcad.coupon.joints import joint_pieces
from jumpcad.coupon.pieces import coupon_holes
from jumpcad.coupon.readings import Readings, measured_workshop
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


def contents(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*.*")}


@pytest.fixture(scope="module")
def coupon(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A coupon's folder; not to be changed."""
    return export_coupon(load_workshop("fine"), tmp_path_factory.mktemp("coupon") / "c").folder


@pytest.mark.thorough
def test_the_same_workshop_gives_the_same_bytes(coupon: Path, tmp_path: Path) -> None:
    assert contents(export_coupon(load_workshop("fine"), tmp_path / "b").folder) == contents(coupon)


def test_readings_that_were_filled_in_are_not_lost(
    coupon: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(export, "_contents", lambda *_: iter(contents(coupon).items()))
    folder = Path(shutil.copytree(coupon, tmp_path / "c"))
    (folder / "readings.toml").write_text("[gears]\nturns_freely_mm = 0.1")
    with pytest.raises(JumpcadError, match=r"c: readings\.toml: edited or added since the bundle was written"):
        export_coupon(load_workshop("fine"), folder)
    assert "0.1" in (folder / "readings.toml").read_text()


@pytest.mark.parametrize("role", ["links", "body", "gears"])
def test_the_guide_names_the_material_in_which_each_piece_is_printed(role: str) -> None:
    """One role in PLA, the others in PETG."""
    workshop = load_workshop()
    roles = {one: "PLA" if one == role else "PETG" for one in ("links", "body", "gears")}
    workshop = workshop.model_copy(update={"roles": workshop.roles.model_copy(update=roles)})
    holes = coupon_holes(workshop)
    made = {re.sub(r"_\d+$", "", piece.name): piece.material for piece in joint_pieces(workshop, holes)}
    said = dict(re.findall(r"\*\*(\w+)\*\* \((\w+)\)", _guide(workshop, holes)))
    assert {"taps", "shaft_bores", "lying_holes", "dog_pockets", "axle_floor", "seat"} <= said.keys()
    assert {name: made[name] for name in said} == said
    assert f"gears in {roles['gears']}" in _guide(workshop, holes)


def test_the_file_for_readings_has_every_fit_of_the_workshop_and_is_read_as_it_stands() -> None:
    """With the # of all lines removed nothing changes, but what holes without a fit need: twice the press fit."""
    workshop = with_fits_apart(load_workshop("fine"))
    filled = re.sub("(?m)^# (?=[a-z0-9_]+ = )", "", _template(workshop, coupon_holes(workshop)))
    found = measured_workshop(Readings.from_data(tomllib.loads(filled), "r.toml", filled), workshop)
    assert found.fits.model_dump() == workshop.fits.model_dump() | {
        "hole_allowance_diameter_mm": pytest.approx(2.0 * workshop.fits.press_mm)
    }
    for name in workshop.materials:
        gauge = tomllib.loads(filled)["gauge"][name]
        assert [gauge[f"axle_{fit}"] for fit in ("press_mm", "sliding_mm", "loose_mm")] == [
            getattr(workshop.fits, fit) for fit in ("press_mm", "sliding_mm", "loose_mm")
        ]
        assert gauge["bearing_press_mm"] == workshop.fits.press_mm
