"""What is made of a design instead of it: neighbours within the tolerances of the parameters, and of making it.

Making has errors of printed lengths, of the springs' rate, of the mass and of the floor's friction, all at once in
every neighbour; `jumpcad simulate --uncertain` varies the same, with the same deviations.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc

from jumpcad.design import PARAMETERS, Design
from jumpcad.mechanism.variants import design_within_limits, with_length_errors
from jumpcad.search.variant import Variant
from jumpcad.transforms import Array

SAMPLES = 16
"""Neighbours of each kind."""
PERCENT = 1.0
PERCENTILE = 10
FRICTIONS = ("ground.friction", "ground.bare_friction")
"""Keys of the floor's friction in a workshop: of feet with a pad, and without."""
SPRINGS = "made.spring_factor"
"""Key of the rate of springs as made over that of the design: the robot is built for the design's."""
MADE = (*FRICTIONS, SPRINGS)
"""Keys by which a variant as made may differ from the study's workshop."""
LENGTHS, SHARES = 4, 3
"""Numbers that errors of making take: of the links l2…l5; of rate, mass and friction."""


@dataclass(frozen=True)
class Making:
    """How far what is made differs from its design.

    Parameters
    ----------
    length_mm
        Largest error of a link's length, evenly spread.
    rate, mass
        Standard deviations of the springs' rate and of the mass, relative. 0 for robots that are made in no workshop.
    floor
        Standard deviation of the logarithm of the floor's friction.
    friction
        Its value in the workshop.
    key
        Where it stands there.
    """

    length_mm: float
    rate: float = 0.0
    mass: float = 0.0
    floor: float = 0.0
    friction: float = 0.0
    key: str = FRICTIONS[0]

    @property
    def words(self) -> str:
        """The tolerances for a heading."""
        shares = (("springs", self.rate), ("mass", self.mass), ("friction", self.floor))
        more = "".join(f", {name} ±{200.0 * share:.0f} %" for name, share in shares if share)
        return f"lengths ±{self.length_mm:g} mm{more}"

    def neighbours(self, one: Variant, generator: np.random.Generator) -> list[Variant]:
        """Return variants as they may be made.

        The robot is built as designed, and jumps with other springs; a heavier one jumps as one of the design's mass
        with weaker springs. Factors are rounded, so that the last digits of a processor do not make other designs.
        """
        if not (self.rate or self.mass or self.floor):
            return [
                replace(one, design=with_length_errors(one.design, error))
                for error in self.length_mm * _even(LENGTHS, generator)
            ]
        points = _even(LENGTHS + SHARES, generator)
        normal = ndtri(np.clip((points[:, LENGTHS:] + 1.0) / 2.0, 1e-9, 1.0 - 1e-9))
        rate, mass = np.maximum(1.0 + np.array([self.rate, self.mass]) * normal[:, :2], 0.3).T
        friction = float(one.workshop.get(self.key, self.friction))
        springs, floor = np.round(rate / mass, 6), np.round(friction * np.exp(self.floor * normal[:, 2]), 6)
        return [
            self._made(one, self.length_mm * points[row, :LENGTHS], float(springs[row]), float(floor[row]))
            for row in range(SAMPLES)
        ]

    def _made(self, one: Variant, error_mm: Array, springs: float, friction: float) -> Variant:
        workshop = {**one.workshop, self.key: friction} if self.floor else one.workshop
        return Variant(with_length_errors(one.design, error_mm), {**workshop, SPRINGS: springs})


LENGTHS_ALONE = Making(0.2)
"""Of robots that are made in no workshop; judgement."""


def varied_parameters(design: Design, generator: np.random.Generator) -> list[Design]:
    """Return designs with every parameter varied evenly within ±1 %, and within a design's limits."""
    factors = 1.0 + PERCENT / 100.0 * _even(len(PARAMETERS), generator)
    return [design_within_limits(np.array(design.to_vector()) * factor) for factor in factors]


def tenth(scores: list[float]) -> float:
    """Return the score that nine of ten reach: the 10th percentile, the lowest of ten or fewer."""
    return float(np.percentile(scores, PERCENTILE, method="lower"))


def _even(dimension: int, generator: np.random.Generator) -> Array:
    """Return evenly spread points (SAMPLES, dimension) of the cube from -1 to 1."""
    points: Array = qmc.Sobol(dimension, seed=generator).random(SAMPLES)
    return 2.0 * points - 1.0
