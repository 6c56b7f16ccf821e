"""Mass properties against handbook tensors and sums of points."""

import math

import numpy as np
import pytest

from jumpcad.mechanism.mass import MassProperties, combined, principal_axes


def turned(axis: int, angle_rad: float, offset: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    """A transform (4, 4): turn about one axis, then shift."""
    first, second = [(1, 2), (2, 0), (0, 1)][axis]
    transform = np.eye(4)
    transform[[first, second], [first, second]] = math.cos(angle_rad)
    transform[first, second], transform[second, first] = -math.sin(angle_rad), math.sin(angle_rad)
    transform[:3, 3] = offset
    return transform


def test_parallel_axis_of_unequal_things_off_centre() -> None:
    """Two points of 1 and 3 kg, 4 m apart: reduced mass 3/4 kg · 16 m² about both axes across their line."""
    point = MassProperties(1.0, np.zeros(3), np.zeros((3, 3)))
    pair = combined([point.placed(turned(0, 0.0, (5, 7, 1))), point.scaled_to(3.0).placed(turned(0, 0.0, (9, 7, 1)))])
    assert pair.mass_kg == 4.0
    np.testing.assert_allclose(pair.com_m, [8.0, 7.0, 1.0])
    np.testing.assert_allclose(pair.inertia_kg_m2, np.diag([0.0, 12.0, 12.0]), atol=1e-12)


def test_sum_equals_a_cloud_of_points() -> None:
    """The tensor of points is Σ m·(r²·1 - r·rᵀ), however they are grouped."""
    rng = np.random.default_rng(3)
    places, masses = rng.normal(size=(40, 3)), rng.uniform(0.1, 1.0, 40)
    points = [
        MassProperties(mass, place, np.zeros((3, 3))) for mass, place in zip(masses.tolist(), places, strict=True)
    ]
    whole = combined([combined(points[:13]), combined(points[13:20]), *points[20:]])
    arms = places - np.average(places, axis=0, weights=masses)
    expected = np.einsum(
        "n,nij->ij", masses, (arms**2).sum(1)[:, None, None] * np.eye(3) - arms[:, :, None] * arms[:, None]
    )
    np.testing.assert_allclose(whole.inertia_kg_m2, expected)


def test_principal_axes_turn_the_tensor_diagonal() -> None:
    """Against numpy's eigenvalues, for tensors of random clouds; the rotation keeps lengths and hands."""
    rng = np.random.default_rng(4)
    for _ in range(20):
        points = rng.normal(size=(5, 3)) * rng.uniform(0.1, 3.0, 3)
        tensor = (points**2).sum() * np.eye(3) - points.T @ points
        moments, axes = principal_axes(tensor)
        np.testing.assert_allclose(np.sort(moments), np.linalg.eigvalsh(tensor), rtol=1e-12)
        np.testing.assert_allclose(axes @ np.diag(moments) @ axes.T, tensor, atol=1e-12 * moments.max())
        np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-14)
        assert np.linalg.det(axes) > 0.0


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_tensor_turned_about_one_axis_is_turned_back(axis: int) -> None:
    """By 20°; of its products of inertia one alone is not zero."""
    others = [k for k in range(3) if k != axis]
    cos, sin = np.cos(np.radians(20.0)), np.sin(np.radians(20.0))
    turn = np.eye(3)
    turn[np.ix_(others, others)] = [[cos, -sin], [sin, cos]]
    moments, axes = principal_axes(turn @ np.diag([3.0, 1.0, 2.0]) @ turn.T)
    np.testing.assert_allclose(moments, [3.0, 1.0, 2.0], rtol=1e-12)
    np.testing.assert_allclose(axes, turn, atol=1e-12)


def test_of_a_nearly_diagonal_tensor_the_axes_hardly_turn() -> None:
    tensor = np.diag([3.0, 1.0, 2.0]) + 1e-4 * (np.ones((3, 3)) - np.eye(3))
    moments, axes = principal_axes(tensor)
    np.testing.assert_allclose(axes, np.eye(3), atol=2e-4)
    np.testing.assert_allclose(moments, [3.0, 1.0, 2.0], atol=1e-7)
