"""Design and workshop files with a comment on every value."""

import re
from collections.abc import Mapping
from typing import Any

import jumpcad
from jumpcad.cli.output import shell_quoted
from jumpcad.files import find_template, read_toml, template_names, to_toml

LINE = re.compile(r"(?P<key>\w+)(?P<equals> = )(?P<value>.*?)(?P<comment>\s+#.*)?")


def commented_design(design: "jumpcad.Design", origin: str, file: str) -> str:
    """Return the TOML document of a design with unit, searched range and effect of every number."""
    from jumpcad.design import PARAMETERS, PRINTED_BOUNDS
    from jumpcad.files.templates import fill

    numbers = dict(zip(PARAMETERS, design.to_vector(), strict=True))
    values = {"origin": origin, "file": shell_quoted(file), "numbers": numbers, "bounds": PRINTED_BOUNDS}
    return fill("texts/design.toml.j2", values)


def commented_workshop(workshop: "jumpcad.Workshop", origin: str) -> str:
    """Return the TOML document of a workshop: the default workshop's file, comments included, with other values."""
    from jumpcad.catalogue import load_catalogue

    shipped, text = read_toml(find_template("workshops", "default"))
    data, printer = workshop.model_dump(mode="json", exclude_none=True), printer_name(workshop)
    changes = {}
    for table in re.findall(r"^\[([\w.]+)\]", text, re.MULTILINE):
        values, there = _at(data, table), _at(shipped, table)
        if table == "bought" and values["kit"]:  # without what is the kit's
            kit = load_catalogue().kits[values["kit"]].model_dump(mode="json")
            values = {key: value for key, value in values.items() if key not in kit or value != kit[key]}
        changes[table] = {
            key: value for key, value in values.items()
            if not isinstance(value, dict) and (key not in there or there[key] != value)
        }  # fmt: skip
    lines = [
        f"# A workshop, copied from {origin}: printer, fits, bought parts, limits. Use it with --workshop FILE.toml.",
        '# Figures marked "practice" or "judgement" are to be replaced by what you measure (jumpcad coupon).',
        *([f'printer = "{printer}"'] if printer else []),
        changed_toml(text.split('printer = "mk4"\n', 1)[1], changes).rstrip("\n"),
    ]
    others = ({} if printer else {"printer": data["printer"]}) | _others(data)
    return "\n".join(lines) + "\n" + ("\n" + to_toml(others) if others else "")


def changed_toml(text: str, changes: Mapping[str, Mapping[str, Any]]) -> str:
    """Return a TOML document with other values in its tables, by the tables' names, everything else as it was.

    Keys and tables that it does not have are added.
    """
    left = {table: dict(values) for table, values in changes.items()}
    lines: list[str] = []
    table = ""

    def added() -> list[str]:
        return [_written(key, value) for key, value in left.pop(table, {}).items()]

    for line in text.splitlines():
        if head := re.match(r"\s*\[([^\[\]]+)\]", line):
            blank = [lines.pop() for _ in range(len(lines)) if lines and not lines[-1].strip()]
            lines += [*added(), *blank]
            table = head[1].strip()
        found = LINE.fullmatch(line.strip())
        if found and found["key"] in left.get(table, {}):
            line = _written(found["key"], left[table].pop(found["key"])) + (found["comment"] or "")
        lines.append(line)
    lines += added()
    for table in list(left):
        lines += ["", f"[{table}]", *added()]
    return "\n".join(lines) + "\n"


def printer_name(workshop: "jumpcad.Workshop") -> str:
    """Return the name of a workshop's printer; empty if it is not shipped."""
    from jumpcad.workshop import Printer

    for name in template_names("printers"):
        if Printer(**read_toml(find_template("printers", name))[0]) == workshop.printer:
            return name
    return ""


def _others(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables that the default workshop does not have: pins, changed materials, the user's own parts."""
    from jumpcad.workshop import OWN_PARTS

    found: dict[str, Any] = {"bought": {"pins": data["bought"]["pins"]}} if data["bought"]["pins"] else {}
    for name, material in data["materials"].items():
        shipped = {}
        if name.lower() in template_names("materials"):
            shipped = read_toml(find_template("materials", name.lower()))[0]
        if own := {key: value for key, value in material.items() if shipped.get(key) != value}:
            found.setdefault("materials", {})[name] = own
    return found | {kind: data[kind] for kind in OWN_PARTS if data[kind]}


def _at(data: Mapping[str, Any], path: str) -> Mapping[str, Any]:
    for key in path.split("."):
        data = data[key]
    return data


def _written(key: str, value: Any) -> str:
    """Return a key and its value as TOML, on one line."""
    text = to_toml({key: value}).strip()
    return text.replace("[\n    ", "[").replace(",\n]", "]").replace(",\n    ", ", ")
