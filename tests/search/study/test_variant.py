"""The input of one evaluation: a design with the values of its workshop, changed by name."""

import pytest

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.search.study.variant import Variant

DESIGN = load_design("kenan-2.0")
VARIANT = Variant(DESIGN, {"body.plate_mm": 3.0, "bought.retention": "nuts"})


def test_each_value_is_changed_where_it_belongs() -> None:
    changed = VARIANT.changed({"body.plate_mm": 2.5, "c_coef": 1.05})
    assert changed.workshop == {"body.plate_mm": 2.5, "bought.retention": "nuts"}
    assert changed.design == DESIGN.model_copy(update={"c_coef": 1.05})
    assert (VARIANT.workshop["body.plate_mm"], VARIANT.design) == (3.0, DESIGN)
    with pytest.raises(JumpcadError):
        VARIANT.changed({"c_coef": 1e3})
