"""What docs/reference tells users: keys of a workshop's tables, ranges of their numbers, formulas of the checks."""

import re
from collections.abc import Iterable
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel, TypeAdapter, ValidationError

from jumpcad.findings import Basis
from support.places import ROOT

BLOCK = re.compile(r"^### `([^`]+)`\n\n- \*\*Formula\*\*: (.*)\n- \*\*Source\*\*: (.*)$", re.M)
ROW = re.compile(r"\| `(\w+)` \| [^|]*\| (?:`auto` or )?(whole, )?(?:(\d+) numbers, each )?(\S+) to (\S+) \|")
BEYOND = 1e-6


class Range(NamedTuple):
    """A key, the least and the greatest number that it may have, how many it has in a list, and whether they are whole.

    `count` is 0 for a number that is no list.
    """

    key: str
    low: float
    high: float
    count: int
    whole: bool

    def tries(self) -> list[tuple[object, bool]]:
        """Return both ends, and what is just beyond them, each with whether it is allowed; lists ascend."""
        step = 1.0 if self.whole else BEYOND
        below = self.low - step * (1.0 if self.whole or not self.low else abs(self.low))
        above = self.high + step * (1.0 if self.whole else abs(self.high))
        kind = int if self.whole else float
        if self.count:
            others = self.count - 1
            lists = ((self.low, self.high, True), (below, self.high, False), (self.low, above, False))
            return [((kind(first), *(kind(last),) * others), allowed) for first, last, allowed in lists]
        return [(kind(one), allowed) for one, allowed in
                ((self.low, True), (self.high, True), (below, False), (above, False))]  # fmt: skip


def taken(adapter: TypeAdapter[Any], value: object) -> bool:
    """Tell whether a table takes a value."""
    try:
        adapter.validate_python(value)
    except ValidationError:
        return False
    return True


def documented_ranges(table: str) -> list[Range]:
    """Return the ranges of a table, such as `fits` or `boards.NAME`."""
    text = (ROOT / "docs" / "reference" / "workshop.md").read_text(encoding="utf-8")
    section = text.partition(f"\n## [{table}]\n")[2].partition("\n## ")[0]
    rows = [found.groups() for found in map(ROW.match, section.splitlines()) if found]
    return [Range(key, float(low), float(high), int(count or 0), bool(whole)) for key, whole, count, low, high in rows]


def wrongly_taken(table: str, model: type[BaseModel]) -> list[str]:
    """Return the ends of ranges that a table refuses, and what just beyond them it takes."""
    wrong = []
    for one in documented_ranges(table):
        field = model.model_fields[one.key]
        adapter: TypeAdapter[Any] = TypeAdapter(
            Annotated[(field.annotation, *field.metadata)] if field.metadata else field.annotation
        )
        wrong += [f"{table}.{one.key} = {value}" for value, allowed in one.tries() if taken(adapter, value) != allowed]
    return wrong


def documented_bases(names: Iterable[str]) -> dict[str, Basis]:
    """Return formula and source of findings by their names, as docs/reference/checks.md has them."""
    page = (ROOT / "docs" / "reference" / "checks.md").read_text(encoding="utf-8")
    bases = {name: Basis(formula, source) for name, formula, source in BLOCK.findall(page)}
    return {name: bases[name] for name in names}
