"""Records are read from TOML files, made in Python and checked again, by the same rules."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.tables import Bed, Printer

from jumpcad.errors import JumpcadError
from jumpcad.files.records import Contradiction, Record


def test_good_file(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text('name = "MK4"\n[bed]\nwidth_mm = 250\n')
    assert Printer.from_toml(file) == Printer(name="MK4", bed=Bed(width_mm=250.0))


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_is_finite(value: float) -> None:
    with pytest.raises(JumpcadError, match="must be a finite number"):
        Printer(name="x", nozzle_mm=value, bed=Bed(width_mm=1.0))


def test_a_record_that_was_changed_behind_its_back_is_found_out() -> None:
    printer = Printer(name="x", bed=Bed(width_mm=1.0))
    assert printer.revalidated() == printer
    wrong = printer.model_copy(update={"bed": Bed.model_construct(width_mm=-1.0)})
    with pytest.raises(JumpcadError, match=r"^bed\.width_mm = -1\.0: must be more than 0$"):
        wrong.revalidated()


class Span(Record):
    """Two ends, in order."""

    low_mm: float = 0.0
    high_mm: float = 1.0

    def contradictions(self) -> Iterator[Contradiction]:
        if self.high_mm < self.low_mm:
            yield ("high_mm",), self.high_mm, f"must be at least low_mm = {self.low_mm:g}"
        if self.low_mm < 0.0 < self.high_mm:
            yield ("low_mm",), self.low_mm, "must be on one {side}"


def test_values_that_contradict_each_other_are_all_named(tmp_path: Path) -> None:
    """One alone too, in Python as in a file, where it is named with its line."""
    assert Span(low_mm=1.0, high_mm=2.0).high_mm == 2.0
    with pytest.raises(JumpcadError, match=r"^high_mm = 1\.0: must be at least low_mm = 3$"):
        Span(low_mm=3.0)
    with pytest.raises(JumpcadError, match=r"^low_mm = -1\.0: must be on one \{side\}$"):
        Span(low_mm=-1.0)
    (tmp_path / "s.toml").write_text("low_mm = 3.0\nhigh_mm = 2.0\n")
    where = re.escape(f"{tmp_path / 's.toml'}:2")
    with pytest.raises(JumpcadError, match=rf"^{where}: high_mm = 2\.0: must be at least low_mm = 3$"):
        Span.from_toml(tmp_path / "s.toml")
