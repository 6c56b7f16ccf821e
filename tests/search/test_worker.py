"""What runs in a worker process."""

import pytest
from support.hills import SMALL, Hill

from jumpcad.errors import JumpcadError
from jumpcad.search.pool import local_pool


class Elsewhere(Hill):
    """A hill whose version depends on who asks."""

    asked = 0

    def versions(self):
        type(self).asked += 1
        return {"hill": str(type(self).asked)}


def test_a_worker_with_another_program_computes_nothing():
    design = SMALL.to_design([0.5, 0.5, 0.5])
    with local_pool(0) as pool, pytest.raises(JumpcadError, match="a worker has hill 2, not 1"):
        list(pool.evaluate(Elsewhere(), [design]))
