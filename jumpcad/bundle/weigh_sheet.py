"""A sheet for the kitchen scale: what each part weighs as computed, and what a gram more of it changes."""

from collections import defaultdict
from dataclasses import replace

from jumpcad.errors import JumpcadError
from jumpcad.files.reading import to_csv
from jumpcad.mechanism.mass import combined
from jumpcad.robot.electronics.leads import metres_by_colour
from jumpcad.robot.robot import Robot
from jumpcad.robot.springs.thing import CHOOSE
from jumpcad.simulation import simulate
from jumpcad.transforms import in_metres

COLUMNS = ("part", "on", "pieces", "computed_g", "weighed_g", "touchdown_mm_per_g", "rise_mm_per_g")
LEAST_KG = 0.5e-3
"""What weighs less together is left out; judgement: half of it changes the touchdown by less than a millimetre."""


def weigh_sheet(robot: Robot) -> str:
    """Return the sheet as CSV: the pieces of a part on one body, and by two jumps the effect of a gram more of them."""
    pieces, others = defaultdict(list), defaultdict[str, float](float)
    for part in robot.parts:
        for place in part.placements:
            pieces[part.name, place.body].append(part.mass.placed(in_metres(place.T_body_part)))
    for item in robot.hardware:
        if item.units:
            pieces[item.article, item.body].append(item.mass)
        else:
            others[item.article] += item.mass_kg  # such as a motor's shaft
    rows, plain, cut = [], _figures(robot), metres_by_colour(robot.layout, robot.wiring)
    for (name, body), masses in pieces.items():
        together = combined(masses)
        if together.mass_kg < LEAST_KG:
            continue
        old, gram = robot.bodies[body], together.scaled_to(1e-3)  # spread as the pieces are
        mass = combined([old, gram])
        heavier = _figures(replace(robot, bodies={**robot.bodies, body: replace(old, **vars(mass))}))
        both = zip(heavier, plain, strict=True) if heavier and plain else ()
        effect = [f"{1000.0 * (more - now):.2f}" for more, now in both] or ["", ""]
        kind, _, colour = name.rpartition(", ")[0].rpartition(", ")
        words = f"{kind}, {colour}, cut {cut[colour]:.2f} m" if colour in cut else name.removesuffix(CHOOSE)
        rows.append((words, body, len(masses), f"{1000.0 * (together.mass_kg + others[name]):.2f}", "", *effect))
    return to_csv([COLUMNS, *rows])


def _figures(robot: Robot) -> tuple[float, float] | None:
    """Return touchdown distance and rise (m), or None where it does not jump."""
    try:
        jump = simulate(robot, engine="planar")
    except JumpcadError:
        return None
    reach, rise = jump.touchdown_distance_m, jump.com_rise_m
    return None if reach is None or rise is None else (reach, rise)
