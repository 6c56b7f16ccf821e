"""The planar engine on the ground, against the laws of contact."""

import importlib.util
import math
import sys

import numpy as np
import pytest
from support.planar import FINE, NO_CONTACT, model_of, moving, with_damping, world_at

from jumpcad.robot.robot import Robot
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.mechanics import Mechanics
from jumpcad.simulation.planar_model import Inertia, PlanarMotion, Stance
from jumpcad.transforms import Array


def test_a_robot_that_stands_weighs_its_weight(kenan: Robot) -> None:
    """Held by thick oil in its joints: the ground's two forces are the weight, under the centre of mass."""
    dt = 1e-6
    model = model_of(kenan, with_damping(FINE, 5.0))
    upright = kernel.released(model, 0.0, 0.0, complex(0.0, kenan.foot_depth_m))
    contact = kernel.advance(model, upright, dt, 200).contact
    assert contact.mode == kernel.STICK
    assert (contact.first_ns + contact.second_ns) / dt == pytest.approx(9.81 * kenan.mass_kg, rel=1e-4)
    arms = [model.sole_m[index].real for index in (contact.first, contact.second)]
    borne = (arms[0] * contact.first_ns + arms[1] * contact.second_ns) / (contact.first_ns + contact.second_ns)
    centre = Mechanics(kenan, 9.81).centre_of_mass_m(world_at(kenan, upright).state())[0]
    assert borne == pytest.approx(centre, abs=1e-4)


def mass_matrix(inertia: Inertia) -> Array:
    """The mass matrix (4, 4) of the coordinates ankle x, ankle z, foot, leg, from its closed form."""
    to_foot, to_leg, mass = inertia.by_foot, inertia.by_leg, inertia.mass
    full = np.diag([mass, mass, inertia.foot + abs(to_foot) ** 2 / mass, inertia.leg + abs(to_leg) ** 2 / mass])
    full[2, 3] = full[3, 2] = inertia.both + (to_foot.conjugate() * to_leg).real / mass
    full[0, 2], full[1, 2], full[0, 3], full[1, 3] = to_foot.real, to_foot.imag, to_leg.real, to_leg.imag
    full[2:, :2] = full[:2, 2:].T
    return full


def vector(speed: PlanarMotion) -> Array:
    return np.array([speed.ankle.real, speed.ankle.imag, speed.foot, speed.leg])


@pytest.mark.parametrize("held", [False, True])
def test_a_step_on_the_ground_obeys_the_laws_of_contact(either: Robot, held: bool) -> None:
    """Impulses change the velocities by the mass matrix. The ground pushes and does not pull; no sphere goes below it;

    the foot sticks with less than the full friction, or slides against all of it. A leg that is held stands still.
    """
    model, rng, modes = model_of(either), np.random.default_rng(7), set()
    for _ in range(150):
        angle, leg_rad = rng.choice([0.0, rng.uniform(-0.15, 0.15)]), rng.uniform(-0.7, 0.1)
        turn = complex(math.cos(angle), -math.sin(angle))
        lowest = min((at * turn).imag - radius for at, radius in zip(model.sole_m, model.sole_radius_m, strict=True))
        ground = Stance(complex(0.0, -lowest + rng.choice([0.0, 1e-4])), turn, 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, leg_rad), turn)
        free = PlanarMotion(
            complex(rng.normal(0.0, 1.0), rng.normal(-0.5, 1.0)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0)
        )
        after, contact, hold = kernel.settle(model, ground, kernel.gains_of(inertia), free, NO_CONTACT, held)
        arms = [(at * turn).real for at in model.sole_m]
        up, height = contact.first_ns + contact.second_ns, ground.ankle_m.imag
        turning = -height * contact.along_ns - sum(
            arms[index] * push
            for index, push in ((contact.first, contact.first_ns), (contact.second, contact.second_ns))
            if index >= 0
        )
        impulse = mass_matrix(inertia) @ (vector(after) - vector(free))
        np.testing.assert_allclose(impulse, [contact.along_ns, up, turning, hold], atol=1e-12)
        assert min(contact.first_ns, contact.second_ns) >= -1e-12
        for index, arm in enumerate(arms):
            rate = after.ankle.imag - arm * after.foot
            gap = (ground.ankle_m + model.sole_m[index] * turn).imag - model.sole_radius_m[index]
            assert rate >= -max(gap, 0.0) / ground.half_s - 1e-9
            if index in (contact.first, contact.second):
                assert rate == pytest.approx(-max(gap, 0.0) / ground.half_s, abs=1e-9)
        slip = after.ankle.real - height * after.foot
        assert abs(contact.along_ns) <= model.friction * up + 1e-12
        if up > 0.0 and abs(slip) > 1e-9:
            assert contact.along_ns == pytest.approx(-math.copysign(model.friction * up, slip))
        if held:
            assert after.leg == pytest.approx(0.0, abs=1e-9)
        else:
            assert hold == 0.0
        modes.add((contact.mode, contact.second >= 0))
    assert {mode for mode, _ in modes} == {kernel.SEPARATE, kernel.STICK, kernel.FORWARD, kernel.BACKWARD}
    assert len({mode for mode, _ in modes}) == 4
    assert {two for _, two in modes} == {False, True}


@pytest.mark.parametrize("sunk_m", [1e-6, 1e-4])
def test_a_foot_that_has_sunk_in_is_stopped_and_not_thrown_out(either: Robot, sunk_m: float) -> None:
    """Rounding, or another engine's state, may leave a sphere below the ground: it goes no deeper, and no faster up."""
    model, rng, stopped_feet = model_of(either), np.random.default_rng(5), 0
    for _ in range(40):
        ground = Stance(complex(0.0, either.foot_depth_m - sunk_m), 1.0 + 0j, 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, rng.uniform(-0.7, 0.1)), ground.turn)
        free = PlanarMotion(complex(rng.normal(), rng.normal(-0.5, 0.5)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0))
        after, contact, _ = kernel.settle(model, ground, kernel.gains_of(inertia), free, NO_CONTACT, False)
        for index in (contact.first, contact.second):
            if index >= 0:
                stopped_feet += 1
                assert after.ankle.imag - kernel.arm_m(model, ground, index) * after.foot == pytest.approx(0, abs=1e-9)
    assert stopped_feet > 20


def test_no_third_sphere_goes_below_the_ground_that_two_touch(lopsided: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """Spheres in a row, the middle one lower, level or higher: two of them carry, whatever pushes there are."""
    monkeypatch.setitem(sys.modules, "numba", None)  # compiling it for three spheres costs seconds
    spec = importlib.util.spec_from_file_location("plain_kernel", kernel.__file__)
    plain = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(plain)
    model, rng, pairs = model_of(lopsided), np.random.default_rng(11), set()
    for _ in range(200):
        low, high = (rng.choice([-1.0, 0.0, 1.0]) * 10.0 ** rng.uniform(-7.0, -3.5) for _ in range(2))
        spheres = 0.08 + 0j, complex(rng.uniform(-0.03, 0.05), low), complex(-0.07, high)
        sole = tuple(spheres[index] for index in rng.permutation(3))
        three = model._replace(sole_m=sole, sole_radius_m=(0.004, 0.004, 0.004))
        ground = Stance(complex(0.0, 0.004 - min(at.imag for at in sole)), 1.0 + 0j, 1e-4)
        inertia = plain.inertia_at(three, plain.links_at(three, rng.uniform(-0.7, 0.1)), ground.turn)
        free = PlanarMotion(
            complex(rng.normal(0.0, 1.0), rng.normal(-1.0, 1.0)), rng.normal(0.0, 8.0), rng.normal(0.0, 20.0)
        )
        after, contact, _ = plain.settle(three, ground, plain.gains_of(inertia), free, NO_CONTACT, False)
        assert min(contact.first_ns, contact.second_ns) >= -1e-12
        for at in sole:
            rate = after.ankle.imag - at.real * after.foot
            assert rate >= -(ground.ankle_m.imag + at.imag - 0.004) / ground.half_s - 1e-9
        pairs.add((contact.first, contact.second, contact.mode == plain.STICK))
    assert {pair for pair in pairs if pair[1] >= 0} >= {(one, two, True) for one, two in ((1, 0), (2, 0), (2, 1))}
    assert {pair[2] for pair in pairs if pair[1] >= 0} == {False, True}


@pytest.mark.parametrize("height_m", [None, 0.5])
def test_dry_friction_brakes_the_leg_or_holds_it(either: Robot, height_m: float | None) -> None:
    """All of it against a leg that turns; of one that would turn back, what it takes to stand still."""
    model, rng, held = model_of(either), np.random.default_rng(3), 0
    limit = 2e-4
    for _ in range(80):
        ankle = complex(0.0, either.foot_depth_m if height_m is None else height_m)
        ground = Stance(ankle, complex(1.0, 0.0), 1e-4)
        inertia = kernel.inertia_at(model, kernel.links_at(model, rng.uniform(-0.6, 0.0)), ground.turn)
        free = PlanarMotion(complex(rng.normal(0.0, 0.2), -0.3), rng.normal(0.0, 2.0), rng.normal(0.0, 3.0))
        after, contact, friction = kernel.settle_with_friction(
            model, ground, kernel.gains_of(inertia), free, NO_CONTACT, limit
        )
        assert abs(friction) <= limit * (1.0 + 1e-9)
        if abs(after.leg) > 1e-9:
            assert friction == pytest.approx(-math.copysign(limit, after.leg))
        held += abs(after.leg) <= 1e-9
        impulse = mass_matrix(inertia) @ (vector(after) - vector(free))
        assert impulse[3] == pytest.approx(friction, abs=1e-12)
        assert impulse[0] == pytest.approx(contact.along_ns, abs=1e-12)
    assert 0 < held < 80


def test_what_a_flat_fall_takes_is_the_impact(kenan: Robot) -> None:
    """Both ends of the foot strike at once, the springs loaded: the energy that is missing is the impact's alone."""
    model = model_of(kenan, with_damping(FINE))
    high = moving(model, -0.5)._replace(foot_rad=0.0, speed=PlanarMotion(0.0 - 0.8j, 0.0, 0.0))
    drop = 1j * (kernel.gap_m(model, high) - 1e-5)
    world = world_at(kenan, high._replace(ankle_m=high.ankle_m - drop), with_damping(FINE))
    energy = kernel.energy(world.model, world.moment)
    world.advance(1)
    contact, losses = world.moment.contact, world.moment.losses
    assert min(contact.first_ns, contact.second_ns) > 0.0
    lost = energy - kernel.energy(world.model, world.moment)
    assert lost > 0.5 * kenan.mass_kg * 0.5**2
    assert losses.impact_j + losses.slip_j == pytest.approx(lost, rel=0.01)
