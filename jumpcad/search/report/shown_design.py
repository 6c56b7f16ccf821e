"""One design of a study as a section of its page: side view, numbers, lengths and energy, figures, command."""

import shlex
from collections.abc import Iterator, Sequence

from jumpcad.search.fronts import energy_j
from jumpcad.search.report.side_view import Box, box_mm, side_view
from jumpcad.search.report.text import broken, escape_html
from jumpcad.search.report.words import figure_words, with_unit
from jumpcad.search.study.objective import Objective
from jumpcad.search.study.trial import Trial

HEADLINES = ("ballistic_range_m", "com_rise_m", "mass_kg", "winding_time_s")
"""Figures that are shown at once; the others open on a click."""


def shown_designs(shown: Sequence[Trial], numbers: Sequence[int], objective: Objective, file: str) -> Iterator[str]:
    """Yield a section for each design, numbered from 1; all are drawn to the same scale.

    ``numbers`` are those of the study's trials, ``file`` is the study: the command below the figures has both.
    """
    box = box_mm(trial.design for trial in shown)
    for number, (trial, of_study) in enumerate(zip(shown, numbers, strict=True), start=1):
        yield f'<section class="design" id="design-{number}">'
        yield f"<h3>Design {number} (trial {of_study}): {trial.score:.4g} {escape_html(objective.unit)}</h3>"
        yield from _drawn(trial, box)
        first, others = _lines(trial)
        yield from _rows(first)
        if others:
            yield f"<details><summary>more figures ({len(others)})</summary>"
            yield from _rows(others)
            yield "</details>"
        command = f"jumpcad studio {shlex.quote(file)} --trial {of_study}"
        yield f'<p class="command">In the studio: <code>{escape_html(command)}</code></p>'
        yield "</section>"


def _rows(lines: Sequence[tuple[str, str]]) -> Iterator[str]:
    yield "<table>"
    yield from (
        f'<tr><td>{broken(name)}</td><td class="number">{escape_html(value)}</td></tr>' for name, value in lines
    )
    yield "</table>"


def _drawn(trial: Trial, box: Box) -> Iterator[str]:
    yield side_view(trial.design, box)
    yield '<p><span class="key rest">at rest</span><span class="key loaded">springs loaded</span></p>'


def _lines(trial: Trial) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Return label and value of what is shown at once, and of the other figures."""
    design, metrics = trial.design, trial.evaluation.metrics
    first = []
    for name, value in design.model_dump().items():
        first.append((name, with_unit(f"{value:.5g}" if isinstance(value, float) else str(value), name)))
    for name, setting in trial.workshop.items():
        first.append((name, setting if isinstance(setting, str) else with_unit(f"{setting:.5g}", name)))
    lengths = (design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm)
    first.append(("main leg, front link, foot, toe", ", ".join(f"{length:.1f}" for length in lengths) + " mm"))
    first.append(figure_words("spring_energy_j", metrics.get("spring_energy_j", energy_j(design))))
    first += [figure_words(name, metrics[name]) for name in HEADLINES if name in metrics]
    told = {"spring_energy_j", *HEADLINES}
    return first, [figure_words(name, figure) for name, figure in metrics.items() if name not in told]
