"""The details of assembly steps that have a picture of their own: which parts are shown, from where."""

from dataclasses import dataclass

from jumpcad.scene.renderer import View


@dataclass(frozen=True)
class Inset:
    """A detail of a step: patterns of the parts that are shown and of those that are framed, the direction of view.

    `room` is the size of the frame over that of the framed parts. Of what the step puts on, `placed` is drawn in its
    place. `usb` are words for the controller's USB socket.
    """

    step: str
    name: str
    title: str
    shown: str
    framed: str
    view: View
    room: float = 1.0
    placed: str = ""
    usb: str = ""


BEHIND = {"arm": r"leg_spring_pin_(split_pin|clip_1)"}
"""What a plate hides in a step's picture, by the step's key: a detail shows it."""

INSETS = (
    Inset("leg", "hub", "Hub and roller", "main_leg|hub_bearing_.*|roller.*", "hub_bearing_.*|roller.*",
          View(-40.0, 25.0)),
    Inset("foot", "pads", "Pads from below", "foot|toe_.*|nose_pad_.*", "nose_pad_.*", View(35.0, -30.0), room=2.6),
    Inset("arm", "springs", "Springs, seen from the left: arms and pins",
          "spring_.*|main_leg|leg_spring_pin.*|leg_axle", "spring_(left|right).*|leg_spring_pin", View(75.0, 12.0)),
    Inset("arm", "retention", "The pin's right end and what keeps it, seen from the right",
          "spring_.*|main_leg|leg_spring_pin.*|leg_axle",
          "spring_right.*|leg_spring_pin|" + BEHIND["arm"], View(-128.0, 20.0), room=1.2,
          placed="leg_spring_pin"),
    Inset("cam", "gear", "Cam gear from the right: the face with the pockets, towards the cam", "cam_gear", "cam_gear",
          View(-60.0, 15.0)),
    Inset("boards", "small", "Resistors and diode between the boards",
          "electronics_tray_upper|tape_(controller|driver)|wiring_(res|dio).*", "wiring_(res|dio).*", View(62.0, 50.0),
          room=2.4),
    Inset("cam", "dog", "Dog: jaws of the cam, pockets of the gear", "cam|cam_gear|cam_axle", "cam|cam_gear",
          View(24.0, 20.0)),
    Inset("left", "sensor", "Sensor without its mount: plunger towards the plate", "body_plate_left|sensor", "sensor",
          View(-14.0, 20.0), room=2.2),
    Inset("close", "pinion", "Pinion onto the motor's shaft, left plate still off",
          r"(?!body_plate_left|sensor|tie_sensor|standoff_\d+_screw_left).*", "motor_pinion|motor_shaft",
          View(62.0, 28.0), room=2.6),
    Inset("jump", "button", "The controller's button, from above", r"(?!tie_controller|cage_).*", "controller",
          View(62.0, 62.0), room=2.2, usb="buttons: beside USB"),
    Inset("cage", "bar", "Front bar: notches over the horns, ties, sockets with the hoop's ends",
          "cage_bar_front|cage_hoop_front|cage_tie_[34]|body_plate_.*", "cage_bar_front|cage_tie_[34]",
          View(62.0, 28.0)),
)  # fmt: skip
