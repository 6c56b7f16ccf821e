"""The smallest cam that meets every limit.

A coarse grid over the three numbers of a cam's shape gives the start, sequential quadratic programming the optimum,
without random numbers; the direction of the cam's axis follows from the free room. Of the points of a grid around the
optimum the smallest cam that meets the limits is taken, so that differences between processors in the linear algebra
underneath do not reach the robot: where the best cam lies on a kink, the optimum differs by 2e-6 of it.
"""

import itertools
import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import optimize

from jumpcad.drive.cam import Cam, CamGeometry
from jumpcad.drive.cam_findings import SCALES, cam_findings, missed
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import FIRST_ROWS, ROWS, CamLimits, axis_range, measure
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose, lower
from jumpcad.process import one_thread
from jumpcad.transforms import Array

FTOL = 1e-5
"""Where the search for a shape ends: size (mm), a thousandth of the grid's step."""
COARSE = 5
"""Points of the coarse grid along each of the three numbers. Of 1,180 cams, 7 and an end at 1e-9 mm change one, which
becomes larger."""


@lru_cache(maxsize=8)
def synthesise_cam(law: CamLaw, limits: CamLimits) -> Cam:
    """Find the smallest cam for a law: outer radius first, then lever and distance of the axis.

    It is often that of the round of growth before, in which only the springs' pin moves.
    """
    search = _Shapes(law, limits)
    for _ in range(4):
        logs, fits = search.best()
        shapes = search.around(logs)
        outer, margins, numbers = measure(law, limits, shapes, samples=181)
        fine = (margins > -1e-9).all(axis=0)
        chosen = int(np.where(fine, _size(outer, shapes), np.inf).argmin())
        if fine.any() or not fits:
            break
        search.allow_for(shapes[0], margins[:, 0])
    margin = np.minimum.reduceat(margins[:, chosen], FIRST_ROWS)
    if not fine.any():
        missing, ways = missed(limits, margin)
        raise CannotBuildError(
            f"no cam winds the leg by {math.degrees(law.compression_rad):.1f}° against {law.spring_torque_nm:.2f} N·m; "
            f"the nearest one misses: {missing}",
            "cam", (margin / SCALES[FIRST_ROWS]).min(), "", ways,
        )  # fmt: skip
    numbers = {name: values[[chosen]] for name, values in numbers.items()}
    geometry = _geometry(law, limits, shapes[chosen], outer[[chosen]])
    outline = geometry.outline_mm()
    radii = np.hypot(*outline.T)
    return Cam(
        geometry=geometry, profile_mm=outline, outer_radius_mm=float(radii.max()), core_radius_mm=float(radii.min()),
        max_pressure_angle_rad=float(numbers["pressure_angle"][0]),
        min_convex_radius_mm=float(numbers["convex_radius"][0]), peak_contact_n=float(numbers["force"][0]),
        contact_pressure_mpa=float(numbers["pressure"][0]), worn_mm=limits.worn_mm(float(numbers["force"][0])),
        findings=cam_findings(limits, margin, numbers),
    )  # fmt: skip


class _Shapes:
    """The search for a shape: logarithms of lever (mm), gap from lever to axis (mm) and lead (rad), shape (3,)."""

    STEP = 1e-6
    STEPS = STEP * np.eye(4, 3, -1)  # none, and one along each axis
    PAST_RAD = 1e-4  # of the lead beyond the overshoot: without any the outline has no hollow
    GRID = np.array([1e-2, 1e-2, math.radians(1e-2)])  # mm, mm, rad
    CORNERS = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
    RESERVE = 3e-3  # of a margin's scale: about what grid and coarse samples cost, so that most cams are found at once
    ROUNDING = 1e-2  # of a margin's scale: what a step of the grid costs, so that adding it leads to other shapes

    def __init__(self, law: CamLaw, limits: CamLimits) -> None:
        self.law, self.limits = law, limits
        self.reserve = np.full(len(ROWS), self.RESERVE)
        lever_min = limits.hub_radius_mm + limits.roller_radius_mm + limits.clearance_mm
        gap_min, lead_min = max(limits.gap_min_mm, limits.core_radius_mm), limits.overshoot_rad + self.PAST_RAD
        self.lower = np.log([lever_min, gap_min, lead_min])
        self.upper = np.log([limits.lever_max_mm, limits.gap_max_mm, limits.lead_max_rad])
        if (self.lower >= self.upper).any():
            fits = 2.0 * (limits.lever_max_mm - lever_min + limits.roller_radius_mm)
            raise CannotBuildError(
                f"no lever from {lever_min:.1f} mm (hub, roller and clearance) to {limits.lever_max_mm:g} mm (cam's "
                f"axis {limits.gap_min_mm:.1f} to {limits.gap_max_mm:g} mm beyond it, overshoot at least "
                f"{math.degrees(limits.overshoot_rad):.1f}°), which needs a roller of less than {fits:.1f} mm diameter",
                ways=choose("a smaller", "bought.roller", "bought.leg_bearing") + lower("stiffness_nmm_per_deg"),
            )
        self.known: dict[bytes, tuple[float, Array, Array, Array]] = {}

    def best(self) -> tuple[Array, bool]:
        """Return logarithms of the best shape (3,), and if it meets all limits with the reserve; if none, the nearest.

        Sequential quadratic programming from the best point of a coarse grid; where that ends outside the limits, it
        starts again from where the largest violation is smallest.
        """
        self.known.clear()
        starts = self._coarse()
        for start in starts:
            shape = self._smallest(start)
            if not self._fits(shape):
                starts[0] = start = self._least_bad(start)
                shape = self._smallest(start) if self._fits(start) else start
            if self._fits(shape):
                return shape, True
        return max(starts, key=lambda logs: float(self._at(logs)[2].min())), False

    def around(self, logs: Array) -> Array:
        """Return the shapes (n, 3) of the grid around one within the bounds, the nearest first."""
        steps = np.exp(logs) / self.GRID
        corners = np.floor(steps + 0.01) + self.CORNERS  # a bound may be on the grid, but for its last digits
        low, high = np.exp(self.lower) / self.GRID - 1e-6, np.exp(self.upper) / self.GRID + 1e-6
        inside = corners[((corners >= low) & (corners <= high)).all(axis=1)]
        return np.asarray(inside[np.abs(inside - steps).sum(axis=1).argsort(kind="stable")] * self.GRID)

    def allow_for(self, shape: Array, margin: Array) -> None:
        """Add the cost of coarse samples and rounding at a shape (3,) of known true margins to the reserve."""
        hidden = self._at(np.log(shape))[2] + self.reserve - margin / SCALES
        missing = -margin / SCALES
        rounded_off = np.where(missing > 0, np.maximum(2.0 * missing, self.ROUNDING), 0.0)
        self.reserve = np.maximum(self.reserve, 1.05 * hidden + 1e-4) + rounded_off

    def _fits(self, logs: Array) -> bool:
        return float(self._at(logs)[2].min()) >= -1e-5

    def _coarse(self) -> list[Array]:
        """Return the best points of a coarse grid, one per lever."""
        grid = np.array(list(itertools.product(*np.linspace(self.lower, self.upper, COARSE).T)))
        size, margins = self._size_and_margins(grid, samples=12)
        missing = np.log1p(np.maximum(-margins, 0.0)).sum(axis=0)
        rank = np.where(missing > 0, 1e6 + missing, size).reshape(COARSE, -1)
        order = np.argsort(rank.min(axis=1))[:3]
        return list(grid.reshape(COARSE, -1, 3)[order, rank.argmin(axis=1)[order]])

    def _smallest(self, start: Array) -> Array:
        """Return the point where the size is smallest and every margin positive."""
        bounds = list(zip(self.lower, self.upper, strict=True))
        return _constrained_minimum(lambda logs: self._at(logs)[:2], lambda logs: self._at(logs)[2:], start, bounds)

    def _least_bad(self, start: Array) -> Array:
        """Return where the largest violation is smallest: least t with every margin above -t."""
        violation = max(0.0, -float(self._at(start)[2].min()))
        last = np.array([0.0, 0.0, 0.0, 1.0])

        def margins(point: Array) -> tuple[Array, Array]:
            _, _, values, slopes = self._at(point[:3])
            return values + point[3], np.column_stack([slopes, np.ones(len(values))])

        bounds = [*zip(self.lower, self.upper, strict=True), (-0.05, None)]
        return _constrained_minimum(lambda point: (point[3], last), margins, np.append(start, violation), bounds)[:3]

    def _at(self, logs: Array) -> tuple[float, Array, Array, Array]:
        """Return size, its gradient (3,), margins (rows,) and their gradients (rows, 3) at one point."""
        key = logs.tobytes()
        if key not in self.known:
            size, margins = self._size_and_margins(logs + self.STEPS, samples=25)
            size_slope, margin_slope = (size[1:] - size[0]) / self.STEP, (margins[:, 1:] - margins[:, :1]) / self.STEP
            self.known[key] = float(size[0]), size_slope, margins[:, 0], margin_slope
        return self.known[key]

    def _size_and_margins(self, logs: Array, samples: int) -> tuple[Array, Array]:
        shapes = np.exp(logs)
        outer, margins, _ = measure(self.law, self.limits, shapes, samples)
        return _size(outer, shapes), margins / SCALES[:, None] - self.reserve[:, None]


def _size(outer_mm: Array, shapes: Array) -> Array:
    """Return what the search makes small (n,): the outer radius first, then lever and distance of the axis."""
    return outer_mm + 0.1 * (2 * shapes[:, 0] + shapes[:, 1])


def _constrained_minimum(
    objective: Callable[[Array], tuple[float, Array]], margins: Callable[[Array], tuple[Array, Array]], start: Array,
    bounds: Any,
) -> Array:  # fmt: skip
    """Return where a function is least with every margin positive; both come with their gradients."""
    constraints: Any = {"type": "ineq", "fun": lambda x: margins(x)[0], "jac": lambda x: margins(x)[1]}
    with one_thread():
        found = optimize.minimize(
            objective, start, jac=True, bounds=bounds, constraints=constraints, method="SLSQP",
            options={"maxiter": 60, "ftol": FTOL},
        )  # fmt: skip
    return np.asarray(found.x)


def _geometry(law: CamLaw, limits: CamLimits, shape: Array, outer: Array) -> CamGeometry:
    lever, gap, lead = (float(value) for value in shape)
    highest, _ = axis_range(law, limits, np.array([lever + gap]), shape[2:], outer)
    return CamGeometry(
        law=law, lever_mm=lever, axis_distance_mm=lever + gap, axis_rad=float(highest[0]), lead_rad=lead,
        roller_radius_mm=limits.roller_radius_mm, clearance_mm=limits.clearance_mm, overshoot_rad=limits.overshoot_rad,
    )  # fmt: skip
