"""One measured robot: built in its workshop, and its measurements, checked against the built model."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from pathlib import Path

import numpy as np

from jumpcad.building import build
from jumpcad.calibration.measurements import Measurements, contradictions, lengths, load_measurements
from jumpcad.calibration.priors import FLOOR, TRAVEL_MM, Prior, modelled_mass, tested_floor, weighed_mass
from jumpcad.calibration.surface import Surface, surface_of
from jumpcad.calibration.video import TakeoffSeen, read_points, seen_takeoff
from jumpcad.design import load_design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.landing.landing import distances_m
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.robot.robot import Robot
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.simulation.mechanics import Mechanics, loaded_state
from jumpcad.workshop import load_workshop

LANDINGS = (0.7, 0.85, 1.0, 1.2, 1.5)
"""Spring energies over the model's at which the touchdown is simulated."""
TRIES = 8
"""Landings at each of them, where they are simulated."""
UNITS = {
    **dict.fromkeys(("mass", "part"), ((1e-3, "is that kg?"), (10.0, "a digit too many?"), (0.1, "a digit too few?"))),
    "rate": (
        (180.0 / math.pi, "is that per radian?"), (1e-3, "is that N·m/deg?"), (0.5, "is that of one spring?"),
        (180.0 / math.pi / 1000.0, "is that N·m/rad?"), (10.0, "a digit too many?"), (0.1, "a digit too few?"),
    ),
    "length": ((1e-3, "is that m?"), (0.1, "is that cm?"), (10.0, "a digit too many?")),
    "energy": ((1e3, "is that mJ?"), (1.0 / 3600.0, "is that Wh?"), (10.0, "a digit too many?")),
}  # fmt: skip
"""The factor by which a mistake changes a value, and the question that the error asks."""
LARGEST_FACTOR = {"mass": 2.5, "part": 5.0, "rate": 1.8, "length": 5.0, "energy": 5.0}
"""By which a value may be larger or smaller than the model's."""
SAME_RATE_SHARE, RATE_DEVIATIONS = 0.01, 3.0
"""By which the rates of one pair of springs may differ, by design, and measured (standard deviations)."""
MOST_ENERGY_SHARE = 1.1
"""Largest energy of a jump over that of the springs; above 1 because both have errors."""


@dataclass(frozen=True, repr=False)
class Subject:
    """A robot with its measurements; `seen` has the take-off of each of its videos, `travel` is that after landing."""

    name: str
    measured: Measurements
    robot: Robot
    seen: tuple[TakeoffSeen, ...]
    travel: Prior = TRAVEL_MM

    @cached_property
    def surface(self) -> Surface:
        """The response surface of its jump over the calibrated parameters."""
        return surface_of(self.robot)

    @cached_property
    def standing_m(self) -> float:
        """Height of the centre of mass above the floor, springs loaded (m)."""
        return float(Mechanics(self.robot, GRAVITY_M_S2).centre_of_mass_m(loaded_state(self.robot))[2])

    @cached_property
    def beyond_m(self) -> tuple[float, float]:
        """Distance at first touchdown less ballistic range: mean and standard deviation over `LANDINGS` (m)."""
        jumps = (simulate(with_spring_factor(self.robot, energy), engine="planar") for energy in LANDINGS)
        further = [-jump.touchdown_gap_m for jump in jumps if jump.touchdown_gap_m is not None]
        return (float(np.mean(further)), float(np.std(further))) if further else (0.0, 0.02)

    def landing(self) -> "Subject":
        """Return the robot with the travel of simulated landings: normal, with their mean and deviation (MuJoCo)."""
        rng, found = np.random.default_rng(0), []
        for energy in LANDINGS:
            jumps = distances_m(with_spring_factor(self.robot, energy), TRIES, rng)
            found += [rest - touchdown for touchdown, rest in jumps]
        mean, deviation = 1000.0 * float(np.mean(found)), 1000.0 * float(np.std(found))
        return replace(self, travel=Prior("normal", mean, deviation, "simulated landings", 0.0))

    @property
    def electrical_j(self) -> float:
        """Energy from the battery for one winding, by the model (J)."""
        return self.robot.layout.drive.train.electrical_j

    @property
    def fastest_m_s(self) -> float:
        """Take-off speed if all of the springs' energy went into it, with rate and mass as measured."""
        energy_j, mass_kg = self.robot.spring.energy_j * self.rate.first, self.robot.mass_kg * self.mass.first
        return math.sqrt(2.0 * energy_j / mass_kg)

    @property
    def pair(self) -> str:
        """Name of its pair of springs: as measured, by default the robot's."""
        return self.measured.spring.pair or self.name

    @property
    def rate_nmm_per_deg(self) -> float:
        """Rate of both springs together in the model."""
        return 1000.0 * math.radians(self.robot.spring.stiffness_nm_per_rad)

    @property
    def rate(self) -> Prior:
        """Prior of the springs' rate over the model's."""
        measured = self.measured.spring.both_nmm_per_deg
        if measured is None:
            scatter = self.robot.workshop.safety.spring_rate_scatter
            return Prior("normal", 1.0, scatter / 2.0, "workshop: safety.spring_rate_scatter as two deviations", 0.3)
        share = measured / self.rate_nmm_per_deg
        return Prior("normal", share, share * self.measured.spring.error_share, "measured", 0.3)

    @property
    def mass(self) -> Prior:
        """Prior of the mass over the model's."""
        weighed = self.measured.mass
        if weighed.robot_g is not None:
            return weighed_mass(weighed.robot_g, 1000.0 * self.robot.mass_kg, weighed.robot_error_g)
        on_scale = (part for part in self.robot.parts if part.mass_source == "weighed")
        known = sum(part.mass.mass_kg * len(part.placements) for part in on_scale)
        return modelled_mass(1.0 - known / self.robot.mass_kg)

    @property
    def floor(self) -> Prior:
        """Prior of the coefficient of friction between feet and floor."""
        weight_n = self.robot.mass_kg * self.mass.first * GRAVITY_M_S2
        tests = self.measured.floor
        found = [pull / weight_n for pull in tests.pull_n]
        found += [math.tan(math.radians(slope)) for slope in tests.slope_deg]
        return tested_floor(found) if found else FLOOR


def load_subject(name_or_path: str | Path) -> Subject:
    """Return the robot of a measurement file, built, with its measurements checked."""
    measured, path = load_measurements(name_or_path)
    design = load_design(_beside(path, measured.design))
    workshop = load_workshop(_beside(path, measured.workshop))
    name = Path(measured.design).stem
    robot = build(design, workshop, name)
    if measured.mass.parts_g:
        modelled = {part.name: 1000.0 * part.mass.mass_kg for part in robot.parts}
        for part, grams in measured.mass.parts_g.items():
            key = f"mass.parts_g.{part}"
            if part not in modelled:
                near, known = did_you_mean(part, modelled), ", ".join(modelled)
                raise JumpcadError(f"{path}: {key}: no such part{near}; the robot has {known}")
            _require_unit(str(path), key, grams, modelled[part], "g", "part")
        mass = workshop.mass.model_copy(update={"weighed_g": workshop.mass.weighed_g | measured.mass.parts_g})
        robot = build(design, workshop.model_copy(update={"mass": mass}).revalidated(), name)
    subject = Subject(path.stem, measured, robot, ())
    videos = [(path.parent / video.points, video.slow_motion) for video in measured.videos]
    seen = (seen_takeoff(read_points(file), str(file), subject.fastest_m_s, slow) for file, slow in videos)
    subject = replace(subject, seen=tuple(seen))
    _require_plausible(subject, str(path))
    return subject


def require_each_once(names: Sequence[str | Path]) -> None:
    """Require that no measurements are named twice, nor under two names: their jumps would count as other jumps."""
    known: list[tuple[str | Path, Path, Measurements, list[Path]]] = []
    for name in names:
        measured, path = load_measurements(name)
        videos = [(path.parent / video.points).resolve() for video in measured.videos]
        for other, at, theirs, seen in known:
            if at == path.resolve() or (measured, videos) == (theirs, seen):
                same = "twice" if str(other) == str(name) else f"too, under the name {other}"
                raise JumpcadError(f"{name}: is given {same}: name the measurements of each robot once")
        known.append((name, path.resolve(), measured, videos))


def _beside(path: Path, name: str) -> str | Path:
    """Return the path of a TOML file relative to the measurements, or a template's name or absolute path as it is."""
    beside = path.parent / name
    return beside if name.endswith(".toml") and not Path(name).is_absolute() else name


def _require_plausible(subject: Subject, source: str) -> None:
    """Reject values in a wrong unit, and energies that contradict each other (`JumpcadError`)."""
    measured, robot = subject.measured, subject.robot
    if measured.mass.robot_g is not None:
        _require_unit(source, "mass.robot_g", measured.mass.robot_g, 1000.0 * robot.mass_kg, "g", "mass")
    rate = measured.spring.both_nmm_per_deg
    if rate is not None:
        _require_unit(source, "spring.rate_nmm_per_deg", rate, subject.rate_nmm_per_deg, "N·mm/° for both", "rate")
    weight_n = robot.mass_kg * subject.mass.first * GRAVITY_M_S2
    jump = simulate(robot, Settings(), "planar")
    for series in measured.jumps:
        for key, model in (("distance_mm", jump.ballistic_range_m), ("height_mm", jump.com_rise_m)):
            for value in getattr(series, key) if model else ():
                expected = 1000.0 * (model or 0.0)
                if key == "height_mm" and series.height_of != "rise":
                    expected += 500.0 * subject.standing_m
                _require_unit(source, f"jumps.{key}", value, expected, "mm", "length")
        for value in series.battery_j:
            _require_unit(source, "jumps.battery_j", value, subject.electrical_j, "J", "energy")
            if value < robot.spring.energy_j:
                raise JumpcadError(
                    f"{source}: jumps.battery_j = {value:g}: the springs alone hold {robot.spring.energy_j:.3g} J: "
                    "measure voltage times current from the start of the winding to the release"
                )
    _require_energy(subject, source)
    for contradiction in contradictions(measured, subject.standing_m, weight_n):
        raise JumpcadError(f"{source}: {contradiction}")


def _require_unit(source: str, key: str, value: float, expected: float, unit: str, kind: str) -> None:
    """Reject a value that differs from the model's by more than `LARGEST_FACTOR`, naming the probable mistake."""
    ratio, most = value / expected, LARGEST_FACTOR[kind]
    if 1.0 / most <= ratio <= most:
        return
    factor, hint = min(UNITS[kind], key=lambda unit: abs(math.log(ratio / unit[0])))
    asked = f" {hint}" if abs(math.log(ratio / factor)) < math.log(2.0) else ""
    raise JumpcadError(f"{source}: {key} = {value:g}: the model has {expected:.3g} {unit}:{asked} give it in {unit}")


def _require_energy(subject: Subject, source: str) -> None:
    """Reject a flight that needs more energy than the springs have, if range and rise are both measured.

    A robot that was not weighed may be as light as the lightest that is believed. A parabola of range R and rise h,
    from take-off to the same height, needs m·g·(h + R²/16h).
    """
    measured = subject.measured
    means = {(one.what, one.of): one.mean_mm / 1000.0 for one in lengths(measured.jumps)}
    rise = means.get(("height", "rise"))
    weighed = measured.mass.robot_g
    mass_g = 1000.0 * subject.robot.mass_kg / LARGEST_FACTOR["mass"] if weighed is None else weighed
    held = subject.robot.spring.energy_j * subject.rate.first
    for of in ("centre-of-mass", "first-touchdown"):
        distance = means.get(("distance", of))
        if rise is None or distance is None:
            continue
        needed = mass_g / 1000.0 * GRAVITY_M_S2 * (rise + distance**2 / (16.0 * rise))
        if needed > MOST_ENERGY_SHARE * held:
            what, measure = ("", "measure") if weighed else (" (not weighed)", "weigh the robot, measure")
            raise JumpcadError(
                f"{source}: jumps.height_mm = {1000.0 * rise:.4g} with distance_mm = {1000.0 * distance:.4g}: takes "
                f"{needed:.3g} J for {mass_g:.3g} g{what}, and the springs hold {held:.3g} J: {measure} the springs' "
                "rate, or say what distance and height are of"
            )


def require_pairs(subjects: Sequence[Subject]) -> None:
    """Require that robots with the same pair of springs have springs of one rate, by design and as measured."""
    for one, other in combinations(subjects, 2):
        if one.pair != other.pair:
            continue
        rates = one.rate_nmm_per_deg, other.rate_nmm_per_deg
        apart = SAME_RATE_SHARE * max(rates)
        springs = one.measured.spring, other.measured.spring
        first, second = (spring.both_nmm_per_deg for spring in springs)
        if first is not None and second is not None and abs(rates[1] - rates[0]) <= apart:
            rates = first, second
            errors = [rate * spring.error_share for rate, spring in zip(rates, springs, strict=True)]
            apart = RATE_DEVIATIONS * math.hypot(*errors)
        if abs(rates[1] - rates[0]) > apart:
            raise JumpcadError(
                f"{other.name}: spring.pair = {other.pair}: its springs have {rates[1]:.3g} N·mm/° together, those of "
                f"{one.name} {rates[0]:.3g}: give both designs the stiffness of the springs that they share, or each "
                "robot a pair of its own"
            )


def renamed(subjects: list[Subject]) -> list[Subject]:
    """Return the subjects with unique names: repeated names get a number."""
    names: dict[str, int] = {}
    found = []
    for subject in subjects:
        names[subject.name] = count = names.get(subject.name, 0) + 1
        found.append(subject if count == 1 else replace(subject, name=f"{subject.name} {count}"))
    return found
