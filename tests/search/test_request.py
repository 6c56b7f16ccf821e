"""What a study is asked for, and its stages."""

import pytest
from support.hills import SMALL, Hill

from jumpcad.search.request import Request, plan_stages


@pytest.mark.parametrize(
    ("method", "evaluations", "split"),
    [
        ("ga+bo", 250, [50, 138]),
        ("ga+bo", 60, [15, 30]),
        ("ga+bo", 1000, [50, 750]),
        ("ga", 7, [7]),
        ("ga+bo", 1, [0, 1]),
    ],
)
def test_split_of_the_budget(method, evaluations, split):
    stages = plan_stages(Request(SMALL, Hill(), method=method, evaluations=evaluations))
    assert [stage.evaluations for stage in stages] == split
    assert evaluations - sum(split) == (0 if evaluations < 24 else min(evaluations // 4, 200))
