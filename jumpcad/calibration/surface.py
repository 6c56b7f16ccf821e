"""Response surface of one robot's jump over the calibrated parameters, from the planar engine, with its error.

Of the calibrated parameters, the motion of a printed robot depends on three numbers only: the springs' energy per mass,
the friction of its pins and that of the floor (the same factor on all masses and on the springs' stiffness changes no
path). Jumps of the engine on a grid of the three are interpolated.
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
"""Springs' energy per mass over the model's."""
PINS = (0.0, 0.25, 0.9)
FLOORS = (0.2, 0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 1.0, 1.3)
Nodes = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]
"""Springs' energy per mass over the model's, coefficients of friction of pins and of floor; each ascending."""
NODES: Nodes = (ENERGY, PINS, FLOORS)
FINE = (81, 25, 67)
"""Points along each axis of the refined grid, between which the surface is linear."""
DT_S = 1e-3
"""Time step of the engine."""
NO_SLIP_SHARE = 1e-4
"""Energy lost by slipping, over that of the springs, below which the feet do not slip: more friction has no effect."""
FIGURES = ("ballistic_range_m", "com_rise_m", "forward_m_s", "up_m_s")
"""What the surface gives; the last two are the velocity of the centre of mass at take-off."""
CHECKED_POINTS = 12
"""Points at which `Surface.errors` compares the surface with the engine."""


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
        return np.asarray(np.degrees(np.arctan2(self.up_m_s, self.forward_m_s)))


@dataclass(frozen=True, repr=False)
class Surface:
    """`values` (4, *FINE): the `FIGURES` of a jump on even points of log energy, pins and floor.

    `nodes` are the grid points at which the engine simulated the jump.
    """

    mechanism: Mechanism
    nodes: Nodes
    values: Array

    def at(self, energy: Array, pins: Array, floor: Array) -> JumpAt:
        """Return the jumps at points (n,); a friction beyond the nodes counts as the nearest node's.

        An energy beyond the nodes gives NaN.
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
        return float(np.median(self.errors))

    @cached_property
    def errors(self) -> Array:
        """Relative errors of range against the engine, at random points between the nodes at which the robot jumps."""
        rng = np.random.default_rng(12)
        energy = np.exp(rng.uniform(np.log(0.6), np.log(2.0), CHECKED_POINTS))
        pins, floor = rng.uniform(0.1, 0.5, CHECKED_POINTS), rng.uniform(0.3, 1.0, CHECKED_POINTS)
        found = self.at(energy, pins, floor).range_m
        engine = [_jump(self.mechanism, *point) for point in zip(energy, pins, floor, strict=True)]
        ranges = np.array([jump.ballistic_range_m or np.nan for jump in engine])
        off = np.abs(found / ranges - 1.0)
        return np.asarray(off[np.isfinite(off)])


def surface_of(mechanism: Mechanism, nodes: Nodes = NODES) -> Surface:
    """Return the surface of a printed robot from its jumps at every combination of nodes."""
    grid = np.full((len(FIGURES), *map(len, nodes)), np.nan)
    for i, energy in enumerate(nodes[0]):
        for j, pins in enumerate(nodes[1]):
            for k, floor in enumerate(nodes[2]):
                jump = _jump(mechanism, energy, pins, floor)
                grid[:, i, j, k] = _figures(jump)
                if jump.energy is not None and abs(jump.energy.slip_j) < NO_SLIP_SHARE * jump.spring_energy_j:
                    grid[:, i, j, k:] = grid[:, i, j, k, None]
                    break
    if np.isnan(grid).all():
        raise JumpcadError(
            "the robot jumps with no energy, friction or floor that a calibration tries: run jumpcad simulate on it"
        )
    for axis, (known, count) in enumerate(zip(_axes(nodes), FINE, strict=True), start=1):  # to even points
        even = np.linspace(known[0], known[-1], count)
        grid = np.moveaxis(_lines(np.moveaxis(grid, axis, 0), known, even), 0, axis)
    return Surface(mechanism, nodes, np.ascontiguousarray(grid))


def _jump(mechanism: Mechanism, energy: float, pins: float, floor: float) -> Jump:
    settings = Settings(dt_s=DT_S, push_off_steps=0, pin_friction=float(pins), ground_friction=float(floor))
    return simulate(with_spring_factor(mechanism, float(energy)), settings, "planar")


def _figures(jump: Jump) -> tuple[float, ...]:
    if jump.verdict != "jump" or jump.takeoff_speed_m_s is None or jump.takeoff_angle_deg is None:
        return (np.nan,) * len(FIGURES)
    assert jump.ballistic_range_m is not None
    assert jump.com_rise_m is not None
    angle = np.radians(jump.takeoff_angle_deg)
    forward, up = jump.takeoff_speed_m_s * np.cos(angle), jump.takeoff_speed_m_s * np.sin(angle)
    return jump.ballistic_range_m, jump.com_rise_m, float(forward), float(up)


def _axes(nodes: Nodes) -> tuple[Array, Array, Array]:
    """Return the nodes along each axis, of energy as logarithms."""
    energy, pins, floors = nodes
    return np.log(energy), np.array(pins), np.array(floors)


def _lines(values: Array, nodes: Array, even: Array) -> Array:
    """Return values (k, ...) at nodes (k,) by monotone cubics on even points; NaN outside the nodes with a jump.

    Lines that have a jump at the same nodes are interpolated together.
    """
    lines = values.reshape(len(nodes), -1)
    found = np.full((len(even), lines.shape[1]), np.nan)
    jumps, which = np.unique(np.isfinite(lines), axis=1, return_inverse=True)
    for number, known in enumerate(jumps.T):
        alike = which.ravel() == number
        if known.sum() >= 2:
            found[:, alike] = PchipInterpolator(nodes[known], lines[known][:, alike], extrapolate=False)(even)
    return found.reshape(len(even), *values.shape[1:])
