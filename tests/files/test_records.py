"""Records are read from TOML files, made in Python and checked again, by the same rules."""

from pathlib import Path

import pytest
from support.tables import Bed, Printer

from jumpcad.errors import JumpcadError


def test_good_file(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text('name = "MK4"\n[bed]\nwidth_mm = 250\n')
    assert Printer.from_toml(file) == Printer(name="MK4", bed=Bed(width_mm=250.0))


def test_python_callers_get_the_same_words_without_a_file() -> None:
    with pytest.raises(JumpcadError, match=r"^nozzle_mm = 0\.01: must be at least 0\.1$"):
        Printer(name="x", nozzle_mm=0.01, bed=Bed(width_mm=1.0))


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
