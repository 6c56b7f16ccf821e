"""Fatigue of steel that is loaded once per jump, from zero to its largest stress and back (MPa, jumps).

Printed parts are not here: handbooks have no such figures for them, and the strength factor covers fatigue.
"""

import itertools
import math

LOW_CYCLES, LASTING = 1e3, 1e6
"""Cycles: up to the first, yield is the limit; from the second on, lives are infinite (Shigley, 6-8)."""
YIELD_SHARE = 0.78
"""Yield over tensile strength of cold-drawn spring wire in bending (Shigley, 10-12)."""
SPRING_SHARES = ((LOW_CYCLES, YIELD_SHARE), (1e5, 0.53), (LASTING, 0.50))
"""Jumps, and largest stress at the coil's inner fibre over tensile strength: music wire, not shot-peened, repeated
bending (Shigley, table 10-10); below 1e5 on a straight line in logarithms to yield."""
LOW_CYCLE_SHARE = 0.77
"""Alternating strength at 1e3 cycles over tensile strength, at 1400 MPa and more (Shigley, figure 6-18)."""


def spring_share(jumps: float) -> float:
    """Return the largest bending stress of a torsion spring's wire over its tensile strength, for a number of jumps."""
    at = min(max(jumps, LOW_CYCLES), LASTING)
    (n0, s0), (n1, s1) = next(pair for pair in itertools.pairwise(SPRING_SHARES) if at <= pair[1][0])
    return s0 * math.pow(at / n0, math.log(s1 / s0) / math.log(n1 / n0))


def spring_jumps(share: float) -> float:
    """Return the jumps that a spring lasts with a stress over its tensile strength; infinite from `LASTING` on."""
    if share <= SPRING_SHARES[-1][1]:
        return math.inf
    (n0, s0), (n1, s1) = next(pair for pair in itertools.pairwise(SPRING_SHARES) if share >= pair[1][1])
    return n0 * math.pow(share / s0, math.log(n1 / n0) / math.log(s1 / s0))


def pin_limit_mpa(tensile_mpa: float, jumps: float) -> float:
    """Return the largest bending stress of a thin cold-drawn pin for a number of jumps.

    Fatigue strength: half of the tensile strength, at most 700 MPa, times the surface factor 4.51·S^-0.265 for an
    infinite life (Shigley, 6-7 and 6-9), and S-N lines below (6-8). A 3 mm pin that does not turn needs no factor for
    its size. Goodman's line for a stress that is half mean and half amplitude (6-12), yield at most.
    """
    endless = min(0.5 * tensile_mpa, 700.0) * min(1.0, 4.51 * math.pow(tensile_mpa, -0.265))
    first = LOW_CYCLE_SHARE * tensile_mpa
    at = min(max(jumps, LOW_CYCLES), LASTING)
    strength = first * math.pow(at / LOW_CYCLES, math.log(endless / first) / math.log(LASTING / LOW_CYCLES))
    return min(2.0 / (1.0 / strength + 1.0 / tensile_mpa), YIELD_SHARE * tensile_mpa)
