"""What strength checks share: the leg's axle as a simple beam."""

import numpy as np
import pytest

from jumpcad.checks.load_case import leg_axle_moment_nmm


def test_leg_axle_is_a_simple_beam() -> None:
    # without springs: M = F·L/4 (Shigley, table A-9); arms that pull in one line only shear the axle beside the leg
    none = np.zeros(2)
    assert leg_axle_moment_nmm((none, none), np.array([0.0, 80.0]), 40.0, 8.0) == pytest.approx(80.0 * 40.0 / 4.0)
    up = np.array([0.0, 50.0])
    assert leg_axle_moment_nmm((up, -up), none, 40.0, 8.0) == pytest.approx(50.0 * 40.0 / 4.0)
    # both arms push the coil the same way: the leg's half goes straight back into the axle, 8 mm beside it
    sideways = leg_axle_moment_nmm((up, none), none, 40.0, 8.0)
    assert sideways == pytest.approx(25.0 * 8.0)
