"""Run a study of a slow hill: the process that tests kill. Arguments: file, method, evaluations, workers, pause (s)."""

import sys
from pathlib import Path

import pytest

from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from support.hills import SMALL, Hill
from support.proposals import with_less_work

if __name__ == "__main__":
    with_less_work(pytest.MonkeyPatch())  # as the tests that compare with it
    file, method, evaluations, workers, pause = sys.argv[1:]
    request = Request(SMALL, Hill(pause_s=float(pause)), method=method, evaluations=int(evaluations), seed=4)
    with local_pool(int(workers)) as pool:
        run_study(request, Path(file), pool)
