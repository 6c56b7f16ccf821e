"""Commands and the workers of a search look for garbage seldom; programs that use jumpcad as a library as they like."""

import gc
import subprocess
import sys

from jumpcad.gc_tuning import THRESHOLDS, collect_seldom, collect_usually
from jumpcad.search.study.local_workers import LocalWorkers

COMMAND = """
import gc, sys, jumpcad, jumpcad.search
before = gc.get_threshold()
from jumpcad.cli import main
sys.argv = ["jumpcad", "--version"]
try:
    main()
except SystemExit:
    print(before, gc.get_threshold())
"""


def test_a_command_looks_seldom_and_an_import_changes_nothing() -> None:
    asked = "import gc; print(gc.get_threshold())"
    usual = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout.strip()
    found = subprocess.run([sys.executable, "-c", COMMAND], capture_output=True, text=True, check=True)
    assert found.stdout.splitlines()[-1] == f"{usual} {THRESHOLDS}"
    assert usual != str(THRESHOLDS)


def test_a_worker_looks_seldom() -> None:
    workers = LocalWorkers(1)
    try:
        assert workers.submit(gc.get_threshold).result(60.0) == THRESHOLDS
    finally:
        workers.end()


def test_a_process_that_stays_looks_as_usual() -> None:
    usual = gc.get_threshold()
    try:
        collect_seldom()
        assert gc.get_threshold() == THRESHOLDS
        collect_usually()
        assert gc.get_threshold() != THRESHOLDS
    finally:
        gc.set_threshold(*usual)
