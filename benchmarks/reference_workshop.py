"""The page of all keys of a workshop."""

import json
import re
from typing import Any

from reference_page import page, table

from jumpcad.dimensions import unit_of_key
from jumpcad.files import find_template
from jumpcad.workshop import OWN_PARTS, Workshop, load_workshop


def workshop_keys() -> str:
    """Return the page of every key of a workshop: unit, limits, default, and the source that the default has."""
    schema, default = Workshop.model_json_schema(), load_workshop("default").model_dump()
    comments = _comments(find_template("workshops", "default").read_text(encoding="utf-8"))
    blocks = []
    for name, entry in schema["properties"].items():
        kind = _definition(schema, entry)
        if name in OWN_PARTS:
            blocks.append(_own_part(name, kind))
        elif name == "materials":
            for material, values in default[name].items():
                text = find_template("materials", material.lower()).read_text(encoding="utf-8")
                blocks.append(_section(f"materials.{material}", kind, values, _comments(text)))
        elif name == "printer":
            blocks.append(_section(name, kind, default[name], {}))
        elif "properties" in kind:
            own = {key: comment for (section, key), comment in comments.items() if section == name}
            blocks.append(_section(name, kind, default[name], {("", key): text for key, text in own.items()}))
        else:
            blocks.append(f"## [{name}]\n\nThe beginning of an article's name, and the price of one piece (EUR).")
    words = (
        "Every key, what it may be, its value in the workshop `default`, and where that value comes from. "
        "How workshops are written: [Workshop](../workshop.md)."
    )
    return page("Workshop keys", words, *blocks)


def _definition(schema: dict[str, Any], entry: dict[str, Any]) -> dict[str, Any]:
    """Return the table that an entry refers to, itself or in a mapping."""
    for place in (entry, entry.get("additionalProperties", {})):
        if isinstance(place, dict) and "$ref" in place:
            return dict(schema["$defs"][place["$ref"].rsplit("/", 1)[1]])
    return entry


def _section(name: str, kind: dict[str, Any], values: dict[str, Any], comments: dict[tuple[str, str], str]) -> str:
    rows = [
        (f"`{key}`", unit_of_key(key), _allowed(entry), _value(values.get(key)), comments.get(("", key), ""))
        for key, entry in kind["properties"].items()
    ]
    head = ("key", "unit", "allowed", "default", "meaning or source")
    return f"## [{name}]\n\n{_description(kind)}\n\n{table(head, rows)}"


def _own_part(name: str, kind: dict[str, Any]) -> str:
    required = set(kind.get("required", ()))
    rows = [
        (f"`{key}`", unit_of_key(key), _allowed(entry), "yes" if key in required else "")
        for key, entry in kind["properties"].items()
        if key != "name"
    ]
    return f"## [{name}.NAME]\n\n{_description(kind)}\n\n{table(('key', 'unit', 'allowed', 'required'), rows)}"


def _description(kind: dict[str, Any]) -> str:
    return "\n".join(line.strip() for line in kind.get("description", "").splitlines())


def _allowed(entry: dict[str, Any]) -> str:
    if "anyOf" in entry:
        return " or ".join(dict.fromkeys(_allowed(one) for one in entry["anyOf"] if one.get("type") != "null"))
    if values := entry.get("enum") or ([entry["const"]] if "const" in entry else []):
        return ", ".join(f"`{value}`" for value in values)
    if "prefixItems" in entry:
        return f"{len(entry['prefixItems'])} numbers, each {_allowed(entry['prefixItems'][0])}"
    if "minimum" in entry or "maximum" in entry:
        whole = "whole, " if entry.get("type") == "integer" else ""
        return f"{whole}{entry['minimum']:g} to {entry['maximum']:g}"
    return {"string": "text", "array": "list of names", "object": "table"}.get(entry.get("type", ""), "")


def _value(value: Any) -> str:
    if value is None or value == {}:
        return ""
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def _comments(text: str) -> dict[tuple[str, str], str]:
    """Return the comments of a TOML file's keys, by section and key."""
    found: dict[tuple[str, str], str] = {}
    section, last = "", None
    for line in text.splitlines():
        if heading := re.match(r"\[([\w.]+)\]", line):
            section, last = heading[1], None
        elif entry := re.match(r"(\w+)\s*=\s*(?:\"[^\"]*\"|[^#\"])*(?:#\s*(.*))?$", line):
            last = (section, entry[1])
            found[last] = entry[2] or ""
        elif last and (more := re.match(r"\s+#\s*(.*)", line)):
            found[last] += f" {more[1]}"
    return found
