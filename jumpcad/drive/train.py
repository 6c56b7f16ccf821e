"""The drive train: motor and gears that turn the cam, as few pairs as fit, light and quick, strong enough.

Torques in N·m, lengths in mm.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from jumpcad.catalogue import Motor
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.gear_choice import by_cost
from jumpcad.drive.gears import GearPair
from jumpcad.drive.motor import EMPTY_SHARE, TrainLimits, allowed_nm, free_speed_rad_s, winding
from jumpcad.errors import CannotBuildError
from jumpcad.findings import SHOWN_AS, Basis, Finding, Remedy, at_most, higher, limit, lower

CONTACT_RATIO_MIN = 1.1
"""Least pairs of teeth in contact on average; judgement: handbooks advise 1.2 for gears that run long and fast."""
BASIS = {
    "motor_torque": Basis(
        "U/(lift - ramp/2)/(i·η) ≤ min(f·safety.motor_stall_share·T_stall, f·safety.motor_torque_max_nm, "
        f"{EMPTY_SHARE:g}·T_empty) (N·m); U springs' energy, lift and ramp cam angles of 310° and 30° in rad, i "
        f"ratio, η = {TrainLimits.cam_efficiency:g}·safety.gear_efficiency^pairs, T_stall at rated voltage, T_empty "
        "with an empty battery, f = (1 - safety.motor_torque_reserve)/(1 + safety.spring_rate_scatter)",
        "constant torque over the lift; T_stall and its share: makers' data sheets, templates/hardware/motors.toml; "
        f"{TrainLimits.cam_efficiency:g} and {EMPTY_SHARE:g}: judgement",
    ),
    "cam_speed": Basis(
        f"ω/i ≤ min({TrainLimits.cam_speed_max_rad_s:g} rad/s, (window - play - 3°)/0.05 s) (rad/s, shown in °/s); ω "
        "unloaded with a full battery, i ratio, window as of `release_window`",
        "judgement: the next lift must not reach the roller while the leg swings back",
    ),
    "gear_strength_*": Basis(
        "F/(b·m·Y) ≤ the gears' strength_in_plane_mpa/s (MPa); F = T/pitch radius of the pinion with all load at "
        "the tip of one tooth, b width, m module, Y form factor of the tooth as the rack cuts it",
        "Lewis (Shigley 14-1)",
    ),
    "gear_mesh_*": Basis(
        f"min(g, ε - {CONTACT_RATIO_MIN:g}) ≥ 0; ε contact ratio, g length of roll (mm) by which contact ends before "
        "either fillet begins",
        "ISO 21771; least contact ratio: judgement, handbooks advise 1.2",
    ),
    "cam_gear_room": Basis(
        "r_tip ≤ a - axle with its spacers - gap (mm); a from the hub to the cam's axis", "geometry; gap: judgement"
    ),
}


class NoTrainError(CannotBuildError):
    """No motor and gears turn a cam within their limits."""


@dataclass(frozen=True)
class GearTrain:
    """Motor and gear pairs, in order from the motor to the cam.

    - `motor`, `driven`: As it is sold, and as it behaves at the battery's nominal voltage under load.
    - `ratio`, `efficiency`: Motor turns per cam turn; share of the motor's work that reaches the springs while they are
      loaded.
    - `wheel_torques_nm`: Largest torque on the wheel of each pair.
    - `cam_speed_rad_s`: Speed of the unloaded cam with a full battery.
    - `motor_torque_nm`: Largest torque on the motor's output.
    - `winding_s`, `mean_current_a`, `peak_current_a`, `motor_j`, `boards_j`: For one turn of the cam, which is one
      jump, at the battery's nominal voltage under load: time, currents of the motor, and energy of motor and of boards.
      Waiting before the jump is not counted.
    """

    motor: Motor
    driven: Motor
    stages: tuple[GearPair, ...]
    ratio: float
    efficiency: float
    wheel_torques_nm: tuple[float, ...]
    cam_speed_rad_s: float
    motor_torque_nm: float
    winding_s: float
    mean_current_a: float
    peak_current_a: float
    motor_j: float
    boards_j: float
    findings: tuple[Finding, ...]

    @property
    def electrical_j(self) -> float:
        """Energy from the battery for one jump: of the motor, and of the boards while it winds."""
        return self.motor_j + self.boards_j


def synthesise_train(law: CamLaw, motors: Sequence[Motor], limits: TrainLimits) -> GearTrain:
    """Choose motor and gears for a cam."""
    if not motors:
        raise CannotBuildError("no motor is allowed: name at least one of the catalogue's motors")
    for count in (1, 2):
        for motor, stages in by_cost(law, motors, limits, count):
            train = finished_train(law, motor, stages, limits)
            if all(finding.margin >= 0 for finding in train.findings):
                return train
    torque = law.peak_torque_nm / limits.cam_efficiency
    allowed = max(allowed_nm(motor, limits) for motor in motors)
    ways: Remedy = (*lower("stiffness_nmm_per_deg", "compression_ratio"), "allow a stronger motor")
    if torque < allowed * limits.pair_efficiency:  # the motor is strong enough, and too fast
        ways = (*higher("stiffness_nmm_per_deg", "compression_ratio"), "allow a slower motor")
    raise NoTrainError(
        f"no motor turns the cam: it needs {1000 * torque:.0f} mN·m, the strongest allowed motor may give "
        f"{1000 * allowed:.0f} mN·m, and no one or two gear pairs make "
        f"{torque / allowed / limits.pair_efficiency:.1f}:1 (limits: {math.degrees(limits.cam_speed_max_rad_s):.0f} "
        f"°/s, {limits.cam_gear_tip_max_mm:.1f} mm radius of the cam gear, {limits.stress_mpa:g} MPa in "
        f"teeth {limits.face_width_mm:g} mm wide)",
        ways=ways,
    )


def finished_train(law: CamLaw, motor: Motor, stages: tuple[GearPair, ...], limits: TrainLimits) -> GearTrain:
    """Return a train with its figures, and every limit with its margin."""
    ratio = math.prod(pair.ratio for pair in stages)
    efficiency = limits.efficiency(len(stages))
    peak = law.peak_torque_nm / (ratio * efficiency)
    cam_speed = free_speed_rad_s(limits.driven(motor, "full")) / ratio
    torques = [law.peak_torque_nm / limits.cam_efficiency]  # on the wheels, from the cam to the motor
    for pair in stages[:0:-1]:
        torques.append(torques[-1] / (pair.ratio * limits.pair_efficiency))
    torques.reverse()
    driven = limits.driven(motor)
    turn = winding(law, driven, ratio, efficiency)
    boards_j = limits.supply.boards_w * turn.seconds if limits.supply else 0.0
    findings = (*_motor_findings(motor, cam_speed, peak, limits), *_gear_findings(stages, torques, limits))
    return GearTrain(
        motor=motor, driven=driven, stages=stages, ratio=ratio, efficiency=efficiency, wheel_torques_nm=tuple(torques),
        cam_speed_rad_s=cam_speed, motor_torque_nm=peak, winding_s=turn.seconds, mean_current_a=turn.mean_current_a,
        peak_current_a=turn.peak_current_a, motor_j=turn.electrical_j, boards_j=boards_j, findings=findings,
    )  # fmt: skip


def _motor_findings(motor: Motor, cam_speed_rad_s: float, torque_nm: float, limits: TrainLimits) -> Iterator[Finding]:
    allowed, (unit, factor) = allowed_nm(motor, limits), SHOWN_AS["rad/s"]
    yield at_most(
        "motor_torque", torque_nm, allowed, "N·m",
        f"{motor.name} gives {1000 * torque_nm:.1f} mN·m at most; {1000 * allowed:.1f} mN·m are allowed",
        "a stronger motor, or a larger ratio",
    )  # fmt: skip
    yield at_most(
        "cam_speed", cam_speed_rad_s, limits.cam_speed_max_rad_s, "rad/s",
        f"the unloaded cam turns at {factor * cam_speed_rad_s:.0f} {unit}; "
        f"{factor * limits.cam_speed_max_rad_s:.0f} {unit} are allowed",
        "a slower motor, or a larger ratio",
    )  # fmt: skip


def _gear_findings(
    stages: tuple[GearPair, ...], wheel_torques_nm: list[float], limits: TrainLimits
) -> Iterator[Finding]:
    """Yield strength and mesh of every pair, from the cam to the motor, and whether the cam's gear fits."""
    for number, pair, torque in reversed([*zip(range(1, len(stages) + 1), stages, wheel_torques_nm, strict=True)]):
        stress = pair.pinion.lewis_stress_mpa(torque / pair.ratio)
        yield at_most(
            f"gear_strength_{number}", stress, limits.stress_mpa, "MPa",
            f"bending of teeth, pair {number}: {stress:.1f} of {limits.stress_mpa:.1f} MPa "
            "(Lewis, load at one tip)",
            "wider gears, or a larger module",
        )  # fmt: skip
        yield limit(
            f"gear_mesh_{number}", min(pair.involute_margin_mm, pair.contact_ratio - CONTACT_RATIO_MIN), "mm",
            f"pair {number} has a contact ratio of {pair.contact_ratio:.2f}, of {CONTACT_RATIO_MIN:g} at least; "
            f"contact ends {pair.involute_margin_mm:.2f} mm before the fillets, of 0 mm at least",
            "more teeth",
        )  # fmt: skip
    tip, fits = stages[-1].wheel.tip_radius_mm, limits.cam_gear_tip_max_mm
    message = f"the cam gear's tip radius is {tip:.1f} mm; {fits:.1f} mm fit"
    yield at_most("cam_gear_room", tip, fits, "mm", message, "a stronger motor, or another pair of gears")
