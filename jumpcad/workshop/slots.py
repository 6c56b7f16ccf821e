"""Keys of a workshop that name parts of the catalogue, and the parts that fit there."""

from dataclasses import dataclass

from jumpcad.catalogue import Board, Catalogue, Component
from jumpcad.files import did_you_mean

ANY = "any"
"""In place of a leg's bearing: the lightest that carries its load."""


@dataclass(frozen=True)
class Slot:
    """What a key names: a table of the catalogue, what its parts are called, and names that are none of a part.

    `unnamed` is what an empty name means there; where it is empty, a part must be named.
    """

    table: str
    word: str
    unnamed: str = "none"
    others: tuple[str, ...] = ()

    def fitting(self, catalogue: Catalogue) -> list[str]:
        parts = getattr(catalogue, self.table)
        return [name for name, part in parts.items() if self.word in (_kinds(part) or (self.word,))]

    def misfit(self, catalogue: Catalogue, name: str) -> str:
        """Return why a name does not fit, with those that do; empty if it fits."""
        if name in self.others or (not name and self.unnamed):
            return ""
        parts, fitting = getattr(catalogue, self.table), self.fitting(catalogue)
        if name in fitting:
            return ""
        found = " or ".join(_kinds(parts[name])) if name in parts else ""
        what = f"is a {found}, no {self.word}" if found else f"is no {self.word} in the catalogue"
        unnamed = f'"" for {self.unnamed}' if self.unnamed else ""
        *choices, last = filter(None, (*fitting, *self.others, unnamed))
        listed = f"{', '.join(choices)} or {last}" if choices else last
        return f"{what}: choose {listed}{did_you_mean(name, fitting)}"


SLOTS = {
    "bought.motors": Slot("motors", "motor", ""),
    "bought.leg_bearing": Slot("bearings", "bearing", others=(ANY,)),
    "bought.roller": Slot("bearings", "bearing", ""),
    "bought.battery": Slot("batteries", "battery", ""),
    "bought.controller": Slot("boards", "controller", ""),
    "bought.driver": Slot("boards", "driver", ""),
    "bought.regulator": Slot("boards", "regulator"),
    "bought.sensor": Slot("components", "sensor"),
    "bought.switch": Slot("components", "switch"),
    "bought.plug": Slot("components", "plug"),
    "bought.capacitor": Slot("components", "capacitor"),
    "bought.diode": Slot("components", "diode"),
    "bought.wire": Slot("components", "wire"),
    "bought.spring": Slot("springs", "spring", "springs made to order"),
    "bought.leg": Slot("bars", "leg bar", "printed legs"),
    "cage.rod": Slot("cage_rods", "cage rod", "no cage"),
    "steering.motor": Slot("steering_motors", "motor", ""),
    "steering.gyroscope": Slot("boards", "gyroscope"),
    "bought.axle": Slot("rods", "rod", ""),
    "ground.pad": Slot("pads", "pad"),
    "body.stop_pad": Slot("pads", "pad"),
}
"""By dotted key. That the rest stop needs a pad, and a robot switch and plug, is said elsewhere."""


def _kinds(part: object) -> tuple[str, ...]:
    """Return what a part can be used as, where parts of its table differ in that; empty if that is not known."""
    return (part.kind,) if isinstance(part, Component) else part.uses if isinstance(part, Board) else ()
