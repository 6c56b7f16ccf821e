"""Compiled or not, the planar engine says the same."""

import importlib.util
import json
import math
import os
import subprocess
import sys
from typing import Any

import pytest

from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.planar_kernel import compiled
from jumpcad.simulation.planar_model import Inertia

WITHOUT_NUMBA = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
PROGRAM = """
import json
from jumpcad import Settings, capsule_robot, load_design, simulate
said = []
for name in ("kenan-2.0", "best-bo"):
    for friction in (0.3, 1.5):
        jump = simulate(capsule_robot(load_design(name)), Settings(ground_friction=friction), "planar").to_dict()
        said.append([jump["verdict"], jump["ballistic_range_m"], jump["com_rise_m"], jump["takeoff_time_s"],
                     *jump["energy"].values()])
"""


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_compiled_and_plain_give_the_same_numbers() -> None:
    assert hasattr(kernel.response, "py_func"), "compiled in this process"
    here: dict[str, Any] = {}
    exec(PROGRAM, here)
    printing = f"{PROGRAM}print(json.dumps(said))"
    run = subprocess.run(
        [sys.executable, "-c", printing], capture_output=True, text=True, check=True, env=WITHOUT_NUMBA
    )
    compiled, plain = here["said"], json.loads(run.stdout)
    assert len(compiled) == 4
    for one, other in zip(compiled, plain, strict=True):
        assert one[0] == other[0] == "jump"
        assert one[1:] == pytest.approx(other[1:], rel=1e-9, abs=1e-12)


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_what_is_compiled_is_kept_for_the_next_process_and_divides_as_a_processor_does() -> None:
    """By zero it says infinite or no number, which ends a push-off as lost, and raises nothing."""
    assert kernel.response.stats.cache_path  # type: ignore[attr-defined]
    assert not math.isfinite(kernel.response(Inertia(1.0, 0j, 0j, 0.0, 0.0, 0.0), 0j, 1.0, 0.0).foot)


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason="numba is not installed")
def test_where_no_folder_can_be_written_it_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("numba.core.caching.CacheImpl._locator_classes", [])
    twice = compiled(lambda number: 2.0 * number)
    assert hasattr(twice, "py_func")
    assert twice(1.5) == 3.0


@pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason='numba is not installed: pip install ".[fast]"')
def test_where_the_disk_is_full_it_is_compiled_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_given: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("numba.core.caching.IndexDataCacheFile.save", full)
    assert compiled(thrice)(1.5) == 4.5


def thrice(number: float) -> float:
    return 3.0 * number


def test_a_missing_compiler_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)

    def twice(number: float) -> float:
        return 2.0 * number

    assert compiled(twice) is twice
