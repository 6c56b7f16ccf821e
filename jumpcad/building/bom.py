"""The bill of materials: every printed part and every bought one, nuts and washers included.

Prices come from the workshop, else from shops and estimates that ship; printing times come from a slicer. Unknown ones
stay blank.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from jumpcad.catalogue.articles import ESTIMATE, shipped_prices
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import shown
from jumpcad.files.reading import to_csv
from jumpcad.parts.part import MassLine
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.foot.pads import printed_pads
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.robot.springs.thing import CHOOSE, ORDERED
from jumpcad.workshop import Workshop

ALWAYS = (
    "solder with flux core, 0.5 to 1 mm", "heat-shrink tube 4 mm, 0.1 m", "super glue (CA), thin", "isopropyl alcohol",
    "grease, silicone or lithium", "light oil", "adhesive tape", "emery cloth", "20 spare cable ties 2.5 x 100 mm",
    "spare foam tape",
)  # fmt: skip
DUST = ("gloves", "mask (FFP2)", "sandpaper")
"""For fibre that is cut and sanded."""


def used_up(robot: Robot) -> tuple[str, ...]:
    """Return the names of what the guide tells the builder to use up."""
    layout, parts = robot.layout, robot.layout.electronics.components
    found = list(ALWAYS)
    if "plug" in parts:
        found.append("second battery and socket like the robot's, leads insulated")
    if printed_pads(robot.hardware, robot.workshop):
        found.append("super glue (CA) that stays flexible")
    if layout.of(Cage) is not None or layout.leg_bar is not None:
        found += DUST
    if layout.leg_bar is not None:
        found += ["epoxy, two components, movable for 20 min or longer, 5 g", "baking paper"]
    return tuple(found)


COLUMNS = (
    "kind", "item", "quantity", "ordered", "material", "grams_each", "grams", "mass_from", "eur_each", "eur",
    "print_time_s", "price_from",
)  # fmt: skip
MASSES = tuple(field.name for field in fields(MassLine))
OWN, THERE = "workshop", "there already"


@dataclass(frozen=True)
class BillLine(MassLine):
    """One line: mass, price and printing time are those of one piece.

    What it costs are the pieces that are `ordered`, in packs of `pack`. `price_from` is `workshop`, `there already`
    (price 0, none is ordered), a shop with its date, or `estimate`.
    """

    price_eur: float | None = None
    time_s: float | None = None
    price_from: str = ""
    pack: int = 1

    @property
    def total_kg(self) -> float:
        """Mass of all pieces (kg)."""
        return self.quantity * self.mass_kg

    @property
    def ordered(self) -> int:
        """How many pieces are ordered: whole packs, and of springs more than the robot has, to choose from."""
        if self.price_from == THERE:
            return 0
        return -(-self.quantity * (ORDERED if self.name.endswith(CHOOSE) else 1) // self.pack) * self.pack

    @property
    def total_eur(self) -> float | None:
        """Price of all pieces that are ordered."""
        return None if self.price_eur is None else self.ordered * self.price_eur


@dataclass(frozen=True)
class SlicedPlate:
    """A print plate as sliced: grams and seconds of all parts on it."""

    name: str
    material: str
    grams: float
    time_s: float


@dataclass(frozen=True)
class Bill:
    """All lines, printed parts first, the print plates if they were sliced, and names of what is used up."""

    items: tuple[BillLine, ...]
    plates: tuple[SlicedPlate, ...] = ()
    used: tuple[str, ...] = ()

    @property
    def mass_kg(self) -> float:
        """Mass of everything (kg)."""
        return sum(item.total_kg for item in self.items)

    @property
    def time_s(self) -> float | None:
        """Printing time of all plates (s); None if they were not sliced."""
        return sum(plate.time_s for plate in self.plates) if self.plates else None

    @property
    def cost_eur(self) -> float | None:
        """Price of all lines whose prices are known; None if none is."""
        known = [item.total_eur for item in self.items if item.total_eur is not None]
        return sum(known) if known else None

    @property
    def known_share(self) -> float:
        """Share of the cost that is no estimate."""
        known = sum(item.total_eur or 0.0 for item in self.items if item.price_from != ESTIMATE)
        return known / self.cost_eur if self.cost_eur else 0.0

    @property
    def known(self) -> str:
        """How much of the cost is known, and what has no price, in words."""
        free = sum(item.price_eur is None for item in self.items)
        without = f", {counted(free, 'line')} without a price" if free else ""
        return f"{100.0 * self.known_share:.0f} % of it by known prices, the rest estimated{without}"

    @property
    def summary(self) -> str:
        """Mass, known prices and their sum, in words."""
        cost = "" if self.cost_eur is None else f"; about {euros(self.cost_eur)} € together, {self.known}"
        return f"In all {1000.0 * self.mass_kg:.1f} g{cost}."

    def sliced(self, times_s: Mapping[str, float], plates: Iterable[SlicedPlate]) -> "Bill":
        """Return the bill with printing times: `times_s` of one copy of each part, by name, and those of plates."""
        items = (
            replace(item, time_s=times_s.get(item.name)) if item.kind == "printed" else item for item in self.items
        )
        return Bill(tuple(items), tuple(plates), self.used)


@decided_once
def bill_of_materials(robot: Robot) -> Bill:
    """Return a robot's printed parts, then the bought ones by article, with the prices of its workshop."""
    printed = [
        BillLine("printed", part.name, part.quantity, part.material, part.mass_kg, part.mass_source)
        for part in robot.parts
    ]
    pads = printed_pads(robot.hardware, robot.workshop)
    printed += [BillLine("pad", one.name, one.quantity, one.pad.description, one.item.mass_kg, "solid") for one in pads]
    names = {one.name for one in pads}
    articles = defaultdict(list)
    for thing in robot.hardware:
        if thing.name not in names:
            articles[thing.article].append(thing)
    bought = []
    for article, things in articles.items():
        quantity = sum(thing.units for thing in things)
        each = sum(thing.mass_kg for thing in things) / quantity
        bought.append(BillLine("bought", article, quantity, "", each, "catalogue"))
    return replace(_priced([*printed, *bought], robot.workshop), used=used_up(robot))


def mass_facts(lines: Iterable[MassLine]) -> list[dict[str, Any]]:
    """Return masses and where they came from, for the manifest."""
    return [{name: getattr(line, name) for name in MASSES} for line in lines]


def bill_of_facts(facts: Iterable[Mapping[str, Any]], workshop: Workshop, used: Iterable[str] = ()) -> Bill:
    """Return the bill of `mass_facts` in a manifest, with the prices of a workshop and what is used up."""
    lines = [BillLine(**{name: line[name] for name in MASSES}) for line in facts]
    return replace(_priced(lines, workshop), used=tuple(used))


def write_bom(bill: Bill) -> str:
    """Return the bill of materials as CSV: the lines, the sliced plates, the total."""
    return to_csv([COLUMNS, *_rows(bill)])


def _rows(bill: Bill) -> Iterator[Sequence[object]]:
    for item in bill.items:
        each, total = (f"{1000.0 * mass:.3f}" for mass in (item.mass_kg, item.total_kg))
        prices = euros(item.price_eur, 3), euros(item.total_eur)
        row = (item.kind, item.name, item.quantity, item.ordered, item.material, each, total, item.source)
        yield *row, *prices, _seconds(item.time_s), item.price_from
    for name in bill.used:
        yield "used up", name, *[""] * (len(COLUMNS) - 2)
    for plate in bill.plates:
        yield "plate", plate.name, 1, "", plate.material, "", "", "", "", "", _seconds(plate.time_s), ""
    total = f"{1000.0 * bill.mass_kg:.3f}"
    yield "total", bill.known, "", "", "", "", total, "", "", euros(bill.cost_eur), _seconds(bill.time_s), ""


def euros(price: float | None, digits: int = 2) -> str:
    """Return a price as text, empty if it is unknown."""
    return "" if price is None else f"{price:.{digits}f}"


def _seconds(time_s: float | None) -> str:
    return "" if time_s is None else f"{time_s:.0f}"


def _priced(items: Sequence[BillLine], workshop: Workshop) -> Bill:
    """Return the bill of lines with prices: filament by mass, articles by the beginnings of names."""
    known = [*(item.name for item in items), *shipped_prices().pieces]
    for key in workshop.prices_eur:
        if not any(name.startswith(key) or key.startswith(name) for name in known):
            inside = [f" (did you mean {name!r}?)" for name in known if key in name]
            hint = inside[0] if inside else did_you_mean(key, {name[: len(key) + 1].rstrip() for name in known})
            raise JumpcadError(f"prices_eur.{shown(key)}: no article's name begins so{hint}; bom.csv lists them")
    lines = []
    for item in items:
        price, source, pack = _price(item, workshop)
        lines.append(replace(item, price_eur=price, price_from=source, pack=pack))
    return Bill(tuple(lines))


def _price(item: BillLine, workshop: Workshop) -> tuple[float | None, str, int]:
    """Return the price of one piece, where it is from, and how many are sold together."""
    if item.kind == "printed":
        material = workshop.materials.get(item.material)
        if material is not None and material.price_eur_per_kg is not None:
            return material.price_eur_per_kg * item.mass_kg, OWN, 1
        return shipped_prices().filament_eur_per_kg * item.mass_kg, ESTIMATE, 1
    beginnings = [beginning for beginning in workshop.prices_eur if item.name.startswith(beginning)]
    if beginnings:
        price = workshop.prices_eur[max(beginnings, key=len)]
        return price, OWN if price else THERE, 1
    return shipped_prices().eur(item.name) or (None, "", 1)
