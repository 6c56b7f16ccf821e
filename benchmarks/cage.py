"""What a cage costs and does: templates and two upright fliers without one, with two hoops, and with a bow besides.

Run `python benchmarks/cage.py [ROBOT …]` from the repository (about half a minute a row); it prints the table of
`docs/decisions/cage.md`. Without an argument it takes all robots.
"""

import sys

import numpy as np

from jumpcad.building import build
from jumpcad.checks import quick_findings
from jumpcad.collision.hulls import least_share_on_feet, share_on_feet
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.landing.landing import land, share_righted
from jumpcad.landing.series import jumps
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop, varied

UPRIGHT = {
    "upright-45": [100.0, 0.9595, 0.7772, 0.8377, 0.8, 70.0, 30.0, 16.808],
    "upright-20": [100.0, 0.9558, 0.8571, 0.8097, 0.8, 70.0, 30.0, 17.644],
}
"""Robots that turn by 45 and 20 degrees in flight without a cage."""
CAGES: dict[str, dict[str, str | bool]] = {
    "–": {},
    "hoops": {"cage.rod": "glass-1.5"},
    "and bow": {"cage.rod": "glass-1.5", "cage.bow": True},
}
DROPS, LANDINGS, JUMPS, SEEDS = 60, 20, 10, 3
HEAD = (
    "| robot | cage | mass | range, rise | pitch at touchdown | stable poses: as computed, least | "
    f"stands of {DROPS} drops | of {LANDINGS} own landings | jumps of {SEEDS} × {JUMPS} |\n"
    f"|---|---|{'--:|' * 7}"
)


def row(name: str, cage: str) -> str:
    """Return the line of one robot with one cage, or why it has none."""
    design = Design.from_vector(UPRIGHT[name]) if name in UPRIGHT else load_design(name)
    try:
        robot = build(design, varied(load_workshop("default"), CAGES[cage]), name)
    except JumpcadError as refusal:
        return f"| {name} | {cage} | {refusal} |"
    jump, broken = simulate(robot), [one.name for one in errors(quick_findings(robot)) if one.name.startswith("cage")]
    drops = share_righted(robot, DROPS, np.random.default_rng(0))
    stood = sum(jumps(robot, JUMPS, seed).stood for seed in range(SEEDS))
    cells = (
        name if name in UPRIGHT else f"`{name}`",
        cage + "".join(f" (`{one}` fails)" for one in broken),
        f"{1000.0 * robot.mass_kg:.1f} g",
        f"{1000.0 * (jump.ballistic_range_m or 0.0):.0f}, {1000.0 * (jump.com_rise_m or 0.0):.0f} mm",
        f"{jump.touchdown_pitch_deg:.0f}°".replace("-", "−"),
        f"{share_on_feet(robot):.2f}, {least_share_on_feet(robot):.2f}",
        f"{DROPS * drops:.0f}",
        f"{LANDINGS * land(robot, LANDINGS, 0).share_righted:.0f}",
        f"{stood}",
    )
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Print the table."""
    print(HEAD, flush=True)
    for name in sys.argv[1:] or [*UPRIGHT, *template_names("robots")]:
        for cage in CAGES:
            print(row(name, cage), flush=True)


if __name__ == "__main__":
    main()
