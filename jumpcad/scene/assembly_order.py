"""The order of assembly as data: for every step the parts, their direction of assembly, the tool, and the texts.

Parts are named by regular expressions. Parts that a robot lacks are left out, and so are the texts that need them.
Lengths and diameters of tools are those of a usual screwdriver, key or pair of pliers.

The pin in the leg that the springs push comes late, through a hole in the left plate: without it they are slack, so
that both plates hold the springs' other pin before anything is loaded, the cam can be turned by hand, and the motor
turns it for the first time without springs.
"""

from dataclasses import dataclass
from typing import Literal

ROBOT, LEG, FOOT, STOP = "robot", "leg", "foot", "rest stop"
LOWER, UPPER, LEFT = "lower tray", "upper tray", "left plate"
"""Assemblies: the robot is built up on the right plate, the others on the bench."""


@dataclass(frozen=True)
class Tool:
    """A straight tool: the cylinder along the fastener's axis, from its end outwards, that must be free (mm)."""

    name: str
    diameter_mm: float
    length_mm: float


HEX_M3 = Tool("hex key 2 mm, long end", 3.0, 50.0)
"""ISO 2936: 2.3 mm across corners, long arm 50 mm."""
TORX_M2 = Tool("screwdriver T6", 3.0, 50.0)
"""Socket 6 of ISO 14580; a blade of 3 mm."""
HEX_AXLE = Tool("hex key 2.5 mm, long end", 3.5, 50.0)
NUT_M3 = Tool("nut driver 5.5 mm", 9.0, 40.0)
PLIERS = Tool("needle-nose pliers", 4.0, 40.0)
"""Both jaws together at the tip of electronics pliers; judgement."""
CLIP = Tool("clip applicator", 6.0, 30.0)
PRESS = Tool("flat-ended bolt or thumb", 8.0, 40.0)


@dataclass(frozen=True)
class Move:
    """Things that take their place together.

    Attributes
    ----------
    parts
        Pattern of their names.
    along
        A side from which they come, `head last` for screws and pins, `from outside` for toes, `from the leg`, or
        `sideways` for a clip: from any side that is free.
    way
        How the path is checked. `straight`: along its whole length, on the shapes; `bent`: likewise, for what is bent
        around parts of `past`; `snapped`: sideways onto a groove, over the part's own size only; `laid`: not at all,
        for what is soldered or flexible.
    past
        Pattern of parts that may be in the way, because one of the two yields.
    through
        Pattern of parts with a hole on the path: the picture shows what moves before it.
    tool, reach
        What fastens them, and the side from which the tool comes: by default `along`, else one of its values.
    trial
        Whether it is taken off again at the end of the step.
    brings
        An assembly of an earlier step that is put on as one piece.
    retention
        The kinds of axle retention with which this move is needed; empty: all.
    """

    parts: str
    along: str = "from the left"
    way: Literal["straight", "snapped", "bent", "laid"] = "straight"
    past: str = ""
    through: str = ""
    tool: Tool | None = None
    reach: str = ""
    trial: bool = False
    brings: str = ""
    retention: tuple[str, ...] = ()


@dataclass(frozen=True)
class Words:
    """A sentence or two, said where the robot has a thing of the pattern `needs`, and none of the pattern `lacks`."""

    text: str
    needs: str = ""
    lacks: str = ""


@dataclass(frozen=True)
class Plan:
    """A step for any robot: its moves onto an assembly, and its texts: instructions, warnings, checks afterwards."""

    key: str
    title: str
    onto: str = ROBOT
    moves: tuple[Move, ...] = ()
    text: tuple[Words, ...] = ()
    warnings: tuple[Words, ...] = ()
    checks: tuple[Words, ...] = ()


def _pin(name: str, reach: str, clips: tuple[str, str] = ("from the right", "from the left")) -> tuple[Move, ...]:
    """Return the moves of a pin with its split pin, to which pliers come from a side, or with its clips."""
    return (
        Move(name, "from the left"),
        Move(rf"{name}_split_pin", "from the front", "bent", past=name, tool=PLIERS, reach=reach),
        *_clips(name, clips),
    )


def _clips(name: str, reach: tuple[str, str] = ("from the right", "from the left")) -> tuple[Move, ...]:
    """Return the moves of the clips at the right and the left end of an axle, sideways onto their grooves."""
    return tuple(
        Move(rf"({name})_clip_{end}", "sideways", "snapped", past=rf"({name})", tool=CLIP, reach=side)
        for end, side in enumerate(reach, start=1)
    )


AXLES = r"(leg|front|cam|idler)_axle"
SMALL = r"(tape|tie)_(?!(sensor|motor)_leads).*|plug|capacitor|wiring_(?!sensor|switch).*"

ORDER: tuple[Plan, ...] = (
    Plan(
        "leg", "Main leg", LEG,
        (
            Move("main_leg"),
            Move("main_leg_bar|main_leg_end", way="laid"),
            Move("hub_bearing_1", "from the right"),
            Move("hub_bearing_2", "from the left"),
            Move("roller_washer"),
            Move("roller"),
            Move("roller_screw", "from the left", tool=HEX_M3),
            Move("roller_nut", "from the right", past="roller_screw", tool=NUT_M3, reach="from the right"),
        ),
        (
            Words("Cut the bars of leg and front link to length, sand their ends, degrease them and the sockets. Glue "
                  "each bar with epoxy into the sockets of its two ends, as deep as it goes, lying on a flat plate, "
                  "and let it cure.", needs="main_leg_bar"),
            Words("Press one bearing into either side of the hub, between flat jaws with a sheet of card, pressing "
                  "lightly, until it is flush: push on its outer ring alone.", needs="hub_bearing.*"),
            Words("Open the eye at the leg's lower end with a drill or reamer of {eye_drill} mm, turned by hand, until "
                  "the pin turns in it without rocking."),
            Words("Open the leg's hole for the springs' pin too, until its pin goes in under the push of a thumb; the "
                  "pin itself stays out until step {step_arm}.", needs="leg_spring_pin"),
            Words("Washer and roller go on the lever's left side (the lever is the short arm at the hub; it points "
                  "backwards and up when the leg hangs down). Put the screw in from the left and turn the lock nut on "
                  "from the right until the washer has no play: {torque_m3} N·m, hand-tight."),
        ),
        checks=(Words("The roller's outer ring spins freely; the leg turns freely on a piece of its axle."),),
    ),
    Plan(
        "foot", "Foot and front link", FOOT,
        (
            Move("foot"),
            Move("toe_(left|right)", "from outside"),
            Move("toe_(left|right)_screw_.*", "head last", tool=HEX_M3),
            Move("nose_pad_.*|toe_(left|right)_pad", "from below", "straight"),
        ),
        (
            Words("Screw the toes to the foot's stubs from outside: {torque_plastic} N·m at most, the thread is cut "
                  "into plastic.", needs="toe_(left|right)"),
            Words("Degrease the soles with alcohol. Cut the pads to size and press them on for half a minute: under "
                  "either toe's tip, and around both lugs of the nose, from the sole up its round front. Leave them "
                  "for an hour before the first jump.", needs="nose_pad_.*"),
            Words("Open the eyes of the front link with the drill of {eye_drill} mm, as the leg's; the holes of the "
                  "foot must let the pins through without force.", needs=r"front_link(_\d)?"),
        ),
        checks=(Words("Both pins turn in their eyes and do not rock."),),
    ),
    Plan(
        "motor", "Motor, standoffs, right plate", ROBOT,
        (
            Move("body_plate_right"),
            Move("standoff_\\d+"),
            Move("standoff_\\d+_screw_right", "from the right", tool=HEX_M3),
            Move("switch"),
            Move("switch_screw_\\d+", "head last", tool=TORX_M2),
            Move("motor|motor_shaft"),
            Move("motor_cap"),
            Move("cap_screw_.*", "from the left", tool=TORX_M2),
        ),
        (
            Words("Solder the motor's two wires first ({motor_wire} mm each): its terminals are behind the plate's "
                  "window of {window} mm later, and no solder may stand out beyond it. The terminal with the mark is "
                  "motor +. A shaft that stands out of the motor's back is cut off before that (Order and cut): it "
                  "would stand in the window."),
            Words("Screw the standoffs to the right plate, the one with the motor's socket, from outside: "
                  "{torque_plastic} N·m. Then lay it on two strips of wood on the bench, outside down, so that screws, "
                  "slider and wires are free below it: up is the robot's left from now on."),
            Words("Solder the switch's leads to it first, those of the table under Wiring: later there is no room for "
                  "the iron.", needs="switch"),
            Words("Put the switch into its opening, its slider outwards, and turn its two screws in from outside. Ears "
                  "without thread: screws 2 mm longer, and an M2 nut behind each ear.", needs="switch"),
            Words("Lead the wires through the window and push the motor into its socket from above, its shaft up, its "
                  "shorter side as the socket's, until its rear stands on the socket's floor. Its front is now level "
                  "with the socket's rim or up to 0.4 mm above it ({clamp} mm as drawn). Higher: solder or a wire is "
                  "on the floor. Lower: the motor is shorter; glue strips of card onto the floor, beside the window."),
            Words("Put the cap on: it lies on the motor, not on the socket. Turn its two screws into the plastic, a "
                  "quarter of a turn each in turns, until the motor has no play along its shaft, and no further: "
                  "{torque_m2} N·m at most. The cap bends a little, a gap below its ears may remain."),
        ),
        checks=(Words("Pushed at its shaft, and at its rear through the window, the motor does not move. Nothing "
                      "touches its shaft."),),
    ),
    Plan(
        "lower", "Lower tray with the battery", LOWER,
        (
            Move("electronics_tray_lower"),
            Move("battery", "from above"),
            Move("strap_battery|tie_balance_lead", way="laid"),
        ),
        (
            Words("Lay the battery on the lower tray, between the two stops at its ends, its leads to the front, over "
                  "the stop. Cut its strap to {strap} mm: once around battery and tray through both slots, and an "
                  "overlap of 20 mm. Close it with the overlap on top of the battery and one layer below the tray, "
                  "where the front link passes it. A piece of adhesive tape under the upper end, 10 to 15 mm of it "
                  "standing out to the front, is what opens it later. Tight enough that it does not slide, not so "
                  "tight that it dents. Gaps to the stops of more than 1 mm are filled with foam tape on the stop. Do "
                  "not plug it in yet. Later it leaves the finished robot to the front: strap open, lifted over the "
                  "stop."),
            Words("Once it fits, take it out again and lay it aside, away from soldering iron and tools, strap and "
                  "tray with it. It is strapped in for good in step {step_trays}."),
            Words("The plug of the balance lead lies ahead of the battery under its cable tie, its open end covered "
                  "with adhesive tape: its pins must touch nothing. The tie is only so tight that the plug slides out "
                  "from under it: to charge, pull it out.",
                  needs="tie_balance_lead"),
        ),
        (
            Words("A lithium battery that is dented, swollen or shorted can burn: do not use it, and keep tools off "
                  "its plug."),
        ),
    ),
    Plan(
        "boards", "Upper tray with the boards", UPPER,
        (
            Move("electronics_tray_upper"),
            Move("controller|driver|regulator", "from above"),
            Move(SMALL, way="laid"),
        ),
        (
            Words("Solder first, with the boards loose: pads may be on a board's underside (BAT+ and BAT- often are) "
                  "or under its tie. First what is soldered by its own legs: bend the legs as soldering.svg shows "
                  "(under Wiring), a piece of heat-shrink tube over each leg, and lay the bodies where the "
                  "picture shows them, on a strip of foam tape."),
            Words("Then solder every wire of the table under Wiring to its boards, the shortest first, and slide "
                  "heat-shrink tube over each joint in the air. The motor's wires go to the driver last: first through "
                  "the right plate's wire hole, from outside to inside, then solder them. The sensor's ends stay free "
                  "until step {step_left}."),
            Words("Cut the foam tape out where a board has wires or legs underneath, so that the board lies flat. Then "
                  "lay every board on its piece, in its place, against the tray's rim where there is one, the "
                  "controller's USB socket to the right, and pull a cable tie over it. Plug and capacitor get a tie "
                  "too: the plug opens forwards. Heads of ties lie on top, beside what they hold, with their ends cut "
                  "off; below the tray they would touch the battery's strap. None covers a button of the controller. "
                  "Tie the wires together beside the boards, so that no joint bears a pull."),
            Words("Put the firmware on the controller over USB (firmware/README.md) before the battery is plugged in "
                  "for the first time."),
        ),
        (
            Words("{charge_how}"),
            Words("Before the battery is plugged in: switch on, multimeter across the plug's poles, no contact (a "
                  "short beep is the capacitor). Plus "
                  "of plug and battery must agree: makers of batteries do not."),
        ),
    ),
    Plan(
        "left", "Left plate with the sensor", LEFT,
        (
            Move("body_plate_left"),
            Move("sensor", "from the left"),
            Move("sensor_mount", "from the left"),
            Move("sensor_screw_\\d+", "head last", tool=TORX_M2),
            Move("tie_sensor_leads", way="laid"),
        ),
        (
            Words("The mount is closed all round, so the leads go through it first: lead the free ends of the sensor's "
                  "two leads through the plate's wire hole to the outside, then through the mount's window towards the "
                  "plate, and only then solder them to COM and {contact} (table and notes under Wiring).",
                  needs="sensor"),
            Words("Put the sensor into the plate's opening from outside, its plunger through to the "
                  "inside, push the mount along the leads over it, and turn the two screws into the plastic: "
                  "{torque_m2} N·m. Tie the leads at the hole so that its terminals bear no pull, and hold "
                  "them flat on the plate with a strip of adhesive tape every 20 mm, 5 mm or "
                  "more below the standoff's hole: straight from the mount to the wire hole they could come under the "
                  "screw's head in step {step_close}.", needs="sensor"),
        ),
        checks=(Words("Pressed on the inside, the plunger clicks and comes out again. Multimeter between the "
                      "controller's ground and its pin of the sensor, battery unplugged: {free}; pressed, {pressed}. "
                      "The other way round a lead is at the wrong terminal.", needs="sensor"),),
    ),
    Plan(
        "power", "First power-up, on the bench", ROBOT, (),
        (
            Words("Nothing is on the motor's shaft yet. Lay right plate, left plate and both trays side by side as "
                  "wired, switch off, USB cable out; plug the battery in, switch on."),
            Words("Multimeter on volts, the switch on: between {driver_supply} the battery's voltage; keep "
                  "off the plug's poles, they are too near to each other.", needs="driver"),
            Words("Then between the controller's ground and {divider_pin}: {divider_share} of that ({divider_v} V at "
                  "{nominal_v} V). Anything else: the resistors are exchanged, or a leg is not soldered; then nothing "
                  "protects the battery. {off}, unplug the battery, and mend it before you go on.",
                  needs="wiring_resistor_upper"),
            Words("Connect the computer by USB, open the console (firmware/README.md)."),
            Words("Type `state`: the controller answers `idle`. Type `wind`: the motor turns for {wind_max} s at most. "
                  "Press the sensor by hand: the motor stops at once, and `state` says `ready`. Hold it, type `jump` "
                  "and Enter, and let go at once, within {release_ms} ms: the motor stops {after_ms} ms later and the "
                  "count is 1. Held longer it says `fault`: press the sensor, `wind`, and try again."),
            Words("Press and hold the sensor, wait 2 s, type `wind`: the motor must not turn, and the answer is "
                  "`fault` right after a jump, else `ready`. A broken lead reads the same.",
                  needs="wiring_resistor_pull_up"),
            Words("Seen from the robot's left, so onto the shaft, it must turn {motor_turn} (red arrow). If it does "
                  "not, exchange its two wires at the driver."),
            Words("Current. {usb_out}. Switch off; multimeter on its 10 A range, its leads on the switch's two "
                  "terminals by two crocodile clips that do not touch: the current now passes it, and off is to take "
                  "a clip away. Wind, and stop with the sensor. Then take the clips off, switch off, USB cable out, "
                  "and unplug the battery.", needs="switch"),
        ),
        (
            Words("Something becomes hot or smells: {off_then}, unplug the battery, look for the short. Do not leave "
                  "a connected battery alone."),
        ),
        (
            Words("Battery {battery_v} V at rest, at least {min_v} V."),
            Words("`state` prints the battery's voltage, to {state_off} V of the multimeter's at the plug. Calibrate "
                  "it (firmware/README.md).", needs="wiring_resistor_upper"),
            Words("The shaft alone turns with about {free_rpm} rpm. From the battery come about {boards_ma} mA while "
                  "the motor stands and {free_ma} mA while it turns, the boards included; the 10 A range shows "
                  "{boards_a} and {free_a} A, its last digit uncertain. A third more or less is the "
                  "scatter of motors and boards (judgement)."),
        ),
    ),
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
                  "slots, the battery's tray below. Lead the wires along the plate, away from leg, cam and gears, and "
                  "tie them."),
            Words("Outside, the motor's wires lie flat on the plate, straight from its window to the wire hole, clear "
                  "of the opening for the USB plug and of the switch's slot, and below the heads of the standoffs' "
                  "screws, never under one; a strip of adhesive tape every 20 mm "
                  "holds them."),
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
            Move(r"front_link(_\d|_bar)?"),
            Move("front_spacer_left"),
            Move("cam_spacer_right"),
            Move("idler_spacer_right"),
        ),
        (
            Words("Stand the axles and the springs' pin in their bores. They lean until the left plate is on: the tube "
                  "that comes first on each holds it upright, so push that down to the plate.", lacks=".*_axle_nut"),
            Words("The springs' pin has no tube: a strip of adhesive tape from it to the plate, on the side away from "
                  "the leg, holds it upright. It comes off in step {step_close}, with tweezers.",
                  lacks=".*_axle_nut|spring_boss"),
            Words("The springs' pin has no tube: its boss on the plate holds it.", needs="spring_boss",
                  lacks=".*_axle_nut"),
            Words("The axles are screws that come from the left at the end. Until then stand rods of their diameter, "
                  "{axle_length} mm long, in the bores.", needs=".*_axle_nut"),
            Words("Leg axle: the bushing of {bushing_right} mm; over it the LEFT-HAND spring; the leg with the roller "
                  "up; the RIGHT-HAND spring; the bushing of {bushing_left} mm. If a bushing has a thicker "
                  "end, that is at the leg. Seen on the standing robot, the outer arm of either "
                  "spring lies below the springs' pin, and the inner arms beside the leg, above the hole for its pin. "
                  "Left-hand: held upright, the wire in front rises to the left."),
            Words("Front axle: tube, front link, tube ({front_tubes}). Cam axle: its tube ({cam_tube} mm)."),
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
        (Words("Glue the pad into its seat in the bar, the one with raised edges."),),
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
            Words("Push the stop's tab into the right plate behind the leg, its pad towards the leg."),
            Words("Grease the jaws, the roller's path and the teeth thinly (silicone or lithium grease). On the cam "
                  "axle go the cam, jaws up, and over its jaws the gear. The roller lies on the cam."),
            Words("The gear's face with the pockets goes towards the cam, the face with the sensor's ring groove to "
                  "the left, up. It fits the jaws in one position only: where its pockets do not take both jaws, turn "
                  "it by half a turn."),
            Words("Then the idler, its small wheel down.", needs="idler"),
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
                  "guide the axles into their bores with tweezers: first the leg's, then the cam's, the front one, the "
                  "springs' pin last; then the trays' and the stop's tabs. Do "
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
            *_clips(f"{AXLES}|spring_pin"),
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
            Words("Left plate and its screws for good, {torque_plastic} N·m. Put the axles' screws in from the left, "
                  "each pushing its rod out, and turn the lock nuts on until the plates just bear no load.",
                  needs=".*_axle_nut"),
            Words("Left plate and its screws for good, {torque_plastic} N·m. Press a clip into the groove at either "
                  "end of every axle.", needs=".*_axle_clip_1"),
            Words("Pull the strip of tape off the springs' pin.", lacks=".*_axle_nut|spring_boss"),
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
                  "tolerance. The leg still swings freely.", needs=".*_axle_(nut|clip_1)"),
            Words("The sensor's check of step {step_left} once more, battery unplugged: multimeter between the "
                  "controller's ground and its pin of the sensor, {free} where the cam does not press it; and neither "
                  "lead has contact with a standoff's screw.", needs="sensor"),
        ),
    ),
    Plan(
        "dry", "First winding, without springs", ROBOT, (),
        (
            Words("The springs are slack: the leg has no pin yet that they could push. Hold the robot upright by the "
                  "plates, its leg hanging, plug the battery in, switch on, USB cable in, type `wind`, then `jump`; "
                  "ten times."),
            Words("{off}, unplug the battery."),
        ),
        (),
        (
            Words("It winds in about {dry_s} s and stops by itself, ready. After `jump` the leg falls within "
                  "{release_ms} ms. For {landing_s} s after that `wind` is only answered by the last message, and "
                  "nothing turns: give it again."),
            Words("A motor that runs for {wind_max} s and says `fault` had no signal. `ready` at once, or `fault: "
                  "sensor pressed too early`: a broken lead, or a cam that stands under the sensor. Give `wind`, then "
                  "`jump`: a jump that is counted was the cam, `fault: no release seen in time` is the lead. Mend the "
                  "sensor before the springs are armed.", needs="wiring_resistor_pull_up"),
            Words("A motor that runs for {wind_max} s and says `fault` had no signal: mend the sensor before the "
                  "springs are armed.", lacks="wiring_resistor_pull_up"),
        ),
    ),
    Plan(
        "arm", "The springs' pin in the leg", ROBOT,
        (
            Move("leg_spring_pin(_clip_2)?", "from the left", through="body_plate_left"),
            Move("leg_spring_pin_split_pin", "from the front", "bent", past="leg_spring_pin", tool=PLIERS),
            Move("leg_spring_pin_clip_1", "from the front", "snapped", past="leg_spring_pin|spring_right_leg_arm",
                 tool=CLIP),
        ),
        (
            Words("Lay the robot on its right plate and hold the leg on its stop: its empty hole is then behind the "
                  "hole in the left plate, {pin_hole} mm wide, below the leg's axle.", needs="leg_spring_pin"),
            Words("The slack springs swung backwards while the robot stood upright. Turn them back first: with a small "
                  "screwdriver from the front lift the outer arm of either spring until it lies against the springs' "
                  "other pin from below."),
            Words("Look before you push: both outer arms lie under the springs' other pin, and both inner arms between "
                  "the leg's empty hole and that pin. A thin rod through the hole, held at its edge away from that "
                  "pin, touches no arm. If an inner arm is behind or below the hole, its spring is not yet turned "
                  "back: the pin would stand between its two arms and the springs would not push.",
                  needs="leg_spring_pin"),
            Words("Press a clip into the groove at one end of the pin; that end goes in last.",
                  needs="leg_spring_pin_clip_.*"),
            Words("Drop the pin ({leg_pin}) through that hole and push it with a thin rod through the leg, below the "
                  "inner arms of both springs, until its end stands out beside the right spring's arm: all four arms "
                  "then lie between it and the springs' other pin."),
            Words("An arm may be up to {wider}° wider than ordered and then lies in the pin's way. Push it "
                  "aside with a small screwdriver from the front, towards the springs' other pin: the left spring's "
                  "until the pin is in the leg, then the right one's; {arm_n} N at most. Both plates hold the springs' "
                  "other pin.", lacks="preload"),
            Words("The springs are loaded by {preload}° in this pose: push the arms aside with a small screwdriver "
                  "from the front, towards the springs' other pin, the left spring's until the pin is in the leg, then "
                  "the right one's; {preload_n} N, and {arm_n} N where an arm is {wider}° wider than ordered. "
                  "Both plates hold the springs' other pin.", needs="preload"),
            Words("Turn the pin until its cross hole points forwards, put the split pin through it from the front, "
                  "bend its ends around the pin and cut off what stands out.", needs="leg_spring_pin_split_pin"),
            Words("Press the second clip into the groove at the pin's right end, from the front; an arm that "
                  "touches the pliers gives way, the springs are slack.",
                  needs="leg_spring_pin_clip_.*"),
        ),
        (
            Words("From now on the springs can be loaded: {energy} J, set free within {push_ms} ms. Keep "
                  "fingers out from between leg and body and away from foot, cam and gears, and your eyes away, "
                  "whenever the battery is plugged in or the leg is off its stop."),
        ),
        (
            Words("The plate does not keep the pin, at rest its hole is open: the pin's head is on the left, its split "
                  "pin bent on the right, and pushed from either side it stays.", needs="leg_spring_pin_split_pin"),
            Words("The plate does not keep the pin, at rest its hole is open: both clips are in their grooves, and "
                  "pushed from either side it stays.", needs="leg_spring_pin_clip_.*"),
            Words("The leg lies on its stop and springs back to it when its end is pulled forward a little: {foot_n} N "
                  "there would load it completely, so do not. With arms narrower than ordered it is slack near the "
                  "stop, for {slack}° at most, and springs back from there on; that is no fault."),
        ),
    ),
    Plan(
        "feet", "Foot onto the legs", ROBOT,
        (
            Move("", "from below", brings=FOOT),
            *_pin("ankle_pin", "from the right"),
            *_pin("front_eye_pin", "from the right"),
        ),
        (
            Words("Set the leg's eye between the lugs where the toes meet and push {ankle_pin} through from the left; "
                  "then the front link's between the lugs of the nose, with {front_pin}."),
            Words("Bend the split pins' ends around the pins and cut off what stands out.",
                  needs="ankle_pin_split_pin"),
            Words("Press the clips into the grooves.", needs="ankle_pin_clip_.*"),
        ),
        checks=(Words("The robot stands on nose and toes, the leg on its stop; pressed down, it comes up again, with "
                      "arms narrower than ordered but for the last {slack}° of the leg."),),
    ),
    Plan(
        "jump", "First winding and first jump", ROBOT, (),
        (
            Words("Wear glasses. Put the robot on a floor that is not slippery, with {far} m free ahead of it and "
                  "{high} m above. Plug the battery in, switch on. {cable} {wind_by}"),
            Words("{jump_by} For {landing_s} s after a jump it ignores everything."),
            Words("{stop_by}"),
        ),
        (
            Words("Wound springs stay loaded when the battery is empty or unplugged. To slacken them, hold the robot "
                  "by its plates, feet away from you and free, and release: `jump`. Never take it apart while the leg "
                  "is off its stop."),
            Words("`fault: sensor pressed too early`: a lead of the sensor is broken, the springs may be partly "
                  "loaded. Nothing in the leg's way, type `wind`, then `jump`, until the leg falls: each turns the cam "
                  "a little. Then mend the lead.", needs="wiring_resistor_pull_up"),
            Words("Springs loaded and board, driver, wires or motor fail: the way out is at the guide's end, under "
                  "Springs loaded, and nothing turns."),
            Words("Battery low while it winds: the springs are partly loaded and cannot be released. Wait a minute and "
                  "give `wind` again. Refused again: {charge_loaded} Then `wind` again, and `jump`."),
        ),
        (
            Words("It winds in about {wind_s} s. Of that, computed: {wind_ma} mA from the battery on average, "
                  "{peak_ma} mA at most, {wind_j} J; do not connect a multimeter for it. As computed it jumps {range} "
                  "mm far and {rise} mm high; what others measured on the bench was 77 to 87 % of the computed energy "
                  "at best, so expect less."),
            Words("Half of that: does a foot slip, does a link rub, is the springs' rate right, does the roller leave "
                  "the cam at once?"),
        ),
    ),
)  # fmt: skip
"""What is done, in this order."""
