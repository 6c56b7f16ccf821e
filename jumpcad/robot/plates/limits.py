"""Strength of the plates around axles and pins (N, mm, MPa)."""

from jumpcad.findings import Basis, Finding, at_most, higher
from jumpcad.robot.load_case import IN_PLANE, load_case, stress_finding
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import engravable

BASIS = {
    "plate_seat": Basis(
        f"F/(d·t) ≤ the body's {IN_PLANE}; F what the more loaded plate carries of an axle or the springs' pin, a "
        "simple beam loaded as for `leg_axle_strength` and its like, d axle, t depth of its seat in one plate",
        "statics of two supports; bearing pressure (Shigley 8-12)",
    ),
}


def seat_finding(robot: Robot) -> list[Finding]:
    """Return `plate_seat`, of the plate that an axle or pin loads most."""
    case = load_case(robot)
    plate = case.layout.lateral.left_plate
    seat, longer = plate[1] - plate[0] - case.layout.floor_mm, {"leg_axle": case.layout.boss_mm}
    worst = max(beam.plate_load_n / (seat + longer.get(name, 0.0)) for name, beam in case.beams.items())
    allowable = case.workshop.material("body").strength_in_plane_mpa / case.workshop.safety.printed_factor
    what, stress = "plates under axles and pins", worst / case.layout.axle_mm
    return [stress_finding("plate_seat", what, stress, allowable, higher("body.plate_mm"), "plate")]


ENGRAVING_BASIS = {"engraving": Basis("letters of the name that the font lacks = 0", "character map of the font")}


def engraving_findings(robot: Robot) -> list[Finding]:
    """Return `engraving` for a name with letters that cannot be engraved; they are left out."""
    lacking = "".join(dict.fromkeys(letter for letter in robot.name if not engravable(letter)))
    if not lacking:
        return []
    return [
        at_most(
            "engraving", len(lacking), 0, "letters",
            f"the engraving's font lacks {len(lacking)} of the letters, {lacking!r}: left out on the plates of "
            f"{robot.name!r}",
            "use Latin, Greek or Cyrillic letters if the plates must show the whole name", "warning",
        )
    ]  # fmt: skip
