"""The reference flights, and robots to try things on."""

import csv

import pytest
from support.flights import Flight, make_lopsided
from support.places import DATA

from jumpcad.design import PARAMETERS, Design, load_design
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot

TABLE = DATA / "reference_flights.csv"


@pytest.fixture(scope="session")
def flights() -> list[Flight]:
    """All reference flights."""
    with TABLE.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return [
        Flight(
            row["name"],
            row["verdict"],
            capsule_robot(Design.from_vector([float(row[name]) for name in PARAMETERS])),
            {name: float(text) for name, text in row.items() if name not in ("name", "verdict") and text},
        )
        for row in rows
    ]


@pytest.fixture(scope="session")
def jumping(flights: list[Flight]) -> list[Flight]:
    """Those of the reference flights that jump."""
    return [flight for flight in flights if flight.verdict == "jump"]


@pytest.fixture(scope="session")
def kenan() -> Robot:
    """The capsule robot of the second prototype."""
    return capsule_robot(load_design("kenan-2.0"))


@pytest.fixture(scope="session")
def lopsided(kenan: Robot) -> Robot:
    """A robot whose bodies have no symmetry: centres of mass off every axis, tensors turned out of their frames."""
    return make_lopsided(kenan)


@pytest.fixture(scope="module", params=["kenan-2.0", "best-ga"])
def either(request: pytest.FixtureRequest) -> Robot:
    """A robot whose bodies have no symmetry, with equal links and with others."""
    return make_lopsided(capsule_robot(load_design(request.param)))
