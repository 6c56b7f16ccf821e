"""Losses of a gear train multiply."""

from dataclasses import replace

import pytest
from support.limits import default_limits


def test_every_pair_takes_its_share_of_the_work() -> None:
    limits = replace(default_limits().train, cam_efficiency=0.8, pair_efficiency=0.5)
    assert [limits.efficiency(pairs) for pairs in (0, 1, 2)] == pytest.approx([0.8, 0.4, 0.2])
