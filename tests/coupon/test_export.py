"""The coupon's folder: the same bytes for the same workshop, and no readings lost."""

import json
import re
import shutil
import tomllib
from pathlib import Path

import pytest
from support.fits import with_fits_apart

from jumpcad.coupon import export
from jumpcad.coupon.export import _guide, _mass_kg, _template, export_coupon
from jumpcad.coupon.joints import joint_pieces
from jumpcad.coupon.pieces import coupon_holes, pieces
from jumpcad.coupon.readings import Readings, measured_workshop
from jumpcad.errors import JumpcadError
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.workshop import load_workshop


def contents(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*.*")}


@pytest.fixture(scope="module")
def coupon(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A coupon's folder; not to be changed."""
    return export_coupon(load_workshop("fine"), tmp_path_factory.mktemp("coupon") / "c").folder


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


@pytest.mark.parametrize("retention", ["plates", "clips", "nuts"])
def test_axles_that_are_screws_are_no_rods_to_try_holes_with(retention: str) -> None:
    """The shank of a screw M3 may have 2.86 mm (ISO 4762, h13), and its other half is thread."""
    workshop = load_workshop()
    workshop = workshop.model_copy(update={"bought": workshop.bought.model_copy(update={"retention": retention})})
    said = _guide(workshop, coupon_holes(workshop))
    assert "3 mm rod, 30 mm long or longer, square and free of burrs (" in said
    assert ("its own axles will do" in said) == (retention != "nuts")


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


@pytest.mark.parametrize(("bearing", "needed"), [(None, ["MR63", "683"]), ("623", ["623"]), ("", [])])
def test_the_guide_asks_for_the_bearings_that_go_into_gauges_and_seats(bearing: str | None, needed: list[str]) -> None:
    """ISO 15 dimension series: the lightest two with a bore of 3 mm, the one that the workshop allows, or none."""
    workshop = load_workshop()
    if bearing is not None:
        workshop = workshop.model_copy(update={"bought": workshop.bought.model_copy(update={"leg_bearing": bearing})})
    holes = coupon_holes(workshop)
    text = _guide(workshop, holes)
    (asked,) = re.findall(r"\(its own axles will do\); (.*)the gear motor; an M2", text)
    assert re.findall(r"\w*\d{3}\w*|MR\d+", asked) == needed
    assert asked.startswith(("", "the bearing ", "the bearings ")[len(needed)])
    row = re.search(r"- \*\*B\*\*, (.*?)[,:]", text)
    assert row is not None
    assert row[1] == (f"the bearing {needed[0]}" if needed else "left out")
    seat = re.search(r"- \*\*seat\*\* \(\w+\), (.*?)[,:]", text)
    assert seat is not None
    assert seat[1] == (f"the bearing {needed[1]}" if needed[1:] else "left out")


def test_the_guides_hole_for_the_axle_and_its_force_on_a_floor_are_read_as_they_are_said() -> None:
    """`.10` is 0.10 mm a side of 3 mm; the force named is no sign of a weak floor, and one a newton smaller is."""
    workshop = load_workshop()
    text = _guide(workshop, coupon_holes(workshop))
    assert "`.10` is a hole of 3.2 mm for the axle" in text
    assert "two pieces of its 3 mm rod" in text
    said = re.search(r"as strong as the workshop says breaks at (\d+) N", text)
    assert said is not None
    assert f"# floor_n = {said[1]}\n" in _template(workshop, coupon_holes(workshop))
    for less, weaker in ((0, False), (2, True)):
        reading = f"[joints]\nfloor_n = {int(said[1]) - less}"
        found = measured_workshop(Readings.from_data(tomllib.loads(reading), "r.toml", reading), workshop)
        assert (found.materials != workshop.materials) == weaker


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


def test_wheels_are_printed_in_the_gears_material_and_gauges_in_every_one(monkeypatch: pytest.MonkeyPatch) -> None:
    workshop = load_workshop()
    workshop = workshop.model_copy(update={"roles": workshop.roles.model_copy(update={"gears": "PLA"})})
    monkeypatch.setattr(export, "_mass_kg", lambda *_: 0.001)
    monkeypatch.setattr(export, "write_folder", lambda folder, kind, facts, *_: facts["masses"])
    materials = {line["name"]: line["material"] for line in export_coupon(workshop, "unwritten")}  # type: ignore[attr-defined]
    wheels = {name: of for name, of in materials.items() if re.match("gear_|pinion_", name)}
    assert len(wheels) > 3
    assert set(wheels.values()) == {"PLA"}
    gauges = {name: of for name, of in materials.items() if name.startswith("gauge_")}
    assert gauges == {f"gauge_{name}": name for name in workshop.materials}


def test_a_piece_weighs_what_the_printers_own_nozzle_lays() -> None:
    """A wider one bridges the infill with thicker threads."""
    workshop = load_workshop()
    wide = workshop.model_copy(update={"printer": workshop.printer.model_copy(update={"nozzle_mm": 0.6})})
    (piece,) = (one for one in pieces(coupon_holes(workshop), ["PETG"], "PETG") if one.name == "gauge_PETG")
    density = workshop.materials["PETG"].density_g_cm3
    for shop, nozzle_mm in ((workshop, 0.4), (wide, 0.6)):
        expected = mass_properties(piece.shape, density, shop.process, nozzle_mm)
        assert _mass_kg(piece, shop) == expected.mass_kg
    assert _mass_kg(piece, wide) > _mass_kg(piece, workshop)


def test_the_coupon_weighs_what_its_pieces_weigh_each_in_its_material(coupon: Path) -> None:
    """Printed solid they would weigh more, as shells alone less."""
    workshop, manifest = load_workshop("fine"), json.loads((coupon / "manifest.json").read_text())
    holes = coupon_holes(workshop)
    made = pieces(holes, list(workshop.materials), workshop.material_name("gears")) + joint_pieces(workshop, holes)
    lines = {line["name"]: line for line in manifest["masses"]}
    assert manifest["mass_kg"] == pytest.approx(sum(line["quantity"] * line["mass_kg"] for line in lines.values()))
    assert lines.keys() == {piece.name for piece in made}
    for piece in made:
        line, solid_kg = lines[piece.name], 1e-6 * workshop.materials[piece.material].density_g_cm3 * piece.mesh.volume
        assert (line["material"], line["quantity"], line["kind"]) == (piece.material, 1, "printed")
        assert 0.4 * solid_kg < line["mass_kg"] < 1.02 * solid_kg
