"""Uncertainty of one jump, from calibration, print tolerance, springs, mass and floor, and the sensitivity to each.

Each of these is a group of inputs, independent of the others. The first-order index of a group is the share of the
variance that it explains alone: Var(E[y | group]) / Var(y). E[y | group] is the group's part of an additive cubic
polynomial that is fitted to all jumps (ANOVA by regression; Rabitz and Alis 1999), which needs far fewer jumps than
Saltelli's scheme; the rest of the variance is due to interactions of groups.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.special import ndtri

from jumpcad.arguments import check_arguments
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.mechanism.model import BODY, Mechanism
from jumpcad.mechanism.variants import with_length_errors, with_lengths, with_spring_factor
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation import prior as priors
from jumpcad.simulation.planar import touchdown
from jumpcad.simulation.simulator import divided, simulate
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import Array, ByValue

SAMPLES = 256
"""Jumps, a power of two."""
AS_MADE = 64
"""Jumps of the planar engine for the median that stands beside a headline, a quarter of a second: that of the templates
is within 1 % of the median of 256."""
DEGREE, RESAMPLES = 3, 100
"""Degree of the polynomial; bootstrap resamples."""
FIGURES = {"touchdown_distance_m": "touchdown", "com_rise_m": "rise"}
"""Figures of a jump whose uncertainty is computed, and their names in texts."""
ROBUST_TOUCHDOWN, ROBUST_PITCH = "robust_touchdown_m", "robust_pitch_deg"
"""Figures of `robust_figures`."""
ROBUST_JUMPS, LENGTH_SHARE, CENTRE_M = 16, 0.01, 0.002
"""Jumps, a power of two; largest error of each link's length, as a share, and of the body's centre of mass; judgement.

The second lowest of 16 is the tenth percentile. These errors are wider than one workshop's: others copy a robot.
"""
FALLEN = 0.0, 180.0
"""Touchdown (m) and pitch (°) of a robot that does not jump."""
INPUTS = 8
"""Uniform variables of all groups together, where the settings have draws."""
EDGE, TINY = 1e-9, 1e-30
"""Least distance of a sample from 0 and 1; least variance that is divided by."""


@dataclass(frozen=True, eq=False)
class Uncertainty(ByValue):
    """Quantiles (10, 50, 90 %) of touchdown and rise over `jumps` simulated jumps, and what they depend on.

    `first_order` has, by group and figure, the share of the variance that the group explains, `interval` its 80 %
    bootstrap interval. A sample that does not jump counts as 0; `jumps_share` is the share of those that do.
    `calibrated` tells whether the settings had draws of a calibration.
    """

    quantiles: dict[str, list[float]]
    first_order: dict[str, dict[str, float]]
    interval: dict[str, dict[str, list[float]]]
    jumps: int
    jumps_share: float
    calibrated: bool

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return dict(vars(self))


@check_arguments
def uncertain_jump(robot: Robot, settings: Settings, engine: str, seed: int = 0, samples: int = SAMPLES) -> Uncertainty:
    """Return the uncertainty of a printed robot's jump over `samples` jumps, a power of two.

    The robot's workshop has the tolerance of lengths and the scatter of spring rates. Without draws of a calibration in
    the settings, its priors are used, about the efficiency of springs and the friction of pins and floor that they
    give.
    """
    points = priors.sobol(INPUTS + (not settings.draws), samples, np.random.default_rng(seed))
    inputs = varied_inputs(robot, settings, np.clip(points, EDGE, 1.0 - EDGE))
    rows = ({name: values[row] for name, values in inputs.items()} for row in range(samples))
    figures = np.array([_jump(robot, settings, engine, values) for values in rows])
    generator = np.random.default_rng([seed, 1])
    again = [_first_order(inputs, figures, generator.integers(0, samples, samples)) for _ in range(RESAMPLES)]
    low, high = np.quantile(np.array(again), (0.1, 0.9), axis=0)
    shares = _first_order(inputs, figures, np.arange(samples))
    return Uncertainty(
        {name: np.quantile(figures[:, k], priors.QUANTILES).tolist() for k, name in enumerate(FIGURES)},
        {name: dict(zip(FIGURES, shares[g].tolist(), strict=True)) for g, name in enumerate(inputs)},
        {
            name: {figure: [float(low[g, k]), float(high[g, k])] for k, figure in enumerate(FIGURES)}
            for g, name in enumerate(inputs)
        },
        samples,
        float((figures[:, 0] > 0.0).mean()),
        bool(settings.draws),
    )


def uncertainty_of(robot: Robot, settings: Settings | None = None) -> Uncertainty | None:
    """Return the uncertainty of a robot's jump by the planar engine; None where it cannot simulate that.

    What pages and commands tell of a robot as it may be made comes from here, so that they tell the same.
    """
    if settings is None:
        return _as_made(robot)
    try:
        return uncertain_jump(robot, settings, "planar", samples=AS_MADE)
    except JumpcadError:
        return None


@decided_once
def _as_made(robot: Robot) -> Uncertainty | None:
    return uncertainty_of(robot, Settings())


def robust_figures(robot: Mechanism, settings: Settings, rate_scatter: float) -> dict[str, float]:
    """Return the touchdown that nine of ten robots as made reach, and the worst of their pitches, by the planar engine.

    The robots differ evenly: links by `LENGTH_SHARE`, the body's centre of mass along and across by `CENTRE_M`, springs
    by `rate_scatter` (two standard deviations), the floor from the slipperiest to the roughest of `floors`, unless the
    settings say what it is. All designs are compared on the same differences. What does not jump counts as `FALLEN`.
    Friction in the pins stays; air, restitution and rolling friction are left out.
    """
    settings, usual = divided(robot, settings), coefficients(robot, settings)
    pins_nm = pin_torque_nm(with_spring_factor(robot, settings.spring_efficiency), usual.pin)
    design = robot.design
    errors_mm = LENGTH_SHARE * np.array(design.links_mm)

    def landed(point: Array) -> tuple[float, float]:
        made = with_spring_factor(robot, 1.0 + rate_scatter * float(point[6]))
        given = (
            {}
            if settings.ground_friction is not None
            else {"ground_friction": usual.ground * math.exp(2.0 * priors.FLOOR_SHARE * point[7])}
        )
        try:
            made = with_lengths(made, with_length_errors(design, errors_mm * point[:4]))
        except CannotBuildError:
            return FALLEN
        body = made.bodies[BODY]
        body = replace(body, com_m=body.com_m + CENTRE_M * np.array([point[4], 0.0, point[5]]))
        made = replace(made, bodies={**made.bodies, BODY: body})
        return touchdown(made, settings.model_copy(update=given), pins_nm) or FALLEN

    ways, pitches = np.array([landed(point) for point in _differences()]).T
    return {
        ROBUST_TOUCHDOWN: float(np.quantile(ways, priors.QUANTILES[0], method="lower")),
        ROBUST_PITCH: float(np.abs(pitches).max()),
    }


@cache
def _differences() -> Array:
    """Return even points (ROBUST_JUMPS, 8) of the cube from -1 to 1."""
    return 2.0 * priors.sobol(8, ROBUST_JUMPS, np.random.default_rng(0)) - 1.0


def _first_order(inputs: dict[str, Array], figures: Array, rows: npt.NDArray[np.intp]) -> Array:
    """Return the first-order indices (groups, figures) from some rows of the sample."""
    blocks = []
    for values in inputs.values():
        chosen = values[rows]
        deviation = chosen.std(axis=0)
        unit = (chosen - chosen.mean(axis=0)) / np.where(deviation > 0.0, deviation, 1.0)
        block = np.concatenate([unit**power for power in range(1, DEGREE + 1)], axis=1)
        blocks.append(block - block.mean(axis=0))
    results = figures[rows] - figures[rows].mean(axis=0)
    fitted = np.linalg.lstsq(np.concatenate(blocks, axis=1), results, rcond=None)[0]
    variance, shares, start = np.maximum((results**2).mean(axis=0), TINY), [], 0
    for block in blocks:
        part = np.einsum("ij,jk->ik", block, fitted[start : start + block.shape[1]])
        shares.append((part**2).mean(axis=0) / variance)
        start += block.shape[1]
    return np.array(shares)


def varied_inputs(robot: Robot, settings: Settings, points: Array) -> dict[str, Array]:
    """Return the values (n, k) of each group of inputs at points (n, INPUTS) of the unit cube, one more without draws.

    Draws of a calibration are pairs: one coordinate chooses among them.
    """
    workshop, rubs, draws = robot.workshop, coefficients(robot, settings), settings.draws
    *first, springs, mass, floor = points.T
    if draws:
        pairs = np.column_stack([draws.spring_efficiency, draws.pin_friction])
        calibrated = pairs[np.minimum((first[0] * len(pairs)).astype(int), len(pairs) - 1)]
    else:
        efficiency, given = priors.SPRING_EFFICIENCY, settings.spring_efficiency
        if given != Settings().spring_efficiency:
            efficiency = replace(priors.SPRING_EFFICIENCY, first=given, source="settings", least=0.1)
        pins = priors.Prior("lognormal", rubs.pin, priors.PIN_FRICTION.second, "workshop")
        calibrated = np.column_stack([efficiency.at(ndtri(first[0])), pins.at(ndtri(first[1]))])
    rate = priors.Prior("normal", 1.0, workshop.safety.spring_rate_scatter / 2.0, "workshop", 0.3)
    single = {
        "springs": (springs, rate),
        "mass": (mass, priors.Prior("normal", 1.0, priors.PRINTED_MASS_SHARE, "model", 0.3)),
        "floor": (floor, priors.Prior("lognormal", rubs.ground, priors.FLOOR_SHARE, "workshop")),
    }
    lengths = workshop.fits.link_tolerance_mm * (2.0 * np.column_stack(first[-4:]) - 1.0)
    others = {name: prior.at(ndtri(share))[:, None] for name, (share, prior) in single.items()}
    return {"calibration": calibrated, "lengths": lengths} | others


def changed(robot: Robot, settings: Settings, values: Mapping[str, Array]) -> tuple[Robot, Settings]:
    """Return robot and settings with one row of every group's inputs.

    A factor on the mass has the effect of its inverse on the springs.
    """
    (efficiency, pins), (floor,) = values["calibration"].tolist(), values["floor"].tolist()
    friction = {"spring_efficiency": efficiency, "pin_friction": pins, "ground_friction": floor}
    robot = with_lengths(robot, with_length_errors(robot.design, values["lengths"]))
    robot = with_spring_factor(robot, float(values["springs"][0]))
    return with_spring_factor(robot, 1.0 / float(values["mass"][0])), settings.model_copy(update=friction)


def _jump(robot: Robot, settings: Settings, engine: str, values: Mapping[str, Array]) -> tuple[float, ...]:
    """Return the `FIGURES` of one jump; 0 where there is no jump or the changed design cannot be built."""
    try:
        jump = simulate(*changed(robot, settings, values), engine)
    except CannotBuildError:
        return (0.0,) * len(FIGURES)
    return tuple(getattr(jump, name) or 0.0 for name in FIGURES)
