"""What to order and cut where a bill's line is no article of a shop: rods, standoffs, strips, wire; tools; printing."""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterator

from jumpcad.bundle.arrival import REAMED_MM, scale_range_kg
from jumpcad.bundle.bom import bill_of_materials
from jumpcad.bundle.switch_order import switch_order
from jumpcad.bundle.wiring import wires
from jumpcad.dimensions import STRAP_SLOT_MM, TRAY_MM
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files.markdown import plain
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import Step

ROD_M = (0.33, 0.5, 1.0)
"""Lengths in which shops sell rods of 2 to 4 mm."""
ROD_SHORT_MM = 0.3
"""By which a rod may be shorter; judgement, a saw and a file."""
ROD_ROOM_MM = 0.5
"""By which a rod is thinner than the hole that it passes, at least."""
SAW_MM = 2.0
"""Lost at every cut; judgement."""
STANDOFFS_MM = (20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 60.0)
"""Lengths of M3 standoffs, female to female, polyamide, that shops have."""
STRAP_OVERLAP_MM = 20.0
"""Of a strap, hook on loop; judgement."""
PLUG_ROOM_MM = 0.5
"""By which the body of a USB plug is smaller than its window."""
THREAD_MM = 6.0
"""Of a screw inside its standoff."""
OTHER = (
    "solder, heat-shrink tube 4 mm, 0.1 m, for joints of more than two wires, silicone or lithium grease, alcohol, "
    "adhesive tape, a strip more of foam tape, some more cable ties "
    "2.5 mm wide; two screws M2 x 6 and two nuts M2 if the switch's ears have no thread; one more socket like the "
    "robot's, for a battery beside the robot: keep its leads insulated until they are needed"
)


def order_lines(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on what has to be cut, and how much of it to order."""
    yield from ("", "## Order and cut", "")
    yield from _rods(robot)
    yield from _standoffs(robot)
    yield from _strips(robot)
    yield from _motor(robot)
    total: defaultdict[str, float] = defaultdict(float)
    for *_, colour, length in wires(robot):
        total[colour] += length
    yield from _bearings(robot)
    yield from _screw_axles(robot)
    lengths = ", ".join(f"{colour} {length / 1000.0:.2f} m" for colour, length in sorted(total.items()) if length)
    yield (
        f"- wire AWG 28, silicone: {lengths}, ends included; the bill has each rounded up to 0.1 m: buy 0.2 m more "
        "of each, for cuts that fail and legs that are too short"
    )
    yield (
        "- hook-and-loop strap: hook and loop back to back, no thicker than the bill says, since it passes between the "
        f"lower tray and the front link; cut to {strap_mm(robot):.0f} mm"
    )
    yield from _plug(robot)
    yield from _tape(robot)
    yield from switch_order(robot)
    yield f"- besides: {OTHER}"


def strap_mm(robot: Robot) -> float:
    """Return the length of the battery's strap: around battery and tray through both slots, and the overlap."""
    battery = chosen_parts(robot.workshop).battery
    across, upright = battery.width_mm + 2.0 * STRAP_SLOT_MM[0], battery.height_mm + TRAY_MM
    return 5.0 * math.ceil((2.0 * (across + upright) + STRAP_OVERLAP_MM) / 5.0)


def tool_lines(robot: Robot, steps: list[Step]) -> Iterator[str]:
    """Yield the guide's section on tools."""
    names = sorted({placed.move.tool.name for step in steps for placed in step.placed if placed.move.tool})
    yield from ("", "## Tools", "")
    yield f"- {', '.join(names)}"
    yield (
        f"- drill or reamer {robot.layout.axle_mm + REAMED_MM:g} mm, drill 2.8 mm for a switch's screws with nuts, tap "
        "M3, vice with flat jaws, small flat "
        "screwdriver, side cutters"
    )
    chosen = chosen_parts(robot.workshop)
    charger = ""
    if chosen.regulator is not None:
        adapter = f" and an adapter to {plain(chosen.battery.plug)}" if chosen.battery.plug else ""
        charger = f", LiPo charger with a balance lead{adapter}"
    plug = robot.layout.fittings.usb_size_mm if robot.layout.fittings.usb_mm is not None else None
    body = "" if plug is None else f", plug body at most {plug[0] - PLUG_ROOM_MM:g} x {plug[1] - PLUG_ROOM_MM:g} mm"
    yield (
        "- soldering iron, wire stripper, heat gun or lighter for the tube, multimeter with a 10 A range, two leads "
        "with crocodile clips, computer, "
        f"USB cable with data lines{body}{charger}"
    )
    yield "- on the computer: Python with `pip install esptool mpremote` (firmware/README.md)"
    yield (
        f"- kitchen scale to 1 g or better, up to {scale_range_kg(robot):g} kg; pocket scale to 0.1 g or better, for "
        "the printed parts; caliper, protractor, two AA cells in a holder"
    )
    yield (
        "- for the springs' test: a wooden board, 20 mm or thicker, that the vice holds upright, with its drill and a "
        "nail in it, card, a block with a smooth edge, two wedges below the scale, a drop of oil"
    )
    rod = math.floor(2.0 * (robot.layout.pin_hole.diameter_mm - ROD_ROOM_MM)) / 2.0
    yield (
        f"- rod of at most {rod:g} mm, 60 mm or longer, for the springs' pin through its hole in the left plate; block "
        "of wood that supports the motor while the pinion is pressed on; super glue"
    )
    yield (
        "- cut-off disc, file, fine emery cloth, fine saw, knife, tweezers, 1 m of cord, thin wooden stick, glasses "
        "that "
        "close at the sides"
    )


def print_lines(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on print settings: one row a plate."""
    process, workshop, bed = robot.workshop.process, robot.workshop, robot.workshop.printer.bed_mm
    yield from ("", "## Print settings", "")
    yield (
        f"For every plate: nozzle {workshop.printer.nozzle_mm:g} mm, layers {process.layer_height_mm:g} mm (first "
        f"{process.first_layer_mm:g} mm), lines {process.line_width_mm:g} mm wide, {process.perimeters} perimeters, "
        f"{process.top_layers} top and {process.bottom_layers} bottom layers, {100.0 * process.infill:.0f} % infill "
        f"({process.infill_pattern}), no supports, no brim. Parts lie as they are to be printed: do not tilt them. "
        f"Plates are laid out for a bed of {bed[0]:g} x {bed[1]:g} mm; on another one let the slicer arrange the "
        "parts, "
        "turned about the vertical only. "
        "Mass and strength are computed for these settings."
    )
    yield from ("", "| file | material | parts |", "|---|---|---|")
    for plate in packed(robot.parts, workshop.printer.bed_mm, process.part_spacing_mm):
        parts = Counter(item.part.name for item in plate.items)
        named = ", ".join(f"{count} × {name}" if count > 1 else name for name, count in parts.items())
        yield f"| print/{plate.name}.3mf | {plate.material} | {named} |"
    yield from (
        "",
        "Where jumpcad, the program that wrote this bundle, is installed, print its fit coupon first (`jumpcad coupon "
        "--workshop workshop.toml -o coupon`, with this folder's workshop.toml): it shows which diameters "
        "and clearances your printer makes. It is tested with the rods, bearings, motor and screws of this order "
        "(coupon.md has the list): order, print the coupon, test it when they are there, and then print the robot. "
        "Without it the fits are tried by hand (When things "
        "arrive). "
        "Put the seam of the "
        "cam where its drop is, not on the lift. Break the first layer's edge in bores.",
    )


def weigh_lines(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on what to weigh, with the table of a workshop to write it into."""
    yield from ("", "## Weigh and write back", "")
    yield (
        "Weigh every printed part to 0.1 g, and write the grams of one piece into a copy of this folder's "
        "workshop.toml, in place of its table `[mass.weighed_g]`. `jumpcad build design.toml --workshop "
        "my-workshop.toml -o weighed`, with the copy's name, then computes the jump with them. Computed here: "
        f"{1000.0 * robot.mass_kg:.1f} g for the whole robot."
    )
    yield from ("", "```toml", "[mass.weighed_g]")
    yield from (f"{part.name} = {1000.0 * part.mass_kg:.2f}" for part in robot.parts)
    yield "```"


def _rods(robot: Robot) -> Iterator[str]:
    kinds = {rod.description for rod in robot.workshop.catalogue.rods.values()}
    for item in bill_of_materials(robot).items:
        found = re.fullmatch(r"(.*) ([\d.]+) x ([\d.]+) mm(, grooves.*)?", item.name)
        if found is None or found[1] not in kinds:
            continue
        length = float(found[3])
        needed = item.quantity * (length + SAW_MM)
        stock = next((f"{m:g}" for m in ROD_M if 1000.0 * m >= needed), f"{math.ceil(needed / 1000.0):g}")
        yield (
            f"- {plain(found[1])} {found[2]} mm: {item.quantity} pieces of {length:.1f} mm, +0 / -{ROD_SHORT_MM:g} mm, "
            f"ends square and deburred{found[4] or ''}; cut from a rod of {stock} m, ground, h6 to h9. Cut steel with "
            "a cut-off disc, wear glasses: sparks and broken pieces fly. A rod that does not enter a bearing: polish "
            "it with fine emery cloth until it does, do not press"
        )


def _standoffs(robot: Robot) -> Iterator[str]:
    for item in bill_of_materials(robot).items:
        if found := re.match(r"standoff (\S+) x ([\d.]+) mm", item.name):
            length = float(found[2])
            stock = next((one for one in STANDOFFS_MM if one >= length), math.ceil(length))
            yield (
                f"- standoffs {found[1]}, female to female, polyamide: {item.quantity} of {stock:g} mm, cut to "
                f"{length:.1f} mm, +0 / -0.1 mm and all equal; tap them again where less than {THREAD_MM:g} mm of "
                "thread is left"
            )


def _bearings(robot: Robot) -> Iterator[str]:
    """Yield the bearings with their dimensions: unshielded ones of the same name are narrower."""
    billed = {item.name for item in bill_of_materials(robot).items}
    listed = "; ".join(
        f"{plain(one.name)}, {one.bore_mm:g} x {one.outer_mm:g} x {one.width_mm:g} mm"
        for one in robot.workshop.catalogue.bearings.values()
        if f"ball bearing {one.name}" in billed
    )
    if listed:
        yield f"- ball bearings with two metal shields (suffix ZZ; open ones may be narrower): {listed}"


def _screw_axles(robot: Robot) -> Iterator[str]:
    """Yield where screws that serve as axles are found: they are longer than the norm's longest of their size."""
    if robot.layout.retention == "nuts":
        yield (
            "- screws M3 as axles: ISO 4762 lists M3 up to 30 mm; longer ones of the same dimensions are sold as "
            "ISO 4762 or DIN 912, strength class 12.9. Their smooth shank is what turns: not threaded up to the head"
        )
        low, high = robot.layout.lateral.outside
        yield (
            f"- {len(robot.layout.axles) + 1} rods of {robot.layout.axle_mm:g} mm, {high - low:.0f} mm long, any "
            "material, straight and deburred: they try the fits, and stand in for the axles until the screws come"
        )


def _plug(robot: Robot) -> Iterator[str]:
    """Yield which half of a plug is meant, and what to do where its poles do not meet the battery's."""
    plug = chosen_parts(robot.workshop).components.get("plug")
    if plug is not None:
        yield (
            f"- {plain(plug.description)}: the half that mates with the battery's plug. Where plus does not meet plus, "
            "exchange the contacts of the robot's half, or solder its leads the other way round; not the battery's"
        )


def _tape(robot: Robot) -> Iterator[str]:
    """Yield the pieces of foam tape under the boards."""
    boards = chosen_parts(robot.workshop).boards.items()
    pieces = ", ".join(f"{board.length_mm:g} x {board.width_mm:g} mm ({role})" for role, board in boards)
    yield f"- double-sided foam tape 1 mm thick: {pieces}; cut out under pads that are soldered from below"


def _strips(robot: Robot) -> Iterator[str]:
    """Yield each kind of strip with the pieces that are cut from it."""
    pieces: defaultdict[str, list[tuple[int, float, float]]] = defaultdict(list)
    for item in bill_of_materials(robot).items:
        if found := re.fullmatch(r"(.*), cut ([\d.]+) x ([\d.]+) mm", item.name):
            pieces[found[1]].append((item.quantity, float(found[2]), float(found[3])))
    for name, cut in pieces.items():
        listed = ", ".join(f"{count} of {one:.1f} x {other:.1f} mm" for count, one, other in cut)
        length = sum(count * (max(one, other) + SAW_MM) for count, one, other in cut)
        wide = max(min(one, other) for _, one, other in cut)
        enough = f"{10.0 * math.ceil(length / 10.0):.0f} mm of it, {wide:.1f} mm wide or wider"
        yield f"- {plain(name)}: {listed}; order {enough}"


def _motor(robot: Robot) -> Iterator[str]:
    """Yield what to compare before the motor is ordered: shops' names for these motors are no articles."""
    motor = robot.layout.drive.train.motor
    sure = {"stated": "as its source states", "derived": "derived", "memory": "from memory"}[motor.confidence]
    yield (
        f"- gear motor: {plain(motor.article or motor.name)}. Compare before you order: {motor.ratio:.0f}:1, "
        f"{motor.voltage_v:g} V, {motor.no_load_rpm:.0f} rpm, {1000.0 * motor.no_load_current_a:.0f} mA without load, "
        f"{motor.stall_torque_nm:.3f} N·m and {motor.stall_current_a:g} A stalled, shaft {motor.shaft_mm:g} mm with a "
        f"flat, {motor.shaft_length_mm:g} mm long ({sure}: {plain(motor.source)}). Ratio, voltage, shaft and gearbox "
        "must agree; speed and torque may be 10 % off "
        "(judgement). An extended shaft at its back: cut that off with the disc before anything is soldered, the stub "
        "held in pliers, the motor wrapped against filings"
    )
