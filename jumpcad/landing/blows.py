"""Blows of a landing: their energy from the simulation, their force from what gives, and what the first part bears.

MuJoCo's contacts have an assumed time, not a stiffness, so their peak force is no figure; their impulse is. A blow's
energy is half of its impulse times the speed of the contact before it, that of a mass stopped without rebound. Its
peak force on a floor that gives nothing follows from what gives in the robot (N, mm, N/mm).
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from jumpcad.dimensions import TOE_TIP_WIDTH_MM
from jumpcad.findings import Finding, at_most, lower
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.robot.cage.limits import landing_n, ring_n_per_mm
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.electronics.limits import holding_findings
from jumpcad.robot.foot.limits import toe_findings
from jumpcad.robot.foot.pads import TOE_AHEAD_MM, TOE_BACK_MM
from jumpcad.robot.leg.thing import leg_findings
from jumpcad.robot.load_case import LoadCase, load_case
from jumpcad.robot.robot import Robot

if TYPE_CHECKING:
    from jumpcad.landing.arena import Arena

BLOW_S, ROD_BLOW_S = 0.01, 0.05
"""How long a blow lasts at most, also on a cage's rods; a part that was as long off the floor is hit anew."""
LEAST_J = 1e-3
"""Blows with less are left out."""
EDGE_MM = 6.0
"""Radius of printed edges seen from the side; judgement: plates are drawn around axles and screws."""
NOSE, TOE, CAGE = "nose", "toe", "cage"
"""Where a foot is hit, before and behind the ankle; and the rods of a cage."""
BEARS = {
    "front_link_buckling": NOSE, "front_bar_buckling": NOSE, "toe_landing": TOE, "electronics_hold": "body",
}  # fmt: skip
"""Checks whose load is proportional to a landing's force, and the part that the force acts on."""


@dataclass
class Blow:
    """A hit on a part: speed (m/s) before it, when (s), impulse (N·s), and work of the floor while it goes in (J)."""

    part: str
    speed_m_s: float
    begun_s: float
    impulse_ns: float = 0.0
    work_j: float = 0.0

    @property
    def energy_j(self) -> float:
        """What must be absorbed: m·v²/2, with the mass that the impulse shows."""
        return 0.5 * self.impulse_ns * self.speed_m_s


class Blows:
    """The blows on a robot in an arena; called after each of MuJoCo's steps, whose contacts are those before it."""

    def __init__(self, arena: "Arena") -> None:
        self._arena, self._names = arena, {number: name for name, number in arena.bodies.items()}
        self._now: dict[str | tuple[str, str], tuple[Blow, float]] = {}
        self.all: list[Blow] = []
        self.falls: dict[tuple[str, str], list[Blow]] = {}
        """Blows on a cage, hoop and bar together, by bar and direction, as `fall_findings` takes them."""
        self._cage = [arena.model.geom(index).name.startswith(CAGE) for index in range(arena.model.ngeom)]

    def __call__(self) -> None:
        """Add what the floor did in the last step."""
        data, model = self._arena.data, self._arena.model
        if not data.ncon:
            return
        time, contact = float(data.time), data.contact
        shape = contact.geom.max(axis=1)  # the floor comes first
        hit = model.geom_bodyid[shape]
        arm = contact.pos - data.subtree_com[self._arena.bodies["body"]]
        falling = -(data.cvel[hit, 5] + data.cvel[hit, 0] * arm[:, 1] - data.cvel[hit, 1] * arm[:, 0])
        ahead = np.einsum("ni,ni->n", contact.pos - data.xpos[hit], data.xmat[hit][:, ::3]) > 0.0
        rods = self._arena.rods[shape]
        for number, body in enumerate(hit):
            name = self._names[int(body)]
            part = CAGE if rods[number] else name if name != FOOT else NOSE if ahead[number] else TOE
            push = float(data.efc_force[contact.efc_address[number]]) if contact.efc_address[number] >= 0 else 0.0
            hits: list[tuple[str | tuple[str, str], list[Blow]]] = [(part, self.all)]
            if self._cage[shape[number]] and (cage := self._arena.robot.layout.of(Cage)):
                front = int(model.geom_pos[shape[number], 0] > 0.0)
                down = cage.bars[front].T_body_bar[:3, :3].T @ -self._arena.pose(BODY)[2, :3]  # in the bar's frame
                way = ("side", "top", "ahead" if down[2] > 0.0 else "behind")[int(np.argmax(np.abs(down)))]
                fall = ("rear", "front")[front], way
                hits.append((fall, self.falls.setdefault(fall, [])))
            for key, found in hits:
                blow, last = self._now.get(key, (None, 0.0))
                lasts_s = BLOW_S if key in (name, NOSE, TOE) else ROD_BLOW_S
                if blow is None or time - last > lasts_s:
                    blow = Blow(part, 0.0, time)
                    found.append(blow)
                self._now[key] = blow, time
                if time - blow.begun_s < lasts_s:
                    blow.impulse_ns += push * float(model.opt.timestep)
                    blow.work_j += push * max(float(falling[number]), 0.0) * float(model.opt.timestep)
                    blow.speed_m_s = max(blow.speed_m_s, float(falling[number]))


@dataclass(frozen=True)
class PartForce:
    """The hardest blow on a part, and the forces on a floor that gives nothing and on one that gives the stop.

    `sag_mm` is how far a hoop of the cage gives on the first, None of another part.
    """

    part: str
    energy_j: float
    speed_m_s: float
    hard_n: float
    soft_n: float
    sag_mm: float | None = None


def part_forces(robot: Robot, blows: Iterable[Blow]) -> list[PartForce]:
    """Return the hardest blow on each part, hardest first.

    On a hard floor a foot's blow is met by its pad, with the front link or the toe behind it, and one on a cage by its
    hoop: F = √(2·E·k). One on printed edges crushes them, F = 2·b·R·√(2·r·d) over the dent d. All are upper bounds. On
    a soft one a blow is met evenly over `safety.landing_stop_mm`, F = E/s, as the checks take it, or by what gives in
    the part, if it gives more.
    """
    hardest: dict[str, Blow] = {}
    for blow in blows:
        hardest[blow.part] = max(hardest.get(blow.part, blow), blow, key=lambda one: one.energy_j)
    case, stop_mm, cage = load_case(robot), robot.workshop.safety.landing_stop_mm, robot.layout.of(Cage)
    found = []
    for blow in sorted(hardest.values(), key=lambda one: -one.energy_j):
        if blow.energy_j < LEAST_J:
            continue
        hard = hard_n(case, blow.part, 1000.0 * blow.energy_j)
        sag = hard / ring_n_per_mm(cage.rod, cage.tightest_mm) if cage and blow.part == CAGE else None
        soft = min(1000.0 * blow.energy_j / stop_mm, hard)
        found.append(PartForce(blow.part, blow.energy_j, blow.speed_m_s, hard, soft, sag))
    return found


def hard_n(case: LoadCase, part: str, energy_nmm: float) -> float:
    """Return the largest force (N) of a blow of some energy on a floor that gives nothing."""
    sections, shell, workshop, cage = case.layout.sections, case.shell, case.workshop, case.layout.of(Cage)
    if part == CAGE and cage is not None:
        return landing_n(cage.rod, cage.tightest_mm, energy_nmm / 1000.0)
    if part not in (NOSE, TOE):
        plates, material = 2.0 * float(np.diff(case.layout.lateral.left_plate)[0]), workshop.material("body")
        width = plates if part == "body" else sections.thickness_mm
        material = material if part == "body" else workshop.material("links")
        push = 2.0 * width * material.strength_in_plane_mpa * math.sqrt(2.0 * EDGE_MM)
        dent = (1.5 * energy_nmm / push) ** (2.0 / 3.0)  # E = ∫F·dd, F growing as its root
        return push * math.sqrt(dent)
    modulus, design = workshop.material("links").modulus_mpa, case.robot.design
    if part == NOSE:
        gives = design.l3_mm / (modulus * float(sections.front(shell).area_mm2))
        pads, size = 2.0, (sections.lug_thickness_mm, 2.0 * sections.foot_depth_mm)
    else:
        gives = design.l5_mm**3 / (3.0 * modulus * float(np.max(sections.toe(shell).second_moment_mm4)))
        pads, size = 1.0, (TOE_TIP_WIDTH_MM, TOE_BACK_MM + TOE_AHEAD_MM)
    if pad := workshop.foot_pad:
        gives += 1.0 / (pads * pad.rate_n_per_mm(*size))
    return math.sqrt(2.0 * energy_nmm / gives)


def landing_strength(robot: Robot, forces: Sequence[PartForce]) -> Finding | None:
    """Return the finding of the part that needs the softest floor, None where no part that is hit has a check.

    The floor must absorb what the part does not when the check of the part is at its limit: with the force F that it
    bears there, and Fh on a hard floor, it gives E/F·(1 - (F/Fh)ⁿ): n is 2 for what springs back, 3 for a dent.
    """
    case, hardest = load_case(robot), {one.part: one for one in forces}
    needed: list[tuple[float, PartForce, str, float]] = []
    for found in (*leg_findings(robot), *toe_findings(robot), *holding_findings(robot)):
        hit = hardest.get(BEARS.get(found.name, ""))
        if hit is not None and found.value and found.limit:
            borne = (case.toe_blow_n if hit.part == TOE else case.landing_n) * found.limit / found.value
            taken = min(borne / hit.hard_n, 1.0) ** (2 if hit.part in (NOSE, TOE) else 3)
            needed.append((1000.0 * hit.energy_j * (1.0 - taken) / borne, hit, found.name, borne))
    if not needed:
        return None
    stop, hit, name, borne = max(needed)
    return at_most(
        "landing_strength", stop, robot.workshop.safety.landing_stop_mm, "mm",
        f"of a blow of {1000.0 * hit.energy_j:.0f} mJ on the {hit.part} the floor must take {stop * borne:.0f} mJ, the "
        f"{hit.part} the rest: over {stop:.1f} mm at the {borne:.1f} N that {name} allows; on a floor that "
        f"gives nothing {hit.hard_n:.1f} N act at most",
        ("let it land on a mat that gives as much", *lower("stiffness_nmm_per_deg", "compression_ratio")), "warning",
    )  # fmt: skip
