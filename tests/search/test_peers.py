"""The table of `benchmarks/peers.py`."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.places import ROOT


def peers(*arguments: str) -> str:
    """Return what the program prints."""
    command = [sys.executable, str(ROOT / "benchmarks" / "peers.py"), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True, encoding="utf-8").stdout


def row(seed: int, at_40: float, at_60: float, cpu_s: float = 10.0) -> str:
    """Return a row of a log: the best score from the 40th evaluation on, and that of the last one."""
    best = [0.0] * 39 + [at_40] * 20 + [at_60]
    one = {"problem": "light", "method": "ga", "seed": seed, "best": best, "rejected": 0.25, "cpu_s": cpu_s}
    return json.dumps(one) + "\n"


@pytest.mark.thorough
def test_the_table_has_medians_and_of_equal_rows_the_last(tmp_path: Path) -> None:
    log = tmp_path / "log.jsonl"
    rows = (row(0, 9.0, 9.0), row(0, 1.0, 4.0), row(1, 2.0, 5.0, 40.0), row(2, 3.0, 9.0))
    log.write_text("".join(rows), encoding="utf-8")
    lines = peers("--table", str(log)).splitlines()
    assert len(lines) == 3
    assert lines[-1].endswith("| 3 | 2.00 [1.00, 3.00] | 5.00 [4.00, 9.00] | 25 % | 10 |")


@pytest.mark.thorough
def test_a_search_that_the_log_holds_is_not_run_again(tmp_path: Path) -> None:
    log = tmp_path / "log.jsonl"
    log.write_text(row(0, 1.0, 4.0), encoding="utf-8")
    before = log.read_bytes()
    assert peers("--log", str(log), "--methods", "ga", "--problems", "light", "--seeds", "1") == ""
    assert log.read_bytes() == before
