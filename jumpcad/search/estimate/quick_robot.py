"""About the robot that a design would be, in microseconds: the capsule robot with a printed one's mass and size.

With it the first designs of a search are chosen. Of ten winners of searches it tells the touchdown within a tenth; what
has no room, and most of what breaks, it does not know.
"""

import math
from dataclasses import replace

from jumpcad.design import Design
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot

BODY_MM, ABOVE_MM, BESIDE_MM = 100.0, 60.0, 20.0
"""Length of a printed robot's body, and by how much body and feet stand out from the links' ends."""
MOST_J, MOST_NM = 0.8, 1.75
"""Energy and torque of springs above which a first design is hardly ever built: of 505 random robots of the default
workshop, all 146 that kept all limits had less. Release kick and the leg's axle reject the others."""


def quick_size_m(design: Design) -> float:
    """Return about the size of a printed robot: within 8 %, in the median of 223 that jump."""
    high = ABOVE_MM + design.l2_mm * math.sin(math.radians(design.rest_angle_deg))
    wide = BESIDE_MM + 2.0 * design.l5_mm * math.sin(math.radians(design.ground_link_angle_deg))
    return max(design.l_max_mm, BODY_MM, high, wide) / 1000.0


def quick_robot(design: Design) -> Mechanism | None:
    """Return the robot of a design about as it is printed; None where its springs are too strong.

    Its mass is that of 505 random robots of the default workshop within 6 g (least squares): by the lengths of the
    links, the stiffness and the energy of the springs.
    """
    plain = capsule_robot(design)
    energy_j, stiffness = plain.spring.energy_j, plain.spring.stiffness_nm_per_rad
    if energy_j > MOST_J or 2.0 * energy_j * stiffness > MOST_NM**2:
        return None
    links_g = 0.106 * design.l2_mm + 0.028 * design.l3_mm + 0.194 * design.l4_mm + 0.1 * design.l5_mm
    mass_kg = (77.0 + links_g + 0.216 * design.stiffness_nmm_per_deg + 48.5 * energy_j) / 1000.0
    heavier = mass_kg / sum(body.mass_kg for body in plain.bodies.values())
    bodies = {
        name: replace(body, mass_kg=heavier * body.mass_kg, inertia_kg_m2=heavier * body.inertia_kg_m2)
        for name, body in plain.bodies.items()
    }
    return replace(plain, bodies=bodies)
