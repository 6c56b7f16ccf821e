"""Reading workshop files: what they build on, the shipped printers and materials, and own parts like shipped ones."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.catalogue import Article, load_catalogue
from jumpcad.design import DEFAULT
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean, find_template, read_toml, template_names
from jumpcad.files.complaints import Origin, place, shown
from jumpcad.files.records import NAME, NAME_RULE, composed
from jumpcad.workshop.tables import Roles
from jumpcad.workshop.workshop import OWN_PARTS, Workshop

MOST_BASES = 20
"""Files of a workshop that may build on each other."""
TELLS = {
    "motors": ("article", ("ratio", "voltage_v", "width_mm", "height_mm", "body_length_mm", "shaft_mm",
                           "shaft_flat_mm", "shaft_length_mm")),
    "batteries": ("description", ("voltage_v", "capacity_mah", "length_mm", "width_mm", "height_mm")),
    "boards": ("description", ("length_mm", "width_mm", "height_mm")),
}  # fmt: skip
"""What is ordered for a part, and figures that it stands for: with others it is not that article."""
STALE = {
    "motors": (("no_load_rpm", "stall_current_a"), ("ratio", "no_load_current_a", "stall_torque_nm", "article")),
    "springs": (("outer_diameter_mm",), ("inside_diameter_mm", "rate_nmm_per_deg", "left_hand", "right_hand")),
}
"""Figures that, given beside `like`, make some of the shipped part's stale: these follow where they are not given."""


@check_arguments
def load_workshop(
    name_or_path: str | Path = DEFAULT, printer: str | None = None, material: str | None = None
) -> Workshop:
    """Return the workshop of a template (`default`) or of a TOML file, with everything that it builds on.

    Parameters
    ----------
    name_or_path
        The workshop.
    printer
        Another printer: a shipped one's name or a TOML file.
    material
        One material for every role: a shipped one's name, or one of the workshop's.

    Raises
    ------
    JumpcadError
        If a file is missing, or a key is unknown, out of range, or contradicts another.
    """
    for kind, word in (("printers", "printer"), ("materials", "material")):
        if (name := str(name_or_path)).lower() in template_names(kind):
            raise JumpcadError(f"{name} is a {word}, not a workshop: say --{word} {name}, alone or with a workshop")
    path = find_template("workshops", name_or_path)
    data, origins = _assembled(path, ())
    if printer is not None:
        origins.insert(0, _printer(printer))
        data |= origins[0].data
    if material is not None:
        known = data.get("materials")
        name = material.upper() if material.lower() in template_names("materials") else material
        own = known.get(name) if isinstance(known, dict) else None
        data["roles"] = dict.fromkeys(Roles.model_fields, name)
        data["materials"] = {name: _material(path, name, own)}
    return Workshop.from_data(data, str(path), origins=origins)


def _printer(name_or_path: str) -> Origin:
    file = find_template("printers", name_or_path)
    data, text = read_toml(file)
    return Origin(str(file), text, {"printer": data}, "printer")


def _assembled(path: Path, above: tuple[str, ...]) -> tuple[dict[str, Any], list[Origin]]:
    """Return the data of a workshop file on top of its base, and the files that they are of."""
    if len(above) > MOST_BASES:
        raise JumpcadError(f"{above[0]}: more than {MOST_BASES} workshops build on each other; join some of them")
    data, text = read_toml(path)
    whole: dict[str, Any] = {}
    origins: list[Origin] = []
    if "base" in data or path != find_template("workshops", DEFAULT):
        base = data.pop("base", DEFAULT)
        if not isinstance(base, str):
            raise JumpcadError(f"{path}: base = {shown(base)}: must be the name of a workshop or a path")
        beside = path.parent / base
        base_path = beside if base.endswith(".toml") and os.path.isfile(beside) else find_template("workshops", base)
        real = os.path.realpath(path)  # unlike Path.resolve, also of links that lead round in a circle
        if os.path.exists(base_path) and os.path.realpath(base_path) in (real, *above):
            raise JumpcadError(f"{path}: base = {shown(base)}: leads back to a file that builds on it")
        whole, origins = _assembled(base_path, (*above, real))
    if isinstance(data.get("printer"), str):
        origins.insert(0, _printer(data.pop("printer")))
        whole |= origins[0].data
    data = composed(data)  # after the paths, which are as they are written
    origins.insert(0, Origin(str(path), text, data))
    data |= {
        kind: _completed(kind, data[kind], str(path), text) for kind in OWN_PARTS if isinstance(data.get(kind), dict)
    }
    if isinstance(data.get("bought"), dict) and data["bought"].get("kit"):
        kits, name = load_catalogue().kits, data["bought"]["kit"]
        if not isinstance(name, str) or name not in kits:
            hint = did_you_mean(name, kits) if isinstance(name, str) else ""
            where = place(str(path), text, "bought.kit")
            raise JumpcadError(f"{where}: bought.kit = {shown(name)}: is none of the kits {', '.join(kits)}{hint}")
        data["bought"] = kits[name].model_dump() | data["bought"]
    own = set(data["materials"]) if isinstance(data.get("materials"), dict) else set()
    whole = _merged(whole, data)
    if isinstance(whole.get("roles"), dict) and isinstance(whole.setdefault("materials", {}), dict):
        used = [name for name in whole["roles"].values() if isinstance(name, str)]
        if wrong := [name for name in sorted({*own, *used}) if not NAME.fullmatch(name)]:
            raise JumpcadError(f"{path}: {shown(wrong[0])} cannot be the name of a material: {NAME_RULE}")
        if unused := sorted(own - set(used)):
            raise JumpcadError(
                f"{path}: materials.{unused[0]}: no role uses it; the roles use {', '.join(sorted(set(used)))}"
                f"{did_you_mean(unused[0], used)}"
            )
        whole["materials"] = {name: _material(path, name, whole["materials"].get(name)) for name in sorted(set(used))}
    return whole, origins


def _material(path: Path, name: str, own: Any) -> Any:
    """Return the data of a material: the shipped one, if there is one of that name, under the file's own figures."""
    known = template_names("materials")
    if name.lower() in known:
        shipped = read_toml(find_template("materials", name.lower()))[0]
        return _merged(shipped, own) if isinstance(own, dict) else shipped if own is None else own
    if own is None:
        raise JumpcadError(
            f"{path}: roles: {name!r} is neither a table under [materials] nor one of {', '.join(known)}"
            f"{did_you_mean(name.lower(), known)}"
        )
    return own


def _completed(kind: str, tables: dict[str, Any], source: str, text: str) -> dict[str, Any]:
    """Return own parts in which `like` has been replaced by the figures of the shipped part that it names."""
    shipped: Mapping[str, Article] = getattr(load_catalogue(), "steering_motors" if kind == "motors" else kind, {})
    completed = {}
    for name, table in tables.items():
        if isinstance(table, dict) and "like" in table and NAME.fullmatch(name):
            like, key = table["like"], f"{kind}.{name}.like"
            if not isinstance(like, str) or like not in shipped:
                known = ", ".join(shipped) or "there are none"
                hint = did_you_mean(like, shipped) if isinstance(like, str) else ""
                where = place(source, text, key)
                raise JumpcadError(f"{where}: {key} = {shown(like)}: is no shipped part of this kind ({known}){hint}")
            figures = shipped[like].model_dump(exclude={"source"})
            own = {key: value for key, value in table.items() if key != "like"}
            table = figures | _renamed(kind, name, figures, own) | own
            given, stale = STALE.get(kind, ((), ()))
            if given and own.keys() >= set(given):
                table = {key: value for key, value in table.items() if key in own or key not in stale}
        completed[name] = table
    return completed


def _renamed(kind: str, name: str, figures: dict[str, Any], own: dict[str, Any]) -> dict[str, str]:
    """Return what is ordered for an own part in place of the shipped one's article, where its figures are others."""
    key, tells = TELLS.get(kind, ("", ()))
    if all(own.get(one, figures[one]) == figures[one] for one in tells):
        return {}
    if kind == "motors":
        return {key: ""}
    sizes = [shown(own.get(one, figures[one])).removesuffix(".0") for one in ("length_mm", "width_mm", "height_mm")]
    return {key: f"{name}, at most {' x '.join(sizes)} mm"}


def _merged(base: dict[str, Any], over: dict[str, Any]) -> dict[str, Any]:
    """Return nested data with the values of `over` in place of those of `base`."""
    merged = dict(base)
    for key, value in over.items():
        both = isinstance(value, dict) and isinstance(merged.get(key), dict)
        merged[key] = _merged(merged[key], value) if both else value
    return merged
