"""Words for a study's page: units of parameters, what figures are called, and what each reason of a refusal means."""

import tomllib
from functools import cache

from jumpcad.design import Design
from jumpcad.dimensions import KEY_UNITS, unit_of_key
from jumpcad.evaluation import FIGURES
from jumpcad.files.templates import templates_folder
from jumpcad.workshop.varied import Value

SHOWN_AS = {"kg": ("g", 1000.0), "m": ("mm", 1000.0), "J": ("mJ", 1000.0)}
"""Units in which figures are shown in place of others, and the factor."""


def unit_of(parameter: str) -> str:
    """Return the unit of a parameter by the end of its name; of one of the design without any, `ratio`."""
    return unit_of_key(parameter) or ("ratio" if parameter in Design.model_fields else "")


def with_unit(text: str, parameter: str) -> str:
    """Return values of a parameter with its unit; ratios have none."""
    unit = unit_of(parameter)
    return text if unit in ("", "ratio") else f"{text}{unit}" if unit == "°" else f"{text} {unit}"


def named(parameter: str) -> str:
    """Return a parameter's name with its unit, for a heading or an axis."""
    unit = unit_of(parameter)
    return f"{parameter} ({unit})" if unit else parameter


def meaning_of(parameter: str) -> str:
    """Return what a parameter of the design is; empty for a value of the workshop."""
    field = Design.model_fields.get(parameter)
    return field.description or "" if field else ""


@cache
def reasons() -> dict[str, str]:
    """Return what each reason of a refusal means; names that begin with one of these mean the same."""
    return tomllib.loads((templates_folder() / "report/reasons.toml").read_text(encoding="utf-8"))


def reason_words(reason: str) -> str:
    """Return what a reason of a refusal means; empty if it is not known."""
    names = [name for name in reasons() if reason == name or reason.startswith(f"{name}_")]
    return reasons()[max(names, key=len)] if names else ""


def figure_words(name: str, value: float) -> tuple[str, str]:
    """Return label and value, with its unit, of a figure of an evaluation."""
    end = next((end for end in KEY_UNITS if name.endswith(f"_{end}")), "")
    unit, factor = SHOWN_AS.get(KEY_UNITS.get(end, ""), (KEY_UNITS.get(end, ""), 1.0))
    label = FIGURES.get(name, name.removesuffix(f"_{end}").replace("_", " "))
    return label, f"{factor * value:.4g}{'' if unit == '°' else ' '}{unit}".strip()


def value_words(value: Value, digits: int = 6) -> str:
    """Return a parameter's value: a name, or a number with so many digits."""
    return value if isinstance(value, str) else f"{value:.{digits}g}"
