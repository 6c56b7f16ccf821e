"""Strength and fatigue of axles, pins, screws, bearings and springs (N, N·mm, mm, MPa)."""

import math
from collections.abc import Iterator

from jumpcad.dimensions import ROLLER_WASHER_MM
from jumpcad.findings import Basis, Finding, Ways, at_most, choose, higher, lower
from jumpcad.robot.load_case import LoadCase, load_case, stress_finding
from jumpcad.robot.robot import Robot
from jumpcad.strength.axles import SCREW_AREA_MM2, SCREW_YIELD_MPA, clipped_pins
from jumpcad.strength.bearings import allowed_n, bearing_load_n
from jumpcad.strength.stress import YIELD_SHARE, pin_limit_mpa, pin_stress_mpa, spring_jumps, spring_share

PINS = ("foot_pin", "leg_pin")
"""Clevis pins or rods; another bought.axle changes them only with clips."""
ROLLER_SCREW_CORE_MM = 2.39
"""M3, ISO 724."""
ROLLER_SCREW_YIELD_MPA = 640.0
"""Property class 8.8, ISO 898-1."""
BENDING = "32·M·d/(π·(d⁴ - b⁴)) ≤ yield stress/s (MPa), d diameter, b bore"
SOFTER = lower("stiffness_nmm_per_deg", "compression_ratio")
ROUND = (
    "bending of a round bar: Shigley 3-10; yield stress: templates/hardware/axles.toml, at most safety.steel_yield_mpa"
)
TEETH = "forces of teeth: Shigley 13-14"
FRICTION = "friction of the feet·(m·g + U/safety.landing_stop_mm)"
BASIS = {
    "leg_axle_strength": Basis(
        f"{BENDING}; M of a simple beam between the plates: the leg pushes with the forces of arms and cam where its "
        "bearings are (without, a third of its width beside its middle), each coil beside it pushes back, at its "
        "ends, with the forces of its own two arms",
        ROUND,
    ),
    "front_axle_strength": Basis(
        f"{BENDING}; M of a simple beam between the plates, F the front link's largest force in the push-off or the "
        "landing force, halves of it a third of the link's width beside its middle",
        ROUND,
    ),
    "cam_axle_strength": Basis(
        f"{BENDING}; M of a simple beam between the plates under the cam's largest force and the force of the cam "
        "gear's teeth",
        f"{ROUND}; {TEETH}",
    ),
    "idler_axle_strength": Basis(
        f"{BENDING}; M of a simple beam between the plates under the forces of both its gears' teeth",
        f"{ROUND}; {TEETH}",
    ),
    "spring_pin_strength": Basis(
        f"{BENDING}; M of a simple beam between the plates under the force of one arm at each spring's outer end, in "
        "the wire's middle",
        ROUND,
    ),
    "leg_pin_strength": Basis(
        f"{BENDING}; M = F·(gap + half the wire + a quarter of the leg's thickness), F of one arm", ROUND
    ),
    "foot_pin_strength": Basis(
        f"{BENDING}; M = F/2·x, F largest of ankle and front link in the push-off and the landing force, x from the "
        "lug's middle to a quarter of the leg's thickness within it",
        ROUND,
    ),
    "roller_screw_strength": Basis(
        f"32·M/(π·d³) ≤ {ROLLER_SCREW_YIELD_MPA:g} MPa/s, d = {ROLLER_SCREW_CORE_MM:g} mm, M = N·x, N the cam's "
        "largest force, x from lever to roller's middle",
        "Shigley 3-10; core of M3: ISO 724; property class 8.8: ISO 898-1",
    ),
    "axle_retention": Basis(
        f"{FRICTION} ≤ holding force/s (N): π·d·floor·strength_in_plane_mpa/√3 of a blind bore's floor in the body, "
        f"s of what is printed; load of a clip; {SCREW_AREA_MM2:g} mm²·{SCREW_YIELD_MPA:g} MPa of a screw",
        "distortion energy; clips: DIN 6799; screws: ISO 898-1; all friction on one axle: judgement",
    ),
    "pin_retention": Basis(
        f"{FRICTION} ≤ load of its split pin or clip/s (N)",
        "templates/hardware/axles.toml (ISO 1234, DIN 6799); all friction on one pin: judgement",
    ),
    "spring_fatigue": Basis(
        "inner fibre's stress ≤ c·R_m (MPa); c on straight lines in logarithms from 0.78 at 10³ jumps to 0.53 at 10⁵ "
        "and 0.50 at 10⁶, for safety.jumps",
        "Shigley 10-12 and table 10-10; R_m: EN 10270-1 SM",
    ),
    "axle_fatigue": Basis(
        "stress ≤ min(2/(1/S + 1/R_m), 0.78·R_m)/r (MPa), R_m = yield/0.78; S on a straight line in logarithms from "
        "0.77·R_m at 10³ jumps to min(R_m/2, 700)·min(1, 4.51·R_m^-0.265) at 10⁶, for safety.jumps",
        "Shigley 6-7 to 6-9, 6-12 (Goodman) and figure 6-18",
    ),
    "hub_bearing_load": Basis(
        "|F_arms/2 + F_cam·(1/2 + x/y)| ≤ C0/(safety.bearing_factor·r) (N); x from the leg's middle to the roller's, y "
        "between the bearings' middles, C0 static load rating",
        "statics of two supports; C0: makers' catalogues; factor: SKF, Rolling bearings",
    ),
}


def steel_findings(robot: Robot) -> Iterator[Finding]:
    """Yield a finding for every way in which a bought part could break."""
    case = load_case(robot)
    layout, lateral = case.layout, case.layout.lateral
    names = {
        "leg_axle": "the leg's axle, springs loaded",
        "front_axle": "the front link's axle at release or landing",
        "cam_axle": "the cam's axle, springs loaded",
        "idler_axle": "the idler's axle, springs loaded",
        "spring_pin": "the pin that holds the springs' arms",
        "foot_pin": "the foot's pins",
        "leg_pin": "the leg's pin that the springs' arms push",
    }
    for name, stress in case.steel_stresses_mpa.items():
        allowed = case.bars[name].yield_mpa / case.workshop.safety.metal_factor
        yield stress_finding(f"{name}_strength", names[name], stress, allowed, _stronger(case, name, stress, allowed))
    lever = ROLLER_WASHER_MM + (lateral.cam[1] - lateral.cam[0]) / 2.0
    stress = pin_stress_mpa(layout.drive.cam.peak_contact_n * lever, ROLLER_SCREW_CORE_MM)
    allowed = ROLLER_SCREW_YIELD_MPA / case.workshop.safety.metal_factor
    ways = choose("a narrower", "bought.roller")
    yield stress_finding("roller_screw_strength", "the roller's screw, springs loaded", stress, allowed, ways)
    kept = {"plates": "the plates over its ends", "clips": "its clips", "nuts": "its nut"}[layout.retention]
    clipped = clipped_pins(case.workshop.catalogue, case.workshop.bought)
    pins = "its clips" if clipped else "its split pin"
    for name, what, by in (("axle_retention", "an axle", kept), ("pin_retention", "a pin of the foot", pins)):
        allowed = case.bars["leg_axle" if name == "axle_retention" else "foot_pin"].axial_n
        yield at_most(
            name, case.axial_n, allowed, "N",
            f"a landing sideways loads {what} along its axis with {case.axial_n:.0f} N; {by} may carry {allowed:.0f} N",
            'another bought.retention ("plates", "clips", "nuts"), or a stronger material for the body',
        )  # fmt: skip
    safety, spring = case.workshop.safety, layout.drive.spring
    lasts = spring_jumps(spring.stress_mpa / spring.tensile_mpa)
    rounded = f"{lasts:.2g}"
    allowed = spring_share(safety.jumps) * spring.tensile_mpa
    yield at_most(
        "spring_fatigue", spring.stress_mpa, allowed, "MPa",
        f"the springs' wire: {spring.stress_mpa:.0f} of {allowed:.0f} MPa for {safety.jumps:g} jumps; its life is "
        f"{'infinite' if math.isinf(lasts) else f'about {float(rounded):.0f} jumps'}",
        SOFTER, "warning",  # since nothing breaks at the first jump
    )  # fmt: skip
    limits = {name: pin_limit_mpa(bar.yield_mpa / YIELD_SHARE, safety.jumps) for name, bar in case.bars.items()}
    name, stress = max(case.steel_stresses_mpa.items(), key=lambda item: item[1] / limits[item[0]])
    allowed = limits[name] / safety.load_factor
    yield at_most(
        "axle_fatigue", stress, allowed, "MPa",
        f"the {name.replace('_', ' ')}: {stress:.0f} of {allowed:.0f} MPa for {safety.jumps:g} jumps",
        higher("bought.axle_mm", note="with its bearings") + SOFTER, "warning",
    )  # fmt: skip
    hub, cam = layout.hub_bearing, lateral.cam
    if hub is None:
        return
    (arms, _), push = case.wound_forces_n
    force = bearing_load_n((arms, push), layout.sections.thickness_mm, cam[1] - cam[0], hub)
    allowed = allowed_n(hub, case.workshop)  # an overload dents the races but does not stop the robot
    yield at_most(
        "hub_bearing_load", force, allowed, "N",
        f"the {hub.name} at the cam's side of the leg's hub: {force:.0f} of {allowed:.0f} N, its static rating "
        f"over {case.workshop.safety.bearing_factor:g} and the reserves",
        'bought.leg_bearing = "any" for a stronger one, or "" for none', "warning",
    )  # fmt: skip


def _stronger(case: LoadCase, name: str, stress_mpa: float, allowed_mpa: float) -> Ways:
    """Return what to change for an axle or pin; where it is too weak, with sufficient figures.

    The stress falls with the cube of the diameter; the rate of the spring that is named is on the safe side.
    """
    bar, spring = case.bars[name], case.workshop.stock_spring
    share = max(stress_mpa / allowed_mpa, 1.0)
    needed = bar.yield_mpa * share
    softer = SOFTER
    if spring is not None:  # the design's stiffness counts for springs made to order alone
        rate = spring.rate_nmm_per_deg / share**2  # a softer spring changes cam and gears too, so that less is gained
        softer = (f'a bought.spring of {rate:.1f} N·mm/° at most, or "" for softer ones made to order',)
    if share == 1.0:
        return (*choose("a stronger", "bought.axle"), *higher("bought.axle_mm"), *softer)
    rods = case.workshop.catalogue.rods.values()
    strong = [rod.name for rod in rods if rod.yield_mpa >= needed and not rod.bore_share]
    kind = f'bought.axle of {" or ".join(strong)} with bought.retention = "plates"' if strong else "no shipped rod"
    kind = "no stronger pins" if name in PINS else kind
    return (
        f"{needed:.0f} MPa yield stress ({kind}), {_thicker(case, name, share)}a span between the plates shorter by "
        f"{100.0 * (1.0 - 1.0 / share):.0f} % (a shorter motor, a narrower battery or board)",
        *softer,
    )


def _thicker(case: LoadCase, name: str, share: float) -> str:
    """Return a diameter that bears so many times the stress, of those that can be bought; empty where there is none.

    Screws as axles, which nuts need, have one diameter, clips and clevis pins a few.
    """
    bought, catalogue = case.workshop.bought, case.workshop.catalogue
    least = case.bars[name].diameter_mm * share ** (1.0 / 3.0)
    if bought.retention == "nuts":
        return ""
    if bought.retention == "clips" or clipped_pins(catalogue, bought):
        made = [clip.shaft_mm for clip in catalogue.clips.values()]
    elif name in PINS:
        made = [pin.diameter_mm for pin in catalogue.clevis_pins.values()]
    else:
        return f"bought.axle_mm of {math.ceil(10.0 * least) / 10.0:.1f} or more with its bearings, "
    enough = min((size for size in made if size >= least), default=None)
    return "" if enough is None else f"bought.axle_mm of {enough:g} with its bearings, "
