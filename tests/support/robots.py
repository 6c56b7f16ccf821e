"""Robots for the tests of several packages."""

from collections import defaultdict

from jumpcad.building import build
from jumpcad.design import Design, load_design
from jumpcad.mechanism.mass import combined
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Body
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.parts.part import Drawing, Part, Placement, lying_on_left, lying_on_right, lying_stack
from jumpcad.parts.purchased import bought
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import disc, hole, rectangle, stadium, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import in_metres
from jumpcad.workshop import load_workshop

DENSITY_G_CM3 = 1.24

FOLDED = Design.from_vector(
    [100.0, 0.998740230633252, 0.5, 1.0927486889246836, 0.8, 70.0, 29.937154821580194, 15.833474247591226]
)
"""A design whose loaded springs fold front link and foot nearly flat."""


def make_small_robot(name: str = "kenan-2.0") -> Robot:
    """Return a robot of a few printed and bought parts, asymmetric on purpose; its bodies follow from its parts."""
    design = load_design(name)
    capsules = capsule_robot(design)
    l1, l2, l3, l4 = design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm

    def bar(length: float) -> tuple[float, float, object]:
        return (-3.0, 3.0, stadium((0.0, 0.0), (length, 0.0), 7.9) - union([hole(3.2), hole(3.2, (length, 0.0))]))

    plate = rectangle((l1 + 14.0, 26.0), (0.0, 8.0), 3.0) - union([hole(3.2, (x, 0.0)) for x in (-l1 / 2, l1 / 2)])
    drawings = []
    for title, role, body, slabs, face in (
        ("body_plate_left", "body", BODY, [(18.0, 21.0, plate)], "left"),
        (
            "body_plate_right",
            "body",
            BODY,
            [(-21.0, -18.0, plate), (-18.4, -9.0, rectangle((14, 16), (5, 12)))],
            "right",
        ),
        ("main_leg", "links", MAIN_LEG, [bar(l2), (2.9, 6.0, disc(8.0))], "left"),
        ("front_link", "links", FRONT_LINK, [bar(l3)], "left"),
        (
            "foot",
            "links",
            FOOT,
            [bar(l4), (-8.0, -3.1, disc(12.0, (-9.0, 2.0))), (-3.2, 3.2, disc(12.0, (-9.0, 2.0)))],
            "left",
        ),
    ):
        stack, pose = lying_stack(slabs, face)
        drawings.append(Drawing(title, role, stack, (Placement(body, pose),)))
    ring = Stack.of([(0.0, 3.0, disc(7.2) - hole(3.1))])
    places = tuple(
        Placement(BODY, pose) for x in (-l1 / 2, l1 / 2) for pose in (lying_on_right(21.5, x), lying_on_left(-21.5, x))
    )
    drawings.append(Drawing("ring", "gears", ring, places))
    parts = tuple(
        Part(one.name, one.role, one.shape, one.placements, "PLA" if one.role == "body" else "PETG",
             one.shape.mass_properties(DENSITY_G_CM3), "solid")
        for one in drawings
    )  # fmt: skip
    hardware = (
        *(
            bought(f"{end}_axle", "steel rod 3 x 49.0 mm", BODY, 2.7, [(-24.5, 24.5, disc(3.0, (x, 0.0)))])
            for end, x in (("leg", -l1 / 2), ("front", l1 / 2))
        ),
        bought("battery", "battery 2S 150 mAh", BODY, 14.0, [(-8.0, 10.0, rectangle((38, 12), (3, 24)))]),
        bought("ankle_pin", "steel rod 3 x 14.0 mm", FOOT, 0.8, [(-7.0, 7.0, disc(3.0))]),
        bought("roller", "bearing 623", MAIN_LEG, 1.6, [(6.0, 10.0, disc(10.0, (12.0, 1.0)) - hole(3.0, (12.0, 1.0)))]),
    )
    pieces = defaultdict(list)
    for part in parts:
        for place in part.placements:
            pieces[place.body].append(part.mass.placed(in_metres(place.T_body_part)))
    for item in hardware:
        pieces[item.body].append(item.mass)
    bodies = {}
    for title, items in pieces.items():
        whole = combined(items)
        contacts = capsules.bodies[title].contacts
        bodies[title] = Body.of(title, whole, contacts)
    workshop = load_workshop()
    whole_robot = build(design, workshop, name="")
    return Robot(
        name, bodies, capsules.joints, capsules.loops, capsules.springs, design, capsules.foot_depth_m,
        parts, hardware, workshop, whole_robot.layout, whole_robot.release, whole_robot.stop_blow,
    )  # fmt: skip
