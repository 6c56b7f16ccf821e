"""The designs that a study's page shows: points in a chart of score against a cost, side views, figures, command.

A side view shows links as the lines between their joints, from the eight numbers alone. Both poses stand on the same
flat foot.
"""

import cmath
import shlex
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from scipy.spatial.distance import pdist, squareform

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import FIGURES
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.planar import points
from jumpcad.search.fronts import Cost, energy_j, front
from jumpcad.search.models import PUBLISHED_FIGURES
from jumpcad.search.report.drawings import MOST_DOTS, Axes, evenly, scale
from jumpcad.search.report.figures import figure_words, value_words, with_unit
from jumpcad.search.study.trial import Trial

HEADLINES = ("touchdown_distance_m", "ballistic_range_m", "com_rise_m", "mass_kg", "winding_time_s")
"""Figures that are shown at once; the others open on a click."""
RADIUS, LEAST_RADIUS = 6.0, 3.5
"""Of a point, and of one that has others near it."""
LINKS = {
    "toes": ("toe tip", "ankle"),
    "foot": ("ankle", "front eye"),
    "front link": ("front eye", "front pivot"),
    "main leg": ("ankle", "back pivot"),
    "body": ("back pivot", "front pivot"),
}
POSES = {"loaded": "springs loaded", "rest": "at rest"}
"""Poses in the order in which they are drawn, and their labels."""
EDGE_MM = 12.0

Box = tuple[float, float, float, float]
"""Lowest x and z, highest x and z (mm)."""


def chart(
    trials: Sequence[Trial], shown: Sequence[Trial], numbers: Sequence[int], cost: Cost, is_front: bool, file: str
) -> dict[str, Any]:
    """Return the axes of a chart, the paths of other designs and of a front's line, and the shown designs.

    The score is drawn against a cost; trials that do not jump are left out. The shown designs have `numbers` as trials
    of the study, and a command for its file.
    """
    feasible = [trial for trial in trials if trial.score is not None and np.isfinite(cost.of(trial))]

    def place(trial: Trial) -> tuple[float, float]:
        return cost.shown(cost.of(trial)), trial.score or 0.0

    x_values, y_values = zip(*map(place, [*feasible, *shown]), strict=True)
    axes = Axes(scale(list(x_values)), scale(list(y_values)))
    places = np.array([(axes.x(x), axes.y(y)) for x, y in map(place, shown)])
    apart = squareform(pdist(places)) + np.diag(np.full(len(places), np.inf))
    radii = np.clip(0.5 * apart.min(axis=0), LEAST_RADIUS, RADIUS).tolist()  # half way to the nearest neighbour
    points = zip(shown, numbers, map(tuple, places.tolist()), radii, strict=True)
    return {
        "axes": axes,
        "others": axes.dots(place(feasible[index]) for index in evenly(len(feasible), MOST_DOTS)),
        "line": axes.steps([place(trial) for trial in front(feasible, cost)]) if is_front else "",
        "shown": [
            shown_design(trial, of_study, file)
            | {"number": number, "cost": place(trial)[0], "place": at, "radius": radius}
            for number, (trial, of_study, at, radius) in enumerate(points, start=1)
        ],
    }


def shown_design(trial: Trial, of_study: int, file: str) -> dict[str, Any]:
    """Return score, joints in both poses or why there are none, figures with labels, and command of a design."""
    try:
        poses, impossible = joints_mm(trial.design), ""
    except CannotBuildError as error:
        poses, impossible = {}, str(error)
    first, others = _lines(trial)
    command = f"jumpcad studio {shlex.quote(file)} --trial {of_study}"
    return {"of_study": of_study, "score": trial.score, "poses": poses, "impossible": impossible, "first": first,
            "others": others, "command": command}  # fmt: skip


def _lines(trial: Trial) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Return label and value of what is shown at once, and of the other figures."""
    design, metrics = trial.design, trial.evaluation.metrics
    values = design.model_dump() | dict(trial.workshop)
    first = [(name, with_unit(value_words(value, 5), name)) for name, value in values.items()]
    lengths = design.links_mm
    first.append(("main leg, front link, foot, toe", ", ".join(f"{length:.1f}" for length in lengths) + " mm"))
    first.append(figure_words("spring_energy_j", metrics.get("spring_energy_j", energy_j(design))))
    first += [figure_words(name, metrics[name]) for name in HEADLINES if name in metrics]
    named = {*FIGURES, *PUBLISHED_FIGURES} - {"spring_energy_j", *HEADLINES}  # others are those of estimates
    return first, [figure_words(name, figure) for name, figure in metrics.items() if name in named]


def joints_mm(design: Design) -> dict[str, dict[str, tuple[float, float]]]:
    """Return the joints of each pose, with the foot flat, in mm: x forward from the ankle, z up from the ground.

    Toes spread sideways, so that from the side they look shorter.
    """
    found, linkage = {}, Linkage(design)
    for name, leg_rad in zip(POSES, (-design.compression_rad, 0.0), strict=True):
        pose = linkage.pose([leg_rad])
        turn = cmath.exp(1j * float(pose.foot_rad[0]))
        ankle, eye = (complex(points(joint)[0]) for joint in (pose.ankle_mm, pose.front_eye_mm))
        back, front = (complex(points(joint)) for joint in (linkage.back_pivot_mm, linkage.front_pivot_mm))
        at = {"toe tip": complex(float(toe_tip_mm(design)[0]), 0.0), "ankle": 0j}
        others = {"front eye": eye, "front pivot": front, "back pivot": back}
        at |= {joint: (place - ankle) * turn for joint, place in others.items()}
        places = np.round([(point.real, point.imag) for point in at.values()], 1) + 0.0
        found[name] = dict(zip(at, map(tuple, places.tolist()), strict=True))
    return found


def box_mm(designs: Iterable[Design]) -> Box:
    """Return the common bounding box of designs in both poses, so that they are drawn to one scale."""
    corners = [(0.0, 0.0)]
    for design in designs:
        try:
            corners += [place for pose in joints_mm(design).values() for place in pose.values()]
        except CannotBuildError:
            continue
    every = np.array(corners)
    low, high = every.min(axis=0) - EDGE_MM, every.max(axis=0) + EDGE_MM
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
