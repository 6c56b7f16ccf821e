"""A measured robot whose jump is known on a coarse grid: enough for what the tests compare, in a second."""

import pytest

from jumpcad.calibration.subject import Subject, load_subject
from jumpcad.calibration.surface import Surface, surface_of

COARSE = ((0.45, 0.7, 1.0, 1.6, 2.5), (0.0, 0.3, 0.9), (0.3, 0.4, 0.5, 0.57, 0.65, 1.0))


@pytest.fixture(scope="session")
def subject() -> Subject:
    """Kenan 2.0, as the study measured it."""
    found = load_subject("kenan-2.0")
    vars(found)["surface"] = surface_of(found.robot, nodes=COARSE)
    return found


@pytest.fixture(scope="session")
def surface(subject: Subject) -> Surface:
    """Its jump."""
    return subject.surface
