"""The studio without a browser: a real viser server, its sliders, what it shows and says."""

import queue
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import needs
from support.built import built

from jumpcad.bundle.bom import bill_of_materials
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.workshop import load_workshop

viser = needs.package("viser")

from jumpcad.studio import Points, Studio, app, inputs  # noqa: E402
from jumpcad.studio.answers import Printed, capsule_answer, printed_answer  # noqa: E402
from jumpcad.studio.app import BY_NUMBER, CLICK  # noqa: E402


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    made = Studio(load_design("kenan-2.0"), "kenan-2.0", ["default", "fine"], server, tmp_path)
    yield made
    server.stop()


def test_it_shows_every_part_and_says_what_evaluate_says(studio: Studio) -> None:
    found = studio.answer(studio.design)
    assert found.robot is not None
    assert {name.rpartition("/")[2] for name in studio.stage.meshes} == {one.name for one in visuals(found.robot)}
    jump = evaluate(studio.design).jump
    assert jump.ballistic_range_m is not None
    told = found.figures()["range"][0]
    assert told == pytest.approx(1000.0 * jump.ballistic_range_m, rel=0.005)  # planar against PyBullet
    assert f"{told:.1f} mm" in studio.figures.content


def test_its_thread_answers_one_design_after_the_other_until_it_ends(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    answered: queue.Queue[Design] = queue.Queue()
    monkeypatch.setattr(studio, "answer", answered.put)
    studio.start()
    assert answered.get(timeout=30.0) == studio.design  # the first, without being asked
    for length in (105.0, 110.0):
        studio.sliders["carrying_link_mm"].value = length
        studio._ask()
        assert answered.get(timeout=30.0).carrying_link_mm == length
    studio.end()
    assert not studio._thread.is_alive()
    assert answered.empty()


def test_differences_are_those_from_the_robot_before() -> None:
    """Mass of the new one less that of the old one, with its sign."""
    design, shop = load_design("kenan-2.0"), load_workshop()
    old, new = (printed_answer(design.model_copy(update={"carrying_link_mm": mm}), shop) for mm in (100.0, 110.0))
    (mass, _), (before, _) = new.figures()["mass"], old.figures()["mass"]
    assert mass > before + 0.5
    assert f"| mass | {mass:.1f} g (+{mass - before:.1f}) |" in new.to_markdown(old)
    assert f"| mass | {before:.1f} g (-{mass - before:.1f}) |" in old.to_markdown(new)
    assert f"| mass | {mass:.1f} g |" in new.to_markdown()


def test_only_what_changes_is_sent_again(studio: Studio) -> None:
    robot = studio.answer(studio.design).robot
    assert robot is not None
    assert studio.stage.show(robot) == 0
    other = printed_answer(studio.design.model_copy(update={"ground_link_angle_deg": 45.0}), studio.workshop).robot
    assert other is not None
    assert 0 < studio.stage.show(other) < len(studio.stage.meshes) / 2


def test_what_only_moves_is_moved(studio: Studio) -> None:
    """A longer carrying link changes the links and what holds them, and moves nearly everything."""
    studio.answer(studio.design)
    sent: list[str] = []
    add = studio.server.scene.add_mesh_simple
    studio.server.scene.add_mesh_simple = lambda name, *rest, **more: sent.append(name) or add(name, *rest, **more)
    robot = printed_answer(studio.design.model_copy(update={"carrying_link_mm": 101.0}), studio.workshop).robot
    assert robot is not None
    studio.stage.show(robot)
    assert "/robot/main_leg/main_leg" in sent
    assert len(sent) < len(studio.stage.meshes) / 4
    for one in visuals(robot):
        handle = studio.stage.meshes[f"/robot/{one.body}/{one.name}"][1]
        assert tuple(handle.position) == pytest.approx(tuple(one.T_body_mesh[:3, 3]), abs=1e-9)


def test_a_motion_moves_nodes_and_sends_no_mesh(studio: Studio) -> None:
    """The cam turns about its axis, which stays where it is in the body; another design stands at rest again."""
    robot = studio.answer(studio.design).robot
    assert robot is not None
    studio.player.show(0.5)
    moment, sent = studio.player._motion.at(1.5), []
    studio.server.scene.add_mesh_simple = lambda name, *_, **__: sent.append(name)
    studio.player.show(1.5)
    del studio.server.scene.add_mesh_simple
    assert sent == []
    handle = studio.stage.meshes["/robot/body/cam"][1]
    (rest,) = [one.T_body_mesh for one in visuals(robot) if one.name == "cam"]
    turned = Rotation.from_quat(handle.wxyz, scalar_first=True) * Rotation.from_matrix(rest[:3, :3]).inv()
    assert turned.as_rotvec() == pytest.approx([0.0, moment.turned_rad["cam"], 0.0], abs=1e-6)
    axis = np.array([robot.layout.cam_axis_mm[0], 0.0, robot.layout.cam_axis_mm[1]]) / 1000.0
    assert turned.apply(rest[:3, 3] - axis) + axis == pytest.approx(handle.position, abs=1e-6)
    studio.player.time.value = 1.5
    studio.answer(studio.design)
    assert handle.position == pytest.approx(rest[:3, 3], abs=1e-9)
    assert studio.player.time.value == 0.0


def test_a_hidden_part_that_is_violated_is_seen_through_the_others(studio: Studio) -> None:
    """With legs of 240 mm the cam's window of release is missed: the cam is red between plates that are pale."""
    studio.answer(studio.design.model_copy(update={"carrying_link_mm": 240.0}))
    cam, plate = (studio.stage.meshes[f"/robot/body/{name}"][1] for name in ("cam", "body_plate_left"))
    assert cam.opacity is None
    assert cam.color[0] > 2 * max(cam.color[1:])
    assert plate.opacity < 0.5
    studio.answer(studio.design)
    (whole,) = [mesh for name, (_, mesh) in studio.stage.meshes.items() if name.endswith("/body_plate_left")]
    assert whole.opacity is None


def test_a_part_says_what_the_bill_of_materials_says(studio: Studio) -> None:
    robot = studio.answer(studio.design).robot
    assert robot is not None
    studio._say_part("spring_left")
    (spring,) = [line for line in bill_of_materials(robot).items if "right hand" in line.name]
    assert f"{spring.name}; as bought {1000.0 * spring.mass_kg:.2f} g" in studio.part.content
    studio._say_part("main_leg")
    assert "stl/main_leg.stl" in studio.part.content


def test_a_point_of_a_study_brings_its_design_and_workshop(study: Path, tmp_path: Path) -> None:
    server, points = viser.ViserServer(host="127.0.0.1", port=0, verbose=False), Points(study)
    shown = Studio(points.trial(1).design, "four", ["fine", "of the study"], server, tmp_path, points)
    assert shown.workshop == load_workshop("fine")
    assert "best 1: 2 body lengths (trial 1)" in points.listed
    assert (shown.trial.min, shown.trial.max, shown.trial.step) == (1, 4, 1)
    shown._run_action(lambda: shown.open(4))
    assert shown.status.content == "as trial 4"
    assert (shown.design, shown.workshop) == (points.trial(4).design, load_workshop())
    assert "trial 4 of 4" in shown.point.content
    assert shown.best.value == "best 3: 1 body lengths (trial 4)"
    shown.open(2)
    assert shown.best.value == BY_NUMBER
    shown.open(4)
    shown.sliders["e_coef"].value = 1.1
    shown._reset()
    assert shown.design == points.trial(4).design
    shown._run_action(lambda: shown.open(9))
    assert "has no trial 9" in shown.status.content
    assert shown.number == 4
    server.stop()


def test_a_design_that_cannot_be_built_is_told_with_its_reason(studio: Studio) -> None:
    found = studio.answer(studio.design.model_copy(update={"stiffness_nmm_per_deg": 200.0}))
    assert found.robot is None
    assert found.reason
    assert found.reason in studio.figures.content
    studio.player.show(1.0)
    assert "no motion" in studio.player.words.content
    studio._say_part("cam")  # of the last robot, which is still seen
    assert studio.part.content == CLICK
    studio.shown = None
    studio._say_part("cam")
    assert studio.part.content == CLICK


def test_the_ghost_is_what_was_kept_and_figures_show_the_difference(studio: Studio) -> None:
    studio.answer(studio.design)
    studio._run_action(studio._keep)
    assert any(name.startswith("/ghost/") for name in studio.stage.meshes)
    found = studio.answer(studio.design.model_copy(update={"stiffness_nmm_per_deg": 8.0}))
    assert found.robot is not None
    assert "(-" in studio.figures.content


def test_sliders_hold_the_design_and_reset(studio: Studio) -> None:
    assert studio.design == load_design("kenan-2.0")
    studio.sliders["e_coef"].value = 1.0
    assert studio.design.e_coef == 1.0
    studio._reset()
    assert studio.design == load_design("kenan-2.0")


def test_a_saved_design_is_read_again_and_a_users_file_is_kept(studio: Studio, tmp_path: Path) -> None:
    studio._run_action(studio._save)
    assert load_design(tmp_path / "kenan-2.0-studio.toml") == studio.design
    studio._run_action(studio._save)
    assert [path.name for path in tmp_path.iterdir()] == ["kenan-2.0-studio.toml"]
    for name in ("kenan-2.0-studio.toml", "kenan-2.0-studio-2.toml"):
        (tmp_path / name).write_text("mine")
    studio.sliders["e_coef"].value = 1.1
    studio._run_action(studio._save)
    assert studio.status.content == f"saved {tmp_path / 'kenan-2.0-studio-3.toml'}"
    assert load_design(tmp_path / "kenan-2.0-studio-3.toml").e_coef == 1.1
    assert {(tmp_path / name).read_text() for name in ("kenan-2.0-studio.toml", "kenan-2.0-studio-2.toml")} == {"mine"}


@pytest.mark.parametrize(("key", "half"), [("compression_ratio", 0.0), ("carrying_link_mm", 1.0), ("c_coef", -5.0)])
def test_half_a_number_typed_is_told_and_changes_nothing(studio: Studio, key: str, half: float) -> None:
    """A browser sends a number after every key: "0" on the way to "0.9"."""
    before, studio._wanted = studio.sliders[key].value, None
    studio.sliders[key].value = half
    studio._ask()
    assert studio.quick.content.startswith(f"**no design**: {key} = {half}: must be ")
    assert studio._wanted is None
    studio.sliders[key].value = before
    studio._ask()
    assert studio._wanted == studio.design
    assert studio.quick.content == capsule_answer(studio.design)


def test_the_answer_at_once_is_the_capsule_robots() -> None:
    words = capsule_answer(load_design("kenan-2.0"))
    assert "190 mm" in words  # the README's range with the study's masses


def test_the_workshop_can_be_changed(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """The panel names the one that is used, which at first is the first; what is there to choose is all."""
    assert studio.choice.options == ("default", "fine")
    assert studio.choice.value == "default"
    assert studio.workshop == load_workshop("default")
    studio.choice.value = "fine"
    assert studio._change_workshop() == "workshop fine"
    assert studio.workshop == load_workshop("fine")
    built: list[Any] = []
    monkeypatch.setattr(app, "printed_answer", lambda *given: built.append(given) or Printed(given[0], reason="none"))
    studio.answer(studio.design)
    assert built == [(studio.design, load_workshop("fine"), "kenan-2.0")]
    assert {key: slider.value for key, slider in studio.sliders.items()} == load_design("kenan-2.0").model_dump()


def test_it_ends_with_its_thread_and_keeps_no_robot(studio: Studio) -> None:
    studio.start()
    studio.end()
    assert not studio._thread.is_alive()
    assert studio.shown is None
    assert not studio.stage.meshes


def test_what_is_still_wanted_when_it_ends_is_not_built(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    answered = []
    monkeypatch.setattr(studio, "answer", answered.append)
    studio.start()
    studio.end()
    answered.clear()
    studio._wanted = studio.design
    studio._work()
    assert answered == []


def test_a_bundle_of_the_studio_has_pictures(studio: Studio, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    asked: list[object] = []

    def export(robot: Robot, folder: Path, pictures: bool) -> SimpleNamespace:
        asked.extend([robot.design, folder, pictures])
        return SimpleNamespace(folder=folder)

    monkeypatch.setattr(app, "export", export)
    found = SimpleNamespace(robot=built("kenan-2.0"), jump=SimpleNamespace(verdict="jump"))
    made: list[object] = []
    monkeypatch.setattr(app, "printed_answer", lambda *given: made.append(given) or found)
    assert studio._build() == f"built {tmp_path / 'kenan-2.0-studio'}"
    assert asked == [studio.design, tmp_path / "kenan-2.0-studio", True]
    studio.sliders["e_coef"].value = 1.0
    studio.workshop = load_workshop("fine")
    studio._build()
    assert made[1] == (studio.design, load_workshop("fine"), "kenan-2.0")


def test_a_bundle_of_a_robot_that_is_not_to_be_built_says_so(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Legs of 240 mm stay on the ground with these springs, and the cam's window of release is missed."""
    monkeypatch.setattr(app, "export", lambda robot, folder, pictures: SimpleNamespace(folder=folder))
    studio.sliders["carrying_link_mm"].value = 240.0
    told = studio._build().split("; ")
    assert told[:2] == [f"built {tmp_path / 'kenan-2.0-studio'}", "**it does not jump (no_takeoff)**"]
    assert re.fullmatch(r"\*\*\d+ of its \d+ limits are violated: do not build it as it is\*\*", told[2])


def test_one_bundle_is_built_at_a_time(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two at once left a hidden folder beside the bundle; the first says that it is at work."""
    told: list[str] = []

    def export(robot: Robot, folder: Path, pictures: bool) -> SimpleNamespace:
        told.append(studio.status.content)
        studio._run_action(studio._build)
        told.append(studio.status.content)
        return SimpleNamespace(folder=folder)

    monkeypatch.setattr(app, "export", export)
    found = SimpleNamespace(robot=built("kenan-2.0"), jump=SimpleNamespace(verdict="jump"))
    monkeypatch.setattr(app, "printed_answer", lambda *_: found)
    assert studio._build().startswith("built ")
    assert told == ["building …", "**not possible**: a bundle is being built; wait until it is there"]
    assert studio._build().startswith("built ")


def test_a_saved_design_says_with_which_workshop_it_is_the_robot(
    studio: Studio, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A workshop with a name by its name; that of a point, whose values no file has, in a file beside the design."""
    file, shop = tmp_path / "kenan-2.0-studio.toml", tmp_path / "kenan-2.0-studio-workshop.toml"
    assert studio._save() == f"saved {file}"
    studio.choice.value = "fine"
    studio._change_workshop()
    assert studio._save() == f"saved {file}; this robot: `jumpcad build {file} --workshop fine`"
    assert not shop.exists()
    points = Points(study)
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    usual = Studio(points.trial(1).design, "usual", ["of the study"], server, tmp_path, points)
    assert usual._save() == f"saved {tmp_path / 'usual-studio.toml'}"  # the study's is the default one
    monkeypatch.setattr(points, "workshop_of", lambda _: load_workshop("light"))
    shown = Studio(points.trial(1).design, "kenan-2.0", ["of the study"], server, tmp_path, points)
    assert shown._save() == f"saved {file}; this robot: `jumpcad build {file} --workshop {shop}`"
    assert load_workshop(str(shop)) == load_workshop("light")
    shop.write_text("mine")
    assert "kenan-2.0-studio-2-workshop.toml" in shown._save()
    assert shop.read_text() == "mine"
    server.stop()


def test_reset_brings_back_the_workshop_too(studio: Studio) -> None:
    """Else the robot is another one than "at the start"."""
    studio.choice.value = "fine"
    studio._change_workshop()
    assert studio._reset() == "as at the start"
    assert (studio.choice.value, studio.workshop) == ("default", load_workshop())


def test_a_workshop_that_cannot_be_used_is_not_named_as_the_one_in_use(studio: Studio) -> None:
    studio.choice.value = "fine"
    studio.workshop = load_workshop("fine")
    studio._change_workshop()
    studio.choice.options = (*studio.choice.options, "gone.toml")
    studio.choice.value = "gone.toml"
    studio._run_action(studio._change_workshop)
    assert "not possible" in studio.status.content
    assert (studio.choice.value, studio.workshop) == ("fine", load_workshop("fine"))


def test_each_button_does_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    groups: list[SimpleNamespace] = []

    def group(label: str, options: tuple[str, ...]) -> SimpleNamespace:
        groups.append(SimpleNamespace(options=options, acts=[]))
        groups[-1].on_click = groups[-1].acts.append
        return groups[-1]

    monkeypatch.setattr(server.gui, "add_button_group", group)
    for name in ("_keep", "_reset", "_save", "_build"):
        monkeypatch.setattr(Studio, name, lambda self, done=name: done)
    shown = Studio(load_design("kenan-2.0"), "kenan-2.0", ["default"], server, tmp_path)
    (buttons,), told = groups, {}
    for name in buttons.options:
        buttons.value = name
        buttons.acts[0](None)
        told[name] = shown.status.content
    server.stop()
    assert told == {
        "Keep as ghost": "_keep", "Reset": "_reset", "Save design": "_save", "Build bundle": "_build",
    }  # fmt: skip


def test_sliders_have_ends_steps_and_hints_of_their_own(studio: Studio) -> None:
    """Each parameter's, as it is described."""
    for key, value in load_design("kenan-2.0").model_dump().items():
        slider = studio.sliders[key]
        assert (slider.min, slider.max) == inputs.slider_ends(key, value)
        assert slider.step == inputs.slider_step(slider.max - slider.min)
        assert (slider.label, slider.hint) == (key, Design.model_fields[key].description)


def test_what_a_person_changes_is_acted_on(study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each slider asks for the new design; workshop, list of points and number open what they say."""
    acts: dict[object, Callable[[], object]] = {}
    monkeypatch.setattr(app, "when_changed", lambda handle, act: acts.update({handle.label: act}))
    spans, step = list[float](), inputs.slider_step
    monkeypatch.setattr(app, "slider_step", lambda span: spans.append(span) or step(span))
    server, points = viser.ViserServer(host="127.0.0.1", port=0, verbose=False), Points(study)
    shown = Studio(points.trial(1).design, "four", ["fine", "of the study"], server, tmp_path, points)
    assert spans == [slider.max - slider.min for slider in shown.sliders.values()]
    assert {key for key, act in acts.items() if act == shown._ask} == set(shown.sliders)
    assert (shown.best.value, shown.trial.value) == (points.listed_as(1, ""), 1)
    assert shown.point.content == points.to_text(1)
    shown.sliders["e_coef"].value = 1.1
    shown.player.button.label = "Pause"
    acts["e_coef"]()
    assert (shown._wanted, shown.player.button.label) == (shown.design, "Play")
    assert shown.quick.content == capsule_answer(shown.design)
    shown.choice.value = "of the study"
    acts["workshop"]()
    assert (shown.workshop, shown.status.content) == (load_workshop(), "workshop of the study")
    shown.best.value = "best 3: 1 body lengths (trial 4)"
    acts["point"]()
    assert (shown.number, shown.design, shown.trial.value) == (4, points.trial(4).design, 4)
    shown.trial.value = 3
    acts["trial"]()
    assert (shown.number, shown.design, shown.best.value) == (3, points.trial(3).design, points.listed_as(3, ""))
    shown.best.value = BY_NUMBER
    acts["point"]()
    assert shown.number == 3
    server.stop()


def test_sliders_reach_as_far_as_the_design_to_which_they_are_reset(studio: Studio) -> None:
    """And no less far than before."""
    before = {key: (slider.min, slider.max) for key, slider in studio.sliders.items()}
    far = {"carrying_link_mm": 390.0, "c_coef": 0.35}
    studio.first = studio.first.model_copy(update=far)
    assert studio._reset() == "as at the start"
    assert studio.design == studio.first
    for key, slider in studio.sliders.items():
        low, high = before[key]
        value = far.get(key, low)
        assert (slider.min, slider.max) == (min(low, value), max(high, value))


def test_a_point_whose_workshop_cannot_be_used_is_not_opened(
    study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    server, points = viser.ViserServer(host="127.0.0.1", port=0, verbose=False), Points(study)
    shown = Studio(points.trial(3).design, "four", ["fine", "of the study"], server, tmp_path, points, 3)
    monkeypatch.setattr(points, "workshop_of", lambda _: load_workshop("no-such-workshop"))
    with pytest.raises(JumpcadError, match="no-such-workshop"):
        shown.open(4)
    assert (shown.number, shown.trial.value, shown.design) == (3, 3, points.trial(3).design)
    server.stop()
