"""Printed robots of which all is known: for searches that learn from the robots that were built."""

from jumpcad.building import build
from jumpcad.design import load_design
from jumpcad.search.estimate.estimated_robot import EXTENTS, estimated_robot, robot_figures
from jumpcad.search.models import PrintedModel, robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.simulation import simulate
from jumpcad.simulation.engines import default_engine

BEST = load_design("best-printable")
SPACE = Space.make(around=BEST, within_percent=15.0)
LIKE = build(BEST)
FIGURES = robot_figures(LIKE) | {f"{name}_mass_kg": body.mass_kg for name, body in LIKE.bodies.items()}


class Quick(PrintedModel):
    """Robots of which all is known: masses grow with the main leg and the springs, the rest is best-printable's."""

    quick_score = None  # its first designs are spread

    def __call__(self, design, workshop=None):
        larger = design.carrying_link_mm / BEST.carrying_link_mm
        heavier = larger * (1.0 + 0.002 * design.stiffness_nmm_per_deg * larger)
        figures = {name: value * (heavier if "mass" in name else 1.0) for name, value in FIGURES.items()}
        jump = simulate(estimated_robot(design, figures, LIKE), self.settings, default_engine())
        found = {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
        size = max(0.1, design.l_max_mm / 1000.0)
        figures |= dict.fromkeys(EXTENTS, 0.1)
        metrics = figures | found | {"size_m": size, "body_lengths": (jump.touchdown_distance_m or 0.0) / size}
        return Evaluation(jump.verdict, metrics, jump.findings)


def quick() -> Quick:
    """Return the model of these robots."""
    plain = robot_model(settings="default")
    return Quick(workshop=plain.workshop, settings=plain.settings, stand_in=True)
