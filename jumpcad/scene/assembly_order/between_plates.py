"""Stage 2: trays, axles, springs, leg, rest stop and gears between the plates, until both are screwed together."""

from jumpcad.scene.assembly_order.plan import (
    FRONT,
    HEX_AXLE,
    HEX_M3,
    LEFT,
    LEG,
    LOWER,
    NUT_M3,
    PRESS,
    ROBOT,
    STOP,
    UPPER,
    Move,
    Plan,
    Words,
    clip_moves,
)

AXLES = r"(leg|front|cam|idler)_axle"

BETWEEN_PLATES: tuple[Plan, ...] = (
    Plan(
        "trays", "Trays into the right plate", ROBOT,
        (
            Move("", brings=LOWER),
            Move("", brings=UPPER),
            Move("tie_motor_leads", way="laid"),
        ),
        (
            Words("{off}, unplug the battery. Now strap it in as in step {step_lower}."),
            Words("Lay the right plate on two strips of wood, outside down. Push the tabs of both trays into its "
                  "slots, the battery's tray below. Lead the wires along the plate as leads.svg shows (under Wiring), "
                  "away from leg, cam and gears, and tie them."),
            Words("Outside, the motor's wires lie flat on the plate, from its window to the wire hole, clear "
                  "of the opening for the USB plug and of the switch's slot, and below the heads of the standoffs' "
                  "screws, never under one; a strip of adhesive tape every 20 mm "
                  "holds them."),
        ),
        checks=(
            Words("A thin wooden stick from above, between the plates, reaches the board's button, beside the switch's "
                  "leads; slanting from the left where the switch is above it. Later it is beside loaded springs: "
                  "try it now.", needs="board_button"),
        ),
    ),
    Plan(
        "legs", "Axles, springs and legs", ROBOT,
        (
            Move(f"{AXLES}|spring_pin", retention=("plates", "clips")),
            Move("spring_bushing_right"),
            Move("spring_right(_leg_arm)?"),
            Move("", brings=LEG),
            Move("spring_left(_leg_arm)?"),
            Move("spring_bushing_left"),
            Move("front_spacer_right"),
            Move("", brings=FRONT),
            Move("front_link"),
            Move("front_spacer_left"),
            Move("cam_spacer_right"),
            Move("idler_spacer_right"),
        ),
        (
            Words("The axles and the springs' pin are screws that come from the left at the end. Until then rods of "
                  "their diameter, {axle_length} mm long, are in their places.", needs=".*_axle_nut"),
            Words("The plates' bores are open: stick adhesive tape over those of the right plate, outside, before you "
                  "lay it down. What stands in them would fall through.", needs=".*_axle_(nut|clip_1)"),
            Words("Stand the axles and the springs' pin in their bores. They lean until the left plate is on: the tube "
                  "that comes first on each holds it upright, so push that down to the plate."),
            Words("The springs' pin has no tube: a strip of adhesive tape from it to the plate, on the side away from "
                  "the leg, holds it upright. It comes off in step {step_close}, with tweezers.", lacks="spring_boss"),
            Words("The springs' pin has no tube: its boss on the plate holds it.", needs="spring_boss"),
            Words("Leg axle: the bushing of {bushing_right} mm; over it the LEFT-HAND spring; the leg with the roller "
                  "up; the RIGHT-HAND spring; the bushing of {bushing_left} mm. Lengths that differ by 0.3 mm or "
                  "less may be exchanged. If a bushing has a thicker end, that is at the leg. Seen on the standing "
                  "robot, the outer arm of either "
                  "spring lies below the springs' pin, and the inner arms beside the leg, above the hole for its pin. "
                  "Left-hand: held upright, the wire in front rises to the left."),
            Words("Front axle: tube, front link, tube ({front_tubes}). Cam axle: its tube ({cam_tube} mm)."),
            Words("Idler axle: its tube ({idler_tube} mm).", needs="idler_spacer_right"),
        ),
        (
            Words("Wear glasses whenever you handle springs. They are slack in this step. Nothing may have to be "
                  "forced; an arm that does not lie "
                  "against its pin belongs to the spring of the other hand."),
        ),
        (Words("The leg turns freely about its axle."),),
    ),
    Plan(
        "stop", "Pad of the rest stop", STOP,
        (Move("stop_bar"), Move("stop_pad", "from the leg", "straight")),
        (
            Words("Glue the pad into its seat in the bar, the one with raised edges."),
            Words("The pad is printed: roughen it and its seat with emery cloth, degrease both, and glue it with a "
                  "thin coat of super glue, pressed for a minute.", needs="printed_stop_pad"),
        ),
    ),
    Plan(
        "cam", "Rest stop, cam and gears", ROBOT,
        (
            Move("", brings=STOP),
            Move("cam"),
            Move("cam_gear"),
            Move("cam_spacer_left"),
            Move("idler"),
        ),
        (
            Words("Push the stop's tab into the right plate behind the leg, its pad towards the leg. Its tabs lie at "
                  "the bar's edge that is nearer to the leg's axle, and the pad then lies in line with the leg; turned "
                  "end for end the bar goes in too, and the pad misses the leg."),
            Words("Grease the jaws, the roller's path and the teeth thinly (silicone or lithium grease). Keep the "
                  "cam's bore and its axle dry: their friction brakes the cam when it is released. On the cam axle "
                  "go the cam, jaws up, and over its jaws the gear. The roller lies on the cam."),
            Words("The gear's face with the pockets goes towards the cam, the face with the sensor's ring groove to "
                  "the left, up. It fits the jaws in one position only: where its pockets do not take both jaws, turn "
                  "it by half a turn."),
            Words("Over the gear goes the short tube ({cam_left_tube} mm). Then the idler, its small wheel down, "
                  "between the gear's teeth.", needs="idler"),
        ),
        checks=(
            Words("The cam turns in its gear freely from jaw to jaw, by {dog_play}°: this play is needed, do not glue "
                  "it."),
        ),
    ),
    Plan(
        "trial", "Trial: left plate on, cam turned by hand", ROBOT,
        (Move("", brings=LEFT, trial=True),),
        (
            Words("The pinion is still off. Put the left plate on for a trial, without screws: hold it level and "
                  "guide the leg's axle and the tabs of trays and stop into their holes first, with tweezers, about a "
                  "millimetre further down the cam's axle, the front one and the springs' pin into theirs. Do "
                  "not press: where it does not go down, something is beside its bore."),
            Words("Hold the plates together with thumb and finger, the robot upright and its leg hanging, and "
                  "turn the cam gear by hand one full turn, "
                  "{cam_turn} as seen from the left. Then lay it down and take the plate off again."),
        ),
        checks=(
            Words("The leg swings freely and falls by its own weight. The cam lifts it by {stroke}° over {lift}° of "
                  "its turn; then it falls. Nothing rubs."),
            Words("The sensor clicks {ready_deg}° before the drop, and again after it; nowhere else. Otherwise take "
                  "the plate off: is the gear on both jaws, its groove to the left, the sensor's base against its "
                  "mount?", needs="sensor"),
        ),
    ),
    Plan(
        "close", "Pinion; left plate for good", ROBOT,
        (
            Move("motor_pinion", past="motor_shaft", tool=PRESS, reach="from the left"),
            Move("", brings=LEFT),
            Move("standoff_\\d+_screw_left", "from the left", tool=HEX_M3),
            Move(f"{AXLES}|spring_pin", "from the left", tool=HEX_AXLE, retention=("nuts",)),
            Move(f"({AXLES}|spring_pin)_nut", "from the right", past=f"{AXLES}|spring_pin", tool=NUT_M3,
                 reach="from the right"),
            *clip_moves(f"{AXLES}|spring_pin"),
        ),
        (
            Words("Press the pinion onto the motor's shaft, flat to flat and its teeth between the wheel's, until it "
                  "is level with the wheel: its ribs are cut. {press_n} N at most, more damages the gearhead."),
            Words("The force goes through motor, socket floor and right plate: stand that plate on the end of a piece "
                  "of wood of {block} mm with a groove {groove} mm wide and 10 mm deep sawn across the end, the groove "
                  "along the window's longer side. The wood bears on the plate on both sides of the window, the wires "
                  "lie in the groove and leave at its ends. Hold the robot level: it stands on the wood alone."),
            Words("Left plate and its screws for good, {torque_plastic} N·m. The closed bores of both plates hold the "
                  "axles.", lacks=".*_axle_(nut|clip_1)"),
            Words("Left plate and its screws for good, {torque_plastic} N·m.", needs=".*_axle_(nut|clip_1)"),
            Words("Pull the strip of tape off the springs' pin.", lacks="spring_boss"),
            Words("Pull the tape off the right plate's bores. Put the axles' screws in from the left, "
                  "each pushing its rod out, and turn the lock nuts on until the plates just bear no load.",
                  needs=".*_axle_nut"),
            Words("Pull the tape off the right plate's bores, push the axles to the right until their grooves stand "
                  "out on both sides, and press a clip into every groove.", needs=".*_axle_clip_1"),
        ),
        (
            Words("From here on do not turn cam or gears by hand: that would drive the gear motor backwards."),
            Words("No wire under the screws' heads: look at the sensor's leads before each screw is turned home.",
                  needs="sensor"),
        ),
        (
            Words("Axles can be moved along by {end_play} mm where rods were cut at the lower "
                  "tolerance: try it at the springs' pin, the others are covered from end to end. The leg still "
                  "swings freely.", lacks=".*_axle_(nut|clip_1)"),
            Words("Axles can be moved along by {end_play} mm where rods were cut at the lower "
                  "tolerance. The leg still swings freely.", needs=".*_axle_clip_1"),
            Words("The screws can be moved along a little: their nuts touch the plate, but do not press it. The leg "
                  "still swings freely.", needs=".*_axle_nut"),
            Words("The sensor's check of step {step_left} once more, battery unplugged: multimeter between the "
                  "controller's ground and its pin of the sensor, {free} where the cam does not press it; and neither "
                  "lead has contact with a standoff's screw.", needs="sensor"),
        ),
    ),
)  # fmt: skip
