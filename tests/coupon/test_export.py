"""The coupon's folder: the same bytes for the same workshop, and no readings lost."""

from pathlib import Path

import pytest

from jumpcad.coupon.export import export_coupon
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


def test_the_same_workshop_gives_the_same_bytes(tmp_path: Path) -> None:
    contents = []
    for name in ("a", "b"):
        folder = export_coupon(load_workshop("fine"), tmp_path / name).folder
        contents.append({str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*.*")})
    assert contents[0] == contents[1]


def test_readings_that_were_filled_in_are_not_lost(tmp_path: Path) -> None:
    folder = export_coupon(load_workshop(), tmp_path / "c").folder
    (folder / "readings.toml").write_text("[gears]\nturns_freely_mm = 0.1")
    with pytest.raises(JumpcadError, match=r"c: readings\.toml: edited or added since the bundle was written"):
        export_coupon(load_workshop(), folder)
    assert "0.1" in (folder / "readings.toml").read_text()
