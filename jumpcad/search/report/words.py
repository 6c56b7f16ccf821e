"""Words for a study's page: units of parameters, what figures are called, and what each reason of a refusal means."""

from jumpcad.design import Design
from jumpcad.dimensions import unit_of_key
from jumpcad.evaluation import FIGURES as FIGURES

FIGURE_UNITS = {
    "_m_s": ("m/s", 1.0),
    "_kg_m2": ("kg·m²", 1.0),
    "_kg": ("g", 1000.0),
    "_m": ("mm", 1000.0),
    "_mm": ("mm", 1.0),
    "_j": ("mJ", 1000.0),
    "_s": ("s", 1.0),
    "_n": ("N", 1.0),
    "_a": ("A", 1.0),
    "_deg": ("°", 1.0),
}
"""Unit in which a figure is shown, and the factor, by the end of the figure's name."""

REASONS = {
    "loop": "foot and front link do not reach each other over the whole travel: the linkage comes apart",
    "winding": "the body tilts so far at rest that no angle is left to load the springs",
    "below_ground": "with loaded springs a pivot of the body would be below the foot",
    "tips": "with loaded springs the centre of mass is not above the foot: it falls over",
    "too_weak": "the springs hold too little energy to stand up and jump",
    "no_takeoff": "simulated, it stays on the ground",
    "audit_energy": "the simulation gained energy: its result cannot be trusted",
    "audit_loop": "the simulated linkage came apart: its result cannot be trusted",
    "cannot_build": "no printed robot could be laid out",
    "quarantined": "the evaluation failed twice, or took too long",
    "screened": "not evaluated: a quick estimate found it too bad",
    "compression": "the springs are loaded by too small an angle",
    "cam": "no cam loads these springs within the motor's torque and the cam's own limits",
    "bed": "a part is larger than the printer's bed",
    "bed_fit": "a part is larger than the printer's bed",
    "stop_room": "no room for the rest stop behind the main leg",
    "stop_reach": "the leg cannot turn as far past rest as the rest stop needs",
    "legs_apart": "main leg and front link come too near to each other",
    "pin_way": "the springs' pin cannot be pushed in through the left plate",
    "spring_pin": "the arms of the bought spring are too long for the leg",
    "spring_bushing": "the coil of the bought spring has no room for its bushing",
    "leg_bearing": "the leg's bearing is too large for its place",
    "leg_bar": "a leg's bar is too short between its sockets",
    "shaft": "the motor's shaft is too short for its pinion",
    "gear_room": "the cam gear is too large beside the leg's axle",
    "clevis_pin": "no clevis pin is as long as needed",
    "sensor_groove": "the cam gear is too thin for the sensor's groove",
    "sensor_track": "the cam gear is too small for the sensor's track",
    "sensor_mount": "no room for the sensor's mount",
    "room": "no room between the plates for this part",
    "leg_strength": "the main leg would break in bending at release",
    "hub_strength": "the main leg would break beside its hub's bore",
    "lever_strength": "the lever that the cam pushes would break",
    "leg_flex": "the main leg bends too much at release",
    "leg_sideways": "the main leg would break sideways when one toe lands first",
    "front_link_strength": "the front link would break along its length",
    "front_link_buckling": "the front link would buckle at landing",
    "front_bar_buckling": "the front link's bar would buckle at landing",
    "eye_strength": "the eyes of the links would tear",
    "foot_lug_strength": "the foot's lugs would tear off between their layers",
    "toe_strength": "a toe would break in bending at release",
    "toe_landing": "a toe would break that lands first",
    "toe_bar_strength": "the bar across a toe's tip would break",
    "toe_joint_strength": "the toes would break at their screw holes",
    "rail_strength": "the foot's rails would break in bending at release",
    "rail_twist": "the foot's rails would break under the twist of their toes at release",
    "plate_seat": "the plates would be crushed under axles and pins",
    "leg_axle_strength": "the leg's axle would bend for good under the loaded springs",
    "cam_axle_strength": "the cam's axle would bend for good under the loaded springs",
    "front_axle_strength": "the front link's axle would bend for good at release or landing",
    "idler_axle_strength": "the idler's axle would bend for good under the loaded springs",
    "spring_pin_strength": "the pin that holds the springs' arms would bend for good",
    "leg_pin_strength": "the leg's pin that the springs' arms push would bend for good",
    "foot_pin_strength": "the foot's pins would bend for good",
    "roller_screw_strength": "the roller's screw would bend for good",
    "axle_retention": "a landing on the side would push an axle out",
    "pin_retention": "a landing on the side would push a pin of the foot out",
    "spring_fatigue": "the springs' wire would not last the jumps that are asked for",
    "axle_fatigue": "the leg's axle would not last the jumps that are asked for",
    "spring_stress": "the springs' wire would stay bent when loaded",
    "spring_rate": "the bought springs differ too much from the stiffness of the design",
    "hub_bearing_load": "the bearing of the leg's hub carries too much",
    "leg_bar_strength": "the main leg's bar would break at its socket",
    "leg_socket_strength": "the socket of the main leg's bar would break",
    "leg_bar_bond": "the glue of the legs' bars would fail",
    "leg_bar_flex": "the main leg with its bar bends too much at release",
    "stop_strength": "the rest stop's bar would break when the leg hits it",
    "stop_plates": "the plates would break where the rest stop sits",
    "stop_leg": "the main leg would break where it hits the rest stop",
    "stop_pad": "the rest stop's pad is compressed too much",
    "stop_clearance": "the leg turns beyond its rest stop until it meets the cam",
    "cam_pressure_angle": "the cam pushes its roller too far from the direction of motion",
    "cam_undercut": "the cam's profile would be undercut",
    "cam_contact": "cam and roller press too hard on each other",
    "cam_roller_load": "the cam's roller carries too much",
    "cam_core": "too little material is left around the cam's axis",
    "cam_hub": "cam and hub touch",
    "cam_drop": "the roller's drop ends too late before the next lift",
    "cam_next_lift": "past rest, the leg touches the cam's next lift",
    "cam_overshoot": "the leg has too little room past rest",
    "cam_place": "no room for the cam around the hub",
    "cam_speed": "the cam turns too fast",
    "cam_gear_room": "the cam gear does not fit",
    "cam_dog_strength": "the cam's dog would break",
    "cam_dog_blocked": "a blocked motor would break the cam's dog",
    "gear_blocked": "a blocked motor would break a gear's teeth",
    "gear_strength": "a gear's teeth would break",
    "gear_mesh": "two gears do not mesh",
    "motor_torque": "the motor is too weak to wind the springs",
    "gearbox_torque": "a blocked motor would break its gearbox",
    "release_energy": "the release loses too much of the springs' energy",
    "release_kick": "the released cam strikes back at the motor's gearbox",
    "release_window": "the cam may stop where it hinders the leg that swings back",
    "supply_voltage": "an electrical part gets a voltage that it does not bear",
    "motor_current": "an electrical part carries more of the motor's current than it may",
    "charging_current": "the board charges the battery too fast",
    "wiring": "the electrical parts cannot be wired together",
    "sensor": "the sensor does not see the cam's position as it must",
    "electronics_hold": "the battery's strap is too weak for a landing",
    "wires_clear": "wires come too near to what moves",
    "ground_clearance": "the ends of the legs would touch the ground",
    "foot_clearance": "something would touch the foot with loaded springs",
    "sideways_tipping": "it tips over sideways when it lands",
    "walls": "a wall is too thin to print",
    "holes": "a hole is too narrow to print",
    "pins": "a column is too thin to print",
    "overhangs": "an overhang is too long to print without support",
    "bridges": "a bridge is too long to print without support",
    "solid": "a part is not one closed solid",
    "engraving": "the plates cannot show the whole name",
    "body_contact": "in the push-off the body touches the ground, which the planar engine does not compute",
    "interference": "two parts overlap somewhere in the motion",
    "assembly_paths": "a part has no free path to its place",
    "tool_access": "a fastener cannot be reached by its tool",
}
"""What each reason of a refusal means; names that begin with one of these mean the same."""


def unit_of(parameter: str) -> str:
    """Return the unit of a parameter by the end of its name; of one of the design without any, `ratio`."""
    return unit_of_key(parameter) or ("ratio" if parameter in Design.model_fields else "")


def with_unit(text: str, parameter: str) -> str:
    """Return values of a parameter with its unit; ratios have none."""
    unit = unit_of(parameter)
    return text if unit in ("", "ratio") else f"{text}{unit}" if unit == "°" else f"{text} {unit}"


def named(parameter: str) -> str:
    """Return a parameter's name with its unit, for a heading or an axis."""
    unit = unit_of(parameter)
    return f"{parameter} ({unit})" if unit else parameter


def meaning_of(parameter: str) -> str:
    """Return what a parameter of the design is; empty for a value of the workshop."""
    field = Design.model_fields.get(parameter)
    return field.description or "" if field else ""


def reason_words(reason: str) -> str:
    """Return what a reason of a refusal means; empty if it is not known."""
    names = [name for name in REASONS if reason == name or reason.startswith(f"{name}_")]
    return REASONS[max(names, key=len)] if names else ""


def figure_words(name: str, value: float) -> tuple[str, str]:
    """Return label and value, with its unit, of a figure of an evaluation."""
    end = next((end for end in FIGURE_UNITS if name.endswith(end)), "")
    label = FIGURES.get(name, name.removesuffix(end).replace("_", " "))
    unit, factor = FIGURE_UNITS.get(end, ("", 1.0))
    return label, f"{factor * value:.4g}{'' if unit == '°' else ' '}{unit}".strip()
