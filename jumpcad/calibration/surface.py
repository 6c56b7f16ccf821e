"""The jump of one robot over what a calibration varies: a response surface of the planar engine, with its error.

The motion of a printed robot depends on the springs' energy over its mass, on the friction of its pins and on that of
the floor, and on nothing else that is calibrated: a factor on all masses and on the springs' stiffness alike changes
no path. So three coordinates are enough, and a grid of the engine's own jumps, interpolated, is cheap and exact at its
nodes.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import map_coordinates

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.simulation import Jump, simulate
from jumpcad.transforms import Array

ENERGY = (0.3, 0.4, 0.5, 0.62, 0.8, 1.0, 1.3, 1.7, 2.3, 3.0)
"""Springs' energy over mass, over the model's."""
PINS = (0.0, 0.25, 0.9)
FLOORS = (0.2, 0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 1.0, 1.3)
Nodes = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]
NODES: Nodes = (ENERGY, PINS, FLOORS)
FINE = (81, 25, 67)
"""Points along each axis between which the surface is linear."""
DT_S = 1e-3
STICKS = 1e-4
"""Share of the springs' energy lost on the ground below which more friction changes nothing."""
FIGURES = ("ballistic_range_m", "com_rise_m", "forward_m_s", "up_m_s")
CHECKS = 12


@dataclass(frozen=True, repr=False)
class JumpAt:
    """Jumps at n points: each (n,), NaN where the robot does not jump."""

    range_m: Array
    rise_m: Array
    forward_m_s: Array
    up_m_s: Array

    @property
    def speed_m_s(self) -> Array:
        """Take-off speed."""
        return np.hypot(self.forward_m_s, self.up_m_s)

    @property
    def angle_deg(self) -> Array:
        """Take-off angle above the ground."""
        angle: Array = np.degrees(np.arctan2(self.up_m_s, self.forward_m_s))
        return angle


@dataclass(frozen=True, repr=False)
class Surface:
    """Figures (4, FINE) of a robot's jump over the logarithm of energy, pins and floor, on even points.

    `nodes` are those at which the engine jumped.
    """

    mechanism: Mechanism
    settings: Settings
    nodes: Nodes
    values: Array

    def at(self, energy: Array, pins: Array, floor: Array) -> JumpAt:
        """Return the jumps at points (n,); beyond its ends the surface stays as it is there.

        An energy beyond the ends is no jump.
        """
        shape = np.broadcast_shapes(np.shape(energy), np.shape(pins), np.shape(floor))
        log_energy = np.log(energy)
        places = [
            (count - 1) * np.clip((value - axis[0]) / (axis[-1] - axis[0]), 0.0, 1.0)
            for value, count, axis in zip((log_energy, pins, floor), FINE, _axes(self.nodes), strict=True)
        ]
        where = np.stack([np.broadcast_to(place, shape) for place in places])
        low, high = _axes(self.nodes)[0][[0, -1]]
        outside = np.broadcast_to((log_energy < low) | (log_energy > high), shape)
        figures = [map_coordinates(figure, where, order=1) for figure in self.values]
        return JumpAt(*(np.where(outside, np.nan, figure) for figure in figures))

    @cached_property
    def error(self) -> float:
        """Median difference of range from the engine's own at points between the nodes, as a share."""
        return float(np.median(self.errors))

    @cached_property
    def errors(self) -> Array:
        """Differences of range from the engine's own at points between the nodes, as shares; of those that jump."""
        rng = np.random.default_rng(12)
        energy = np.exp(rng.uniform(np.log(0.6), np.log(2.0), CHECKS))
        pins, floor = rng.uniform(0.1, 0.5, CHECKS), rng.uniform(0.3, 1.0, CHECKS)
        found = self.at(energy, pins, floor).range_m
        engine = [_jump(self.mechanism, self.settings, *point) for point in zip(energy, pins, floor, strict=True)]
        ranges = np.array([jump.ballistic_range_m or np.nan for jump in engine])
        off = np.abs(found / ranges - 1.0)
        known: Array = off[np.isfinite(off)]
        return known


def surface_of(mechanism: Mechanism, settings: Settings | None = None, nodes: Nodes = NODES) -> Surface:
    """Return the surface of a printed robot from its jumps at every combination of nodes.

    Raises
    ------
    JumpcadError
        If it jumps nowhere on it.
    """
    settings = (settings or Settings()).model_copy(update={"dt_s": DT_S})
    grid = np.full((len(FIGURES), *map(len, nodes)), np.nan)
    for i, energy in enumerate(nodes[0]):
        for j, pins in enumerate(nodes[1]):
            for k, floor in enumerate(nodes[2]):
                jump = _jump(mechanism, settings, energy, pins, floor)
                grid[:, i, j, k] = _figures(jump)
                if jump.energy is not None and abs(jump.energy.slip_j) < STICKS * jump.spring_energy_j:
                    grid[:, i, j, k:] = grid[:, i, j, k, None]
                    break
    if np.isnan(grid).all():
        raise JumpcadError(
            "the robot jumps with no energy, friction or floor that a calibration tries: run jumpcad simulate on it"
        )
    return Surface(mechanism, settings, nodes, _refined(grid, nodes))


def _jump(mechanism: Mechanism, settings: Settings, energy: float, pins: float, floor: float) -> Jump:
    changes = {"pin_friction": float(pins), "ground_friction": float(floor), "spring_efficiency": 1.0}
    return simulate(with_spring_factor(mechanism, float(energy)), settings.model_copy(update=changes), "planar")


def _figures(jump: Jump) -> tuple[float, ...]:
    if jump.verdict != "jump" or jump.takeoff_speed_m_s is None or jump.takeoff_angle_deg is None:
        return (np.nan,) * len(FIGURES)
    assert jump.ballistic_range_m is not None
    assert jump.com_rise_m is not None
    angle = np.radians(jump.takeoff_angle_deg)
    forward, up = jump.takeoff_speed_m_s * np.cos(angle), jump.takeoff_speed_m_s * np.sin(angle)
    return jump.ballistic_range_m, jump.com_rise_m, float(forward), float(up)


def _refined(grid: Array, nodes: Nodes) -> Array:
    """Return the grid on even points, by monotone cubics along one axis after the other."""
    for axis, (known, count) in enumerate(zip(_axes(nodes), FINE, strict=True), start=1):
        grid = np.apply_along_axis(_line, axis, grid, known, np.linspace(known[0], known[-1], count))
    return grid


def _axes(nodes: Nodes) -> tuple[Array, Array, Array]:
    """Return the nodes along each axis, of energy as logarithms."""
    energy, pins, floors = nodes
    return np.log(energy), np.array(pins), np.array(floors)


def _line(values: Array, nodes: Array, even: Array) -> Array:
    """Return one line of figures on even points; NaN beyond the nodes with a jump."""
    known = np.isfinite(values)
    if known.sum() < 2:
        return np.full(len(even), np.nan)
    found: Array = PchipInterpolator(nodes[known], values[known], extrapolate=False)(even)
    return found
