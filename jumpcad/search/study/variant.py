"""`Variant`: the input of one evaluation, a design and values of its workshop; `Tolerances`: what is made instead.

Made are neighbours within ±1 % of the parameters, and within the errors of printed lengths, springs' rate, mass and
floor's friction, all at once; `jumpcad simulate --uncertain` varies the same. A neighbour of a printed robot is that
robot with other links, angles and springs: who prints it does not lay it out anew.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from scipy.special import ndtri

from jumpcad.design import PARAMETERS, Design
from jumpcad.mechanism.variants import Robot, design_within_limits, with_length_errors, with_lengths, with_spring_factor
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.prior import sobol
from jumpcad.transforms import Array
from jumpcad.workshop.varied import Value

NOTHING: Mapping[Any, Any] = MappingProxyType({})

Key = tuple[Value, ...]


@dataclass(frozen=True)
class Variant:
    """A design, and by dotted key the values in which its workshop differs from the study's."""

    design: Design
    workshop: Mapping[str, Value] = field(default_factory=dict)

    @classmethod
    def of(cls, one: "Design | Variant") -> "Variant":
        """Return a variant as it is, and a design in the study's workshop."""
        return one if isinstance(one, Variant) else cls(one)

    @cached_property
    def key(self) -> Key:
        """Values that identify it: the design's vector, then the workshop's values."""
        return (*self.design.to_vector(), *self.workshop.values())

    def value(self, name: str) -> Value:
        """Return the value of a parameter: of the design, or of the workshop."""
        found: Value = self.workshop[name] if name in self.workshop else getattr(self.design, name)
        return found

    def changed(self, values: Mapping[str, Value]) -> "Variant":
        """Return the variant with other values of some parameters; the design's are validated (`JumpcadError`)."""
        ours = {name: values.get(name, value) for name, value in self.workshop.items()}
        numbers = {name: float(value) for name, value in values.items() if name not in ours}
        return Variant(Design(**{**self.design.model_dump(), **numbers}), ours)


SAMPLES = 16
"""Neighbours of each kind."""
PERCENT = 1.0
PERCENTILE = 10
PREFIX = "made."
"""Keys of a variant that begin so say what is made; by the others the robot is designed."""
PARTS = {PREFIX + name: name for name in PARAMETERS}
"""Keys of the parameters as made."""
SPRINGS, FLOOR = f"{PREFIX}spring_factor", f"{PREFIX}friction_factor"
"""Keys of the springs' rate, and of the floor's friction, over those that the robot is designed for."""
MADE = (*PARTS, SPRINGS, FLOOR)
"""All keys of a variant as made."""
LENGTHS, SHARES = 4, 3
"""Numbers that errors of making take: of the links l2…l5; of rate, mass and friction."""


@dataclass(frozen=True)
class Tolerances:
    """How far what is made differs from its design.

    Neighbours of a `printed` robot are that robot with other lengths, springs and floor. Robots that are made in no
    workshop have neighbours of other designs, and errors of lengths alone.
    """

    length_mm: float  # largest error of a link's length, evenly spread
    rate: float = 0.0  # standard deviations, relative: of the springs' rate and of the mass
    mass: float = 0.0
    floor: float = 0.0  # standard deviation of the logarithm of the floor's friction
    printed: bool = False

    @property
    def words(self) -> str:
        """The tolerances for a heading."""
        shares = (("springs", self.rate), ("mass", self.mass), ("friction", self.floor))
        more = "".join(f", {name} ±{200.0 * share:.0f} %" for name, share in shares if share)
        return f"lengths ±{self.length_mm:g} mm{more}"

    def neighbours(self, one: Variant, generator: np.random.Generator) -> list[Variant]:
        """Return variants as they may be made.

        A heavier robot jumps as one of the design's mass with weaker springs. Factors are rounded, so that the last
        digits of a processor do not make other variants.
        """
        if not self.printed:
            errors_mm = self.length_mm * _even(LENGTHS, generator)
            return [replace(one, design=with_length_errors(one.design, error)) for error in errors_mm]
        points = _even(LENGTHS + SHARES, generator)
        normal = ndtri(np.clip((points[:, LENGTHS:] + 1.0) / 2.0, 1e-9, 1.0 - 1e-9))
        rate, mass = np.maximum(1.0 + np.array([self.rate, self.mass]) * normal[:, :2], 0.3).T
        springs, floor = np.round(rate / mass, 6).tolist(), np.round(np.exp(self.floor * normal[:, 2]), 6).tolist()
        return [
            _made(one, with_length_errors(one.design, error), {SPRINGS: springs[row], FLOOR: floor[row]})
            for row, error in enumerate(self.length_mm * points[:, :LENGTHS])
        ]

    def varied(self, one: Variant, generator: np.random.Generator) -> list[Variant]:
        """Return variants with every parameter varied evenly within ±1 %, and within a design's limits."""
        factors = 1.0 + PERCENT / 100.0 * _even(len(PARAMETERS), generator)
        designs = [design_within_limits(np.array(one.design.to_vector()) * factor) for factor in factors]
        return [_made(one, design) if self.printed else replace(one, design=design) for design in designs]


def perturbed(robot: Robot, settings: Settings, values: Mapping[str, Value]) -> tuple[Robot, Settings]:
    """Return a robot, and the settings of its jump, changed by the values of a variant as made.

    Mass, inertia and the angle of the stop stay as designed.
    """
    old = robot.design
    design = old.model_copy(update={name: values[key] for key, name in PARTS.items() if key in values})
    springs = float(values.get(SPRINGS, 1.0)) * design.stiffness_nmm_per_deg / old.stiffness_nmm_per_deg
    if FLOOR in values:
        friction = float(values[FLOOR]) * coefficients(robot, settings).ground
        settings = settings.model_copy(update={"ground_friction": friction})
    return with_spring_factor(robot if design == old else with_lengths(robot, design), springs), settings


def _made(one: Variant, design: Design, more: Mapping[str, Value] = NOTHING) -> Variant:
    """Return a variant made with the parameters of another design."""
    parts = {key: getattr(design, name) for key, name in PARTS.items()}
    changed = {key: value for key, value in parts.items() if value != getattr(one.design, PARTS[key])}
    return Variant(one.design, {**one.workshop, **changed, **more})


def tenth(scores: list[float]) -> float:
    """Return the score that nine of ten reach: the 10th percentile, the lowest of ten or fewer."""
    return float(np.percentile(scores, PERCENTILE, method="lower"))


def _even(dimension: int, generator: np.random.Generator) -> Array:
    """Return evenly spread points (SAMPLES, dimension) of the cube from -1 to 1."""
    return 2.0 * sobol(dimension, SAMPLES, generator) - 1.0
