"""What to order and cut where a bill's line is no article of a shop: rods, standoffs, strips, wire; printing."""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from jumpcad.bundle.article_order import bearings_order, motor_order, plug_order, screw_axles_order, tape_order
from jumpcad.bundle.bom import bill_of_materials
from jumpcad.bundle.printed_pads import pad_rows, pads_order
from jumpcad.bundle.switch_order import switch_order
from jumpcad.bundle.wiring import wires
from jumpcad.catalogue import Rod
from jumpcad.dimensions import AXLE_END_PLAY_MM, STRAP_SLOT_MM, TRAY_MM
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files.markdown import plain
from jumpcad.layout.leg_bars import END_PLAY_MM
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot

ROD_M = (0.33, 0.5, 1.0)
"""Lengths in which shops sell rods of 2 to 4 mm."""
ROD_SHORT_MM = 0.3
"""By which a rod may be shorter; judgement, a saw and a file."""
SAW_MM = 2.0
"""Lost at every cut; judgement."""
GROOVE_OFF_MM = AXLE_END_PLAY_MM
"""By which the distance of a rod's two grooves may be off: half of the clips' play along the rod."""
BAR_SHORT_MM = 0.5
"""By which a leg's bar may be shorter; judgement: little of the sockets, which are 8 mm deep or deeper."""
EYES_OFF_MM = 0.2
"""By which the eyes of a glued leg may be off; judgement: a caliper and two rods."""
STANDOFFS_MM = (20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 60.0)
"""Lengths of M3 standoffs, female to female, polyamide, that shops have."""
STRAP_OVERLAP_MM = 20.0
"""Of a strap, hook on loop; judgement."""
STEEL_FROM_G_CM3 = 7.0
"""Rods that are as dense or denser are of steel; aluminium has 2.8."""
THREAD_MM = 6.0
"""Of a screw inside its standoff."""
OTHER = (
    "solder, heat-shrink tube 4 mm, 0.1 m, for joints of more than two wires, silicone or lithium grease, alcohol, "
    "adhesive tape, a strip more of foam tape, some more cable ties 2.5 mm wide; one more socket like the robot's, for "
    "a battery beside the robot: keep its leads insulated until they are needed"
)


def order_lines(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on what has to be cut, and how much of it to order."""
    yield from ("", "## Order and cut", "")
    yield from _rods(robot)
    yield from _standoffs(robot)
    yield from _strips(robot)
    yield from _bars(robot)
    yield from pads_order(robot)
    yield from motor_order(robot)
    total: defaultdict[str, float] = defaultdict(float)
    for *_, colour, length in wires(robot):
        total[colour] += length
    yield from bearings_order(robot)
    yield from screw_axles_order(robot)
    lengths = ", ".join(f"{colour} {length / 1000.0:.2f} m" for colour, length in sorted(total.items()) if length)
    yield (
        f"- wire AWG 28, silicone: {lengths}, ends included; the bill has each rounded up to 0.1 m: buy 0.2 m more "
        "of each, for cuts that fail and legs that are too short"
    )
    yield (
        "- hook-and-loop strap: hook and loop back to back, no thicker than the bill says, since it passes between the "
        f"lower tray and the front link; cut to {strap_mm(robot):.0f} mm"
    )
    yield from plug_order(robot)
    yield from tape_order(robot)
    yield from switch_order(robot)
    yield f"- besides: {OTHER}"


def strap_mm(robot: Robot) -> float:
    """Return the length of the battery's strap: around battery and tray through both slots, and the overlap."""
    battery = chosen_parts(robot.workshop).battery
    across, upright = battery.width_mm + 2.0 * STRAP_SLOT_MM[0], battery.height_mm + TRAY_MM
    return 5.0 * math.ceil((2.0 * (across + upright) + STRAP_OVERLAP_MM) / 5.0)


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
    yield from pad_rows(robot)
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
    """Yield each kind of rod with its pieces, and how grooves for clips are cut into them."""
    rods = {rod.description: rod for rod in robot.workshop.catalogue.rods.values()}
    kinds = "|".join(map(re.escape, rods))
    pieces: defaultdict[tuple[str, str, str], list[tuple[int, float]]] = defaultdict(list)
    for item in bill_of_materials(robot).items:
        if found := re.fullmatch(rf"({kinds}) ([\d.]+) x ([\d.]+) mm(, grooves .*)?", item.name):
            pieces[found[1], found[2], found[4] or ""].append((item.quantity, float(found[3])))
    for (kind, diameter, grooves), cut in pieces.items():
        needed = sum(count * (length + SAW_MM) for count, length in cut)
        stock = next((f"{m:g}" for m in ROD_M if 1000.0 * m >= needed), f"{math.ceil(needed / 1000.0):g}")
        listed = ", ".join(f"{count} piece{'s' * (count > 1)} of {length:.1f} mm" for count, length in cut)
        yield (
            f"- {plain(kind)} {diameter} mm: {listed}, +0 / -{ROD_SHORT_MM:g} mm, "
            f"ends square and deburred{grooves}; cut from {_stock(rods[kind], stock)}. One that does not enter a "
            "bearing: polish it with fine emery cloth until it does, do not press"
        )
        if grooves:
            yield _grooves(grooves, cut)


def _stock(rod: Rod, metres: str) -> str:
    """Return what rods are cut from, and how."""
    steel = rod.density_g_cm3 >= STEEL_FROM_G_CM3
    if rod.bore_share > 0.0:
        sold = f"a tube of {metres} m, its outside no thicker than said: measure it, many tubes are"
    else:
        sold = f"a rod of {metres} m, {'ground' if steel else 'drawn or ground'}, h6 to h9"
    if not steel:
        return f"{sold}. Saw it with a fine saw"
    return f"{sold}. Cut steel with a cut-off disc, wear glasses: sparks and broken pieces fly"


def _grooves(grooves: str, cut: Sequence[tuple[int, float]]) -> str:
    """Return how the grooves of cut rods (count, length) are made, from their words in the article."""
    diameter, width, end = map(float, re.findall(r"[\d.]+", grooves))
    apart = ", ".join(f"{length - 2.0 * (end + width):.1f} mm ({count} ×)" for count, length in cut)
    return (
        f"- the grooves: two a rod, {2 * sum(count for count, _ in cut)} in all, {diameter:g} mm in diameter and "
        f"{width:g} mm wide (DIN 6799), ±{GROOVE_OFF_MM:g} mm between the inner edges of a rod's two: {apart}. Order "
        "the rods with them from somebody with a lathe: a parting tool cuts one in a minute. At home (judgement, "
        "nobody has tried it for this robot): the rod turns in the chuck of a drill that is clamped down, a cut-off "
        f"disc or a file thinner than {width:g} mm goes in squarely, held against a stop, a little at a time, and the "
        "caliper's edges measure the bottom; glasses. Good is a groove onto which a clip snaps, in which it turns, and "
        "off which it cannot be pulled along the rod. Practise on the rod's waste"
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


def _bars(robot: Robot) -> Iterator[str]:
    """Yield the bars of legs with printed ends: what is cut, how, and how far apart the eyes of the glued legs are."""
    layout, bar = robot.layout, robot.layout.leg_bar
    if bar is None:
        return
    name = re.escape(bar.description)
    cut = [
        (item.quantity, float(found[1]))
        for item in bill_of_materials(robot).items
        if (found := re.fullmatch(rf"{name}, cut ([\d.]+) mm long", item.name))
    ]
    listed = ", ".join(f"{count} of {length:.1f} mm" for count, length in cut)
    needed = 10.0 * math.ceil(sum(count * (length + SAW_MM) for count, length in cut) / 10.0)
    yield (
        f"- {plain(bar.description)}, for main leg and front link: {listed}, +{END_PLAY_MM:g} / -{BAR_SHORT_MM:g} mm; "
        f"order {needed:.0f} mm of it or more. Saw it with the fine saw, tape around the cut, wet; its dust and "
        "splinters harm lungs and skin: mask (FFP2), gloves, glasses, wipe up wet"
    )
    yield (
        "- epoxy, two components, that can be moved for 20 min or longer, 5 g, for the bars. The sockets are a little "
        "deeper than the bars: it is the distance of the eyes that counts when they are glued, middle to middle: main "
        f"leg, hub to ankle, {layout.design.l2_mm:.1f} mm; front link {layout.design.l3_mm:.1f} mm; both "
        f"±{EYES_OFF_MM:g} mm (judgement)"
    )
