"""A hill whose height depends on values of the workshop too."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from jumpcad.design import Design
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.workshop import load_workshop
from support.hills import FIXED, Hill

HEIGHTS = {"lipo-2s-180": 0.7, "lipo-1s-300": 1.0}
PLATE_MM = 1.6
SHOP = Space.parse(
    fix=FIXED, bound=["body.plate_mm=1.2:2.4"], choose=["bought.battery=lipo-2s-180,lipo-1s-300"],
    workshop=load_workshop(),
)  # fmt: skip
"""The hill's three parameters, the plates' thickness and the battery."""


@dataclass(frozen=True)
class Shop(Hill):
    """The hill, lower away from plates of `PLATE_MM`, and by the battery as `HEIGHTS` says."""

    def __call__(self, design: Design, workshop: Mapping[str, float | str] | None = None) -> Evaluation:
        found = super().__call__(design)
        if workshop and found.feasible:
            factor = HEIGHTS[workshop["bought.battery"]] * math.exp(-((workshop["body.plate_mm"] - PLATE_MM) ** 2))
            return Evaluation("jump", {"fitness": found.metrics["fitness"] * factor, "mass_kg": 0.1}, found.findings)
        return found
