"""The cage: hoops as rings bent and landed on, bars as beams that rods bend, horns, clearances (N, mm, MPa, J)."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from jumpcad.catalogue import CageRod
from jumpcad.dimensions import GRAVITY_M_S2, PAD_WALL_MM
from jumpcad.findings import Basis, Finding, at_least, at_most, choose, higher, lower
from jumpcad.robot.cage.place import (
    BAR_MM,
    HORN_HIGHER,
    HORN_MM,
    HORN_MORE,
    HORN_SIZE_MM,
    LAP_MM,
    Cage,
    ground,
    horn_mm,
    plate_ends_mm,
)
from jumpcad.robot.layout import Layout, moving_obstacles
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.room import EVERYWHERE, clearance
from jumpcad.strength.stress import CREEP_MPA
from jumpcad.workshop import Material

Two = tuple[float, float]

RING = 0.149
"""Of a ring's compliance R³/(E·I) between two opposite forces (Roark, ch. 9, case 1)."""
ENERGY = 2.25
"""Energy of such a ring over E·I·R·ΔK²: at its sides a deflection δ adds the curvature ΔK = 1.22·δ/R² (same)."""
FALLS = 2.0 / 3.0
"""Share of the springs' energy that falls to the ground again; measured: 0.46 to 0.65 on three robots with a cage."""

FOLD = 0.45
"""Energy that a hoop of 251° takes sideways until its rod breaks at a socket, over E·I/R: elastica between sockets that
its bar lets turn, glass of 1.5 mm; 0.49 at R 106 mm, 0.59 at 118 mm."""
EULER = 2.05
"""Of π²·E·I/L²: a column clamped at one end and guided at the other, which a floor's grip holds (Roark, table 15.1)."""


def two_horns(
    material: Material, length_mm: Two, high_mm: Two, thick_mm: Two, share: float, held_n: float = math.inf
) -> tuple[float, float, float]:
    """Return what two tapers bear, clamped at the plates, free to turn at the bar; heights from there on.

    Lengths are that of the taper, and the whole one; thicknesses that of the taper, and beyond. The stress for each
    newton upwards on a bar (MPa), and the energies (J) to their strength: pushed along the bar, and by a force of which
    that share bends them upwards, the rest shortens and buckles them; of it their ends hold `held_n` each.
    """
    taper, whole = length_mm
    along = whole * (np.arange(100) + 0.5) / 100.0
    high, thick = np.interp(along, (0.0, taper), high_mm), np.where(along < taper, *thick_mm)
    modulus, strength, found = material.modulus_mpa, material.strength_in_plane_mpa, []
    for section, half in ((high * thick**2 / 6.0, thick / 2.0), (thick * high**2 / 6.0, high / 2.0)):
        force = strength * float((section / along).min())
        gives = float((along**2 / (section * half)).mean()) * whole / modulus
        found.append((force, force**2 * gives / 1000.0))
    (_, sideways), (force, upwards) = found
    buckles = EULER * math.pi**2 * modulus * float((high * thick**3).mean()) / 12.0 / whole**2
    each = min(buckles, held_n, force / share)
    shortens = each**2 * (1.0 - share**2) * float((1.0 / (high * thick)).mean()) * whole / modulus / 1000.0
    return strength / force / 2.0, sideways, upwards * (each * share / force) ** 2 + shortens


def bent_strain(rod: CageRod, radius_mm: float) -> float:
    """Return the strain of a rod that is bent round."""
    return rod.diameter_mm / 2.0 / radius_mm


def landing_strain(rod: CageRod, radius_mm: float, energy_j: float) -> float:
    """Return the strain of a hoop that takes up an energy at its crest, as a ring: d/2·(1/R + √(U/(2.25·E·I·R)))."""
    more = math.sqrt(1000.0 * energy_j / (ENERGY * rod.bending_nmm2 * radius_mm))
    return rod.diameter_mm / 2.0 * (1.0 / radius_mm + more)


def ring_n_per_mm(rod: CageRod, radius_mm: float) -> float:
    """Return the stiffness of a hoop between the ground and its bar, as a ring."""
    return rod.bending_nmm2 / (RING * radius_mm**3)


def landing_n(rod: CageRod, radius_mm: float, energy_j: float) -> float:
    """Return the force of a hoop that takes up an energy as a spring: √(2·U·k)."""
    return math.sqrt(2000.0 * energy_j * ring_n_per_mm(rod, radius_mm))


def bar_mpa(rod: CageRod, radius_mm: float, width_mm: float, height_mm: float) -> float:
    """Return the bending stress of a bar that keeps a rod bent: the moment E·I/R all along it."""
    return rod.bending_nmm2 / radius_mm / (width_mm * height_mm**2 / 6.0)


LANDING_FACTOR = 1.25
"""On the breaking strain at a landing; judgement: hoop and bar touch together, and the body takes what is left."""
SAG_MM = 25.0
"""Most that a hoop gives under half of the robot; judgement: half of the height at which strong robots crouch."""
FREE_MM = 3.0
"""Least distance of rods and bars from what moves, and from the ground under the loaded robot; judgement."""
SHARES = {("rear", "side"): 0.28, ("front", "side"): 0.6, ("front", "ahead"): 0.98, ("rear", "behind"): 0.03}
"""Of the falling energy, by the bar that takes it and the direction, at most; `simulate --landing` says what its own
landings bring a robot. Above the worst of 200 of `best-jumper`, MuJoCo."""
FAR_BEHIND = 0.65
"""The last of these where `cage.rear_behind_mm` puts the rear bar behind the tail: above the worst of 200 landings of
robots with a wheel."""
WITHIN_MM = 100.0
"""Larger distances are not measured."""
MODEL = "a hoop as a ring: Roark, ch. 9, case 1"
BASIS = {
    "cage_bend": Basis(
        "d/(2·R) ≤ sustained_share·breaking_strain of cage.rod (%), d its diameter, R the radius of a hoop or bow",
        "bending of a round rod; strains: templates/hardware/cage_rods.toml",
    ),
    "cage_landing": Basis(
        f"d/2·(1/R + √(V/(2.25·E·I·R))) ≤ breaking_strain/{LANDING_FACTOR:g} (%), V = U/3 the falling energy that one "
        "hoop takes, of U two thirds fall",
        f"{MODEL}; shares: simulated; factor: judgement",
    ),
    "cage_sag": Basis(f"m·g/2·0.149·R³/(E·I) ≤ {SAG_MM:g} mm, m the robot's mass", f"{MODEL}; limit: judgement"),
    "cage_bar": Basis(
        f"6·E·I/(R·b·h²) ≤ {CREEP_MPA:g} MPa, E·I of the rod, b = {BAR_MM:g} mm, h = cage.bar_mm",
        "a beam bent by two moments (Shigley 3-10); limit: judgement, creep",
    ),
    "cage_horn": Basis(
        f"6·F·x/(2·t·h²) ≤ strength_in_plane_mpa/s of the body (MPa), F = √(2·V·k) the hoop's force, V as in "
        f"`cage_landing`, k = E·I/(0.149·R³), x from the bar, p = body.plate_mm, t = {1.0 + HORN_MORE:g}·p, h = "
        f"{HORN_MM[0]:g} mm at the bar to min({HORN_MM[1]:g} mm + {HORN_HIGHER:g}·p, {HORN_MM[2]:g} mm) at the plates",
        f"cantilever: Roark, ch. 8; {MODEL}",
    ),
    "cage_side": Basis(
        f"{SHARES['rear', 'side']:g}·2·U/3 on an end of the rear bar, {SHARES['front', 'side']:g}·2·U/3 of the front "
        f"one (J) ≤ {FOLD:g}·E·I/R of the hoop, and F²·∫x²/(E·I)dx of two horns of the body that bend sideways: F = "
        "strength_in_plane_mpa·h·t²/(6·x), the least; x, h, t as in `cage_horn`; the bar that is nearer to it",
        "cantilevers: Roark, ch. 8; a hoop: elastica; shares: the worst of 200 simulated landings, judgement",
    ),
    "cage_ahead": Basis(
        f"{SHARES['front', 'ahead']:g}·2·U/3 on the front bar (J) ≤ F²·∫x²/(E·I)dx of two horns of the body that bend "
        "upwards: F = strength_in_plane_mpa·t·h²/(6·x), the least, or at which 2.05·π²·E·I/x² buckles them sideways, "
        "or strength_in_plane_mpa·p·w²/(3·l) breaks what is beside their notch: w wide, l deep, p = body.plate_mm; the "
        "floor lies along the front hoop; x, h, t as in `cage_horn`",
        "cantilevers: Roark, ch. 8; columns: Roark, table 15.1; share: the worst of 200 simulated landings, judgement",
    ),
    "cage_behind": Basis(
        f"{SHARES['rear', 'behind']:g}·2·U/3 ({FAR_BEHIND:g} with cage.rear_behind_mm) on the rear bar (J) as in "
        "`cage_ahead`, and F²·x/(E·A) of horns pressed, w more by cage.rear_tip_mm; they reach to the leg's axle, t = "
        "body.plate_mm where the plates begin",
        "as `cage_ahead`",
    ),
    "cage_clear": Basis(
        f"least distance of rods and bars from what moves, and of rods and horns from the ground, springs loaded ≥ "
        f"{FREE_MM:g} mm",
        "geometry; limits: judgement, rods bend",
    ),
}
ELSEWHERE = "change cage.front_ahead_mm, cage.rear_behind_mm or the radii, or leave them 0"
SOFTER = choose("another", "cage.rod") + higher("cage.rear_radius_mm", "cage.front_radius_mm")


def cage_findings(robot: Robot) -> Iterator[Finding]:
    """Yield bending, landing, sag, bar, horn, sideways fall and clearance of a cage; nothing without one."""
    cage = robot.layout.of(Cage)
    if cage is None:
        return
    rod, radii = cage.rod, [arc.radius_mm for arc in cage.arcs]
    least, most = min(radii), max(radii[:2])
    strain, bears = 100.0 * bent_strain(rod, least), 100.0 * rod.sustained_share * rod.breaking_strain
    yield at_most(
        "cage_bend", strain, bears, "%",
        f"{rod.name} bent round {least:.0f} mm: a strain of {strain:.2f} %, and it bears {bears:.2f} % for months",
        SOFTER,
    )  # fmt: skip
    energy, bears = FALLS / 2.0 * robot.spring.energy_j, 100.0 * rod.breaking_strain / LANDING_FACTOR
    strain = 100.0 * landing_strain(rod, min(radii[:2]), energy)
    yield at_most(
        "cage_landing", strain, bears, "%",
        f"{energy:.2f} J on a hoop of {rod.name} at a landing: a strain of {strain:.2f} %; {bears:.2f} % are allowed",
        SOFTER,
    )  # fmt: skip
    sag = robot.mass_kg * GRAVITY_M_S2 / 2.0 / ring_n_per_mm(rod, most)
    yield at_most(
        "cage_sag", sag, SAG_MM, "mm",
        f"a hoop of {most:.0f} mm gives by {sag:.1f} mm under half of the robot; {SAG_MM:g} mm are allowed",
        choose("a thicker", "cage.rod") + lower("cage.rear_radius_mm", "cage.front_radius_mm"),
    )  # fmt: skip
    height = robot.workshop.cage.bar_mm
    stress = bar_mpa(rod, least, BAR_MM, height)
    yield at_most(
        "cage_bar", stress, CREEP_MPA, "MPa",
        f"cross bars {BAR_MM:g} x {height:g} mm under their rods: {stress:.1f} of {CREEP_MPA:g} MPa",
        higher("cage.bar_mm") + choose("a thinner", "cage.rod"),
    )  # fmt: skip
    forces = np.array([landing_n(rod, radius, energy) for radius in radii[:2]])
    stress = max(horn[0] * force for horn, force in zip(_horns(robot, cage), forces, strict=True))
    body = robot.workshop.material("body")
    allowed = body.strength_in_plane_mpa / robot.workshop.safety.printed_factor
    yield at_most(
        "cage_horn", stress, allowed, "MPa",
        f"horns of the body plates at a landing on a hoop: {stress:.1f} of {allowed:.1f} MPa",
        higher("body.plate_mm") + lower("cage.front_ahead_mm"),
    )  # fmt: skip
    yield from fall_findings(robot)
    free, above = _free_mm(robot.layout, cage), _above_mm(robot.layout, cage)
    yield at_least(
        "cage_clear", min(free, above), FREE_MM, "mm",
        f"the cage stays {free:.1f} mm from what moves, and {above:.1f} mm above the ground, springs loaded; "
        f"{FREE_MM:g} mm are needed",
        ELSEWHERE,
    )  # fmt: skip


def _horns(robot: Robot, cage: Cage) -> Iterator[tuple[float, float, float]]:
    """Yield what the rear and the front horns bear, see `two_horns`.

    The rear ones are clamped where the plates are wide: at the leg's axle, which the cam's may stand behind.
    """
    layout, body = robot.layout, robot.workshop.material("body")
    plate, end, (high, more) = float(np.ptp(layout.lateral.left_plate)), plate_ends_mm(layout), horn_mm(layout)
    beside = (HORN_SIZE_MM[0] - BAR_MM) / 2.0 - robot.workshop.fits.drawn.press_mm + np.array([cage.rear_tip_mm, 0.0])
    held = body.strength_in_plane_mpa * plate * beside**2 / (3.0 * LAP_MM)
    wide = (float(layout.hub_mm[0]) - layout.axle_mm / 2.0 - PAD_WALL_MM, end[1])
    axles = (layout.hub_mm, layout.front_mm)
    for bar, axle, ends, clamped, holds in zip(cage.bars, axles, end, wide, held.tolist(), strict=True):
        along = bar.horn_end_mm - axle
        share = abs(float(along @ bar.up)) / math.hypot(*along)
        lengths = (abs(float(bar.place_mm[0]) - ends), abs(float(bar.place_mm[0]) - clamped))
        yield two_horns(body, lengths, (HORN_MM[0], high), (plate + more, plate), share, holds)


def fall_findings(robot: Robot, hits_j: Mapping[tuple[str, str], float] | None = None) -> Iterator[Finding]:
    """Yield what bars, hoops and horns bear in falls sideways, from ahead and behind: warnings; nothing without a cage.

    `hits_j` are the hardest by bar and direction, as in `SHARES`; None: these shares.
    """
    cage = robot.layout.of(Cage)
    if cage is None:
        return
    shares = SHARES | ({("rear", "behind"): FAR_BEHIND} if robot.workshop.cage.rear_behind_mm else {})
    hits = hits_j or {fall: share * FALLS * robot.spring.energy_j for fall, share in shares.items()}
    folded = FOLD * cage.rod.bending_nmm2 / 1000.0
    horns = zip(("rear", "front"), cage.arcs, _horns(robot, cage), strict=False)
    bears = {name: (folded / arc.radius_mm + sideways, upwards) for name, arc, (_, sideways, upwards) in horns}
    for way in ("side", "ahead", "behind"):
        hit, bear, name = max(
            ((hits.get(fall, 0.0), bears[fall[0]][way != "side"], fall[0]) for fall in SHARES if fall[1] == way),
            key=lambda one: one[0] / one[1],
        )
        yield at_most(
            f"cage_{way}", hit, bear, "J",
            f"cage_bar_{name} may land {'on an end' if way == 'side' else f'from {way}'} with {hit:.2f} J; its "
            f"{'hoop and horns' if way == 'side' else 'horns'} bear {bear:.2f} J",
            ("let it land on grass, a mat or a carpet", *higher("body.plate_mm")), "warning",
        )  # fmt: skip


def _free_mm(layout: Layout, cage: Cage) -> float:
    """Return the least distance of rods and bars from what moves; rods beside everything that moves are left out."""
    moving = moving_obstacles(layout)
    reach = max(layout.toe_half_width_mm, *layout.lateral.outside)
    found = []
    for arc in cage.arcs:
        points = arc.points_mm[np.abs(arc.points_mm[:, 1]) < reach][:, [0, 2]]
        if len(points):
            away = float(clearance(moving, points, (0.0, 0.0), 0.0, EVERYWHERE, WITHIN_MM).min())
            found.append(away - cage.rod.diameter_mm / 2.0)
    for bar in cage.bars:
        lean = float(np.arctan2(bar.up[0], bar.up[1]))
        half = (BAR_MM / 2.0, cage.socket_mm / 2.0)
        found.append(float(clearance(moving, bar.place_mm[None], half, -lean, EVERYWHERE, WITHIN_MM)[0]))
    return min(found)


def _above_mm(layout: Layout, cage: Cage) -> float:
    """Return the least height of the cage above the ground, springs loaded."""
    up, origin = ground(layout)
    rods = np.concatenate([arc.points_mm[:, [0, 2]] for arc in cage.arcs]) - cage.rod.diameter_mm / 2.0 * up
    horns = [
        bar.horn_end_mm - HORN_SIZE_MM[1] / 2.0 * bar.up + side * np.array([bar.up[1], -bar.up[0]])
        for bar in cage.bars
        for side in (-HORN_SIZE_MM[0] / 2.0, HORN_SIZE_MM[0] / 2.0)
    ]
    return float(((np.vstack([rods, horns]) - origin) @ up).min())
