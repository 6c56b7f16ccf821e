"""One thread of linear algebra, in all libraries that have it, and as many as before after that."""

import os
import subprocess
import sys

from threadpoolctl import threadpool_info, threadpool_limits

from jumpcad.process.blas_threads import one_thread

FIRST_OF_ALL = """
import numpy
from threadpoolctl import threadpool_info
from jumpcad.process.blas_threads import one_thread
with one_thread():
    import scipy.linalg, sklearn.gaussian_process
    print(*{pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"})
"""


def threads() -> set[int]:
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


def test_there_is_one_within_and_as_many_as_before_afterwards() -> None:
    with threadpool_limits(2, user_api="blas"):
        for _ in range(2):
            with one_thread():
                assert threads() == {1}
            assert threads() == {2}


def test_scipys_own_is_among_them_where_nothing_has_loaded_it_yet() -> None:
    command, environment = [sys.executable, "-c", FIRST_OF_ALL], os.environ | {"OPENBLAS_NUM_THREADS": "2"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.strip() == "1"
