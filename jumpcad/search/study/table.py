"""Trials as a table: CSV, or Parquet for very many."""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError
from jumpcad.files.csv_text import to_csv
from jumpcad.files.outputs import require_target, write_atomically
from jumpcad.search.study.trial import Trial

TABLES = (".csv", ".parquet")


@check_arguments
def write_table(trials: Sequence[Trial], path: str | Path, force: bool = False) -> None:
    """Write trials to a `.csv` or `.parquet` file, over an existing one only if forced.

    Raises
    ------
    JumpcadError
        If the file exists, ends otherwise, or cannot be written; for Parquet also if PyArrow is not installed.
    """
    path = Path(path)
    require_target(path, TABLES, force)
    metrics = sorted({name for trial in trials for name in trial.evaluation.metrics})
    margins = sorted({finding.name for trial in trials for finding in trial.evaluation.findings})
    keys = list(dict.fromkeys(key for trial in trials for key in trial.workshop))
    records = [_record(trial, keys, metrics, margins) for trial in trials]
    if path.suffix == ".csv":
        head = list(records[0]) if records else ["phase"]
        write_atomically(path, to_csv([head, *(list(record.values()) for record in records)]))
    else:
        write_atomically(path, _parquet(records))


def _parquet(records: list[dict[str, Any]]) -> bytes:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise JumpcadError("PyArrow is not installed: pip install 'jumpcad[parquet]', or export to .csv") from None
    stream = io.BytesIO()
    parquet.write_table(pyarrow.Table.from_pylist(records), stream)
    return stream.getvalue()


def _record(trial: Trial, keys: Sequence[str], metrics: Sequence[str], margins: Sequence[str]) -> dict[str, Any]:
    """Return one flat record; a figure that the trial does not have is None."""
    evaluation = trial.evaluation
    return {
        "phase": trial.phase,
        "run": trial.run,
        "step": trial.step,
        "place": trial.place,
        **trial.design.model_dump(),
        **{key: trial.workshop.get(key) for key in keys},
        "verdict": evaluation.verdict,
        "feasible": evaluation.feasible,
        "reasons": " ".join(evaluation.reasons),
        "score": trial.score,
        **{name: evaluation.metrics.get(name) for name in metrics},
        **{f"margin_{name}": evaluation.margins.get(name) for name in margins},
        "detail": evaluation.detail,
        "duration_s": trial.duration_s,
        "model": trial.model,
    }
