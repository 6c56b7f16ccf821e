"""From a design to its drive: torsion springs, snail cam, gear train and motor, in plain numbers."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from jumpcad.catalogue import Catalogue, Motor, StockSpring, load_catalogue
from jumpcad.design import Design
from jumpcad.dimensions import CLEAR_MM, SPACER_RADIUS_MM
from jumpcad.drive.cam import Cam
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import CamLimits
from jumpcad.drive.cam_search import synthesise_cam
from jumpcad.drive.corner import clear_window_rad
from jumpcad.drive.dog import PLAY_MORE_RAD, Dog, free_play_rad
from jumpcad.drive.gear_choice import least_tip_mm
from jumpcad.drive.motor import FACE_WIDTHS_MM, TrainLimits
from jumpcad.drive.spring import SpringLimits, TorsionSpring
from jumpcad.drive.spring_choice import fitted_spring, rate_finding, springs_on_leg, synthesise_spring
from jumpcad.drive.train import GearTrain, NoTrainError, synthesise_train
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, higher

LEAST_TURN_RAD = math.radians(1.0)
"""Least cam angle that the motor may turn while the leg swings back; `release_window` reports where there is less."""
LEAST_COMPRESSION_RAD = math.radians(0.5)
"""Below it the cam's lift is less than a printer can resolve; judgement."""
LEG_SHARE = 0.5
"""Of the main leg, up to which its pin for the springs may stand; judgement: the beam tapers towards the ankle."""


@dataclass(frozen=True)
class DriveLimits:
    """The limits of a drive in a workshop, beside parts of some size.

    The cam's `hub_radius_mm` and the train's `cam_gear_tip_max_mm`, `cam_room_mm`, `idler_distance_min_mm`
    and `cam_speed_max_rad_s` are tightened by the spring and the cam that were found.

    - `motors`: Names in the catalogue; an empty tuple allows all.
    - `dog_mm`: Diameter of the dog between cam and cam gear.
    - `stock_spring`, `preload_rad`: The springs from stock, None where they are made to order; how far they are loaded
      at rest.
    - `fall_s`: Time from release to the leg's swing past rest, during which the motor may turn the cam; the default is
      that of robots of 0.1 kg with strong springs.
    - `more_gap_mm`: How much farther than necessary the cam's axis may be from the hub, in the order tried: a farther
      axis makes room for a larger cam gear, and one pair of gears is lighter than two. Gaps that are too small for one
      pair are left out. Judgement: a body has no room for more.
    """

    spring: SpringLimits
    cam: CamLimits
    train: TrainLimits
    motors: tuple[str, ...]
    dog_mm: float
    stock_spring: StockSpring | None = None
    preload_rad: float = 0.0
    fall_s: float = 0.05
    more_gap_mm: tuple[float, ...] = (0.0, 2.5, 5.0, 7.5, 10.0)


@dataclass(frozen=True)
class Drive:
    """Springs, cam, dog and gear train of one design, and every limit that was checked with its margin."""

    spring: TorsionSpring
    cam: Cam
    train: GearTrain
    dog: Dog

    @property
    def findings(self) -> tuple[Finding, ...]:
        """All findings, from the springs to the motor."""
        return self.spring.findings + self.cam.findings + self.train.findings


def synthesise(design: Design, limits: DriveLimits, catalogue: Catalogue | None = None) -> Drive:
    """Find springs, cam, gears and motor for a design, each as small as its limits allow."""
    catalogue = catalogue or load_catalogue()
    compression = design.compression_rad
    if compression < LEAST_COMPRESSION_RAD:
        raise CannotBuildError(
            f"the springs are loaded by {math.degrees(compression):.2f}°, less than "
            f"{math.degrees(LEAST_COMPRESSION_RAD):g}°",
            "compression", math.degrees(compression - LEAST_COMPRESSION_RAD), "°",
            higher("compression_ratio", "rest_angle_deg", "c_coef"),
        )  # fmt: skip
    spring = _spring(design, limits, catalogue)
    stiffness = 2.0 * spring.stiffness_nm_per_rad
    ours = limits.cam
    law = CamLaw(compression, stiffness, ours.lift_rad, ours.ramp_rad, spring.preload_rad, ours.ease_rad)
    motors = [catalogue.motors[name] for name in limits.motors or tuple(catalogue.motors)]
    refusal: CannotBuildError | None = None
    for width in FACE_WIDTHS_MM:
        beside = replace(limits, train=replace(limits.train, face_width_mm=width))
        try:
            cam, train = _cam_and_train(law, motors, spring.outer_diameter_mm, beside)
        except NoTrainError as error:  # wider teeth carry more
            refusal = error
        else:
            return Drive(spring, cam, train, _dog(cam, limits))
    assert refusal is not None
    raise refusal


def _spring(design: Design, limits: DriveLimits, catalogue: Catalogue) -> TorsionSpring:
    """Find the springs, from stock or made to order; the leg's pin stands on its middle line."""
    stock, leg_pin = limits.stock_spring, -math.radians(design.rest_angle_deg)
    on_leg = springs_on_leg(design, stock, limits.preload_rad)
    if stock is None:
        return synthesise_spring(on_leg, leg_pin, catalogue.wire, limits.spring)
    spring = fitted_spring(stock, on_leg, leg_pin, catalogue.wire, limits.spring)
    needed, reach = spring.arms.pin_radius_mm, LEG_SHARE * design.l2_mm
    if needed > reach:
        raise CannotBuildError(
            f"bought.spring = {stock.name!r}: its arms need the leg's pin {needed:.1f} mm from the axle; "
            f"in a leg of {design.l2_mm:.1f} mm at most {reach:.1f} mm is possible",
            "spring_pin", reach - needed, ways=("choose a smaller spring", *higher("carrying_link_mm")),
        )  # fmt: skip
    return replace(spring, findings=(*spring.findings, rate_finding(design, stock)))


def _cam_and_train(law: CamLaw, motors: Sequence[Motor], coil_mm: float, limits: DriveLimits) -> tuple[Cam, GearTrain]:
    """Find cam and gears beside a spring's coil: one pair of gears where the cam's axis can make room for it."""
    around = max(limits.cam.hub_radius_mm, coil_mm / 2)
    found: tuple[Cam, GearTrain] | None = None
    refusal: CannotBuildError | None = None
    enough = 0.0
    for more in limits.more_gap_mm:
        if more < enough:
            continue
        gap = limits.cam.gap_min_mm + more
        try:
            cam = synthesise_cam(law, replace(limits.cam, hub_radius_mm=around, gap_min_mm=gap))
        except CannotBuildError as error:  # with a farther axis fewer cams are possible
            refusal = refusal or error
            break
        beside = _train_limits(cam, limits)
        try:
            train = synthesise_train(law, motors, beside)
        except CannotBuildError as error:
            refusal = refusal or error
        else:
            if len(train.stages) == 1:
                return cam, train
            found = found or (cam, train)
        if found is not None:  # two pairs work here; farther away only one pair would be better
            tip = least_tip_mm(law, motors, beside)
            enough = more + tip - beside.cam_gear_tip_max_mm if tip <= limits.train.cam_gear_tip_max_mm else math.inf
    if found is None:
        assert refusal is not None
        raise refusal
    return found


def _dog(cam: Cam, limits: DriveLimits) -> Dog:
    """Return the dog of a cam, its play rounded to thousandths of a degree: the cam is known no better."""
    play = float(free_play_rad(cam.roll_over_rad, limits.cam.play_rad))
    return Dog(math.radians(round(math.degrees(play), 3)), limits.dog_mm)


def _train_limits(cam: Cam, limits: DriveLimits) -> TrainLimits:
    """Return the limits of motor and gears beside a cam: its gear passes the leg's axle, an idler's axle the cam."""
    room = math.hypot(*cam.geometry.axis_mm) - SPACER_RADIUS_MM - CLEAR_MM
    around = cam.outer_radius_mm + CLEAR_MM
    _, window = clear_window_rad(cam.geometry)
    play = float(free_play_rad(cam.roll_over_rad, limits.cam.play_rad))
    turn = max(window - play - PLAY_MORE_RAD, LEAST_TURN_RAD)
    train = limits.train
    return replace(
        train, cam_gear_tip_max_mm=min(train.cam_gear_tip_max_mm, room), cam_room_mm=max(train.cam_room_mm, around),
        idler_distance_min_mm=max(train.idler_distance_min_mm, around + SPACER_RADIUS_MM),
        cam_speed_max_rad_s=min(train.cam_speed_max_rad_s, turn / limits.fall_s),
    )  # fmt: skip
