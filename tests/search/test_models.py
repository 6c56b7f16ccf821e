"""Models of robots: what is evaluated, and how."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support import needs

from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.findings import Finding
from jumpcad.paper import published
from jumpcad.search.models import robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.variant import Tolerances, Variant
from jumpcad.settings import load_settings
from jumpcad.simulation import Jump
from jumpcad.simulation.engines import default_engine
from jumpcad.workshop import load_workshop, varied


def test_only_a_printed_robot_has_a_workshop_a_size_and_a_quick_score():
    """Its links are 0.4 mm off (sliding fits of 0.2 mm at both ends), others 0.2 mm; its springs by half of ±10 %."""
    printed, capsule, published = robot_model(), robot_model("capsule"), robot_model("published")
    assert [one.default_objective for one in (printed, capsule, published)] == ["body_lengths", "fitness", "fitness"]
    assert (printed.making.length_mm, printed.making.rate, printed.making.printed) == pytest.approx((0.4, 0.05, True))
    assert capsule.making == published.making == Tolerances(0.2)
    design, score = load_design("kenan-2.0"), find_objective("fitness")
    assert 0.0 < printed.quick_score(design, score) < 10.0
    assert [one.quick_score(design, score) for one in (capsule, published)] == [-math.inf] * 2
    flat = design.model_copy(update={"c_coef": 0.3, "d_coef": 0.6, "rest_angle_deg": 40.0})
    assert printed.quick_score(flat, score) == -math.inf
    assert [one.admits(flat) for one in (printed, capsule, published)] == [False] * 3
    assert [one.admits(design) for one in (printed, capsule, published)] == [True] * 3


def test_a_model_says_what_decides_its_evaluations():
    """The capsule robot is simulated by an engine, the published one by PyBullet alone; versions follow."""
    printed, capsule, published = robot_model(), robot_model("capsule"), robot_model("published")
    assert [one.describe()["engine"] for one in (printed, capsule, published)] == [default_engine()] * 2 + ["pybullet"]
    assert replace(capsule, engine="planar").describe()["engine"] == "planar"
    assert [one.describe()["workshop"] is None for one in (printed, capsule, published)] == [False, True, True]
    assert [one.describe()["settings"] is None for one in (printed, capsule, published)] == [False, False, True]
    assert {"manifold3d", "trimesh"} < set(printed.versions())
    assert not {"manifold3d", "trimesh"} & set(capsule.versions())
    for model, engine in (
        (printed, default_engine()),
        (replace(capsule, engine="mujoco"), "mujoco"),
        (published, "pybullet"),
    ):
        assert {"jumpcad", "code", "numpy", engine} <= set(model.versions())
    assert "mujoco" not in published.versions()
    assert replace(printed, stand_in=True).describe() == printed.describe() | {"stand_in": True}
    digests = {one.digest for one in (printed, capsule, published, replace(printed, stand_in=True))}
    assert len(digests) == 4


def test_a_model_has_the_workshop_settings_and_engine_that_are_named():
    """By a template's name or themselves; without one the default's."""
    light, fine = load_workshop("light"), load_settings("fine")
    for shop, how in (("light", "fine"), (light, fine)):
        named = robot_model("printed", shop, how, "planar")
        assert (named.workshop, named.settings, named.engine) == (light, fine, "planar")
        capsule = robot_model("capsule", None, how, "planar")
        assert (capsule.workshop, capsule.settings, capsule.engine) == (None, fine, "planar")
    usual = robot_model()
    assert (usual.workshop, usual.settings) == (load_workshop("default"), load_settings("default"))
    assert light != usual.workshop
    assert fine != usual.settings


def test_a_design_is_evaluated_in_the_model_s_own_workshop_settings_and_engine(monkeypatch):
    """With other values of that workshop too; springs scatter and lengths are off as it says."""
    light, fine, design = load_workshop("light"), load_settings("fine"), load_design("kenan-2.0")
    gate = [Finding("tips", "info", 0.1, "mm", "", "")]
    jump, asked = Jump("jump", "mujoco", 0.1, 0.2, findings=gate), []
    monkeypatch.setattr("jumpcad.search.models.evaluate_made", lambda *given: asked.append(given[1:4]) or 1 / 0)
    monkeypatch.setattr("jumpcad.search.models.simulate", lambda *given: asked.append(given[1:]) or jump)
    assert robot_model("capsule", None, fine, "mujoco")(design).findings == tuple(gate)
    thick = {"body.plate_mm": 2.0, "safety.spring_rate_scatter": 0.2, "fits.sliding_mm": 0.25}
    printed = robot_model("printed", light, fine, "mujoco")
    for model in (printed, printed.varied(thick)):
        with pytest.raises(ZeroDivisionError):
            model._built(design)
    shop = varied(light, thick)
    assert asked == [(fine, "mujoco"), (light, fine, "mujoco"), (shop, fine, "mujoco")]
    assert (model.making.length_mm, model.making.rate) == (0.5, 0.1)


def test_a_refusal_says_by_how_much_its_limit_was_missed(monkeypatch):
    """For the processes that learn where there is room, whether the robot was built or only laid out."""

    def refused(*_):
        raise CannotBuildError("no room", "room_tray", -2.5)

    for name in ("jumpcad.search.models.layout_of", "jumpcad.search.models.evaluate_made"):
        monkeypatch.setattr(name, refused)
    model, variant = robot_model(), Variant(load_design("kenan-2.0"))
    for found in (model.laid_out(variant), model(variant.design)):
        assert (found.verdict, found.margins["room_tray"]) == ("cannot_build", -2.5)


def test_guesses_and_quick_scores_have_settings_of_their_own():
    """Steps of 2 ms; the planar engine, unless it lacks what the settings ask for."""
    plain = robot_model("printed", None, "fine", "mujoco")
    assert (plain.estimate_engine, plain.estimate_settings.dt_s) == ("planar", 0.002)
    same = plain.estimate_settings.model_copy(update={"dt_s": plain.settings.dt_s, "push_off_steps": 60})
    assert same == plain.settings
    rolling = replace(plain, settings=plain.settings.model_copy(update={"rolling_friction_m": 0.1}))
    assert (rolling.estimate_engine, rolling.estimate_settings.dt_s) == ("mujoco", 0.002)
    slow = replace(plain, settings=plain.settings.model_copy(update={"dt_s": 0.004}))
    assert slow.estimate_settings.dt_s == 0.004


def test_every_objective_is_for_printed_robots_and_for_others_what_they_have() -> None:
    """A capsule robot has a rise and no size, the published one its fitness alone."""
    has = {"printed": ("body_lengths", "range", "rise", "fitness"), "capsule": ("rise",), "published": ("fitness",)}
    for name, objectives in has.items():
        for objective in objectives:
            find_objective(objective).require(robot_model(name).figure_names)
    for name, objective in (("capsule", "body_lengths"), ("published", "rise")):
        with pytest.raises(JumpcadError, match=f"{objective} needs .*, which this model does not give"):
            find_objective(objective).require(robot_model(name).figure_names)


def test_what_a_model_does_not_have_or_use_is_refused():
    for name, given, said in (
        ("capsule", {"workshop": "light"}, "workshop light: does not apply to the capsule robot; leave it out"),
        ("published", {"workshop": load_workshop("light")}, "workshop: does not apply to the published robot"),
        ("published", {"settings": "fine"}, "settings fine: does not apply to the published robot; leave it out"),
        ("published", {"engine": "planar"}, "engine planar: the published simulation exists in pybullet alone"),
        ("printed", {"engine": "bulet"}, "'bulet' is not an engine; there are pybullet, mujoco and planar"),
        ("printd", {}, "'printd' is not one of the models printed, capsule, published .did you mean printed"),
    ):
        with pytest.raises(JumpcadError, match=said):
            robot_model(name, **given)


def test_the_published_fitness_is_distance_over_the_longest_of_legs_and_toes():
    needs.package("pybullet")
    design = load_design("kenan-2.0")
    jump, figures = published.simulate(design), robot_model("published")(design).metrics
    longest_m = max(design.l2_mm, design.l3_mm, design.l5_mm) / 1000.0
    assert figures == {
        "fitness": pytest.approx(jump.distance_m / longest_m), "base_distance_m": jump.distance_m,
        "base_height_m": jump.base_height_m, "spring_energy_j": jump.energy_j,
    }  # fmt: skip


def test_a_capsule_robot_that_is_too_weak_or_tips_is_not_admitted_and_the_first_error_is_the_verdict():
    """Its masses follow from the design; those of others are only known from what is built or published."""
    weak = Design.from_vector([100, 1.0, 0.833, 0.934, 0.2, 70, 5, 40])
    tipping = Design.from_vector([100, 1.0, 0.833, 0.2, 0.755, 70, 29.5, 40])
    for design in (weak, tipping):
        assert [robot_model(name).admits(design) for name in ("capsule", "printed", "published")] == [False, True, True]
    open_loop = load_design("kenan-2.0").model_copy(update={"c_coef": 0.3, "d_coef": 0.6, "rest_angle_deg": 40.0})
    for name in ("capsule", "printed", "published"):
        found = robot_model(name)(open_loop)
        assert found.verdict == next(one.name for one in found.findings if one.severity == "error")
        assert not found.metrics


def test_only_a_printed_robot_of_which_no_other_learns_is_refused_before_it_is_built():
    """Stand-ins and what is made otherwise than designed need figures of robots that are built."""
    weak, printed = Design.from_vector([100, 1.0, 0.833, 0.934, 0.2, 70, 5, 40]), robot_model()
    first, built = printed(weak), replace(printed, stand_in=True)(weak)
    assert (first.verdict, built.verdict) == ("too_weak", "too_weak")
    assert (first.metrics, bool(built.metrics)) == ({}, True)
    assert printed(weak, {"made.spring_factor": 1.05}).metrics


def test_what_has_no_pose_in_the_machine_s_bounds_is_refused_before_it_is_laid_out():
    """Dry runs lay out any point of a search, also one whose springs pass a dead point while they are wound."""
    model = robot_model()
    space = Space.make(workshop=model.workshop)
    outcomes = [model.laid_out(space.to_variant(point)) for point in space.spread(64, np.random.default_rng(3))]
    refused = [one for one in outcomes if isinstance(one, Evaluation) and one.verdict == "winding"]
    assert refused
    assert all("winding" in one.reasons for one in refused)
    assert any(not isinstance(one, Evaluation) for one in outcomes)
