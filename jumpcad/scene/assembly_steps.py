"""The order in which a robot is assembled: each step with the parts that it adds."""

import re
from dataclasses import dataclass

from jumpcad.robot import Robot
from jumpcad.scene.visuals import Visual, visuals


@dataclass(frozen=True)
class Step:
    """One step: what to do, and the parts that are added."""

    title: str
    text: str
    added: tuple[Visual, ...]


ORDER: tuple[tuple[str, str, str], ...] = (
    (
        "Main leg",
        r"main_leg|hub_bearing_\d+|leg_spring_pin|roller.*",
        "Press the bearings into the hub. Press the springs' pin through the beam until it stands out as far on either "
        "side. Screw the roller to the lever's left side with the washer between them and the nut on the right; the "
        "roller must spin freely.",
    ),
    (
        "Foot",
        r"foot|toe_.*|front_link|ankle_pin|front_eye_pin",
        "Toes that are parts of their own are screwed to the foot from outside first. Set the main leg between the "
        "lugs where the toes meet and push the ankle pin through. Do the same with the front link at the nose. Both "
        "must swing freely; the pins sit tight in the lugs.",
    ),
    (
        "Right plate",
        r"body_plate_right|motor|motor_shaft|motor_cap|cap_screw_\d+",
        "Push the motor into the plate's socket, its shaft away from the plate, and close the socket with the cap and "
        "its screws. Solder the motor's wires now.",
    ),
    (
        "Axles",
        r"(leg|front|cam|idler)_axle|spring_pin",
        "Put the axles through the right plate from inside. They stand out of it by a collar's width. Press the pin of "
        "the springs' body arms into the plate until it is flush with the outside.",
    ),
    (
        "Springs and legs",
        r"spring_(left|right)|spring_(left|right)_leg_arm|spring_bushing_.*|front_spacer_.*",
        "On the leg axle go, from the plate on: the right spring, which is the left-hand one, on its bushing with its "
        "outer arm below the plate's pin, the main leg with its pin below the spring's other arm, the left spring, the "
        "right-hand one, on its bushing with its inner arm above the leg's pin. On the front axle go spacer, front "
        "link, spacer. Winding turns the leg's pin towards the plate's pin and closes the coils.",
    ),
    (
        "Cam and gears",
        r"cam|cam_gear|motor_pinion|idler|cam_spacer_.*|idler_spacer_.*",
        "On the cam axle go spacer, cam and, on the cam's hexagon, the cam gear; the roller lies at the foot of the "
        "cam's drop. Press the pinion onto the motor's shaft, flat to flat. Turn the cam once by hand: the leg winds "
        "and lets go.",
    ),
    (
        "Electronics",
        r"electronics_tray.*|battery|controller|driver|regulator|wiring_.*",
        "Put the trays' tabs into the slots of the right plate. The battery is strapped to the lower tray, the boards "
        "lie on the upper one.",
    ),
    (
        "Left plate",
        r"body_plate_left|standoff_.*|collar.*",
        "Screw the standoffs to the right plate. Lower the left plate over axles, spring pin and tabs, with the left "
        "spring's body arm below the pin, and screw it to the standoffs. Push a collar onto either end of every axle, "
        "leaving it play enough to turn.",
    ),
)
"""Title, names of the parts that are added, text."""
REST = ("Everything else", "Fasten what remains where the picture shows it.")


def assembly_steps(robot: Robot) -> list[Step]:
    """Return the steps that a robot needs; everything on it is added in exactly one of them."""
    left = list(visuals(robot))
    steps = []
    for title, names, text in ORDER:
        added = tuple(shape for shape in left if re.fullmatch(names, shape.name))
        left = [shape for shape in left if shape not in added]
        if added:
            steps.append(Step(title, text, added))
    return [*steps, Step(*REST, tuple(left))] if left else steps
