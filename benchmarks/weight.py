"""What the workshop's choices for less weight do: mass, range and rise of two templates, or the findings that stop one.

Run `python benchmarks/weight.py` from the repository; it prints the tables of `docs/decisions/weight.md`: findings
have the share of their limit that is used.
"""

from typing import Any

from jumpcad.building import build
from jumpcad.checks import check
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import errors
from jumpcad.simulation import simulate
from jumpcad.workshop import Workshop, load_workshop

TEMPLATES = ("kenan-2.0", "best-printable")
CHOICES: dict[str, dict[str, Any]] = {
    "default: spring steel 3 mm in the plates, printed legs": {},
    "axle_mm = 2": {"axle_mm": 2.0},
    'axle = "aluminium-7075"': {"axle": "aluminium-7075"},
    'axle = "steel-tube" (hollow)': {"axle": "steel-tube"},
    'axle = "silver-steel", retention = "clips"': {"axle": "silver-steel", "retention": "clips"},
    'axle = "aluminium-7075", retention = "clips"': {"axle": "aluminium-7075", "retention": "clips"},
    'retention = "nuts" (screws as axles)': {"retention": "nuts"},
    'leg = "carbon-tube-4x2"': {"leg": "carbon-tube-4x2"},
    'leg = "carbon-tube-4x3"': {"leg": "carbon-tube-4x3"},
    'leg = "carbon-tube-6x4"': {"leg": "carbon-tube-6x4"},
    'leg = "carbon-strip-2x6"': {"leg": "carbon-strip-2x6"},
    'leg = "carbon-strip-3x6"': {"leg": "carbon-strip-3x6"},
}


def row(template: str, bought: dict[str, Any]) -> str:
    """Return the cells of one choice: mass, range and rise, and what stops it."""
    shop = load_workshop()
    shop = Workshop(**(shop.model_dump() | {"bought": shop.bought.model_dump() | bought}))
    try:
        robot = build(load_design(template), shop, template)
    except JumpcadError as refusal:
        return f"– | – | – | {refusal}"
    found, jump = errors(check(robot)), simulate(robot)
    wrong = ", ".join(f"`{one.name}` {100.0 * (one.use or 0.0):.0f} %" for one in found) or "builds"
    return (
        f"{1000.0 * robot.mass_kg:.1f} | {1000.0 * (jump.ballistic_range_m or 0.0):.0f} | "
        f"{1000.0 * (jump.com_rise_m or 0.0):.0f} | {wrong}"
    )


def main() -> None:
    """Print a table for every template."""
    for template in TEMPLATES:
        print(f"\n## {template}\n\n| `[bought]` | mass (g) | range (mm) | rise (mm) | |\n|---|---|---|---|---|")
        for name, bought in CHOICES.items():
            print(f"| {name} | {row(template, bought)} |", flush=True)


if __name__ == "__main__":
    main()
