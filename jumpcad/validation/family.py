"""Robots that a published jumper might have been: every geometry that takes off at its angle, after its push-off.

Lengths, spring and masses of the EPFL jumpers were not reached. Geometries are sampled in wide limits, and weighted by
how near the simulated take-off angle and push-off time are to the published ones; never by the speed, which is then a
prediction. The sampler is differential evolution Monte Carlo (ter Braak 2006).
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings
from jumpcad.simulation import Jump, simulate
from jumpcad.simulation.robot_file import RobotFile, five_bar_robot
from jumpcad.transforms import Array

LIMITS = np.array(
    [(35.0, 65.0), (0.55, 1.45), (0.3, 1.2), (0.3, 1.2), (0.5, 0.97), (60.0, 90.0), (0.1, 0.4), (6.0, 14.0),
     (0.1, 0.5), (0.85, 1.0)]
)  # fmt: skip
"""Main leg (mm), c, d, e, compression ratio, rest angle (°), legs' share of the mass, body's radius of gyration (mm),
friction of the pins, spring efficiency; the last two as a calibration's priors have them."""
ANGLE_DEG, PUSHOFF_SHARE = 3.0, 0.1
"""Standard deviations of the published angle and push-off time: judgement, other published angles are off by 7°."""
FARTHEST = -12.5
"""Logarithm of a weight, of five standard deviations: if no robot is nearer, there is none."""
TOE_DEG, FLOOR, CONTACT_MM, PIN_MM = 40.0, 0.9, 1.0, 0.5
MEMBERS, GENERATIONS, DRAWS = 64, 40, 40
"""Robots; moves of each; random robots for each, of which the first are drawn by weight."""
SETTINGS = Settings(push_off_steps=60)


@dataclass(frozen=True)
class Member:
    """One robot of a family: its parameters in `LIMITS`, its jump, and the logarithm of its weight."""

    values: Array
    jump: Jump | None
    weight: float

    @property
    def efficiency(self) -> float:
        """Kinetic energy of the centre of mass at take-off over what the springs hold by rate and angle."""
        assert self.jump is not None
        return float(self.values[-1]) * (self.jump.kinetic_ratio or 0.0)


def family(
    *, mass_g: float, spring_energy_j: float, takeoff_angle_deg: float, pushoff_ms: float, seed: int,
    members: int = MEMBERS, generations: int = GENERATIONS, draws: int = DRAWS,
) -> list[Member]:  # fmt: skip
    """Return robots of a mass and a spring energy that take off at an angle after a push-off time."""
    generator = np.random.default_rng(seed)

    def tried(values: Array) -> Member:
        if (values < LIMITS[:, 0]).any() or (values > LIMITS[:, 1]).any():
            return Member(values, None, -math.inf)
        jump = jump_of(values, mass_g, spring_energy_j)
        if jump is None or jump.takeoff_angle_deg is None or jump.takeoff_time_s is None:
            return Member(values, None, -math.inf)
        off = (jump.takeoff_angle_deg - takeoff_angle_deg) / ANGLE_DEG
        late = (1000.0 * jump.takeoff_time_s / pushoff_ms - 1.0) / PUSHOFF_SHARE
        return Member(values, jump, -0.5 * (off * off + late * late))

    width = LIMITS[:, 1] - LIMITS[:, 0]
    drawn = [tried(LIMITS[:, 0] + width * generator.random(len(LIMITS))) for _ in range(draws * members)]
    chance = np.exp([one.weight for one in drawn])
    if max(one.weight for one in drawn) < FARTHEST:
        raise JumpcadError(
            f"no geometry of {mass_g:g} g and {spring_energy_j:g} J takes off at {takeoff_angle_deg:g}° after "
            f"{pushoff_ms:g} ms: check the figures that you entered"
        )
    kept = [drawn[index] for index in generator.choice(len(drawn), members, p=chance / chance.sum())]
    step = 2.38 / math.sqrt(2.0 * len(LIMITS))
    for _ in range(generations):
        for place, here in enumerate(kept):
            one, other = generator.choice(members, 2, replace=False)
            jump = step * (kept[one].values - kept[other].values)
            there = tried(here.values + jump + 0.01 * width * generator.standard_normal(len(LIMITS)))
            if math.log(generator.random()) < there.weight - here.weight:
                kept[place] = there
    return [one for one in kept if one.jump is not None]


def jump_of(values: Array, mass_g: float, spring_j: float, more_g: float = 0.0) -> Jump | None:
    """Return the jump of a robot, `more_g` being added to its body; None if it cannot be assembled."""
    try:
        return simulate(_robot(values, mass_g, spring_j, more_g), SETTINGS, "planar")
    except JumpcadError:
        return None


def _robot(values: Array, mass_g: float, spring_j: float, more_g: float) -> Mechanism:
    """Return a robot whose links are thin rods of one mass per length."""
    l2, c, d, e, ratio, rest, legs, gyration_mm, pins, efficiency = values.tolist()
    l3, l4, l5 = c * l2, d * l2, e * l2
    per_mm = legs * mass_g / (l2 + l3 + l4 + 2.0 * l5)
    back = l5 * math.cos(math.radians(TOE_DEG))
    toes_g, sole_g = 2.0 * l5 * per_mm, l4 * per_mm
    centre = (sole_g * l4 - toes_g * back) / 2.0 / (sole_g + toes_g)
    spread = sole_g * (l4**2 / 12.0 + (l4 / 2.0 - centre) ** 2) + toes_g * (back**2 / 12.0 + (back / 2.0 + centre) ** 2)
    body_g = (1.0 - legs) * mass_g + more_g
    rise = (l3 - l2) * math.sin(math.radians(rest)) / l4  # see `Design.beta_rad`; where there is no pose, refused later
    wind_deg = ratio * (rest + math.degrees(math.asin(min(max(rise, -1.0), 1.0))))
    stiffness = 1000.0 * 2.0 * efficiency * spring_j / math.radians(wind_deg) ** 2 * math.pi / 180.0
    design = {"carrying_link_mm": l2, "c_coef": c, "d_coef": d, "e_coef": e, "compression_ratio": ratio,
              "rest_angle_deg": rest, "stiffness_nmm_per_deg": stiffness, "ground_link_angle_deg": TOE_DEG}  # fmt: skip
    bodies = {
        "body": {"mass_g": body_g, "inertia_gmm2": body_g * gyration_mm**2},
        "main_leg": {"mass_g": l2 * per_mm, "centre_mm": (l2 / 2.0, 0.0), "inertia_gmm2": per_mm * l2**3 / 12.0},
        "front_link": {"mass_g": l3 * per_mm, "centre_mm": (l3 / 2.0, 0.0), "inertia_gmm2": per_mm * l3**3 / 12.0},
        "foot": {"mass_g": sole_g + toes_g, "centre_mm": (centre, 0.0), "inertia_gmm2": spread},
    }
    foot = {"radius_mm": CONTACT_MM, "friction": FLOOR}
    pin = {"friction": pins, "radius_mm": (PIN_MM,) * 4}
    data = {"name": "member", "design": design, "bodies": bodies, "foot": foot, "pins": pin}
    return five_bar_robot(RobotFile.from_data(data, "member"))
