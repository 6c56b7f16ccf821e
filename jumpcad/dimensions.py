"""Clearances, fixed sizes and constants that several packages share, each with its source (mm unless named otherwise).

Values that a user may want to change are in the workshop instead. "Judgement" marks a value without a source.
"""

GRAVITY_M_S2 = 9.81
"""Rounded standard gravity (ISO 80000-3: 9.80665), as in the published study."""

GAP_MM = 0.5
"""Axial gap between parts that move past each other; judgement: three times the spread of a first layer."""
BUSHING_PLAY_MM = 0.15
"""Between the leg or a plate and the end of a bushing on the leg's axle; judgement: the leg then has 0.6 mm in all,
more than the spread of three printed lengths, and moves by half of that from its middle."""
CLEAR_MM = 0.8
"""Between things that do not touch; judgement: twice the play of a loose fit plus assembly error."""
SPACER_RADIUS_MM = 3.2
"""Outside of the printed tubes that hold things apart on the axles; judgement: a wall of 1.5 mm on a 3 mm axle."""

ROLLER_WASHER_MM = 0.5
"""Washer between lever and roller (ISO 7089 M3)."""
ROLLER_HEAD_MM = 1.65
"""Head of the button screw that holds the roller (ISO 7380-1 M3)."""
STANDOFF_RADIUS_MM = 3.2
"""Circumscribed circle of an M3 hexagon standoff 5.5 mm across flats (ISO 4032 hexagon)."""

TRAY_MM = 1.6
"""Thickness of the electronics trays; judgement: eight layers of 0.2 mm."""
TAB_MM = 10.0
"""Length along x of a tray's tab in its slot; judgement."""
TRAY_LENGTH_MIN_MM = 30.0
"""Least length of a tray: its two tabs, 1 mm to either end, and 8 mm between them; judgement."""
STRAP_SLOT_MM = (2.0, 11.0)
"""Slots beside the battery for its strap, across the robot and along it; judgement: hook-and-loop tape 10 mm wide."""
TIE_SLOT_MM = (1.8, 4.0)
"""Slots for a cable tie 2.5 mm wide and 1.1 mm thick; judgement: its head turns it."""
STRAP_EDGE_MM = 2.0
"""From a strap's slot to the plate; judgement: a wall and the tray's play."""
SOCKET_WALL_MM = 1.6
"""Wall of the motor's socket; judgement: four lines of a 0.4 mm nozzle."""
SOCKET_PLAY_MM = 0.3
"""Between the motor and its socket where room is kept for both; judgement: more than a sliding fit."""
MOTOR_CAP_MM = 2.4
"""Thickness of the cap that holds the motor in its socket; judgement: an M2 head sunk, 0.8 mm below it."""
TERMINALS_MM = 0.5
"""Between the motor's rear face and the plate, in which a window lets its terminals through; judgement."""
MOTOR_CLAMP_MM = 0.2
"""Between the socket's rim and the cap, which bears on the motor: the screws pull it down, so that the motor has no
play. Judgement: one printed layer; closing the gap bends the catalogue's caps by 1 %."""
MOTOR_RIM_MM = 1.0
"""Width of the socket's floor at either side, under the motor's rear end; judgement: its terminals stay free."""
CAP_HEAD_MM = 4.0
"""Counterbore in the motor's cap for an M2 head of 3.8 mm (ISO 14580)."""
CAP_EAR_MM = 5.6
"""How far the ears for the motor cap's screws reach beyond the socket at least: the counterbore between two walls of
0.8 mm, two lines of a 0.4 mm nozzle."""
TOE_TIP_WIDTH_MM = 5.0
"""Width of a toe's tip; judgement: wider than high, so that a landing does not turn it over."""
OVERHANG_LINES = 2.0
"""Lines by which an underside may stand out without support; judgement: the first holds the second."""
PAD_WALL_MM = 3.0
"""Material around an axle in the body plates; judgement: 2.5 recommended walls (`fits.wall_mm`)."""
AXLE_END_RADIUS_MM = 3.6
"""Room around an axle's end for clip, screw head or nut: half of a clip of 6.3 mm (DIN 6799), and the plate's play."""
AXLE_FLOOR_MM = 0.8
"""What closes the plates' bores over the axles' ends, outside; judgement: four layers of 0.2 mm."""
AXLE_BOSS_MM = 1.2
"""By how much the plates are thicker, inside, around the leg's axle, whose seat bears the most; judgement."""
AXLE_END_PLAY_MM = 0.2
"""Between an axle's end and what keeps it, and between a clip or nut and its seat; judgement: rods cut by hand."""
STANDOFF_PAD_MM = 9.0
"""Diameter of the plates' pads under the standoffs' screws: a head of 5.7 mm (ISO 7380-1 M3) and a wall."""
STOP_PAD_MM = 8.0
"""Length of the rest stop's pad and bar, along the leg; judgement: between the springs and the folded foot."""
STOP_SEAT_MM = 0.6
"""Depth of that pad's seat in the bar; judgement: it keeps a strip from creeping, and the blow from peeling it."""
STOP_EDGE_MM = 2.5
"""Material of the body plates around the rest stop's tabs; judgement, as around the trays'."""
PIN_HOLE_EDGE_MM = 2.0
"""Material of the left plate around the hole for the leg's springs' pin; judgement: five lines of a 0.4 mm nozzle."""
SPRING_BOSS_MM, SPRING_BOSS_MIN_MM = 4.0, 1.2
"""Height of the boss on the right plate in which the springs' pin stands, where there is room beside the springs, and
the least that is of use; judgement: with the plate two diameters of a 3 mm pin, which then leans by less than 5 degrees
in a sliding fit."""
SPRING_BOSS_WALL_MM = 2.0
"""Wall of that boss around the pin, the fit included; judgement."""
LEVER_EYE_RADIUS_MM = 4.5
"""Of the lever's eye for the roller's screw: a washer of 7 mm (ISO 7089 M3) and an edge of 1 mm."""

DOG_PLAY_MIN_DEG = 12.0
"""Least free play of the cam's dog. With 1 to 8° the cam gains speed and meets the play's end with the roller still on
its corner, which is worse than none (contact simulations of three designs: 6 to 8° with a sharp corner, 8 to 11° with
one rounded by 0.8 mm); judgement above that."""

MESH_FOLDER = "meshes"
"""Folder of the meshes beside a URDF file; MJCF and SDF files see it as `MESHES_FROM_BESIDE`."""
MESHES_FROM_BESIDE = f"../urdf/{MESH_FOLDER}"
"""The same folder, seen from the folder of another format."""

KEY_UNITS = {
    "nmm_per_deg": "N·mm/°", "nm_per_rad": "N·m/rad", "n_per_mm": "N/mm", "kg_m2": "kg·m²", "g_cm3": "g/cm³",
    "eur_per_kg": "EUR/kg", "area_mm2": "mm²", "mm": "mm", "deg": "°", "mpa": "MPa", "nm": "N·m", "n": "N", "g": "g",
    "c": "°C", "v": "V", "a": "A", "ma": "mA", "mah": "mAh", "ohm": "Ω", "rpm": "1/min", "uf": "µF", "eur": "EUR",
    "deg_s": "°/s", "m_s": "m/s", "kg": "kg", "j": "J", "s": "s", "m": "m",
}  # fmt: skip
"""Units of values by the end of their keys, the longest ends first."""


def unit_of_key(key: str) -> str:
    """Return the unit of a value by the end of its key; empty if it says none."""
    return next((unit for end, unit in KEY_UNITS.items() if key.endswith(f"_{end}")), "")


def counted(number: int, noun: str) -> str:
    """Return a number and its noun, in the plural unless it is one: 1 design, 2 designs, 0 designs.

    The noun is the first word; what follows it stays: `counted(2, "design of the space")`.
    """
    first, space, rest = noun.partition(" ")
    return f"{number} {first}{'' if number == 1 else 's'}{space}{rest}"
