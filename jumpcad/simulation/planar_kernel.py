"""The planar robot's motion: four degrees of freedom, one time step, the push-off.

Coordinates are the ankle's place (x + iz), the foot's angle, nose down, and the leg joint's angle; the five-bar's loop
is solved exactly for the latter. The step is Moreau's midpoint rule (Acary and Brogliato, Numerical Methods for
Nonsmooth Dynamical Systems, ch. 10): places at mid-step, velocities and impulses over the step, contact and friction as
laws between impulses and the velocities at its end. Contact modes are tried until one obeys all laws. Forces that
depend on velocities take the mean over the step from a first pass, so that the rule is of second order.

Nothing here calls BLAS: the operations and their order are those written down, on every processor.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar, cast

from jumpcad.simulation.planar_model import (
    Contact,
    Gains,
    Inertia,
    Links,
    Losses,
    PlanarModel,
    PlanarMotion,
    PushOff,
    Stance,
    StepState,
)

OPEN_SHARE = 1e-6
"""(sine of the angle between diagonal and foot)² below which the loop counts as open: foot and front link in line."""
TOLERANCE = 1e-12
"""Of impulses and velocities, over those of the step: error of a contact law by rounding."""
SEPARATE, STICK, FORWARD, BACKWARD = 0, 1, 2, 3

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Return a function compiled to machine code, kept on disk for the next process, or as it is without numba.

    The same statements, and so the same numbers. Where no folder can be written (containers, system installs) every
    process compiles anew, for some seconds. Numba notices a change in the file of a function, not one in the files of
    what that function calls: everything that is compiled stands in this module.
    """
    try:
        from numba import njit
    except ImportError:
        return function
    try:
        made = njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # numba's "cannot cache function: no locator available"
        return cast(Function, njit(error_model="numpy")(function))
    if cache := getattr(made, "_cache", None):  # none where compiling is switched off
        save = cache.save_overload

        def save_if_possible(*given: Any) -> None:
            with suppress(OSError):  # a full disk, or a quota: the next process compiles anew
                save(*given)

        cache.save_overload = save_if_possible
    return cast(Function, made)


@compiled
def links_at(model: PlanarModel, leg_rad: float) -> Links:
    """Solve the loop and its derivatives at a leg angle, on the assembled branch.

    The eye seen along main leg and foot is the eye seen along the front link; that equation differentiated twice gives
    the rates of foot and front link (e.g. Norton, Design of Machinery, ch. 6 and 7).
    """
    angle = model.rest_rad + leg_rad
    leg = complex(model.l2_m * math.cos(angle), -model.l2_m * math.sin(angle))
    diagonal = model.l1_m - leg
    distance = math.sqrt(diagonal.real * diagonal.real + diagonal.imag * diagonal.imag)
    along = (model.l4_m * model.l4_m - model.l3_m * model.l3_m + distance * distance) / (2.0 * distance)
    square, least = model.l4_m * model.l4_m - along * along, OPEN_SHARE * model.l4_m * model.l4_m
    closed = square > least
    foot = diagonal * complex(along / distance, -math.sqrt(max(square, least)) / distance)
    front = leg + foot - model.l1_m
    cross = (front.conjugate() * foot).imag
    foot1, front1 = -(front.conjugate() * leg).imag / cross, -(foot.conjugate() * leg).imag / cross
    normal = leg + foot * (foot1 * foot1) - front * (front1 * front1)
    foot2, front2 = (front.conjugate() * normal).real / cross, (foot.conjugate() * normal).real / cross

    pitch = foot.conjugate() / model.l4_m
    body_com, leg_com, front_com, foot_com = model.com_m
    on_leg, on_front = leg_com / model.l2_m - 1.0, front_com / model.l3_m
    back1 = 1j * leg
    body = _in_foot(pitch, foot1, foot2, 0.5 * model.l1_m + body_com - leg, back1, leg)
    main = _in_foot(pitch, foot1, foot2, on_leg * leg, -1j * on_leg * leg, -on_leg * leg)
    other = _in_foot(
        pitch, foot1, foot2, model.l1_m + on_front * front - leg, back1 - 1j * on_front * front * front1,
        leg - on_front * front * complex(front1 * front1, front2),
    )  # fmt: skip
    return Links(
        closed, (body[0], main[0], other[0], foot_com), (body[1], main[1], other[1], 0j),
        (body[2], main[2], other[2], 0j), (-foot1, 1.0 - foot1, front1 - foot1, 0.0),
        (-foot2, -foot2, front2 - foot2, 0.0), (1.0, front1, foot1 - 1.0, front1 - foot1), pitch, -leg * pitch,
        (model.l1_m - leg) * pitch,
    )  # fmt: skip


@compiled
def _in_foot(
    pitch: complex, foot1: float, foot2: float, place: complex, place1: complex, place2: complex
) -> tuple[complex, complex, complex]:
    """Turn a place in the body's frame and its derivatives into the foot's frame."""
    turned1 = place1 + 1j * foot1 * place
    turned2 = place2 + 2j * foot1 * place1 + complex(-foot1 * foot1, foot2) * place
    return place * pitch, turned1 * pitch, turned2 * pitch


@compiled
def inertia_at(model: PlanarModel, links: Links, turn: complex) -> Inertia:
    """Return the mass matrix, the foot being turned by exp(-i·angle) = `turn`."""
    moment, moment1, foot, both, leg = 0j, 0j, 0.0, 0.0, 0.0
    for index in range(4):
        mass, spin = model.mass_kg[index], model.inertia_kg_m2[index]
        place, place1, turn1 = links.place[index], links.place1[index], links.turn1[index]
        moment += mass * place
        moment1 += mass * place1
        foot += mass * (place * place.conjugate()).real + spin
        both += mass * (place1.conjugate() * place).imag + spin * turn1
        leg += mass * (place1 * place1.conjugate()).real + spin * turn1 * turn1
    by_foot, by_leg, total = -1j * moment * turn, moment1 * turn, model.total_kg
    return Inertia(
        total, by_foot, by_leg, foot - (by_foot * by_foot.conjugate()).real / total,
        both - (by_foot.conjugate() * by_leg).real / total, leg - (by_leg * by_leg.conjugate()).real / total,
    )  # fmt: skip


@compiled
def response(inertia: Inertia, ankle: complex, foot: float, leg: float) -> PlanarMotion:
    """Return the change of velocities by impulses along the coordinates."""
    foot -= (inertia.by_foot.conjugate() * ankle).real / inertia.mass
    leg -= (inertia.by_leg.conjugate() * ankle).real / inertia.mass
    determinant = inertia.foot * inertia.leg - inertia.both * inertia.both
    by_foot = (inertia.leg * foot - inertia.both * leg) / determinant
    by_leg = (inertia.foot * leg - inertia.both * foot) / determinant
    shift = (ankle - inertia.by_foot * by_foot - inertia.by_leg * by_leg) / inertia.mass
    return PlanarMotion(shift, by_foot, by_leg)


@compiled
def gains_of(inertia: Inertia) -> Gains:
    """Return the responses to unit impulses."""
    return Gains(
        response(inertia, 1.0 + 0j, 0.0, 0.0), response(inertia, 1j, 0.0, 0.0), response(inertia, 0j, 1.0, 0.0),
        response(inertia, 0j, 0.0, 1.0),
    )  # fmt: skip


@compiled
def plus(speed: PlanarMotion, change: PlanarMotion, factor: float) -> PlanarMotion:
    """Return velocities changed by a factor times a change."""
    return PlanarMotion(
        speed.ankle + factor * change.ankle, speed.foot + factor * change.foot, speed.leg + factor * change.leg
    )


@compiled
def centre_speed(inertia: Inertia, speed: PlanarMotion) -> complex:
    """Return the velocity of the centre of mass."""
    return speed.ankle + (inertia.by_foot * speed.foot + inertia.by_leg * speed.leg) / inertia.mass


@compiled
def spring_torque(model: PlanarModel, leg_rad: float) -> float:
    """Return the springs' torque on the leg joint, see `Spring.torque_nm`."""
    torque = model.stiffness_nm_per_rad * (model.preload_rad - leg_rad)
    return max(torque, 0.0) if model.one_sided_spring else torque


@compiled
def energy(model: PlanarModel, moment: StepState) -> float:
    """Return kinetic, potential and spring energy together (J)."""
    links = links_at(model, moment.leg_rad)
    turn = complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))
    inertia, speed = inertia_at(model, links, turn), moment.speed
    centre = centre_speed(inertia, speed)
    kinetic = 0.5 * inertia.mass * (centre * centre.conjugate()).real + 0.5 * (
        inertia.foot * speed.foot * speed.foot
        + 2.0 * inertia.both * speed.foot * speed.leg
        + inertia.leg * speed.leg * speed.leg
    )
    height = (moment.ankle_m + 1j * inertia.by_foot / inertia.mass).imag
    spring = 0.5 * spring_torque(model, moment.leg_rad) * (model.preload_rad - moment.leg_rad)
    return kinetic + model.gravity_m_s2 * inertia.mass * height + spring


@compiled
def forces(
    model: PlanarModel, links: Links, inertia: Inertia, turn: complex, leg_rad: float, speed: PlanarMotion
) -> tuple[complex, float, float]:
    """Return the forces of gravity, springs, damping and the motion itself along the coordinates."""
    ankle, foot, leg = 0j, 0.0, 0.0
    squared, mixed = speed.leg * speed.leg, speed.leg * speed.foot
    for index in range(4):
        mass, spin = model.mass_kg[index], model.inertia_kg_m2[index]
        place, place1, place2 = links.place[index], links.place1[index], links.place2[index]
        turn1, turn2 = links.turn1[index], links.turn2[index]
        own = place2 * squared - 2j * place1 * mixed - place * (speed.foot * speed.foot)
        ankle -= mass * own
        foot -= mass * (place.conjugate() * (1j * own)).real + spin * turn2 * squared
        leg -= mass * (place1.conjugate() * own).real + spin * turn1 * turn2 * squared
    pull = model.pull_m_s2
    damped = 1.0 + links.pin1[1] * links.pin1[1] + links.pin1[2] * links.pin1[2]
    return (
        ankle * turn + pull * inertia.mass,
        foot + (pull.conjugate() * inertia.by_foot).real,
        leg
        + (pull.conjugate() * inertia.by_leg).real
        + spring_torque(model, leg_rad)
        - model.damping_nms_per_rad * damped * speed.leg,
    )


@compiled
def dry_torque(model: PlanarModel, links: Links) -> float:
    """Return the dry friction of joints and pins, as a torque on the leg joint."""
    return model.pins_nm + model.joint_friction_nm * (1.0 + abs(links.pin1[1]) + abs(links.pin1[2]))


@compiled
def arm_m(model: PlanarModel, ground: Stance, index: int) -> float:
    """Return how far in front of the ankle a sphere of the sole is."""
    return (model.sole_m[index] * ground.turn).real


@compiled
def least_m_s(model: PlanarModel, ground: Stance, index: int) -> float:
    """Return the least upward speed of a sphere, with which the rest of its gap closes by the end of the step."""
    height = (ground.ankle_m + model.sole_m[index] * ground.turn).imag
    return -max(height - model.sole_radius_m[index], 0.0) / ground.half_s


@compiled
def turning_impulse(model: PlanarModel, ground: Stance, contact: Contact) -> float:
    """Return the ground's impulse of torque about the ankle."""
    turning = -ground.ankle_m.imag * contact.along_ns
    if contact.first >= 0:
        turning -= arm_m(model, ground, contact.first) * contact.first_ns
    if contact.second >= 0:
        turning -= arm_m(model, ground, contact.second) * contact.second_ns
    return turning


@compiled
def contact_in_mode(
    model: PlanarModel, ground: Stance, gains: Gains, free: PlanarMotion, first: int, second: int, mode: int
) -> tuple[bool, Contact]:
    """Return the impulses on one sphere (or two: `second` >= 0) in a mode, and whether they obey all laws.

    The laws: the ground only pushes; no sphere goes below the ground; along the ground the foot sticks with
    less than the full friction, or slides against all of it. The spheres touch in one line, so the foot has
    one velocity and one force along it.
    """
    friction, height = model.friction, ground.ankle_m.imag
    row_1, row_2 = -arm_m(model, ground, first), -arm_m(model, ground, max(second, 0))
    need_1 = least_m_s(model, ground, first) - free.ankle.imag - row_1 * free.foot
    need_2 = least_m_s(model, ground, max(second, 0)) - free.ankle.imag - row_2 * free.foot
    slip = free.ankle.real - height * free.foot
    # Velocities by unit impulses: up at the spheres (1, 2) and along the ground (t).
    lift, lean, spin = gains.z.ankle.imag, gains.z.foot, gains.foot.foot
    drag, tilt = gains.x.ankle.imag - height * lean, gains.x.foot - height * spin
    tt = gains.x.ankle.real - height * gains.x.foot - height * tilt
    t1, t2 = drag + row_1 * tilt, drag + row_2 * tilt
    n11 = lift + 2.0 * row_1 * lean + row_1 * row_1 * spin
    n12 = lift + (row_1 + row_2) * lean + row_1 * row_2 * spin
    n22 = lift + 2.0 * row_2 * lean + row_2 * row_2 * spin
    # Along the ground: an impulse that stops the slip, or all of the friction against it.
    pull = -friction if mode == FORWARD else friction
    if mode == STICK:
        a11, a12, a21, a22 = n11 - t1 * t1 / tt, n12 - t1 * t2 / tt, n12 - t1 * t2 / tt, n22 - t2 * t2 / tt
        b1, b2 = need_1 + t1 * slip / tt, need_2 + t2 * slip / tt
    else:
        a11, a12, a21, a22 = n11 + pull * t1, n12 + pull * t1, n12 + pull * t2, n22 + pull * t2
        b1, b2 = need_1, need_2
    if second < 0:
        up_1, up_2 = b1 / a11, 0.0
    else:
        determinant = a11 * a22 - a12 * a21
        up_1, up_2 = (a22 * b1 - a12 * b2) / determinant, (a11 * b2 - a21 * b1) / determinant
    up = up_1 + up_2
    along = -(slip + t1 * up_1 + t2 * up_2) / tt if mode == STICK else pull * up
    rounding = TOLERANCE * (abs(up_1) + abs(up_2))
    obeys = up_1 >= -rounding and up_2 >= -rounding
    if mode == STICK:
        obeys = obeys and abs(along) <= friction * up + rounding
    else:
        slides = slip + t1 * up_1 + t2 * up_2 + tt * along
        obeys = obeys and (slides if mode == FORWARD else -slides) >= -TOLERANCE * (abs(slip) + tt * abs(along))
    rises, turns = lift * up + lean * (row_1 * up_1 + row_2 * up_2) + drag * along, free.foot
    turns += lean * up + spin * (row_1 * up_1 + row_2 * up_2) + tilt * along
    for index in range(len(model.sole_m)):
        if index not in (first, second):
            least = least_m_s(model, ground, index)
            rate = free.ankle.imag + rises - arm_m(model, ground, index) * turns
            obeys = obeys and rate >= least - TOLERANCE * (abs(least) + abs(free.ankle.imag) + abs(rises))
    return obeys, Contact(first, second, mode, up_1, up_2, along)


@compiled
def contact_of(model: PlanarModel, ground: Stance, gains: Gains, free: PlanarMotion, last: Contact) -> Contact:
    """Return the ground's impulses, beginning with the mode of the last step; NaN if no mode obeys the laws."""
    count = len(model.sole_m)
    touches = False
    for index in range(count):
        falls = free.ankle.imag - arm_m(model, ground, index) * free.foot
        touches = touches or falls < least_m_s(model, ground, index)
    if not touches:
        return Contact(-1, -1, SEPARATE, 0.0, 0.0, 0.0)
    if last.mode != SEPARATE:
        obeys, contact = contact_in_mode(model, ground, gains, free, last.first, last.second, last.mode)
        if obeys:
            return contact
    for first in range(count):
        for second in range(-1, first):
            for mode in (STICK, FORWARD, BACKWARD):
                obeys, contact = contact_in_mode(model, ground, gains, free, first, second, mode)
                if obeys:
                    return contact
    return Contact(-1, -1, SEPARATE, math.nan, math.nan, math.nan)


@compiled
def settle(
    model: PlanarModel, ground: Stance, gains: Gains, free: PlanarMotion, last: Contact, held: bool
) -> tuple[PlanarMotion, Contact, float]:
    """Return velocities after a step, the ground's impulses, and the impulse that holds the leg joint if it is held."""
    by_x, by_z, by_foot, by_leg = gains
    hold = 0.0
    if held:
        hold = -free.leg / by_leg.leg
        free = plus(free, by_leg, hold)
        gains = Gains(
            plus(by_x, by_leg, -by_x.leg / by_leg.leg), plus(by_z, by_leg, -by_z.leg / by_leg.leg),
            plus(by_foot, by_leg, -by_foot.leg / by_leg.leg), by_leg,
        )  # fmt: skip
    contact = contact_of(model, ground, gains, free, last)
    up, turning = contact.first_ns + contact.second_ns, turning_impulse(model, ground, contact)
    after = plus(plus(plus(free, gains.x, contact.along_ns), gains.z, up), gains.foot, turning)
    if held:
        hold -= (by_x.leg * contact.along_ns + by_z.leg * up + by_foot.leg * turning) / by_leg.leg
    return after, contact, hold


@compiled
def settle_with_friction(
    model: PlanarModel, ground: Stance, gains: Gains, free: PlanarMotion, last: Contact, limit_ns: float
) -> tuple[PlanarMotion, Contact, float]:
    """Like `settle`, with dry friction on the leg joint: all of it against the motion, or what holds it still."""
    if limit_ns == 0.0:
        return settle(model, ground, gains, free, last, False)
    against = -limit_ns if free.leg >= 0.0 else limit_ns
    for friction in (against, -against):
        rubbed = plus(free, gains.leg, friction)
        after, contact, _ = settle(model, ground, gains, rubbed, last, False)
        if after.leg * friction <= 0.0:
            return after, contact, friction
    return settle(model, ground, gains, free, last, True)


@compiled
def settle_at_stop(
    model: PlanarModel, ground: Stance, gains: Gains, free: PlanarMotion, last: Contact, leg_rad: float
) -> tuple[PlanarMotion, Contact, float]:
    """Do as `settle` with the leg in the stop: the pad pushes back, but no more than brings the leg to a standstill."""
    push = -2.0 * ground.half_s * model.stop_nm_per_rad * max(leg_rad - model.stop_rad, 0.0)
    pushed = plus(free, gains.leg, push)
    after, contact, _ = settle(model, ground, gains, pushed, last, False)
    if after.leg >= 0.0:
        return after, contact, push
    return settle(model, ground, gains, free, last, True)


@compiled
def step(model: PlanarModel, moment: StepState, dt: float) -> StepState:
    """Return the moment a time step later."""
    before, half = moment.speed, 0.5 * dt
    ankle, foot_rad = moment.ankle_m + half * before.ankle, moment.foot_rad + half * before.foot
    leg_rad = moment.leg_rad + half * before.leg
    turn = complex(math.cos(foot_rad), -math.sin(foot_rad))
    ground, links = Stance(ankle, turn, half), links_at(model, leg_rad)
    inertia = inertia_at(model, links, turn)
    gains = gains_of(inertia)
    last, dry, middle = moment.contact, moment.dry_nm, before
    after, contact, friction_ns, stop_ns = before, last, 0.0, 0.0
    for _ in range(2):
        ankle_n, foot_nm, leg_nm = forces(model, links, inertia, turn, leg_rad, middle)
        free = plus(before, response(inertia, ankle_n, foot_nm, leg_nm), dt)
        after, contact, friction_ns = settle_with_friction(model, ground, gains, free, last, dt * dry)
        stop_ns = 0.0
        if after.leg > 0.0 and leg_rad + half * after.leg > model.stop_rad:
            rubbed = plus(free, gains.leg, friction_ns)
            after, contact, stop_ns = settle_at_stop(model, ground, gains, rubbed, last, leg_rad)
        middle = plus(before, plus(after, before, -1.0), 0.5)
        dry = dry_torque(model, links)
    return StepState(
        ankle + half * after.ankle, foot_rad + half * after.foot, leg_rad + half * after.leg, after, contact, dry,
        _more_losses(model, moment.losses, links, ground, middle, contact, friction_ns, stop_ns),
        _belly_gap_m(model, links, ground), links.closed,
    )  # fmt: skip


@compiled
def _more_losses(
    model: PlanarModel, losses: Losses, links: Links, ground: Stance, middle: PlanarMotion, contact: Contact,
    friction_ns: float, stop_ns: float,
) -> Losses:  # fmt: skip
    """Return the losses after a step: impulses times the mean of the velocities before and after."""
    damped = 1.0 + links.pin1[1] * links.pin1[1] + links.pin1[2] * links.pin1[2]
    along = contact.along_ns * (middle.ankle.real - ground.ankle_m.imag * middle.foot)
    up, turning = contact.first_ns + contact.second_ns, turning_impulse(model, ground, contact)
    ground_j = contact.along_ns * middle.ankle.real + up * middle.ankle.imag + turning * middle.foot
    return Losses(
        losses.damping_j + 2.0 * ground.half_s * model.damping_nms_per_rad * damped * middle.leg * middle.leg,
        losses.friction_j - friction_ns * middle.leg, losses.slip_j - along, losses.impact_j - (ground_j - along),
        losses.stop_j - stop_ns * middle.leg,
    )  # fmt: skip


@compiled
def _belly_gap_m(model: PlanarModel, links: Links, ground: Stance) -> float:
    """Return the least distance of the body's spheres from the ground."""
    gap, middle = math.inf, 0.5 * (links.back_pivot + links.front_pivot)
    for index in range(len(model.belly_m)):
        centre = ground.ankle_m + (middle + model.belly_m[index] * links.pitch) * ground.turn
        gap = min(gap, centre.imag - model.belly_radius_m[index])
    return gap


@compiled
def released(model: PlanarModel, leg_rad: float, leg_rad_s: float, ankle_m: complex) -> StepState:
    """Return the robot on a flat foot, its leg joint at an angle and turning."""
    nothing = Contact(-1, -1, SEPARATE, 0.0, 0.0, 0.0)
    still = PlanarMotion(0j, 0.0, leg_rad_s)
    return StepState(ankle_m, 0.0, leg_rad, still, nothing, 0.0, Losses(0.0, 0.0, 0.0, 0.0, 0.0), math.inf, True)


@compiled
def advance(model: PlanarModel, moment: StepState, dt: float, steps: int) -> StepState:
    """Return the moment a number of time steps later, or the first at which the loop is open."""
    for _ in range(steps):
        if moment.closed:
            moment = step(model, moment, dt)
    return moment


@compiled
def push_off(
    model: PlanarModel, moment: StepState, dt: float, airborne_s: float, clearance_m: float, within_s: float,
    max_time_s: float, audit_every: int,
) -> PushOff:  # fmt: skip
    """Advance from release to the last contact with the ground before the robot flies.

    It flies once it has been in the air for `airborne_s` and cleared the ground by `clearance_m`, its centre of mass
    rising, and the springs are unloaded: the leg joint is past rest, or extends no further. A hop before that is a part
    of the push-off. A robot on the ground `within_s` after the springs have passed rest, or at `max_time_s`, or one
    whose body comes down to the ground, does not fly.
    """
    start_j, worst, gap, deadline = energy(model, moment), -math.inf, math.inf, max_time_s
    left, steps, aloft = moment, 0, 0
    least = max(1, round(airborne_s / dt))
    while True:
        after = step(model, moment, dt)
        lost = not math.isfinite(after.leg_rad)
        if lost or not after.closed:
            return PushOff(False, steps, moment, math.inf if lost else worst, gap)
        moment = after
        steps += 1
        if steps % audit_every == 0:
            worst = max(worst, energy(model, moment) - start_j)
        aloft = 0 if moment.contact.first_ns + moment.contact.second_ns > 0.0 else aloft + 1
        if aloft == 1:
            left = moment
        if aloft <= 1:
            gap = min(gap, moment.belly_gap_m)
        if moment.leg_rad >= 0.0:
            deadline = min(deadline, steps * dt + within_s)
        spent = moment.leg_rad >= 0.0 or moment.speed.leg <= 0.0
        clear = clearance_m == 0.0 or gap_m(model, moment) >= clearance_m
        if spent and clear and aloft >= least and rising(model, moment):
            return PushOff(True, steps - aloft + 1, left, max(worst, energy(model, left) - start_j), gap)
        if steps * dt > deadline or gap < 0.0:
            return PushOff(False, steps, moment, worst, gap)


@compiled
def gap_m(model: PlanarModel, moment: StepState) -> float:
    """Return the distance of the lowest sphere of foot and body from the ground."""
    gap, turn = moment.belly_gap_m, complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))
    for index in range(len(model.sole_m)):
        gap = min(gap, (moment.ankle_m + model.sole_m[index] * turn).imag - model.sole_radius_m[index])
    return gap


@compiled
def rising(model: PlanarModel, moment: StepState) -> bool:
    """Tell whether the centre of mass rises."""
    turn = complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))
    return centre_speed(inertia_at(model, links_at(model, moment.leg_rad), turn), moment.speed).imag > 0.0


@compiled
def touchdown(
    model: PlanarModel, moment: StepState, loaded_rad: float, corners: tuple[Any, Any, Any], below_m: float,
    swing_points: int, moments: int, slowest: float,
) -> tuple[float, float]:  # fmt: skip
    """Return way (m) and pitch (rad) of a robot at its first touch of the ground, from its take-off.

    The closed form of `jumpcad.simulation.flight`, which has the last four parameters, for thousands of jumps.
    `loaded_rad` is the leg's angle where the robot stands loaded, against which way and pitch count; `corners` are
    points x + iz of the bodies, in their frames, with the index of the body and a radius of each.
    """
    stood, links, speed = links_at(model, loaded_rad), links_at(model, moment.leg_rad), moment.speed
    stand, turn = inertia_at(model, stood, 1.0 + 0j), complex(math.cos(moment.foot_rad), -math.sin(moment.foot_rad))
    inertia = inertia_at(model, links, turn)
    place, velocity = moment.ankle_m + 1j * inertia.by_foot / inertia.mass, centre_speed(inertia, speed)
    momentum = inertia.foot * speed.foot + inertia.both * speed.leg
    free0, whole0 = inertia.leg - inertia.both * inertia.both / inertia.foot, inertia.foot
    stored0 = spring_torque(model, moment.leg_rad) * (model.preload_rad - moment.leg_rad)
    stops = math.isfinite(model.stop_rad)
    end_rad = max(model.stop_rad, moment.leg_rad) if stops else model.preload_rad
    apart = (end_rad - moment.leg_rad) / (swing_points - 1)
    time, turned, mean, rate, coupling, whole, free = 0.0, 0.0, 0.0, 0.0, 0.0, whole0, free0
    for index in range(swing_points):
        angle, share = moment.leg_rad + index * apart, 0.5 if index in (0, swing_points - 1) else 1.0
        at = links_at(model, angle)
        flying = inertia_at(model, at, 1.0 + 0j)
        whole, free = flying.foot, flying.leg - flying.both * flying.both / flying.foot
        coupling = flying.both - at.turn1[0] * whole  # with the body's rate, not the foot's
        gained = stored0 - spring_torque(model, angle) * (model.preload_rad - angle)
        square = free0 * speed.leg * speed.leg + momentum * momentum * (1.0 / whole0 - 1.0 / whole) + gained
        rate = math.sqrt(max(square, slowest * slowest * speed.leg * speed.leg * free) / free)
        time += share * abs(apart) / rate if rate > 0.0 else 0.0
        turned -= share * apart * coupling / whole
        mean += 1.0 / (whole * swing_points)
    turned += time * momentum * mean
    if stops:
        quarter = math.sqrt(free / model.stop_nm_per_rad)
        turned += (0.5 * math.pi * momentum - coupling * rate) * quarter / whole
        time, end_rad = time + 0.5 * math.pi * quarter, end_rad + rate * quarter
    at = links_at(model, end_rad)
    flying = inertia_at(model, at, 1.0 + 0j)
    rate, centre = momentum / flying.foot, 1j * flying.by_foot / flying.mass
    axes = (at.pitch, -at.back_pivot / model.l2_m, (model.l4_m - at.front_pivot) / model.l3_m, 1.0 + 0j)
    points, owners, radii = corners
    arms = points.copy()
    for index in range(len(points)):
        owner = owners[index]
        arm = at.place[owner] - centre + (points[index] - model.com_m[owner]) * axes[owner]
        arms[index] = arm * at.pitch.conjugate()
    leaving, loaded = links.pitch * turn, stood.pitch
    pitch = turned - math.atan2(leaving.imag, leaving.real)
    gravity, up = model.gravity_m_s2, velocity.imag
    fallen_s = (up + math.sqrt(max(up * up + 2.0 * gravity * (place.imag + below_m), 0.0))) / gravity
    between = max(fallen_s - time, 0.0) / (moments - 1)
    before, air, above = 0.0, time, False
    for index in range(moments):
        after, low = index * between, math.inf
        here, turn = time + after, complex(math.cos(pitch + rate * after), -math.sin(pitch + rate * after))
        for corner in range(len(arms)):
            low = min(low, (arms[corner] * turn).imag - radii[corner])
        low += place.imag + (up - 0.5 * gravity * here) * here
        if above and low <= 0.0:
            air = here - between * low / (low - before)
            break
        air, above, before = air if above or low <= 0.0 else here, above or low > 0.0, low
    way = place.real + velocity.real * air + (stand.by_foot / stand.mass).imag
    return way, pitch + rate * (air - time) + math.atan2(loaded.imag, loaded.real)
