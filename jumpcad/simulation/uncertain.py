"""Uncertainty of one jump, from calibration, print tolerance, springs, mass and floor, and the sensitivity to each.

Each of these is a group of inputs, independent of the others. The first-order index of a group is the share of the
variance that it explains alone: Var(E[y | group]) / Var(y). E[y | group] is the group's part of an additive cubic
polynomial that is fitted to all jumps (ANOVA by regression; Rabitz and Alis 1999), which needs far fewer jumps than
Saltelli's scheme; the rest of the variance is due to interactions of groups.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.special import ndtri

from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.variants import with_length_errors, with_lengths, with_spring_factor
from jumpcad.robot import Robot
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.prior import FLOOR_SHARE, PIN_FRICTION, PRINTED_MASS_SHARE, QUANTILES, SPRING_EFFICIENCY, Prior
from jumpcad.simulation.simulator import simulate
from jumpcad.sobol import sobol
from jumpcad.transforms import Array

SAMPLES = 256
"""Jumps, a power of two."""
DEGREE, RESAMPLES = 3, 100
"""Degree of the polynomial; bootstrap resamples."""
FIGURES = {"ballistic_range_m": "range", "com_rise_m": "rise"}
"""Figures of a jump whose uncertainty is computed, and their names in texts."""
EDGE, TINY = 1e-9, 1e-30
"""Least distance of a sample from 0 and 1; least variance that is divided by."""


@dataclass(frozen=True)
class Uncertainty:
    """Quantiles (10, 50, 90 %) of range and rise over `jumps` simulated jumps, and what they depend on.

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


Applied = tuple[Robot, Settings]
Apply = Callable[[Robot, Settings, Array], Applied]


@dataclass(frozen=True)
class Group:
    """Uncertain inputs that belong together.

    `inputs` is their number of uniform variables; `values` maps these (n, inputs) to values (n, k); `apply` changes a
    robot and its settings by one row of values (k,).
    """

    inputs: int
    values: Callable[[Array], Array]
    apply: Apply


def uncertain_jump(robot: Robot, settings: Settings, engine: str, seed: int = 0, samples: int = SAMPLES) -> Uncertainty:
    """Return the uncertainty of a printed robot's jump.

    Parameters
    ----------
    robot
        As built; its workshop has the tolerance of lengths and the scatter of spring rates.
    settings
        With the draws of a calibration; without draws the priors of a calibration are used, about the efficiency of
        springs and the friction of pins and floor that the settings give.
    engine
        A key of `ENGINES`.
    seed, samples
        Random seed; number of jumps, a power of two.

    Raises
    ------
    JumpcadError
        If there is no such engine, or it is not installed.
    """
    groups = _groups(robot, settings)
    width = sum(group.inputs for group in groups.values())
    points = sobol(width, samples, np.random.default_rng(seed))
    inputs, start = {}, 0
    for name, group in groups.items():
        inputs[name] = group.values(np.clip(points[:, start : start + group.inputs], EDGE, 1.0 - EDGE))
        start += group.inputs
    figures = np.array(
        [
            _jump(robot, settings, engine, [(group.apply, inputs[name][row]) for name, group in groups.items()])
            for row in range(samples)
        ]
    )
    generator = np.random.default_rng([seed, 1])
    again = [_first_order(inputs, figures, generator.integers(0, samples, samples)) for _ in range(RESAMPLES)]
    low, high = np.quantile(np.array(again), (0.1, 0.9), axis=0)
    shares = _first_order(inputs, figures, np.arange(samples))
    return Uncertainty(
        {name: np.quantile(figures[:, k], QUANTILES).tolist() for k, name in enumerate(FIGURES)},
        {name: dict(zip(FIGURES, shares[g].tolist(), strict=True)) for g, name in enumerate(groups)},
        {
            name: {figure: [float(low[g, k]), float(high[g, k])] for k, figure in enumerate(FIGURES)}
            for g, name in enumerate(groups)
        },
        samples,
        float((figures[:, 0] > 0.0).mean()),
        bool(settings.draws),
    )


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


def _groups(robot: Robot, settings: Settings) -> dict[str, Group]:
    """Return the groups of uncertain inputs, by name."""
    workshop, rubs, draws = robot.workshop, coefficients(robot, settings), settings.draws
    tolerance_mm = workshop.fits.link_tolerance_mm
    rate = Prior("normal", 1.0, workshop.safety.spring_rate_scatter / 2.0, "workshop", 0.3)
    mass = Prior("normal", 1.0, PRINTED_MASS_SHARE, "model", 0.3)
    floor = Prior("lognormal", rubs.ground, FLOOR_SHARE, "workshop")
    pins = Prior("lognormal", rubs.pin, PIN_FRICTION.second, "workshop")
    efficiency, given = SPRING_EFFICIENCY, settings.spring_efficiency
    if given != Settings().spring_efficiency:
        efficiency = replace(SPRING_EFFICIENCY, first=given, source="settings", least=0.1)

    def drawn(at: Array) -> Array:
        pairs = np.column_stack([draws.spring_efficiency, draws.pin_friction])
        found: Array = pairs[np.minimum((at[:, 0] * len(pairs)).astype(int), len(pairs) - 1)]
        return found

    def assumed(at: Array) -> Array:
        return np.column_stack([efficiency.at(ndtri(at[:, 0])), pins.at(ndtri(at[:, 1]))])

    def calibrated(robot: Robot, settings: Settings, value: Array) -> Applied:
        return robot, _changed(settings, spring_efficiency=value[0], pin_friction=value[1])

    def lengths(robot: Robot, settings: Settings, value: Array) -> Applied:
        return with_lengths(robot, with_length_errors(robot.design, value)), settings

    def springs(robot: Robot, settings: Settings, value: Array) -> Applied:
        return with_spring_factor(robot, float(value[0])), settings

    def masses(robot: Robot, settings: Settings, value: Array) -> Applied:
        """A factor on the mass has the effect of its inverse on the springs."""
        return with_spring_factor(robot, 1.0 / float(value[0])), settings

    def floors(robot: Robot, settings: Settings, value: Array) -> Applied:
        return robot, _changed(settings, ground_friction=value[0])

    return {
        "calibration": Group(1, drawn, calibrated) if draws else Group(2, assumed, calibrated),
        "lengths": Group(4, lambda at: tolerance_mm * (2.0 * at - 1.0), lengths),
        "springs": Group(1, lambda at: rate.at(ndtri(at)), springs),
        "mass": Group(1, lambda at: mass.at(ndtri(at)), masses),
        "floor": Group(1, lambda at: floor.at(ndtri(at)), floors),
    }


def _jump(robot: Robot, settings: Settings, engine: str, changes: list[tuple[Apply, Array]]) -> tuple[float, ...]:
    """Return the `FIGURES` of one jump; 0 where there is no jump or the changed design cannot be built."""
    try:
        for apply, value in changes:
            robot, settings = apply(robot, settings, value)
        jump = simulate(robot, settings, engine)
    except CannotBuildError:
        return (0.0,) * len(FIGURES)
    return tuple(getattr(jump, name) or 0.0 for name in FIGURES)


def _changed(settings: Settings, **values: float) -> Settings:
    return settings.model_copy(update={name: float(value) for name, value in values.items()})
