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
        r"main_leg|hub_bearing_\d+|leg_spring_pin.*|roller.*",
        "Press the bearings into the hub. Open the eye at the ankle with a drill or reamer 0.1 mm wider than its pin, "
        "until that turns in it without rocking. Push the springs' pin through the beam and keep it as the list says: "
        "bend the split pin's ends, or press the clips into their grooves. Screw the roller to the lever's left side "
        "with the washer between them and the lock nut on the right; the roller must spin freely.",
    ),
    (
        "Foot",
        r"foot|toe_.*|nose_pad_.*|front_link|ankle_pin.*|front_eye_pin.*",
        "Toes that are parts of their own are screwed to the foot from outside first. Set the main leg between the "
        "lugs where the toes meet and push the ankle pin through. Do the same with the front link at the nose, whose "
        "eyes are opened like the leg's. Both must swing freely. Bend the split pins' ends around the pins, or press "
        "the clips into their grooves. Degrease the soles and glue the pads under the toes' tips and around the nose, "
        "from the sole up its round front.",
    ),
    (
        "Right plate",
        r"body_plate_right|motor|motor_shaft|motor_cap|cap_screw_\d+|stop_bar|stop_pad",
        "Push the motor into the plate's socket, its shaft away from the plate, and close the socket with the cap and "
        "its screws. Solder the motor's wires now. Glue the rest stop's pad into its seat in the bar, and push one of "
        "the bar's tabs into the right plate, the pad towards the leg.",
    ),
    (
        "Axles",
        r"(leg|front|cam|idler)_axle|spring_pin",
        "Put the axles and the pin of the springs' body arms into the right plate's bores from inside. Where these are "
        "closed outside, axles go in to the end. Screws that are axles come from the left plate at the end; until then "
        "rods of their diameter hold the parts.",
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
        "On the cam axle go spacer, cam and, over the cam's jaws, the cam gear; the roller lies at the foot of the "
        "cam's drop. The cam must turn freely in the gear from jaw to jaw. Press the pinion onto the motor's shaft, "
        "flat to flat: its ribs are cut. From here on do not turn the cam by hand: it would drive the gear motor "
        "backwards, and the axles stand in one plate only.",
    ),
    (
        "Electronics",
        r"electronics_tray.*|battery|controller|driver|regulator|capacitor|plug|switch.*|(tie|tape|strap|wiring)_.*",
        "Put the trays' tabs into the slots of the right plate. The battery is strapped to the lower tray, the boards "
        "lie on the upper one.",
    ),
    (
        "Left plate",
        r"body_plate_left|sensor.*|standoff_.*|(leg|front|cam|idler)_axle_.*|spring_pin_.*",
        "Screw the standoffs to the right plate. Lower the left plate over axles, spring pin, stop bar and tabs, with "
        "the left spring's body arm below the pin, and screw it to the standoffs: the plates' closed bores then hold "
        "the axles. Otherwise press a clip into the groove at either end of every axle, or put in the screws from the "
        "left and turn their lock nuts until the plates just bear no load. The motor winds the springs for the first "
        "time now: keep fingers and eyes away from leg, foot and cam while they are loaded.",
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
