"""The published study's table of results: as published, simulated again, measured, and by jumpcad's evaluator.

Lengths in m, energies in J. Published values are quoted from the study, rounded as there.
"""

from dataclasses import asdict, dataclass
from typing import Any

from jumpcad.design import load_design
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.paper import published
from jumpcad.paper.published import PublishedJump
from jumpcad.simulation import Jump, Settings, simulate


@dataclass(frozen=True)
class Measured:
    """A jump of a built robot; the energy is what the motor took from the battery, losses included."""

    distance_m: float
    height_m: float
    electrical_energy_j: float


@dataclass(frozen=True)
class PublishedResult:
    """What the study publishes on one robot: simulated, and measured where it was built."""

    title: str
    template: str
    simulated: PublishedJump
    measured: Measured | None = None


PUBLISHED_RESULTS = (
    PublishedResult("Kenan 1.0", "kenan-1.0", PublishedJump(0.25, 0.10, 0.153), Measured(0.25, 0.15, 1.5)),
    PublishedResult("best GA", "best-ga", PublishedJump(0.891, 0.386, 0.73)),
    PublishedResult("best BO", "best-bo", PublishedJump(0.905, 0.389, 0.72)),
    PublishedResult("Kenan 2.0", "kenan-2.0", PublishedJump(0.321, 0.126, 0.133), Measured(0.35, 0.12, 1.3)),
)


HYPERPARAMETERS: dict[str, tuple[float | None, float]] = {
    "lateral friction": (0.8, published.LATERAL_FRICTION),
    "spinning friction": (0.1, published.SPINNING_FRICTION),
    "rolling friction": (0.01, published.ROLLING_FRICTION),
    "joint damping": (0.001, published.JOINT_DAMPING),
    "restitution": (0.8, published.RESTITUTION),
    "lateral friction of the ground": (None, published.GROUND_FRICTION),
}
"""Settings of the published simulation: in the study's table, and where the study's results come from."""

READING = (
    "published: as given by the study. again: its simulation, run here. measured: built robots, electrical energy with "
    "all losses.\n"
    "evaluator: the same masses (capsule robot) in jumpcad's own simulation: ballistic range, way of the "
    "centre of mass to the touchdown, rise of the centre of mass, energy stored in the springs, share of it at "
    "take-off.\n"
    "Kenan 1.0's published height is the one figure here that the study's simulation does not give.\n"
)

WHY_THEY_DIFFER = (
    "Published length is where the body is at the first contact later than 0.5 s after release: for weak jumpers that "
    "is tumbling after the landing.",
    "Published height is the body's absolute height, standing height included; a jump is what the centre of mass "
    "gains.",
    "The published simulation does not converge: its pose does not close the loop, near-rigid joint motors work "
    "against the loop's constraint, and with smaller time steps it diverges. The evaluator starts from the exactly "
    "closed pose.",
    "Designs whose loop cannot close over their travel score best in it; the evaluator's gate rejects them, and every "
    "run has to pass an audit of its energy and its loop.",
)


@dataclass(frozen=True)
class Reproduction:
    """One robot: as published, simulated again in the same way, and the evaluator's jump with the same masses."""

    published: PublishedResult
    again: PublishedJump
    jump: Jump

    def to_dict(self) -> dict[str, Any]:
        return {
            "robot": self.published.template, "published": asdict(self.published.simulated),
            "reproduced": asdict(self.again), "measured": self.published.measured and asdict(self.published.measured),
            "evaluated": self.jump.to_dict(),
        }  # fmt: skip


def reproduce() -> list[Reproduction]:
    """Simulate the study's four robots twice: as the study did, and with the evaluator, up to touchdown."""
    designs = [(result, load_design(result.template)) for result in PUBLISHED_RESULTS]
    settings = Settings(flight="simulated")
    return [
        Reproduction(result, published.simulate(design), simulate(capsule_robot(design), settings))
        for result, design in designs
    ]
