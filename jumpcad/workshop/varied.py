"""A workshop with some of its values changed, each named by a dotted key such as `body.plate_mm`."""

from collections.abc import Mapping
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.catalogue import load_catalogue
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean, find_template, read_toml, template_names
from jumpcad.files.complaints import shown
from jumpcad.workshop.slots import SLOTS
from jumpcad.workshop.workshop import Workshop

Value = float | str
"""A value that can vary: a number, or a name of the catalogue."""

WORDS = ("name", "source", "surface")
"""Last steps of keys that describe and decide nothing."""


@check_arguments
def workshop_value(workshop: Workshop, key: str) -> Value:
    """Return the value of a key that can vary."""
    known = leaves(workshop.model_dump())
    if key in known and _varies(key, known[key]):
        found: Value = known[key]
        return found
    if key in known or any(one.startswith(f"{key}.") for one in known):
        kind = "a list" if isinstance(known.get(key), tuple) else "no single number or name"
        raise JumpcadError(f"{shown(key)} cannot vary: in the workshop it is {kind}")
    varying = [one for one, value in known.items() if _varies(one, value)]
    hint = did_you_mean(key, varying) or "; a key of the workshop is TABLE.NAME, as in body.plate_mm"
    raise JumpcadError(f"{shown(key)} is neither a parameter of a design nor a key of the workshop{hint}")


@check_arguments
def varied(workshop: Workshop, values: Mapping[str, Value]) -> Workshop:
    """Return a workshop with other values.

    A kit brings all its parts, before other values are set. A material is the workshop's own, or the shipped one of
    that name; materials that no role is left with are dropped. Keys that hold whole numbers take rounded ones.
    """
    data = workshop.model_dump()
    kits = load_catalogue().kits
    if (kit := values.get("bought.kit")) in kits:
        data["bought"] |= kits[str(kit)].model_dump(include=set(data["bought"]))
    for key, value in values.items():
        now, slot = workshop_value(workshop, key), SLOTS.get(key)
        if slot is not None and (reason := slot.misfit(workshop.catalogue, str(value))):
            raise JumpcadError(f"{key} = {shown(value)}: {reason}")
        if key == "bought.kit" and value and value not in kits:
            raise JumpcadError(f"{key} = {shown(value)}: is none of {', '.join(kits)}{did_you_mean(str(value), kits)}")
        *path, last = key.split(".")
        table = data
        for step in path:
            table = table[step]
        table[last] = type(now)(round(value)) if isinstance(now, int) and isinstance(value, float) else value
    held, known = data["materials"], template_names("materials")
    for name in sorted(set(data["roles"].values()) - held.keys()):
        if str(name).lower() not in known:
            raise JumpcadError(f"{shown(name)} is no material of this workshop, nor one of {', '.join(known)}")
        held[name] = read_toml(find_template("materials", str(name).lower()))[0]
    data["materials"] = {name: held[name] for name in sorted(set(data["roles"].values()))}
    return Workshop(**data)


def _varies(key: str, value: Any) -> bool:
    return isinstance(value, int | float | str) and key.split(".")[-1] not in WORDS


def leaves(table: Mapping[str, Any], start: str = "") -> dict[str, Any]:
    """Return what is no table, by dotted key."""
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{start}{name}"
        found |= leaves(value, f"{key}.") if isinstance(value, dict) else {key: value}
    return found
