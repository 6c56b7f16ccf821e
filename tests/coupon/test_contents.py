"""The coupon's folder: the same bytes for the same workshop, and no readings lost."""

import re
import tomllib
from pathlib import Path

import pytest
from support.fits import with_fits_apart

from jumpcad.bundle.export import export_coupon
from jumpcad.coupon.contents import GROUPS, coupon_values
from jumpcad.coupon.pieces import coupon_holes
from jumpcad.coupon.readings import Readings, measured_workshop
from jumpcad.files.templates import fill
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


def test_every_piece_and_every_reading_of_a_joint_is_in_a_picture(coupon: Path) -> None:
    """One gauge stands for those of all materials; the instructions show each picture."""
    pieces = {file.stem for file in (coupon / "stl").iterdir() if not file.stem.startswith("gauge_")}
    seen = [name for name in pieces for group in GROUPS.values() for key in group if re.fullmatch(key, name)]
    assert sorted(seen) == sorted(pieces)
    written = {reading for group in GROUPS.values() for reading in group.values() if reading}
    assert written == {*re.findall(r"^# (\w+) =", (coupon / "readings.toml").read_text().split("[joints]")[1], re.M)}
    shown = re.findall(r"\(pictures/(.*)\)", (coupon / "coupon.md").read_text(encoding="utf-8"))
    assert sorted(shown) == sorted(file.name for file in (coupon / "pictures").iterdir())


def test_the_file_for_readings_has_every_fit_of_the_workshop_and_is_read_as_it_stands() -> None:
    """With the # of all lines removed nothing changes."""
    workshop = with_fits_apart(load_workshop("fine"))
    filled = re.sub(
        "(?m)^# (?=[a-z0-9_]+ = )", "", fill("guides/readings.toml.j2", coupon_values(workshop, coupon_holes(workshop)))
    )
    found = measured_workshop(Readings.from_data(tomllib.loads(filled), "r.toml", filled), workshop)
    assert found.fits == workshop.fits
    for name in workshop.materials:
        gauge = tomllib.loads(filled)["gauge"][name]
        assert [gauge[f"axle_{fit}"] for fit in ("press_mm", "sliding_mm", "loose_mm")] == [
            getattr(workshop.fits, fit) for fit in ("press_mm", "sliding_mm", "loose_mm")
        ]
        assert gauge["bearing_press_mm"] == workshop.fits.press_mm
