"""From eight numbers and a workshop to a `Robot`: layout, parts, bought parts, bodies."""

import math
from dataclasses import replace

from jumpcad.building.bearing_and_drive import solve_bearing_and_drive
from jumpcad.building.bodies import bodies_of, friction_of, outlines_m, release_of, require_parts, weighed_part
from jumpcad.design import Design
from jumpcad.drive import Drive
from jumpcad.drive.spring_choice import for_bought_springs, springs_on_leg
from jumpcad.electronics.supply import Chosen, chosen_parts
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.flight import leg_blow
from jumpcad.mechanism.model import five_bar
from jumpcad.parts.part import Drawing, Part
from jumpcad.robot.axles.thing import require_axle, require_retention
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.foot.drawing import in_one_piece
from jumpcad.robot.layout import Layout, make_layout
from jumpcad.robot.leg.drawing import main_leg
from jumpcad.robot.robot import Robot
from jumpcad.robot.sensor.place import SensorNeeds
from jumpcad.robot.springs.place import PLATE_PINS_RAD, NoPinRoomError
from jumpcad.robot.things import THINGS, things_on
from jumpcad.strength.axles import pin_head_mm
from jumpcad.strength.growth import Growth, grown_mm
from jumpcad.strength.loads import StopBlow, stop_blow
from jumpcad.transforms import same_by_value
from jumpcad.workshop import Workshop

PIN_ROUNDS = 5
"""Attempts with springs for other directions of their pin."""


def assembled(design: Design, workshop: Workshop, name: str, growth: Growth, before: Robot | None = None) -> Robot:
    """Return the robot of a design with its sections grown by factors.

    `before` is the robot of the same design, workshop and name with other factors: where only its lever differs, as in
    most robots that grow, all but the main leg is taken from it; else the masses of parts of one shape.
    """
    layout = layout_of(design, workshop, growth, name)
    kept: tuple[Part, ...] = ()
    if before is not None and _same_but_for_lever(layout, before.layout):
        drawn, hardware = main_leg(layout, workshop), before.hardware
        kept = before.parts[len(drawn) :]
    else:
        drawn = drawings(layout, workshop)
        hardware = tuple(item for thing in things_on(layout) for item in thing.bought(layout, workshop))
        require_parts(workshop.mass.weighed_g, [drawing.name for drawing in drawn])
    for drawing in drawn:
        drawing.require_bed(workshop.printer.bed_mm, layout.of(Cage) is not None)
    known = {part.name: part for part in before.parts} if before is not None else {}
    weighed = (
        replace(part, shape=drawing.shape, placements=drawing.placements)
        if (part := known.get(drawing.name)) is not None and part.shape == drawing.shape
        else weighed_part(drawing, workshop)
        for drawing in drawn
    )
    parts = (*weighed, *kept)
    bodies = bodies_of(layout, parts, hardware)
    spring = springs_on_leg(design, workshop.stock_spring, layout.drive.spring.preload_rad)
    release = release_of(layout, workshop, parts, hardware, bodies, spring)
    stop, blow = layout.stop, leg_blow(bodies, layout.linkage, spring, layout.stop.angle_rad)
    held = stop_blow(blow, stop.angle_rad, stop.radius_mm, stop.pad_n_per_mm(layout.sections.thickness_mm))
    values = (held.energy_j, held.torque_nm, held.force_n, held.give_rad, held.give_mm)
    # rounded: last digits of an integration in time differ between processors
    held = StopBlow(held.stop, *(float(f"{value:.5g}") for value in values))
    leg_range = (-design.compression_rad, held.stop.angle_rad + held.give_rad)
    joints, loop, _ = five_bar(layout.linkage, leg_range, spring.peak_torque_nm)
    return Robot(
        name=name, design=design, bodies=bodies, joints=joints, loops=(loop,), springs=(spring,),
        foot_depth_m=layout.sections.ground_mm / 1000.0, friction=friction_of(layout, workshop),
        outline_m=outlines_m(parts, hardware), parts=parts, hardware=hardware, workshop=workshop, layout=layout,
        release=release, roller_off=release.off, stop_blow=held, stop=held.stop,
    )  # fmt: skip


def _same_but_for_lever(one: Layout, other: Layout) -> bool:
    """Tell whether layouts of one design are the same but for the height of the lever, which only the main leg has."""
    sections = replace(one.sections, lever_root_mm=other.sections.lever_root_mm)
    return same_by_value(replace(one, sections=sections, linkage=other.linkage), other)


def layout_of(design: Design, workshop: Workshop, growth: Growth = Growth(), name: str = "") -> Layout:
    """Return the layout of a design in a workshop, of things beside the machine too; the name is its label.

    If there is no room for the springs' pin, springs for a free direction of the pin are found instead.
    """
    try:
        layout = replace(_with_pin_room(design, workshop, growth), label=name)
    except CannotBuildError as refusal:
        if workshop.bought.spring:
            refusal.ways = for_bought_springs(refusal.ways)
        raise
    for place in (thing.place for thing in THINGS if thing.place is not None):
        layout = replace(layout, things=(*layout.things, place(layout, workshop)))
    return layout


def _with_pin_room(design: Design, workshop: Workshop, growth: Growth) -> Layout:
    """Return the layout with springs whose pin has room."""
    if workshop.bought.retention == "nuts":  # of all axles one is right: a thinner one is no way out
        require_retention(workshop.catalogue, workshop.bought)
    require_axle(workshop)
    directions = PLATE_PINS_RAD
    for _ in range(PIN_ROUNDS):
        try:
            return _laid_out(design, workshop, growth, directions)
        except NoPinRoomError as refusal:
            if not refusal.free_rad:
                raise
            directions = refusal.free_rad
    return _laid_out(design, workshop, growth, directions)


def _laid_out(design: Design, workshop: Workshop, growth: Growth, plate_pins_rad: tuple[float, ...]) -> Layout:
    """Return the layout with springs for one of the directions of the plates' pin."""
    settled = solve_bearing_and_drive(design, workshop, growth, plate_pins_rad)
    require_retention(workshop.catalogue, workshop.bought)
    carried = chosen_parts(workshop)
    electronics = Electronics(
        **vars(carried), wall_mm=settled.holes.fits.wall_min_mm, play_mm=settled.holes.fits.sliding_mm,
        battery_side=side if (side := workshop.seats.battery) in ("left", "right") else None,
        usb_side="left" if workshop.seats.boards == "left" else "right",
    )  # fmt: skip
    return make_layout(
        settled.linkage, settled.sections, settled.drive, electronics, workshop, hub_bearing=settled.holes.bearing,
        roller=settled.roller,
        toes_apart=not in_one_piece(design, settled.sections, workshop.printer.bed_mm, workshop.body.toe_half_width_mm),
        plate_mm=grown_mm(workshop.body.plate_mm, growth.plate),
        leg_pin_hole_mm=settled.holes.loose(pin_head_mm(workshop.catalogue, workshop.bought)),
        sensor=_sensor_needs(workshop, carried, settled.drive),
    )  # fmt: skip


def _sensor_needs(workshop: Workshop, chosen: Chosen, drive: Drive) -> SensorNeeds | None:
    """Return what the sensor's place depends on; None without a sensor that has a plunger.

    The cam turns at most as fast as with an unloaded motor and a full battery.
    """
    part, seats = chosen.components.get("sensor"), workshop.seats
    if part is None or part.travel is None:
        return None
    stop = float(f"{drive.train.cam_speed_rad_s * seats.sensor_stop_s:.5g}")
    reserve, layer = math.radians(seats.sensor_reserve_deg), workshop.process.layer_height_mm
    return SensorNeeds(part, part.travel, seats.sensor_axial_mm, seats.sensor_along_mm, stop, reserve, layer)


def drawings(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return every printed part of a layout, those of the main leg first."""
    return [drawing for thing in things_on(layout) for drawing in thing.draw(layout, workshop)]
