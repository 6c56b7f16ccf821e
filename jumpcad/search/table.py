"""Rows of a study as a table: CSV for everybody, Parquet for many rows."""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jumpcad.errors import JumpcadError
from jumpcad.files.csv_text import to_csv
from jumpcad.files.outputs import require_target, write_atomically
from jumpcad.search.store import Trial


def table(rows: Sequence[Trial]) -> list[dict[str, Any]]:
    """Return one flat record a row, all with the same columns; a figure that a row does not have is None."""
    metrics = sorted({name for row in rows for name in row.evaluation.metrics})
    margins = sorted({finding.name for row in rows for finding in row.evaluation.findings})
    return [_record(row, metrics, margins) for row in rows]


def write_table(rows: Sequence[Trial], path: Path, force: bool = False) -> None:
    """Write rows to a `.csv` or `.parquet` file, over one that is there only if forced.

    Raises
    ------
    JumpcadError
        If the file exists, ends otherwise, or cannot be written; for Parquet also if PyArrow is not installed.
    """
    require_target(path, (".csv", ".parquet"), force)
    records = table(rows)
    if path.suffix == ".csv":
        columns = list(records[0]) if records else ["phase"]
        write_atomically(path, to_csv([columns, *(list(record.values()) for record in records)]))
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


def _record(row: Trial, metrics: Sequence[str], margins: Sequence[str]) -> dict[str, Any]:
    evaluation = row.evaluation
    worst: dict[str, float] = {}
    for finding in evaluation.findings:
        worst[finding.name] = min(finding.margin, worst.get(finding.name, finding.margin))
    return {
        "phase": row.phase,
        "step": row.step,
        "place": row.place,
        **row.design.model_dump(),
        "verdict": evaluation.verdict,
        "feasible": evaluation.feasible,
        "reasons": " ".join(evaluation.reasons),
        "score": row.score,
        **{name: evaluation.metrics.get(name) for name in metrics},
        **{f"margin_{name}": worst.get(name) for name in margins},
        "detail": evaluation.detail,
        "duration_s": row.duration_s,
        "model": row.model,
    }
