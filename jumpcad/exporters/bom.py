"""The bill of materials: every printed part, and every bought one down to each nut and washer."""

import csv
import io
from collections import defaultdict
from dataclasses import dataclass

from jumpcad.robot import Robot

COLUMNS = ("kind", "item", "quantity", "material", "grams_each", "grams", "mass_from")


@dataclass(frozen=True)
class Item:
    """One line: `kind` is `printed` or `bought`, `mass_kg` that of one piece."""

    kind: str
    name: str
    quantity: int
    material: str
    mass_kg: float
    mass_source: str

    @property
    def total_kg(self) -> float:
        """Mass of all pieces (kg)."""
        return self.quantity * self.mass_kg


def bill_of_materials(robot: Robot) -> list[Item]:
    """Return the printed parts, then the bought ones by article."""
    printed = [
        Item("printed", part.name, part.quantity, part.material, part.mass_kg, part.mass_source) for part in robot.parts
    ]
    articles = defaultdict(list)
    for thing in robot.hardware:
        articles[thing.article].append(thing)
    bought = []
    for article, things in articles.items():
        quantity = sum(thing.units for thing in things)
        each = sum(thing.mass_kg for thing in things) / quantity
        bought.append(Item("bought", article, quantity, "", each, "catalogue"))
    return printed + bought


def write_bom(robot: Robot) -> str:
    """Return the bill of materials as CSV."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(COLUMNS)
    for item in bill_of_materials(robot):
        each, total = (f"{1000.0 * mass:.3f}" for mass in (item.mass_kg, item.total_kg))
        writer.writerow([item.kind, item.name, item.quantity, item.material, each, total, item.mass_source])
    return stream.getvalue()
