"""Any design in any workshop gives a result, or a line that says why not and what to change."""

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import evaluate
from jumpcad.files import template_names
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import Workshop, load_workshop

HUGE = 'printer = {name = "huge", bed_mm = [9000.0, 9000.0, 9000.0], nozzle_mm = 0.4}\n'
STRONG = "[safety]\nstrength_factor = 1.0\nmotor_stall_share = 1.0\nmotor_torque_max_nm = 1e4\njumps = 1.0\n"
ODD = {
    "hollow": "[process]\ninfill = 0.0\nperimeters = 1\ntop_layers = 0\nbottom_layers = 0\n",
    "huge": HUGE + STRONG + '[bought]\nleg_bearing = ""\n',
    "soft": HUGE + "[materials.PLA]\nmodulus_mpa = 1.0\nstrength_in_plane_mpa = 1.0\nstrength_interlayer_mpa = 0.5\n",
    "tiny": 'printer = {name = "tiny", bed_mm = [10.0, 10.0, 10.0], nozzle_mm = 0.4}\n',
}


def limits(name: str) -> tuple[float, float]:
    """Return the lower and the upper limit of a parameter."""
    low, high = (
        next(getattr(m, key) for m in Design.model_fields[name].metadata if hasattr(m, key)) for key in ("ge", "le")
    )
    return float(low), float(high)


LIMITS = np.array([limits(name) for name in PARAMETERS])


def any_design(generator: np.random.Generator) -> Design:
    """Draw a design evenly, evenly in its logarithm, or with half of its parameters at a limit."""
    even = generator.uniform(*LIMITS.T)
    drawn = (
        even,
        np.exp(generator.uniform(*np.log(LIMITS).T)),
        np.where(generator.random(8) < 0.5, even, LIMITS[np.arange(8), generator.integers(2, size=8)]),
    )
    return Design.from_vector(np.clip(drawn[generator.integers(3)], *LIMITS.T))


@pytest.fixture(scope="module")
def workshops(tmp_path_factory: pytest.TempPathFactory) -> list[Workshop]:
    """The shipped workshops, and some with values at their limits."""
    folder: Path = tmp_path_factory.mktemp("workshops")
    for name, text in ODD.items():
        (folder / f"{name}.toml").write_text(text)
    return [load_workshop(name) for name in template_names("workshops")] + [
        load_workshop(folder / f"{name}.toml") for name in ODD
    ]


@pytest.mark.thorough
@pytest.mark.filterwarnings("error")  # a value that is not finite shows first as a warning of numpy
@pytest.mark.parametrize("seed", [1, 2])
def test_any_design_has_an_answer(workshops: list[Workshop], seed: int) -> None:
    generator, answers = np.random.default_rng(seed), []
    for number in range(100):
        design = any_design(generator)
        with suppress(CannotBuildError):
            simulate(capsule_robot(design), Settings(dt_s=1 / 500))
        try:
            result = evaluate(design, workshops[number % len(workshops)])
            assert np.isfinite([finding.margin for finding in result.findings]).all()
            assert np.isfinite(list(result.metrics.values())).all()
        except CannotBuildError:
            answers.append("cannot")
        else:
            answers.append(result.verdict)
    assert {"cannot", "jump", "tips", "too_weak"} <= set(answers)
