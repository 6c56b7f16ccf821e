"""What pictures of steps show: things stand before their places, behind what comes first, and turn as they will."""

import itertools

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.steps.step_views import StepView, motor_sense, step_views


@pytest.fixture(scope="module")
def views() -> dict[str, list[StepView]]:
    return step_views(built("kenan-2.0"))


def test_what_goes_on_an_axle_first_stands_nearest_to_its_place(views: dict[str, list[StepView]]) -> None:
    view = views["legs"][0]
    y = {thing.name: pose[1, 3] for thing, pose in zip(view.things, view.poses, strict=True)}
    order = ["spring_bushing_right", "spring_right", "main_leg", "spring_left", "spring_bushing_left"]
    heights = [y[name] for name in order]
    assert heights == sorted(heights)


def test_labels_name_what_is_put_on_and_lead_to_its_place(views: dict[str, list[StepView]]) -> None:
    labels = {label.text: label for label in views["arm"][0].labels}
    pin = labels["leg spring pin"]
    assert pin.at_m[1] > pin.place_m[1] + 0.005, "from the left"
    assert np.allclose(pin.at_m[[0, 2]], pin.place_m[[0, 2]], atol=1e-6)
    assert {"left-hand spring", "right-hand spring"} <= {label.text for label in views["legs"][0].labels}


def test_assemblies_on_the_bench_lie_apart(views: dict[str, list[StepView]]) -> None:
    """Plates and trays that wires join, each with its own parts after it: 12 mm or more between any two."""
    view = views["power"][0]
    boxes: list[list[np.ndarray]] = []
    for thing, pose in zip(view.things, view.poses, strict=True):
        if thing.name.startswith(("body_plate", "electronics_tray")):
            boxes.append([])
        corners = thing.mesh.bounds / 1000.0 @ pose[:3, :3].T + pose[:3, 3]
        boxes[-1] += [corners.min(axis=0), corners.max(axis=0)]
    assert len(boxes) == 4
    for one, other in itertools.combinations(map(np.array, boxes), 2):
        gaps = np.maximum(one.min(axis=0) - other.max(axis=0), other.min(axis=0) - one.max(axis=0))
        assert max(gaps[0], gaps[2]) >= 0.012 - 1e-6


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_labels_of_springs_point_at_their_wire(name: str) -> None:
    """Nearer to the wire's middle line than its radius, in every picture that names them; each at its own.

    And nothing is drawn more than 110 mm from its place: of a large robot's leg the last bushing would be.
    """
    pictures = [view for views in step_views(built(name)).values() for view in views]
    far = max(np.linalg.norm(label.at_m - label.place_m) for view in pictures for label in view.labels)
    assert far == pytest.approx(0.11) if name == "best-bo" else far < 0.11
    seen = 0
    radius_m = built(name).layout.drive.spring.wire_mm / 2000.0
    for view in pictures:
        for label in (label for label in view.labels if label.text.endswith("-hand spring")):
            side = "left" if label.text.startswith("right") else "right"  # the right-hand one is on the robot's left
            at = next(k for k, thing in enumerate(view.things) if thing.name == f"spring_{side}")
            tube = view.things[at].mesh.vertices / 1000.0 @ view.poses[at][:3, :3].T + view.poses[at][:3, 3]
            ends = tube[:8], tube[8:16]  # of the arm: rings of the mesh around its end and where the coil begins
            a, b = (end.mean(axis=0) for end in ends)
            share = np.clip((label.at_m - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
            assert np.linalg.norm(a + share * (b - a) - label.at_m) < radius_m, (view.title, label.text)
            seen += 1
    assert seen >= 5


def test_the_split_pin_goes_through_the_springs_pin_along_its_own_length(views: dict[str, list[StepView]]) -> None:
    """From the front, in a picture without the plates; the step's own picture, where the plate hides it, lacks it."""
    step, *details = views["arm"]
    assert "leg_spring_pin_split_pin" not in {thing.name for thing in step.things}
    (detail,) = [view for view in details if view.name == "retention"]
    assert not any("plate" in thing.name for thing in detail.things)
    (label,) = [label for label in detail.labels if label.text == "leg spring pin split pin"]
    assert label.at_m[0] > label.place_m[0] + 0.005
    at = next(k for k, thing in enumerate(detail.things) if thing.name == "leg_spring_pin_split_pin")
    corners = detail.things[at].mesh.vertices @ detail.poses[at][:3, :3].T
    assert np.argmax(np.ptp(corners, axis=0)) == 0


def test_two_meshing_gears_turn_oppositely_and_three_alike() -> None:
    assert motor_sense(built("kenan-2.0")) == -1
    assert motor_sense(geared()) == 1
