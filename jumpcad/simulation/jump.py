"""The result of a simulation."""

from dataclasses import asdict, dataclass, field
from typing import Any

from jumpcad.findings import Finding
from jumpcad.transforms import Array, ByValue

ACCOUNT = {
    "useful": "of the centre of mass: the jump",
    "internal": "turning and swinging about the centre of mass",
    "springs": "still in the springs",
    "release": "lost between cam and roller",
    "pins": "lost in the joints' friction",
    "slip": "lost by slipping on the ground",
    "contact": "lost in impacts and rounding",
}
"""The entries of `Jump.energy_account_j` in words."""


@dataclass(frozen=True)
class EnergyBudget:
    """Where the energy that was loaded into the springs is at take-off (J); the sum of all is that energy.

    `forward_j` and `upward_j` are the kinetic energy of the centre of mass, which makes the jump; `internal_j` is
    that of the bodies about it; `lift_j` is the height already gained; `spring_j` is still in the springs;
    `release_j` is lost between cam and roller, `joint_damping_j` in the joints by damping and dry friction, `slip_j`
    by friction on the ground, and `contact_j` by impact on ground or stop and the engine's numerics.
    """

    forward_j: float
    upward_j: float
    internal_j: float
    lift_j: float
    spring_j: float
    release_j: float
    joint_damping_j: float
    slip_j: float
    contact_j: float

    @property
    def account_j(self) -> dict[str, float]:
        """What makes the jump, what is left, and what is lost where; the values add up to the loaded energy.

        What an engine's arithmetic has gained makes a loss negative, mostly `contact`; `gained_j` is all of it.
        """
        return {
            "useful": self.forward_j + self.upward_j + self.lift_j, "internal": self.internal_j,
            "springs": self.spring_j, "release": self.release_j, "pins": self.joint_damping_j, "slip": self.slip_j,
            "contact": self.contact_j,
        }  # fmt: skip

    @property
    def gained_j(self) -> float:
        """What rounding has gained: where losses are shown from 0 on, they add up to so much more than was loaded."""
        return -sum(min(value, 0.0) for value in self.account_j.values())


@dataclass(frozen=True, eq=False)
class Trajectory(ByValue):
    """Poses of all bodies over n moments, from release on.

    `body_names` (b), `time_s` (n,), `position_m` (n, b, 3) and `quaternion_xyzw` (n, b, 4) of each body's *frame* in
    the world (not of its centre of mass); `kinetic_j`, `potential_j` (above z = 0), `spring_j`, each (n,).
    """

    body_names: tuple[str, ...]
    time_s: Array
    position_m: Array
    quaternion_xyzw: Array
    kinetic_j: Array
    potential_j: Array
    spring_j: Array

    def columns(self) -> dict[str, Array]:
        """Return the whole trajectory as named columns (n,), for tables."""
        table = {"time_s": self.time_s}
        for index, name in enumerate(self.body_names):
            table |= {f"{name}_{axis}_m": self.position_m[:, index, i] for i, axis in enumerate("xyz")}
            table |= {f"{name}_q{axis}": self.quaternion_xyzw[:, index, i] for i, axis in enumerate("xyzw")}
        return table | {"kinetic_j": self.kinetic_j, "potential_j": self.potential_j, "spring_j": self.spring_j}


@dataclass(frozen=True, repr=False)
class Jump:
    """The result of one simulation.

    `verdict` is `jump`, `no_takeoff`, the reason of the gate's refusal (`loop`, `below_ground`, `tips`, `too_weak`), or
    that of the audit's (`audit_energy`, `audit_loop`). What only a jump has is None under any other verdict; `fitness`
    (ballistic range over the longest link) is then 0. `release_energy_ratio` is what the springs still hold, with the
    motion of the robot, where the roller has left the cam, over what was loaded: 1 without a cam. Range, rise and
    distances count from where the robot stood with loaded springs. `touchdown_distance_m`, turn, pitch and air time up
    to the first touch of any part are those of `jumpcad.simulation.flight`, in closed form, the distance of a simulated
    flight its own; `touchdown_gap_m` is what the ballistic range, down to the height of the start, counts after it.
    `lateral_offset_mm` is how far the standing robot's centre of mass lies beside the leg's plane, to the left.
    `findings` holds the gate's and the audit's margins.
    """

    verdict: str
    engine: str
    mass_kg: float
    spring_energy_j: float
    fitness: float = 0.0
    touchdown_distance_m: float | None = None
    ballistic_range_m: float | None = None
    com_rise_m: float | None = None
    release_energy_ratio: float | None = None
    takeoff_energy_ratio: float | None = None
    takeoff_speed_m_s: float | None = None
    takeoff_angle_deg: float | None = None
    takeoff_time_s: float | None = None
    touchdown_gap_m: float | None = None
    touchdown_pitch_deg: float | None = None
    turn_deg: float | None = None
    turn_rate_deg_s: float | None = None
    air_time_s: float | None = None
    clears_bar_mm: float | None = None
    bar_distance_mm: float | None = None
    lands_on_mm: float | None = None
    step_distance_mm: float | None = None
    lateral_offset_mm: float | None = None
    energy: EnergyBudget | None = None
    trajectory: Trajectory | None = field(default=None, hash=False)
    findings: tuple[Finding, ...] = ()

    def __repr__(self) -> str:
        figures = (("touchdown at", self.touchdown_distance_m), ("rise", self.com_rise_m))
        shown = "".join(f", {name} {value:.3f} m" for name, value in figures if value is not None)
        return f"<Jump {self.verdict}{shown}, fitness {self.fitness:.3f}, {1000.0 * self.mass_kg:.1f} g, {self.engine}>"

    @property
    def energy_account_j(self) -> dict[str, float] | None:
        """The energy that was loaded: useful, internal, springs, release, pins, slip, contact; see `EnergyBudget`."""
        return None if self.energy is None else self.energy.account_j

    @property
    def kinetic_ratio(self) -> float | None:
        """Kinetic energy of the centre of mass at take-off over the springs' energy; None without a jump."""
        return None if self.energy is None else (self.energy.forward_j + self.energy.upward_j) / self.spring_energy_j

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON, without the trajectory."""
        data = {name: value for name, value in vars(self).items() if name not in ("trajectory", "findings")}
        data["energy"] = None if self.energy is None else asdict(self.energy)
        data["energy_account_j"] = self.energy_account_j
        data["findings"] = [finding.to_dict() for finding in self.findings]
        return data
