"""`Trial`: one finished evaluation of a search; filters, counts and tables of trials."""

import io
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import AfterValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import require_target, write_atomically
from jumpcad.files.reading import to_csv
from jumpcad.files.records import Text
from jumpcad.findings import least
from jumpcad.search.methods import PHASES, SEARCH_PHASES
from jumpcad.search.study.objective import EQUALS, Evaluation, Figure, Margin
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

TABLES = (".csv", ".parquet")
"""Endings of tables: CSV, or Parquet for very many trials."""
Count = Annotated[int, Field(ge=0, lt=2**63)]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1)]
Logarithm = Annotated[float, Field(ge=-100, le=100)]


def one_of(names: Iterable[str]) -> Callable[[str], str]:
    """Return a validator of a name among these."""

    def require(name: str) -> str:
        if name not in names:
            raise PydanticCustomError("value_error", "is none of {names}", {"names": ", ".join(names)})
        return name

    return require


Phase = Annotated[str, AfterValidator(one_of(PHASES))]
PLACE = "phase", "run", "step", "place"
Position = tuple[Phase, Count, Count, Count]
"""Where a trial was proposed: phase, run, step and place; each position of a study has one trial."""
if TYPE_CHECKING:
    Proposed = Any
else:  # a prediction, hyperparameters by name, points that were tried
    Proposed = Margin | dict[str, list[Logarithm]] | list[list[Share]]


@dataclass(frozen=True, repr=False)
class Trial:
    """One finished evaluation: the design, its place in the search, the outcome and the score; a row of a study file.

    `run` counts the runs of a phase: a method of `paper` runs several times in a study, and so does the pick of one
    that goes on. `proposal` is what the method predicted. A rejected design has no score. `model` is the digest of the
    model that evaluated it; `workshop` holds the values of the workshop that the search varies, by key.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    phase: Phase
    step: Count
    place: Count
    design: Design
    evaluation: Evaluation
    score: Figure | None
    model: str
    duration_s: Figure
    proposal: Mapping[str, Proposed] = field(default_factory=dict)
    workshop: Mapping[str, Finite | Text] = field(default_factory=dict)
    run: Count = 0

    @cached_property
    def key(self) -> Key:
        """Values that identify the variant."""
        return self.variant.key

    @cached_property
    def variant(self) -> Variant:
        """The evaluated design with its values of the workshop."""
        return Variant(self.design, self.workshop)

    @property
    def position(self) -> Position:
        return self.phase, self.run, self.step, self.place

    def to_dict(self) -> dict[str, Any]:
        found = self.evaluation
        return {
            "phase": self.phase, "score": self.score,
            "fitness": found.metrics.get("fitness") if found.feasible else 0.0,
            "verdict": found.verdict, "detail": found.detail, "design": self.design.model_dump(),
            **({"workshop": dict(self.workshop)} if self.workshop else {}), "metrics": dict(found.metrics),
            "margins": {name: {"margin": one.margin, "unit": one.unit} for name, one in least(found.findings).items()},
        }  # fmt: skip

    def __repr__(self) -> str:
        outcome = " ".join(self.evaluation.reasons)[:80] if self.score is None else f"score {self.score:.4g}"
        return f"<Trial {self.phase} {self.step}.{self.place}: {outcome}>"


def in_order(trials: Iterable[Trial]) -> list[Trial]:
    return sorted(trials, key=lambda trial: (PHASES.index(trial.phase), *trial.position[1:]))


def feasible_trials(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that have a score, best first; of equals, the first."""
    return sorted((trial for trial in trials if trial.score is not None), key=lambda trial: -(trial.score or 0.0))


def best_trial(trials: Sequence[Trial]) -> Trial | None:
    """Return the trial with the highest score, the first of equals; None where every design is rejected."""
    return next(iter(feasible_trials(trials)), None)


def is_flat(trials: Sequence[Trial]) -> bool:
    """Whether all scores are alike, and so say nothing: those of several trials, or a single one of 0."""
    scores = [trial.score for trial in trials if trial.score is not None]
    return len(set(scores)) == 1 and (len(scores) > 1 or scores == [0.0])


def typical_size(margins: Sequence[float] | Array) -> float:
    """Return the median of absolute margins, what counts as 1 where several limits are compared; 1 if it is 0."""
    size = float(np.median(np.abs(margins)))
    return size if 0.0 < size < np.inf else 1.0


def required_sizes(trials: Iterable[Trial]) -> dict[str, float]:
    """Return the typical margin of each requirement, by its name, among trials that jump."""
    found: dict[str, list[float]] = {}
    for trial in trials:
        for name, margin in trial.evaluation.margins.items():
            if EQUALS in name:
                found.setdefault(name, []).append(margin)
    return {name: typical_size(margins) for name, margins in found.items()}


def lacking(trial: Trial, sizes: Mapping[str, float]) -> float:
    """Return what a trial lacks of all that is required, in typical margins: no unit counts more than another."""
    return sum(max(-margin, 0.0) / sizes[name] for name, margin in trial.evaluation.margins.items() if EQUALS in name)


def nearest_to_required(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that only miss what is required, the nearest to it first."""
    near = [trial for trial in trials if trial.evaluation.only_misses_required]
    sizes = required_sizes(trials) if near else {}
    return sorted(near, key=lambda trial: lacking(trial, sizes))


def trial_numbers(trials: Sequence[Trial]) -> dict[Position, int]:
    """Return the numbers of all trials of a study, by position: from 1 in its order, as its exported table has them."""
    return {trial.position: number for number, trial in enumerate(trials, start=1)}


def searched(trials: Sequence[Trial]) -> list[Trial]:
    """Return the trials that the search proposed, without those of the robust pick and the active bounds."""
    return [trial for trial in trials if trial.phase in SEARCH_PHASES]


def count_rejections(trials: Sequence[Trial]) -> dict[str, int]:
    """Return how many trials each reason rejected, most frequent first."""
    return dict(Counter(reason for trial in trials for reason in trial.evaluation.reasons).most_common())


@check_arguments
def write_table(trials: Sequence[Trial], path: str | Path, force: bool = False) -> None:
    """Write trials to a `.csv` or `.parquet` file, over an existing one only if forced."""
    path = Path(path)
    require_target(path, TABLES, force)
    records = _records(trials)
    if path.suffix == ".csv":
        head = list(records[0]) if records else ["phase"]
        write_atomically(path, to_csv([head, *(list(record.values()) for record in records)]), force)
    else:
        write_atomically(path, _parquet(records), force)


@check_arguments
def to_frame(trials: Sequence[Trial]) -> Any:
    """Return trials as a `pandas.DataFrame` with the columns of `write_table`."""
    try:
        import pandas
    except ImportError:
        raise JumpcadError("pandas is not installed: pip install pandas, or write a table to .csv") from None
    return pandas.DataFrame.from_records(_records(trials))


def _records(trials: Sequence[Trial]) -> list[dict[str, Any]]:
    """Return one flat record of each; a figure that a trial does not have is None."""
    metrics = sorted({name for trial in trials for name in trial.evaluation.metrics})
    margins = sorted({finding.name for trial in trials for finding in trial.evaluation.findings})
    keys = list(dict.fromkeys(key for trial in trials for key in trial.workshop))
    return [
        {
            **dict(zip(PLACE, trial.position, strict=True)),
            **trial.design.model_dump(),
            **{key: trial.workshop.get(key) for key in keys},
            "verdict": found.verdict, "feasible": found.feasible, "reasons": " ".join(found.reasons),
            "score": trial.score,
            **{name: found.metrics.get(name) for name in metrics},
            **{f"margin_{name}": found.margins.get(name) for name in margins},
            "detail": found.detail, "duration_s": trial.duration_s, "model": trial.model,
        }
        for trial in trials for found in [trial.evaluation]
    ]  # fmt: skip


def _parquet(records: list[dict[str, Any]]) -> bytes:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise JumpcadError("PyArrow is not installed: pip install 'jumpcad[parquet]', or export to .csv") from None
    stream = io.BytesIO()
    parquet.write_table(pyarrow.Table.from_pylist(records), stream)
    return stream.getvalue()
