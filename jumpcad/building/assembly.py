"""From eight numbers and a workshop to a `Robot`: drive, plan, parts, bought parts, bodies."""

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from jumpcad.catalogue import Bearing
from jumpcad.design import Design
from jumpcad.dimensions import CLEAR_MM, GAP_MM, LEVER_EYE_RADIUS_MM, PAD_WALL_MM, SPACER_RADIUS_MM
from jumpcad.drive import CamLimits, Drive, DriveLimits, SpringLimits, TrainLimits, synthesise
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.layout.layout import Electronics, Layout, make_layout
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, ContactSphere, Surface, five_bar
from jumpcad.parts import body_plate, foot, links, shopping, small, toes, train
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.robot import Robot
from jumpcad.strength.bearings import (
    allowed_n,
    bearing_load_n,
    first_guess,
    hub_bearings,
    hub_width_mm,
    roller_bearing,
    wound_forces_n,
)
from jumpcad.strength.fatigue import spring_share
from jumpcad.strength.sizing import Growth, Sections, sections
from jumpcad.transforms import in_metres
from jumpcad.workshop import Workshop

NOT_IN_EVERY_ROBOT = ("idler", "cam_spacer_left", "idler_spacer_right", "toe_left", "toe_right")
"""Parts that only some designs have: workshops that know their weights serve the other designs too."""


def assembled(design: Design, workshop: Workshop, name: str, growth: Growth) -> Robot:
    """Return the robot of a design with its sections grown by factors."""
    layout, holes = layout_of(design, workshop, growth)
    drawn = drawings(layout, holes, name)
    _require_parts(workshop.mass.weighed_g, [drawing.name for drawing in drawn])
    for drawing in drawn:
        drawing.require_bed(workshop.printer.bed_mm)
    parts = tuple(_printed(drawing, workshop) for drawing in drawn)
    hardware = tuple(shopping.bought_parts(layout, holes, workshop.catalogue, workshop.bought))
    joints, loop, spring = five_bar(design, (-design.compression_rad, 0.0), design.peak_spring_torque_nm)
    return Robot(
        name=name,
        design=design,
        bodies=_bodies(layout, parts, hardware),
        joints=joints,
        loop=loop,
        spring=spring,
        foot_depth_m=layout.sections.foot_depth_mm / 1000.0,
        parts=parts,
        hardware=hardware,
        workshop=workshop,
        layout=layout,
    )


def layout_of(design: Design, workshop: Workshop, growth: Growth | None = None) -> tuple[Layout, HoleSizes]:
    """Return the plan of a design in a workshop, and the bores of its parts."""
    growth = growth or Growth()
    small.require_axle(workshop)
    catalogue, chosen = workshop.catalogue, workshop.bought
    roller = roller_bearing(workshop)
    holes, sizes, drive = _hub_and_drive(design, workshop, roller, growth)
    electronics = Electronics(
        catalogue.batteries[chosen.battery], catalogue.boards[chosen.controller], catalogue.boards[chosen.driver]
    )
    plate = growth.plate * workshop.body.plate_mm
    layout = make_layout(design, sizes, drive, electronics, plate, roller.width_mm, chosen.axle_mm)
    layout = replace(layout, hub_bearing=holes.bearing)
    return replace(layout, toes_apart=not foot.in_one_piece(layout, workshop.printer.bed_mm)), holes


def _hub_and_drive(
    design: Design, workshop: Workshop, roller: Bearing, growth: Growth
) -> tuple[HoleSizes, Sections, Drive]:
    """Return the bores, sections and drive with the lightest hub bearing that bears what they put on it.

    Where none does, it is the strongest, of which `jumpcad.checks` then warns.
    """
    bearings = hub_bearings(workshop)
    number, drive, limits = first_guess(bearings, design, workshop), None, None
    while True:
        bearing = bearings[number]
        holes, sizes = HoleSizes.of(workshop, bearing), sections(design, workshop, hub_width_mm(bearing), growth)
        wanted = _drive_limits(workshop, sizes, roller, holes)
        if drive is None or wanted != limits:
            drive, limits = synthesise(design, wanted, workshop.catalogue), wanted
        forces = wound_forces_n(design, drive)
        enough = [
            other is None
            or bearing_load_n(forces, sizes.thickness_mm, roller.width_mm, other) <= allowed_n(other, workshop)
            for other in bearings
        ]
        stronger = next((index for index in range(number, len(bearings)) if enough[index]), len(bearings) - 1)
        if stronger == number:
            _require_hub_room(drive, holes)
            return holes, sizes, drive
        number = stronger


def _require_hub_room(drive: Drive, holes: HoleSizes) -> None:
    """Refuse bearings whose seat meets the roller's screw in the lever, or whose hub meets the cam axle's spacer."""
    if holes.bearing is None:
        return
    wall = holes.hub_radius_mm - holes.hub_bore_mm / 2.0
    to_screw = drive.cam.lever_length_mm - holes.m3_clearance_mm / 2.0 - holes.fits.wall_min_mm
    to_spacer = math.hypot(*drive.cam.cam_axis_mm) - SPACER_RADIUS_MM - GAP_MM - wall
    largest = 2.0 * (min(to_screw, to_spacer) - holes.fits.press_mm)
    if holes.bearing.outer_mm > largest:
        raise CannotBuildError(
            f"the leg's bearing {holes.bearing.name} is {holes.bearing.outer_mm:g} mm outside; {largest:.1f} mm fit "
            "beside the roller's screw and the cam's axle: choose a smaller bought.leg_bearing"
        )


def drawings(layout: Layout, holes: HoleSizes, name: str) -> list[Drawing]:
    """Return every printed part of a plan."""
    lateral = layout.lateral
    half = layout.sections.thickness_mm / 2.0
    low, high = lateral.inside
    front_left = (layout.front_mm, half + GAP_MM / 2.0, high - GAP_MM / 2.0)
    front_right = (layout.front_mm, low + GAP_MM / 2.0, -half - GAP_MM / 2.0)
    cam_right = (layout.cam_axis_mm, low + GAP_MM / 2.0, lateral.cam[0] - GAP_MM / 2.0)
    made = [
        links.main_leg(layout, holes),
        links.front_link(layout, holes),
        foot.foot(layout, holes),
        *toes.toes_apart(layout, holes),
        *body_plate.plates(layout, holes, name),
        train.cam(layout, holes),
        *train.gears(layout, holes),
        small.motor_cap(layout, holes),
        small.spring_bushing(layout, holes, "left"),
        small.spring_bushing(layout, holes, "right"),
        small.spacer(layout, holes, "front_spacer_left", [front_left]),
        small.spacer(layout, holes, "front_spacer_right", [front_right]),
        small.spacer(layout, holes, "cam_spacer_right", [cam_right]),
        small.collars(layout, holes),
        small.trays(layout, holes),
    ]
    if layout.idler_mm is not None:
        cam_left = (layout.cam_axis_mm, lateral.gears[0][1] + GAP_MM / 2.0, high - GAP_MM / 2.0)
        idler_right = (layout.idler_mm, low + GAP_MM / 2.0, lateral.gears[0][0] - GAP_MM / 2.0)
        made += [
            small.spacer(layout, holes, "cam_spacer_left", [cam_left]),
            small.spacer(layout, holes, "idler_spacer_right", [idler_right]),
        ]
    return made


def _require_parts(weighed: Iterable[str], names: Sequence[str]) -> None:
    """Refuse weights of parts that neither this robot nor any other has."""
    known = (*names, *NOT_IN_EVERY_ROBOT)
    for name in weighed:
        if name not in known:
            raise JumpcadError(
                f"mass.weighed_g.{name}: no such part{did_you_mean(name, known)}; the robot has {', '.join(names)}"
            )


def _printed(drawing: Drawing, workshop: Workshop) -> Part:
    """Return a drawing with its material and the mass of one copy."""
    material, material_name = workshop.material(drawing.role), workshop.material_name(drawing.role)
    model, nozzle = workshop.mass.model, workshop.printer.nozzle_mm
    mass = mass_properties(drawing.shape, material.density_g_cm3, workshop.process, nozzle, model)
    weighed = workshop.mass.weighed_g.get(drawing.name)
    if weighed is not None:
        return Part(drawing, material_name, mass.scaled_to(weighed / 1000.0), "weighed")
    return Part(drawing, material_name, mass, model)


def _bodies(layout: Layout, parts: tuple[Part, ...], hardware: tuple[BoughtPart, ...]) -> dict[str, Body]:
    """Return the four rigid bodies with everything that they carry."""
    carried: dict[str, list[MassProperties]] = defaultdict(list)
    for part in parts:
        for placement in part.placements:
            carried[placement.body].append(part.mass.placed(in_metres(placement.T_body_part)))
    for item in hardware:
        carried[item.body].append(item.mass)
    contacts = _contacts(layout)
    bodies = {}
    for name in BODY_NAMES:
        mass = combined(carried[name])
        bodies[name] = Body(name, mass.mass_kg, mass.com_m, mass.inertia_kg_m2, contacts.get(name, ()))
    return bodies


def _contacts(layout: Layout) -> dict[str, tuple[ContactSphere, ...]]:
    """Return what touches the ground: the foot's round nose, both toe tips, the plates' corners under the pivots."""
    sections = layout.sections
    depth, tip_radius = sections.foot_depth_mm, sections.toe_tip_height_mm / 2.0
    tip_x, tip_y = toes.toe_tip_mm(layout)
    tip_z = tip_radius - depth

    def sphere(name: str, x: float, y: float, z: float, radius: float, surface: Surface) -> ContactSphere:
        return ContactSphere(name, np.array([x, y, z]) / 1000.0, radius / 1000.0, surface)

    pad = layout.axle_mm / 2.0 + PAD_WALL_MM
    return {
        FOOT: (
            sphere("front_eye", layout.design.l4_mm, 0.0, 0.0, depth, "foot"),
            sphere("left_toe", tip_x, tip_y, tip_z, tip_radius, "foot"),
            sphere("right_toe", tip_x, -tip_y, tip_z, tip_radius, "foot"),
        ),
        BODY: (
            sphere("back", layout.hub_mm[0], 0.0, layout.hub_mm[1], pad, "body"),
            sphere("front", layout.front_mm[0], 0.0, layout.front_mm[1], pad, "body"),
        ),
    }


def _drive_limits(workshop: Workshop, sizes: Sections, roller: Bearing, holes: HoleSizes) -> DriveLimits:
    """Return what the drive must respect in this workshop, beside a main leg of this size."""
    fits, safety, process = workshop.fits, workshop.safety, workshop.process
    gears = workshop.material("gears")
    axle_radius = workshop.bought.axle_mm / 2.0 + fits.sliding_mm
    hub_radius = max(holes.hub_radius_mm, sizes.leg_root_mm / 2.0)
    lever_eye = max(LEVER_EYE_RADIUS_MM, sizes.lever_root_mm / 2.0)
    return DriveLimits(
        spring=SpringLimits(
            mandrel_min_mm=2.0 * (axle_radius + fits.wall_min_mm),
            pin_radius_min_mm=hub_radius + CLEAR_MM + workshop.bought.axle_mm / math.sqrt(2.0),
            stress_share=min(safety.spring_stress_share, spring_share(safety.jumps)),
        ),
        cam=CamLimits(
            roller_radius_mm=roller.outer_mm / 2.0,
            cam_width_mm=roller.width_mm,
            roller_load_n=roller.static_load_n,
            gap_min_mm=lever_eye + SPACER_RADIUS_MM + CLEAR_MM,
            core_radius_mm=sizes.key_mm / math.sqrt(3.0) + fits.wall_min_mm,
            modulus_mpa=gears.modulus_mpa,
        ),
        train=TrainLimits(
            stall_share=safety.motor_stall_share,
            torque_max_nm=safety.motor_torque_max_nm,
            pair_efficiency=safety.gear_efficiency,
            backlash_circumferential_mm=fits.backlash_circumferential_mm,
            stress_mpa=gears.strength_in_plane_mpa / safety.strength_factor,
            tip_min_mm=process.line_width_mm,
            pinion_root_min_mm=axle_radius + fits.wall_mm,
            shaft_wall_mm=fits.press_mm + fits.wall_mm,
            cam_gear_root_min_mm=(sizes.key_mm + 2.0 * fits.press_mm) / math.sqrt(3.0) + fits.wall_mm,
        ),
        motors=workshop.bought.motors,
        gap_mm=CLEAR_MM,
        axle_radius_mm=SPACER_RADIUS_MM,
    )
