"""Posteriors against cases with a known answer, and robots whose parameters are known."""

import math
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.calibrations import remeasured

from jumpcad.calibration import posterior as module
from jumpcad.calibration.likelihood import CalibrationModel, CalibrationParameter, Datum, Predicted
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.posterior import CalibrationPosterior, _residual, sampled
from jumpcad.calibration.priors import FLOOR, PIN_FRICTION, SPRING_EFFICIENCY
from jumpcad.calibration.subject import Subject
from jumpcad.calibration.surface import JumpAt
from jumpcad.errors import JumpcadError

SAID: dict[str, Any] = {"design": "kenan-2.0", "source": "a test", "release": "dog"}
STEPS = 450
SHORT = {"steps": 150, "most_steps": 150, "walkers_each": 16}
"""Some 500 to 700 independent draws."""
SHORTEST = {"steps": 20, "most_steps": 20, "walkers_each": 8}


def measured(subject: Subject, **data: Any) -> Subject:
    """Return the robot with other measurements."""
    return remeasured(subject, Measurements(**SAID, **data))


def fitted(subject: Subject, **data: Any) -> CalibrationPosterior:
    """Return the posterior of some measurements."""
    return sampled(CalibrationModel([measured(subject, **data)]), 1, **SHORT)


@pytest.fixture(scope="module")
def posterior(subject: Subject) -> CalibrationPosterior:
    """Of a weighed robot with a distance, and the energy of its battery; with chains as long as by default."""
    jumps = ({"distance_mm": (240.0,), "distance_of": "centre-of-mass", "battery_j": (1.6,)},)
    return sampled(CalibrationModel([measured(subject, jumps=jumps, mass={"robot_g": 103.0})]), 1, STEPS)


@pytest.mark.thorough
def test_the_drive_has_the_answer_of_normal_logarithms(posterior: CalibrationPosterior, subject: Subject) -> None:
    """Prior ln d ~ N(ln 0.7, 0.4), datum ln d = ln(model/1.6) ± 0.1 (and the springs' rate ± 0.05): weights 1/σ²."""
    logs = np.log(posterior.values["drive_efficiency"])
    noise = math.hypot(0.10, 0.05)
    weights = np.array([1.0 / 0.4**2, 1.0 / noise**2])
    middle = weights @ np.array([math.log(0.7), math.log(subject.electrical_j / 1.6)]) / weights.sum()
    assert logs.std() == pytest.approx(weights.sum() ** -0.5, rel=0.15)
    assert logs.mean() == pytest.approx(middle, abs=0.04)  # the distance moves the rate a little


def test_what_the_data_say_nothing_of_stays_at_its_prior(posterior: CalibrationPosterior) -> None:
    found = {row["key"]: row for row in posterior.summaries()}
    assert found["pin_friction"]["verdict"] == "stays at its prior"
    assert found["pin_friction"]["spread"] == pytest.approx(1.0, abs=0.15)
    assert found["drive_efficiency"]["verdict"] == "identified"


def test_chains_are_long_enough_or_say_so(posterior: CalibrationPosterior) -> None:
    assert posterior.converged
    assert posterior.effective > 500


def test_the_same_seed_gives_the_same_draws(subject: Subject, posterior: CalibrationPosterior) -> None:
    first, again = (sampled(CalibrationModel(posterior.model.subjects), 1, **SHORTEST) for _ in range(2))
    assert np.array_equal(again.z, first.z)
    assert not np.array_equal(sampled(CalibrationModel(posterior.model.subjects), 2, **SHORTEST).z, first.z)
    assert first.walkers == 8 * len(posterior.model.parameters)
    assert first.steps == SHORTEST["steps"] - SHORTEST["steps"] // 3  # a third is burn-in, and is not kept
    assert len(first.z) == first.steps * first.walkers


def test_distance_of_an_unknown_kind_is_wider(subject: Subject, posterior: CalibrationPosterior) -> None:
    open_kind = fitted(subject, jumps=({"distance_mm": (240.0,), "distance_of": "unknown"},), mass={"robot_g": 103.0})
    known = np.diff(np.quantile(posterior.values["spring_efficiency"], (0.1, 0.9)))
    (row,) = open_kind.residuals()
    assert set(row["readings"]) == {"centre-of-mass", "first-touchdown", "resting-place"}
    assert sum(row["readings"].values()) == pytest.approx(1.0)
    assert "travel:kenan-2.0" in open_kind.values
    assert np.diff(np.quantile(open_kind.values["spring_efficiency"], (0.1, 0.9))) > 0.9 * known


def test_a_weighed_robot_tells_more_of_its_springs(subject: Subject, posterior: CalibrationPosterior) -> None:
    jumps = ({"distance_mm": (240.0,), "distance_of": "centre-of-mass"},)
    light = fitted(subject, jumps=jumps)
    unweighed, weighed = (
        float(np.ptp(np.quantile(one.values["mass:kenan-2.0"], (0.1, 0.9)))) for one in (light, posterior)
    )
    assert weighed < 0.2 * unweighed


@pytest.mark.thorough
def test_hidden_parameters_lie_in_their_intervals(subject: Subject) -> None:
    """Twelve robots drawn from the priors: 80 % intervals hold 9.6 of 12 on average, 7 to 12 with 98 % probability.

    `benchmarks/calibration.py trials` does it a hundred times, for three plans, with the engine's own jumps.
    """
    held = {"energy": 0, "floor": 0, "mass": 0}
    for trial in range(12):
        rng = np.random.default_rng([5, trial])
        true: dict[str, float] = {}
        range_m = math.nan
        while not math.isfinite(range_m):
            true = {
                name: float(prior.at(rng.standard_normal()))
                for name, prior in (
                    ("spring", SPRING_EFFICIENCY),
                    ("rate", subject.rate),
                    ("mass", subject.mass),
                    ("floor", FLOOR),
                )
            }
            true["energy"] = true["spring"] * true["rate"] / true["mass"]
            one = np.ones(1)
            range_m = float(subject.surface.at(true["energy"] * one, 0.25 * one, true["floor"] * one).range_m[0])
        distance = 1000.0 * range_m * math.exp(math.hypot(0.08, 0.03) * rng.standard_t(4.0))
        found = fitted(subject, jumps=({"distance_mm": (distance,), "distance_of": "centre-of-mass"},))
        energy = found.values["spring_efficiency"] * found.values["rate:kenan-2.0"] / found.values["mass:kenan-2.0"]
        for name, values in (
            ("energy", energy), ("floor", found.values["floor:kenan-2.0"]), ("mass", found.values["mass:kenan-2.0"]),
        ):  # fmt: skip
            low, high = np.quantile(values, (0.1, 0.9))
            held[name] += bool(low <= true[name] <= high)
    assert all(7 <= count <= 12 for count in held.values()), held


def test_nothing_to_calibrate_on(subject: Subject) -> None:
    with pytest.raises(JumpcadError, match=r"too little to calibrate on: give at least one \[\[jumps\]\]"):
        fitted(subject, jumps=({"battery_j": (1.5,)},))
    jumps = ({"distance_mm": (240.0,), "distance_of": "centre-of-mass"},)
    robots = [measured(subject, jumps=jumps), replace(measured(subject, jumps=({"battery_j": (1.5,)},)), name="other")]
    for order in (robots, robots[::-1]):
        with pytest.raises(JumpcadError, match="other: too little to calibrate on"):
            sampled(CalibrationModel(order), 1, **SHORTEST)


def test_jumps_that_no_robot_does(subject: Subject) -> None:
    jumps = ({"distance_mm": (250.0,), "distance_of": "centre-of-mass"},)
    with pytest.raises(JumpcadError, match="no masses, springs and floors that the priors allow"):
        fitted(subject, jumps=jumps, mass={"robot_g": 400.0})


def test_without_emcee(subject: Subject, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(JumpcadError, match=r'pip install "jumpcad\[calibrate\]"'):
        fitted(subject, jumps=({"distance_mm": (250.0,), "distance_of": "centre-of-mass"},))


def drawn(z: np.ndarray, autocorrelation: float = 30.0, steps: int = 1500) -> CalibrationPosterior:
    """Return a posterior of these draws of three parameters."""
    parameters = [
        CalibrationParameter("spring_efficiency", "springs", SPRING_EFFICIENCY),
        CalibrationParameter("pin_friction", "pins", PIN_FRICTION), CalibrationParameter("floor:a", "floor", FLOOR),
    ]  # fmt: skip
    model: Any = CalibrationModel([])
    vars(model)["parameters"] = parameters
    return CalibrationPosterior(model, z, autocorrelation, steps, 24)


def test_chains_of_fifty_autocorrelation_times_have_converged() -> None:
    """docs/calibration.md; of 24 chains of 1500 steps, every thirtieth counts: 1200."""
    z = np.zeros((4, 3))
    assert drawn(z).effective == pytest.approx(1200.0)
    assert drawn(z).converged
    assert not drawn(z, steps=1499).converged


def test_pairs_of_which_one_tells_of_the_other_are_named_strongest_first() -> None:
    """Correlations of 0.9, -0.55 and, by construction, their product, which is below a half."""
    a, b, c = np.random.default_rng(0).standard_normal((3, 20_000))
    second = -0.55 * a + math.sqrt(1.0 - 0.55**2) * b
    z = np.stack([a, second, 0.9 * second + math.sqrt(0.19) * c], axis=1)
    strong, weak = drawn(z).correlated()
    assert strong == ("pin_friction", "floor:a", pytest.approx(0.9, abs=0.02))
    assert weak == ("spring_efficiency", "pin_friction", pytest.approx(-0.55, abs=0.02))


def test_a_summary_has_the_quantiles_of_prior_and_posterior() -> None:
    """Of a normal: 1.2816 deviations to either side of the middle hold eight in ten."""
    z = np.stack([np.linspace(-1.0, 1.0, 1001), np.zeros(1001), np.linspace(-3.0, 3.0, 1001)], axis=1)
    springs, pins, floor = drawn(z).summaries()
    assert springs["prior"] == pytest.approx([0.95 - 1.28155 * 0.05, 0.95, 0.95 + 1.28155 * 0.05], abs=1e-5)
    assert springs["posterior"] == pytest.approx([0.95 - 0.8 * 0.05, 0.95, 0.95 + 0.8 * 0.05])
    spreads = [one["spread"] for one in (springs, pins, floor)]
    assert spreads == pytest.approx([1.0 / math.sqrt(3.0), 0.0, math.sqrt(3.0)], rel=1e-2)
    assert (springs["verdict"], pins["verdict"], floor["verdict"]) == (
        "partly identified", "identified", "stays at its prior",
    )  # fmt: skip
    assert pins["posterior"] == pytest.approx([0.25] * 3)
    moved, _, stays = drawn(np.stack([z[:, 2] + 1.1, z[:, 1], z[:, 2] + 0.9], axis=1)).summaries()
    assert (moved["verdict"], stays["verdict"]) == ("partly identified", "stays at its prior")


def test_a_measurement_stands_beside_its_likeliest_reading() -> None:
    """0.24 m: touchdown at 0.24 m, range at 0.2 m; off by deviations of 8.5 % and the touchdown's own scatter."""
    one = np.ones(5)
    robot = Predicted(JumpAt(0.2 * one, one, one, one), 0.1 * one, one, (0.04, 0.005), 0.1)
    share = math.hypot(0.08, 0.03)
    found = _residual(Datum("a", "distance", "unknown", 0.24, 1, 0.08, 0.03), robot)
    assert (found["as"], found["measured"]) == ("first-touchdown", 0.24)
    assert found["predicted"] == pytest.approx([0.24] * 3)
    assert found["off_by_deviations"] == pytest.approx(0.0)
    assert sum(found["readings"].values()) == pytest.approx(1.0)
    assert max(found["readings"], key=lambda name: found["readings"][name]) == "first-touchdown"
    range_ = _residual(Datum("a", "distance", "centre-of-mass", 0.25, 1, 0.08, 0.03), robot)
    assert range_["off_by_deviations"] == pytest.approx(0.05 / (0.2 * share))
    landed = _residual(Datum("a", "distance", "first-touchdown", 0.25, 4, 0.08, 0.03), robot)
    assert landed["off_by_deviations"] == pytest.approx(0.01 / math.hypot(0.24 * math.hypot(0.04, 0.03), 0.005))


def test_each_robot_has_its_own_energy(subject: Subject) -> None:
    """Springs of 95 % over a mass 1.25 times the model's, and over the model's own; without a dog 40 % to all is kept.

    One that is not weighed varies by a fifth, so that its own quantiles lie farther apart.
    """
    heavy = measured(subject, mass={"robot_g": 1250.0 * subject.robot.mass_kg})
    other = replace(remeasured(subject, Measurements(**{**SAID, "release": "fixed"})), name="other")
    model = CalibrationModel([heavy, other])
    z = np.zeros((3, len(model.parameters)))
    z[:, [one.key for one in model.parameters].index("mass:other")] = (-1.0, 0.0, 1.0)
    found = CalibrationPosterior(model, z, 1.0, 1, 1).energies()
    assert found["kenan-2.0"] == pytest.approx([0.95 / 1.25] * 3)
    kept = 0.95 * (0.4 + 0.6 * 0.5)
    by_mass = [kept / (1.0 + deviation * math.hypot(0.2, 0.01)) for deviation in (1.0, 0.0, -1.0)]
    assert found["other"] == pytest.approx(np.quantile(by_mass, (0.1, 0.5, 0.9)))


@pytest.mark.parametrize(
    ("files", "said"),
    [([], "no measurements: name at least one file, or the template"), (["kenan-1.0", "kenan-1.0"], "is given twice")],
)
def test_there_are_measurements_and_each_counts_once(
    files: list[str], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Told before a robot is built."""
    monkeypatch.setattr(module, "load_subject", lambda _: pytest.fail("built"))
    with pytest.raises(JumpcadError, match=said):
        module.calibrate(files)


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")  # chains that stand still have no variance
@pytest.mark.parametrize(("most", "length"), [(10, 10), (40, 40), (41, 80)])
def test_chains_that_have_not_converged_are_doubled_until_they_are_long_enough(
    subject: Subject, posterior: CalibrationPosterior, most: int, length: int
) -> None:
    """A third of them is burn-in, and is not kept."""
    found = sampled(CalibrationModel(posterior.model.subjects), 1, steps=10, most_steps=most, walkers_each=8)
    assert not found.converged
    assert found.steps == length - length // 3
