"""What to order and cut where a bill's line is no article of a shop: rods, standoffs, strips, wire, the switch."""

import math
import re
from collections import defaultdict
from typing import Any

import numpy as np

from jumpcad.building.bom import Bill
from jumpcad.dimensions import AXLE_END_PLAY_MM, STRAP_SLOT_MM, TRAY_MM
from jumpcad.exporters.threemf import print_plates
from jumpcad.robot.cage.place import SOCKET_MM, Cage, hoop_mm
from jumpcad.robot.electronics.fittings import SWITCH_SLOT_MM
from jumpcad.robot.foot.pads import printed_pads
from jumpcad.robot.leg.place import END_PLAY_MM
from jumpcad.robot.robot import Robot
from jumpcad.strength.axles import SCREW_THREAD_MM

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
CAGE_ROD_M = 1.0
"""Length in which shops sell rods for cages, or a multiple of it; judgement."""
STRAP_OVERLAP_MM = 20.0
"""Of a strap, hook on loop; judgement."""
STEEL_FROM_G_CM3 = 7.0
"""Rods that are as dense or denser are of steel; aluminium has 2.8."""
NUT_THREAD_MM = 18.0
"""Thread of M3 from the end, without its run-out (ISO 4762): it must begin before the lock nut."""
SLIDER_MM, SLIDER_REACHES_MM = 1.5, 5.0
"""Of a switch's slider outside the plate, for a fingertip (judgement), and out of the ears of SS-12F15 G5."""
ROOM_MM = 0.5
"""By which a rod is thinner than the hole that it passes, and the body of a USB plug smaller than its window."""


def order_values(robot: Robot, bill: Bill) -> dict[str, Any]:
    """Return what is printed, cut, bought and used (mm, m, g, A), by the names that templates use."""
    workshop, layout, chosen = robot.workshop, robot.layout, robot.layout.electronics
    pads = printed_pads(robot.hardware, workshop)
    usb = layout.fittings.usb_size_mm if layout.fittings.usb_mm is not None else None
    return {
        "plates": [plate.name for plate in print_plates(robot)],
        "pads": {
            kind: sum(1000.0 * one.item.mass_kg for one in pads if one.pad.description == kind)
            for kind in sorted({one.pad.description for one in pads})
        },
        "rods": _rods(robot, bill), "standoffs": _standoffs(bill), "strips": _strips(bill), "bars": _bars(robot, bill),
        "cage": _cage(robot), "there": "".join(f"|{item.name}" for item in bill.items if not item.ordered),
        "strap_mm": strap_mm(robot), "boards": chosen.boards, "slide_switch": _switch(robot),
        "screw_axles": _screw_axles(robot) if layout.retention == "nuts" else None,
        "pin_rod_mm": math.floor(2.0 * (layout.pin_hole.diameter_mm - ROOM_MM)) / 2.0,
        "usb_body_mm": usb and tuple(side - ROOM_MM for side in usb),
    }  # fmt: skip


def _cage(robot: Robot) -> dict[str, Any] | None:
    """Return the cage's rod, the lengths to cut by hoop or bow and those of bars (mm), and how many rods give them.

    None without a cage.
    """
    cage = robot.layout.of(Cage)
    if cage is None:
        return None
    cut = {arc.name.removeprefix("cage_").replace("_", " "): round(arc.length_mm) for arc in cage.arcs}
    rod_m = CAGE_ROD_M * math.ceil(max(cut.values()) / 1000.0 / CAGE_ROD_M)
    left: list[float] = []  # of each rod, the longest pieces cut first (mm)
    for length in sorted(cut.values(), reverse=True):
        index = next((at for at, rest in enumerate(left) if rest >= length), len(left))
        left[index:index] = [1000.0 * rod_m] * (index == len(left))
        left[index] -= length + SAW_MM
    return {
        "rod": cage.rod, "cut": cut, "rods": len(left), "rod_m": rod_m,
        "bar_mm": {
            part.name.removeprefix("cage_bar_"): float(np.ptp(part.shape.bounds_mm[:, 0]))
            for part in robot.parts
            if part.name.startswith("cage_bar_")
        },
        "hoops": {  # radius of the rod's middle; outside: across, and over the lower edge of the bar (mm)
            bar.name.removeprefix("cage_bar_"): (arc.radius_mm, *hoop_mm(cage, bar, arc))
            for bar, arc in zip(cage.bars, cage.arcs, strict=False)
        },
        "bow": any(bar.post_mm for bar in cage.bars),
        "socket_mm": SOCKET_MM,
        "push_n": cage.rod.bending_nmm2 / cage.tightest_mm**2,
    }  # fmt: skip


def strap_mm(robot: Robot) -> float:
    """Return the length of the battery's strap: around battery and tray through both slots, and the overlap."""
    battery = robot.layout.electronics.battery
    across, upright = battery.width_mm + 2.0 * STRAP_SLOT_MM[0], battery.height_mm + TRAY_MM
    return 5.0 * math.ceil((2.0 * (across + upright) + STRAP_OVERLAP_MM) / 5.0)


def _rods(robot: Robot, bill: Bill) -> list[dict[str, Any]]:
    """Return each kind of rod with its pieces (count, mm), what they are cut from (m), and grooves for clips."""
    rods = {rod.description: rod for rod in robot.workshop.catalogue.rods.values()}
    kinds = "|".join(map(re.escape, rods))
    pieces: defaultdict[tuple[str, str, str], list[tuple[int, float]]] = defaultdict(list)
    for item in bill.items:
        if found := re.fullmatch(rf"({kinds}) ([\d.]+) x ([\d.]+) mm(, grooves .*)?", item.name):
            pieces[found[1], found[2], found[4] or ""].append((item.quantity, float(found[3])))
    listed = []
    for (kind, diameter, grooves), cut in pieces.items():
        needed = sum(count * (length + SAW_MM) for count, length in cut) / 1000.0
        row = {
            "kind": f"{kind} {diameter} mm", "cut": cut, "short_mm": ROD_SHORT_MM,
            "from_m": next((metres for metres in ROD_M if metres >= needed), float(math.ceil(needed))),
            "steel": rods[kind].density_g_cm3 >= STEEL_FROM_G_CM3, "tube": rods[kind].bore_share > 0.0,
            "grooves": grooves,
        }  # fmt: skip
        if grooves:
            across, wide, end = map(float, re.findall(r"[\d.]+", grooves))
            row["groove_mm"], row["groove_off_mm"] = (across, wide), GROOVE_OFF_MM
            row["apart"] = [(count, length - 2.0 * (end + wide)) for count, length in cut]
        listed.append(row)
    return listed


def _standoffs(bill: Bill) -> list[tuple[str, int, float, float]]:
    """Return size, count, length in shops and length to cut (mm) of each kind."""
    found = ((item, re.match(r"standoff (\S+) x ([\d.]+) mm", item.name)) for item in bill.items)
    cut = [(one[1], item.quantity, float(one[2])) for item, one in found if one]
    stock = [next((one for one in STANDOFFS_MM if one >= mm), float(math.ceil(mm))) for *_, mm in cut]
    return [(size, count, shop, mm) for (size, count, mm), shop in zip(cut, stock, strict=True)]


def _strips(bill: Bill) -> list[dict[str, Any]]:
    """Return each kind of strip with its pieces, and how long and wide one must be (mm) to give them."""
    pieces: defaultdict[str, list[tuple[int, float, float]]] = defaultdict(list)
    for item in bill.items:
        if found := re.fullmatch(r"(.*), cut ([\d.]+) x ([\d.]+) mm", item.name):
            pieces[found[1]].append((item.quantity, float(found[2]), float(found[3])))
    return [
        {
            "name": name,
            "cut": cut,
            "long_mm": 10.0 * math.ceil(sum(count * (max(a, b) + SAW_MM) for count, a, b in cut) / 10.0),
            "wide_mm": max(min(a, b) for _, a, b in cut),
        }
        for name, cut in pieces.items()
    ]


def _bars(robot: Robot, bill: Bill) -> dict[str, Any] | None:
    """Return the bars of legs with printed ends: what is cut, and how far apart the eyes of the glued legs are (mm)."""
    layout, bar = robot.layout, robot.layout.leg_bar
    if bar is None:
        return None
    pattern = rf"{re.escape(bar.description)}, cut ([\d.]+) mm long"
    named = ((item, re.fullmatch(pattern, item.name)) for item in bill.items)
    cut = [(item.quantity, float(found[1])) for item, found in named if found]
    return {
        "kind": bar.description,
        "cut": cut,
        "long_mm": 10.0 * math.ceil(sum(count * (length + SAW_MM) for count, length in cut) / 10.0),
        "off_mm": (END_PLAY_MM, BAR_SHORT_MM),
        "eyes_mm": layout.design.links_mm[:2],
        "eyes_off_mm": EYES_OFF_MM,
    }


def _screw_axles(robot: Robot) -> dict[str, Any]:
    """Return the rods that stand in for screws as axles, and longer screws to be cut where links would turn on thread.

    Lengths in mm; `longer` is None where the bill's screws are smooth under leg and front link.
    """
    lateral, stock = robot.layout.lateral, robot.workshop.catalogue.screws["M3 long"]
    low, high = lateral.outside
    (axle,) = (item for item in robot.hardware if item.name == "leg_axle")
    length = float(np.ptp(axle.shape.bounds_mm[:, 2])) - stock.cylinder_head_height_mm
    turns = high - lateral.leg[0]
    enough = (one for one in stock.lengths_mm if turns <= one - SCREW_THREAD_MM and one - NUT_THREAD_MM <= high - low)
    return {
        "rods": len(robot.layout.axles) + 1, "rod_mm": high - low, "length_mm": length, "turns_mm": turns,
        "longer_mm": next(enough, None) if length - SCREW_THREAD_MM < turns else None,
    }  # fmt: skip


def _switch(robot: Robot) -> dict[str, Any] | None:
    """Return what a slide switch must be like (mm, A), and whether its slider is long enough; None without one."""
    fittings, lateral = robot.layout.fittings, robot.layout.lateral
    if fittings.switch is None or fittings.switch_mm is None:
        return None
    plate = lateral.inside[0] - lateral.outside[0]
    supply, most_nm = robot.supply, robot.workshop.safety.motor_torque_max_nm
    blocked_a = supply.driven(robot.layout.drive.train.motor, supply.full_v, most_nm).stall_current_a
    return {
        "article": fittings.switch, "holes_mm": [2.0 * end for end in SWITCH_SLOT_MM], "out_mm": plate + SLIDER_MM,
        "blocked_a": blocked_a, "reaches": plate + SLIDER_MM <= SLIDER_REACHES_MM,
    }  # fmt: skip
