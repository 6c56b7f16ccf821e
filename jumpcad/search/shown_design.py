"""One design of a study as a section of its page: side view, the eight numbers, lengths and energy, figures."""

from collections.abc import Iterator, Sequence

from jumpcad.search.fronts import energy_j
from jumpcad.search.objective import Objective
from jumpcad.search.page_text import broken, written
from jumpcad.search.side_view import Box, box_mm, side_view
from jumpcad.search.trial import Trial

UNITS = {
    "_m_s": ("m/s", 1.0),
    "_kg_m2": ("kg·m²", 1.0),
    "_kg": ("g", 1000.0),
    "_m": ("mm", 1000.0),
    "_mm": ("mm", 1.0),
    "_j": ("mJ", 1000.0),
    "_s": ("s", 1.0),
    "_n": ("N", 1.0),
    "_a": ("A", 1.0),
    "_deg": ("°", 1.0),
}
"""Unit in which a figure is shown, and the factor, by the end of the figure's name."""


def shown_designs(shown: Sequence[Trial], objective: Objective) -> Iterator[str]:
    """Yield a section for each design, numbered from 1; all are drawn to the same scale."""
    box = box_mm(trial.design for trial in shown)
    for number, trial in enumerate(shown, start=1):
        yield f'<section class="design" id="design-{number}">'
        yield f"<h3>Design {number}: {trial.score:.4g} {written(objective.unit)}</h3>"
        yield from _drawn(trial, box)
        yield "<table>"
        yield from (
            f'<tr><td>{broken(name)}</td><td class="number">{written(value)}</td></tr>' for name, value in _lines(trial)
        )
        yield "</table></section>"


def _drawn(trial: Trial, box: Box) -> Iterator[str]:
    yield side_view(trial.design, box)
    yield '<p><span class="key rest">at rest</span><span class="key loaded">springs loaded</span></p>'


def _lines(trial: Trial) -> Iterator[tuple[str, str]]:
    design = trial.design
    for name, value in design.model_dump().items():
        yield name, f"{value:.5g}" if isinstance(value, float) else str(value)
    if "spring_energy_j" not in trial.evaluation.metrics:
        yield "spring energy", f"{1000.0 * energy_j(design):.4g} mJ"
    lengths = (design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm)
    yield "main leg, front link, foot, toe", ", ".join(f"{length:.1f}" for length in lengths) + " mm"
    for name, figure in trial.evaluation.metrics.items():
        yield _figure(name, figure)


def _figure(name: str, value: float) -> tuple[str, str]:
    """Return label and value of a figure of the evaluation as text."""
    end = next((end for end in UNITS if name.endswith(end)), None)
    if end is None:
        return name.replace("_", " "), f"{value:.4g}"
    unit, factor = UNITS[end]
    return name.removesuffix(end).replace("_", " "), f"{factor * value:.4g} {unit}"
