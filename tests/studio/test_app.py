"""The studio without a browser: a real viser server, its sliders, what it shows and says."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support import needs

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.evaluation import evaluate
from jumpcad.scene.visuals import visuals
from jumpcad.workshop import load_workshop

viser = needs.package("viser")

from jumpcad.studio import Points, Studio, app  # noqa: E402
from jumpcad.studio.answers import Printed, capsule_answer  # noqa: E402
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
    assert jump.touchdown_distance_m is not None
    told = found.figures()["touchdown"][0]
    assert told == pytest.approx(1000.0 * jump.touchdown_distance_m, rel=0.005)  # planar against PyBullet
    assert f"{told:.1f} mm" in studio.figures.content


def test_a_point_of_a_study_brings_its_design_and_workshop(study: Path, tmp_path: Path) -> None:
    server, points = viser.ViserServer(host="127.0.0.1", port=0, verbose=False), Points(study)
    shown = Studio(points.trial(1).design, "four", ["fine", "of the study"], server, tmp_path, points)
    assert shown.workshop == load_workshop("fine")
    assert "best 1: 2 link lengths (trial 1)" in points.listed
    assert (shown.trial.min, shown.trial.max, shown.trial.step) == (1, 4, 1)
    shown._run_action(lambda: shown.open(4))
    assert shown.status.content == "as trial 4"
    assert (shown.design, shown.workshop) == (points.trial(4).design, load_workshop())
    assert "trial 4 of 4" in shown.point.content
    assert shown.best.value == "best 3: 1 link lengths (trial 4)"
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


def test_the_answer_at_once_is_the_capsule_robots() -> None:
    words = capsule_answer(load_design("kenan-2.0"))
    assert "151 mm" in words  # the touchdown with the study's masses in docs/results.md


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


def test_a_workshop_that_cannot_be_used_is_not_named_as_the_one_in_use(studio: Studio) -> None:
    studio.choice.value = "fine"
    studio.workshop = load_workshop("fine")
    studio._change_workshop()
    studio.choice.options = (*studio.choice.options, "gone.toml")
    studio.choice.value = "gone.toml"
    studio._run_action(studio._change_workshop)
    assert "not possible" in studio.status.content
    assert (studio.choice.value, studio.workshop) == ("fine", load_workshop("fine"))


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
