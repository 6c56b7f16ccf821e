"""Campaigns over hills."""

from pathlib import Path

import pytest
from support.hills import SMALL, Hill

from jumpcad.search.campaign import Campaign
from jumpcad.search.ledger import Ledger
from jumpcad.search.objective import find_objective
from jumpcad.search.pool import local_pool


@pytest.fixture
def campaign():
    """Return a function that opens a campaign in this process; all are closed at the end."""
    ledgers = []

    def open_campaign(path: Path | None = None, model=None, space=SMALL, prior=(), pool=None) -> Campaign:
        study = {
            "model": {"name": "hill"},
            "objective": "fitness",
            "method": "ga",
            "seed": 0,
            "space": space.describe(),
        }
        ledger = Ledger.write(path, study)
        ledgers.append(ledger)
        return Campaign(space, find_objective("fitness"), model or Hill(), ledger, pool or local_pool(0), prior)

    yield open_campaign
    for ledger in ledgers:
        ledger.close()
