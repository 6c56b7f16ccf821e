"""Measurements against the robot that was built: units, contradictions, priors."""

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from support.calibrations import remeasured

from jumpcad.calibration import subject as subject_module
from jumpcad.calibration.likelihood import CalibrationModel
from jumpcad.calibration.measurements import Measurements
from jumpcad.calibration.subject import (
    Subject,
    _require_plausible,
    load_subject,
    renamed,
    require_each_once,
    require_pairs,
)
from jumpcad.errors import JumpcadError
from jumpcad.files import templates_folder
from jumpcad.landing.landing import land
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.workshop import load_workshop, varied

HEAD = 'design = "kenan-2.0"\nsource = "mine"\nrelease = "dog"\n'
FAR, HIGH = '[[jumps]]\ndistance_of = "first-touchdown"\n', '[[jumps]]\nheight_of = "rise"\n'
JUMP = '[[jumps]]\ndistance_of = "centre-of-mass"\nheight_of = "rise"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[mass]\nrobot_g = 0.103", r"robot_g = 0.103: the model has 1\d\d g: is that kg\? give it in g"),
        ("[mass]\nrobot_g = 1030.0", r"robot_g = 1030: the model has 1\d\d g: a digit too many\?"),
        ("[spring]\nrate_nmm_per_deg = 527.0\nsprings = 2", r"is that per radian\? give it in N·mm/° for both"),
        ("[spring]\nrate_nmm_per_deg = 9.2\nsprings = 1", r"= 18.4: the model has 9.2"),
        ("[spring]\nrate_nmm_per_deg = 0.0092\nsprings = 2", r"is that N·m/deg\?"),
        (JUMP + "distance_mm = [0.35]\nheight_mm = [80.0]", r"distance_mm = 0.35: the model has 20\d mm: is that m\?"),
        (JUMP + "distance_mm = [22.0]\nheight_mm = [80.0]", r"is that cm\?"),
        (
            JUMP + "distance_mm = [220.0]\nheight_mm = [0.08]",
            r"jumps.height_mm = 0.08: the model has [67]\d\.\d mm: is that m",
        ),
        (JUMP + "distance_mm = [220.0]\nheight_mm = [80.0]\nbattery_j = [1300.0]", r"is that mJ\?"),
        ("[floor]\npull_n = [80.0]", r"is a friction of 7\d\.\d: pull the standing robot"),
        (
            "[mass]\nrobot_g = 103.0\n" + JUMP + "distance_mm = [350.0]\nheight_mm = [150.0]",
            r"height_mm = 150 with distance_mm = 350: takes 0.203 J for 103 g, and the springs hold 0.133 J: measure",
        ),
        (
            JUMP + "distance_mm = [900.0]\nheight_mm = [300.0]",
            r"takes 0.21\d? J for 4\d.\d g \(not weighed\), and the springs hold 0.133 J: weigh the robot, measure",
        ),
        ("[mass.parts_g]\nwing = 3.0", r"mine.toml: mass.parts_g.wing: no such part; the robot has main_leg, "),
        (
            "[mass.parts_g]\ncam_spacer_left = 0.5",  # that of other robots
            r"mass.parts_g.cam_spacer_left: no such part \(did you mean cam_spacer_right\?\)",
        ),
        ("[mass.parts_g]\nmain_leg = 47.0", r"parts_g.main_leg = 47: the model has \d\.\d+ g: a digit too many\?"),
        ("[floor]\nslope_deg = [0.6]", r"slope_deg = 0.6: is a friction of 0.0105: give the slope's angle in degrees"),
        ("[floor]\npull_n = [0.3]\nslope_deg = [45.0]", r"one of 1.00: one floor has one friction"),
        (
            FAR + "distance_mm = [90.0, 430.0]",
            r"= 90 and 430, both first-touchdown: one robot does not jump 4.8 times as far: leave failed jumps out",
        ),
        (
            FAR + "distance_mm = [210.0]\n" + FAR.replace("first-touchdown", "resting-place") + "distance_mm = [120.0]",
            r"the resting place, 120, lies before the first touchdown, 210: is one the other\?",
        ),
        (
            HIGH + "height_mm = [150.0]\n" + HIGH.replace("rise", "absolute") + "height_mm = [120.0]",
            r"a rise of 150 is 2\d\d mm above the floor, and the absolute height is 120",
        ),
        (
            "[mass]\nrobot_g = 103.0\n" + FAR + "distance_mm = [350.0]\n" + HIGH + "height_mm = [150.0]",
            r"height_mm = 150 with distance_mm = 350: takes 0.203 J for 103 g, and the springs hold 0.133 J: measure",
        ),
        (
            HIGH.replace("rise", "absolute") + "height_mm = [75.0]",
            r"an absolute height of 75 is not above the 8\d mm of the centre of mass before the jump: is it a rise\?",
        ),
        ('[[videos]]\npoints = "no.csv"\npoint = "body"', r"no.csv: no such file"),
    ],
)
def test_units_and_contradictions_in_one_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + text)
    with pytest.raises(JumpcadError, match=message) as caught:
        load_subject(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["foot", "cam"])
def test_a_part_is_compared_with_the_models(tmp_path: Path, subject: Subject, name: str) -> None:
    """Not with its own weight, by which the robot of the measurements is built."""
    (part,) = (one for one in subject.robot.parts if one.name == name)
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + f"[mass.parts_g]\n{name} = 99.0\n")
    with pytest.raises(JumpcadError, match=rf"parts_g.{name} = 99: the model has {1000.0 * part.mass.mass_kg:.3g} g:"):
        load_subject(path)


def test_priors_follow_what_was_measured(subject: Subject) -> None:
    said = {"design": "kenan-2.0", "source": "a test", "release": "dog"}
    nothing = remeasured(subject, Measurements(**said))
    assert (nothing.mass.first, nothing.rate.first, nothing.floor.shape) == (1.0, 1.0, "uniform")
    assert nothing.rate.second == subject.robot.workshop.safety.spring_rate_scatter / 2.0
    loose = varied(subject.robot.workshop, {"safety.spring_rate_scatter": 0.3})
    assert replace(nothing, robot=replace(subject.robot, workshop=loose)).rate.second == 0.15
    grams = 1000.0 * subject.robot.mass_kg
    rough = remeasured(subject, Measurements(**said, mass={"robot_g": grams, "robot_error_g": 0.05 * grams}))
    assert (rough.mass.first, rough.mass.second) == pytest.approx((1.0, 0.05))
    much = remeasured(
        subject,
        Measurements(
            **said,
            mass={"robot_g": 1.2 * grams},
            spring={"rate_nmm_per_deg": 5.06, "springs": 1, "error_share": 0.02},
            floor={"pull_n": (0.6 * 1.2 * 9.81 * grams / 1000.0,), "slope_deg": (math.degrees(math.atan(0.6)),)},
        ),
    )
    assert much.mass.first == pytest.approx(1.2)
    assert (much.rate.first, much.rate.second) == pytest.approx((1.1, 0.022))  # 10.12 over the design's 9.2
    assert much.floor.first == pytest.approx(0.6)


def test_what_is_not_weighed_keeps_the_models_error(tmp_path: Path, subject: Subject) -> None:
    """A fifth of the mass that is open, and 1 % of a scale: of all where nothing is weighed, else not of the leg."""
    path = tmp_path / "mine.toml"
    path.write_text(HEAD)
    assert load_subject(path).mass.second == pytest.approx(math.hypot(0.2, 0.01))
    path.write_text(HEAD + "[mass.parts_g]\nmain_leg = 20.0\n")
    some = load_subject(path)
    open_share = 1.0 - 0.020 / some.robot.mass_kg
    assert 0.5 < open_share < 1.0
    assert some.mass.second == pytest.approx(math.hypot(0.2 * open_share, 0.01))


def test_each_copy_of_a_weighed_part_counts(subject: Subject) -> None:
    """Of a part that the robot has twice, twice its weight is known."""
    (foot,) = (part for part in subject.robot.parts if part.name == "foot")
    found = []
    for copies in (1, 2):
        parts = (replace(foot, placements=copies * foot.placements, mass_source="weighed"),)
        measured = Measurements(design="kenan-2.0", source="a test", release="dog")
        found.append(Subject("twice", measured, replace(subject.robot, parts=parts), ()).mass.second)
    shares = [1.0 - count * foot.mass_kg / subject.robot.mass_kg for count in (1, 2)]
    assert found == pytest.approx([math.hypot(0.2 * share, 0.01) for share in shares])


@pytest.mark.parametrize(("battery_j", "refused"), [(0.49, True), (0.51, False)])
def test_a_battery_gives_more_than_the_springs_hold(
    monkeypatch: pytest.MonkeyPatch, battery_j: float, refused: bool
) -> None:
    """Of a drive that would need 1 J for springs of 0.5 J."""
    monkeypatch.setattr(subject_module, "simulate", lambda *_: SimpleNamespace(ballistic_range_m=0.2, com_rise_m=0.1))
    jumps = ({"battery_j": (0.8, battery_j)},)
    one = SimpleNamespace(first=1.0)
    robot: Any = SimpleNamespace(
        measured=Measurements(design="kenan-2.0", source="a test", release="dog", jumps=jumps), mass=one, rate=one,
        robot=SimpleNamespace(mass_kg=0.1, spring=SimpleNamespace(energy_j=0.5)), electrical_j=1.0, standing_m=0.05,
    )  # fmt: skip
    if refused:
        with pytest.raises(
            JumpcadError, match=r"jumps\.battery_j = 0\.49: the springs alone hold 0\.5 J: measure volt"
        ):
            _require_plausible(robot, "mine.toml")
    else:
        _require_plausible(robot, "mine.toml")


def test_weighed_parts_count_in_the_model(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEAD + "[mass.parts_g]\nmain_leg = 20.0\n")
    found = load_subject(path)
    (leg,) = (part for part in found.robot.parts if part.name == "main_leg")
    assert leg.mass.mass_kg == pytest.approx(0.020)
    assert found.mass.second < 0.2


def test_a_design_beside_the_measurements(tmp_path: Path, subject: Subject) -> None:
    (tmp_path / "own.toml").write_text(subject.robot.design.to_toml())
    (tmp_path / "shop.toml").write_text("[body]\nplate_mm = 2.05\n")
    (tmp_path / "mine.toml").write_text(HEAD.replace("kenan-2.0", "own.toml") + 'workshop = "shop.toml"\n')
    built = load_subject(tmp_path / "mine.toml").robot
    assert built.design == subject.robot.design
    assert built.workshop == varied(load_workshop(), {"body.plate_mm": 2.05})
    assert built.mass_kg < subject.robot.mass_kg


def test_names_of_robots_differ(subject: Subject) -> None:
    names = [one.name for one in renamed([subject, subject, replace(subject, name="other"), subject])]
    assert names == ["kenan-2.0", "kenan-2.0 2", "other", "kenan-2.0 3"]


@pytest.mark.parametrize(
    ("softer", "one", "other", "said"),
    [
        (0.0, None, None, None),
        (0.005, 9.2, 9.9, None),
        (0.0, 9.2, 10.3, None),  # 1.1 apart, and three times the root of 0.276² and 0.309² are 1.24
        (0.05, None, None, "have 8.74 N·mm/° together, those of kenan-2.0 9.2: give both designs"),
        (0.0, 9.2, 7.0, "have 7 N·mm/° together, those of kenan-2.0 9.2"),
    ],
)
def test_springs_that_two_robots_share_have_one_rate(
    subject: Subject, softer: float, one: float | None, other: float | None, said: str | None
) -> None:
    """By design within a hundredth, and on the scale within three of its deviations, of 3 % each."""

    def robot(pair: str | None, rate: float | None) -> Subject:
        spring = {} if pair is None else {"pair": pair}
        measured = {} if rate is None else {"rate_nmm_per_deg": rate, "springs": 2}
        return remeasured(subject, Measurements(design="kenan-2.0", source="a test", release="dog",
                                               spring=spring | measured))  # fmt: skip

    soft = replace(robot("ours", other), name="soft", robot=with_spring_factor(subject.robot, 1.0 - softer))
    robots = [robot("ours", one), soft]
    if said is None:
        require_pairs(robots)
    else:
        with pytest.raises(JumpcadError, match=f"soft: spring.pair = ours: its springs {said}"):
            require_pairs(robots)
    require_pairs([robots[0], replace(soft, measured=robot(None, other).measured)])


def test_measurements_are_named_once_under_one_name(tmp_path: Path) -> None:
    """Their jumps would count as others': by name, by a copy, by a link; two robots' are no copies."""
    text = (templates_folder() / "measurements" / "kenan-1.0.toml").read_text(encoding="utf-8")
    copy, link = tmp_path / "copy.toml", tmp_path / "link.toml"
    copy.write_text(text, encoding="utf-8")
    link.symlink_to(copy)
    require_each_once(["kenan-1.0", "kenan-2.0"])
    for names, words in (
        (
            ["kenan-1.0", "kenan-2.0", "kenan-1.0"],
            "kenan-1.0: is given twice: name the measurements of each robot once",
        ),
        (["kenan-1.0", copy], "copy.toml: is given too, under the name kenan-1.0"),
        ([copy, "kenan-2.0", link], "link.toml: is given too, under the name "),
    ):
        with pytest.raises(JumpcadError, match=words):
            require_each_once(names)


def test_equal_words_beside_other_videos_are_other_jumps(tmp_path: Path) -> None:
    """The points of a video are found beside the measurements: a copy elsewhere has its own, a link the same."""
    files = [tmp_path / folder / "mine.toml" for folder in ("one", "two")]
    for file in files:
        file.parent.mkdir()
        file.write_text(HEAD + '[[videos]]\npoints = "flight.csv"\npoint = "body"\n')
    require_each_once(files)
    link = tmp_path / "two" / "link.toml"
    link.symlink_to(files[0])
    with pytest.raises(JumpcadError, match=r"link.toml: is given too, under the name .*one"):
        require_each_once([*files, link])
    again = tmp_path / "one" / "again.toml"
    again.write_text(files[0].read_text())
    with pytest.raises(JumpcadError, match=r"again.toml: is given too, under the name .*one"):
        require_each_once([*files, again])


def test_slow_motion_divides_the_time_of_a_video(tmp_path: Path) -> None:
    """240 frames a second played at 30: v = 1 m/s both ways, seen as 1/8 of it."""
    flight = [(n / 30.0, n / 240.0, 0.1 + n / 240.0 - 4.905 * (n / 240.0) ** 2) for n in range(12)]
    (tmp_path / "slow.csv").write_text("t,x,z\n" + "".join(f"{t:.9f},{x:.9f},{z:.9f}\n" for t, x, z in flight))
    file = tmp_path / "mine.toml"
    jumped = HEAD + JUMP + "distance_mm = [200.0]\nheight_mm = [70.0]\n"
    file.write_text(jumped + '[[videos]]\npoints = "slow.csv"\npoint = "body"\nslow_motion = 8\n')
    (seen,) = load_subject(file).seen
    assert (seen.speed_m_s, seen.angle_deg) == pytest.approx((math.sqrt(2.0), 45.0), rel=1e-3)


@pytest.mark.thorough
def test_simulated_landings_take_the_place_of_a_free_travel() -> None:
    """Those of forty jumps with weaker and stronger springs; other landings of the robot agree with their mean."""
    pytest.importorskip("mujoco")
    kenan = load_subject("kenan-2.0")
    landed = kenan.landing()
    free, simulated = ({one.key: one.prior for one in CalibrationModel([one]).parameters} for one in (kenan, landed))
    key = f"travel:{kenan.name}"
    assert (free[key].shape, simulated[key].shape) == ("half-normal", "normal")
    assert {**free, key: None} == {**simulated, key: None}
    others = [1000.0 * (one.rest_m - one.touchdown_m) for one in land(kenan.robot, 8, seed=5).tries]
    assert sum(others) / len(others) == pytest.approx(landed.travel.first, abs=landed.travel.second)
