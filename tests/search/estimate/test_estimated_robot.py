"""An estimated robot has the figures that it is made of, each where it belongs."""

import numpy as np
import pytest
from support.quick import FIGURES, LIKE

from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.search.estimate.estimated_robot import EXTENTS, LAID, estimated_robot, robot_figures

MADE_UP = {
    name: 0.001 * number
    for number, name in enumerate(
        (f"{body}_{figure}" for body in BODY_NAMES for figure in ("com_x_m", "com_z_m", "inertia_kg_m2", "mass_kg")), 1
    )
} | {
    "foot_depth_m": 0.0175, "toe_radius_m": 0.0045, "stop_rad": 0.0625, "stop_nm_per_rad": 7.0,
    "release_turn_rad": 0.03, "release_rad_s": 4.0, "release_ratio": 0.875,
    **{f"{body}_{side}_m": at for body in BODY_NAMES
       for side, at in (("left", -0.01), ("right", 0.05), ("bottom", -0.02), ("top", 0.03))},
}  # fmt: skip


def test_figures_are_those_of_the_robot_to_six_digits() -> None:
    found = robot_figures(LIKE)
    named = {f"{name}_{figure}" for name in BODY_NAMES for figure in ("com_x_m", "com_z_m", "inertia_kg_m2")}
    sides = {f"{name}_{side}_m" for name in BODY_NAMES for side in ("left", "right", "bottom", "top")}
    others = sides | {"foot_depth_m", "toe_radius_m", "stop_rad", "stop_nm_per_rad"}
    release = {"release_turn_rad", "release_rad_s", "release_ratio"}
    assert set(found) == named | others | release | set(LAID) | set(EXTENTS)
    for name, body in LIKE.bodies.items():
        for figure, value in (
            ("com_x_m", body.com_m[0]), ("com_z_m", body.com_m[2]), ("inertia_kg_m2", body.inertia_kg_m2[1, 1]),
        ):  # fmt: skip
            assert found[f"{name}_{figure}"] == pytest.approx(value, rel=6e-6)
    assert LIKE.stop is not None
    assert LIKE.roller_off is not None
    toe = next(one for one in LIKE.bodies[FOOT].contacts if "toe" in one.name)
    for name, value in (
        ("foot_depth_m", LIKE.foot_depth_m), ("toe_radius_m", toe.radius_m), ("stop_rad", LIKE.stop.angle_rad),
        ("stop_nm_per_rad", LIKE.stop.stiffness_nm_per_rad), ("release_rad_s", LIKE.roller_off.leg_rad_s),
        ("release_ratio", LIKE.roller_off.energy_ratio),
        ("release_turn_rad", LIKE.design.compression_rad + LIKE.roller_off.leg_rad),
    ):  # fmt: skip
        assert found[name] == pytest.approx(value, rel=6e-6)


def test_figures_of_a_layout_say_where_cam_motor_and_trays_are_and_how_large_a_spring_is() -> None:
    layout, found = LIKE.layout, robot_figures(LIKE)
    places = {"cam": layout.cam_axis_mm, "motor": layout.motor_mm}
    for part, (x, z) in places.items():
        assert (found[f"laid_{part}_x_mm"], found[f"laid_{part}_z_mm"]) == pytest.approx((x, z), rel=6e-6), part
    assert found["laid_tray_x_mm"] == pytest.approx(layout.tray_mm[0], rel=6e-6)
    assert found["laid_spring_g"] == pytest.approx(layout.drive.spring.mass_g, rel=6e-6)
    assert found["laid_coil_mm"] == pytest.approx(layout.drive.spring.arms.mean_mm, rel=6e-6)


def test_each_figure_is_found_again_in_the_robot() -> None:
    """Bodies turn about y; the toes' spheres stand on the same ground as the foot's others."""
    plain, made = capsule_robot(LIKE.design), estimated_robot(LIKE.design, MADE_UP, LIKE)
    for name in BODY_NAMES:
        body = made.bodies[name]
        com = [MADE_UP[f"{name}_com_x_m"], 0.0, MADE_UP[f"{name}_com_z_m"]]
        assert (body.name, body.mass_kg, body.com_m.tolist()) == (name, MADE_UP[f"{name}_mass_kg"], com)
        assert body.inertia_kg_m2[1, 1] == MADE_UP[f"{name}_inertia_kg_m2"]
        assert (np.linalg.eigvalsh(body.inertia_kg_m2) > 0.0).all()
        assert [one.name for one in body.contacts] == [one.name for one in plain.bodies[name].contacts]
    for one, old in zip(made.bodies[FOOT].contacts, plain.bodies[FOOT].contacts, strict=True):
        toe = "toe" in one.name
        assert one.radius_m == (0.0045 if toe else 0.0175)
        assert one.centre_m[:2].tolist() == old.centre_m[:2].tolist()
        lowest = one.centre_m[2] - one.radius_m
        assert lowest == pytest.approx(old.centre_m[2] - 0.0175)
    for corners in made.outline_m.values():
        assert (corners.real.min(), corners.real.max()) == pytest.approx((-0.01, 0.05))
        assert (corners.imag.min(), corners.imag.max()) == pytest.approx((-0.02, 0.03))
    assert {one.radius_m for one in made.bodies[BODY].contacts} == {LIKE.bodies[BODY].contacts[0].radius_m}
    assert made.stop is not None
    assert (made.stop.joint, made.stop.angle_rad, made.stop.stiffness_nm_per_rad) == ("leg", 0.0625, 7.0)
    assert made.roller_off is not None
    assert (made.roller_off.leg_rad_s, made.roller_off.energy_ratio) == (4.0, 0.875)
    assert (made.foot_depth_m, made.friction) == (0.0175, LIKE.friction)
    assert FIGURES["body_mass_kg"] != MADE_UP["body_mass_kg"]
