"""`jumpcad simulate`: documents, exit codes, one-line errors, trajectories."""

import csv
import json
import re
from pathlib import Path

import pytest
from support import needs
from support.commands import Run

from jumpcad.cli import simulate as module
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.paper import published
from jumpcad.simulation import Jump, Settings, load_settings, simulate
from jumpcad.simulation.jump import EnergyBudget, PublishedQuantities


@pytest.fixture
def command(run: Run) -> Run:
    """`jumpcad simulate` as a function."""
    return lambda *arguments: run("simulate", *arguments)


def test_one_document_with_what_python_says(command: Run) -> None:
    code, out, err = command("kenan-2.0", "--capsule", "--json")
    document = json.loads(out)
    jump = simulate(capsule_robot(load_design("kenan-2.0")))
    assert (code, err) == (0, "")
    assert (document["model"], document["verdict"], document["engine"]) == ("capsule", "jump", "pybullet")
    assert document["ballistic_range_m"] == jump.ballistic_range_m
    assert document["energy"]["joint_damping_j"] == jump.energy.joint_damping_j


def test_both_engines_and_their_difference(command: Run) -> None:
    needs.package("mujoco")
    code, out, _ = command("kenan-2.0", "--capsule", "--engine", "both", "--settings", "fine", "--json")
    document = json.loads(out)
    ranges = [document["engines"][engine]["ballistic_range_m"] for engine in ("pybullet", "mujoco")]
    assert code == 0
    assert document["range_difference_percent"] == pytest.approx(100 * (ranges[1] - ranges[0]) / ranges[0])
    assert abs(document["range_difference_percent"]) < 0.5
    code, out, _ = command("kenan-2.0", "--capsule", "--engine", "both")
    assert code == 0
    assert "% from that of pybullet" in out.splitlines()[-1]


def test_refused_design_says_why_and_what_to_change(command: Run, tmp_path: Path) -> None:
    path = tmp_path / "loop.toml"
    path.write_text(Design.from_vector([100, 1.1596, 0.6455, 0.6, 0.8, 70, 30, 10]).to_toml())
    code, out, err = command(path, "--capsule")
    assert (code, err) == (1, "")
    assert "pybullet: loop" in out
    assert "lower compression_ratio" in out
    code, out, _ = command(path, "--capsule", "--json")
    assert code == 1
    assert json.loads(out)["verdict"] == "loop"
    assert json.loads(out)["ballistic_range_m"] is None


@pytest.mark.parametrize("suffix", ["csv", "json"])
def test_trajectory_file(command: Run, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"path.{suffix}"
    code, _, _ = command("kenan-2.0", "--capsule", "--flight", "--trajectory", path)
    assert code == 0
    expected = simulate(capsule_robot(load_design("kenan-2.0")), Settings(flight="simulated", trajectory=True))
    assert expected.trajectory is not None
    if suffix == "csv":
        with path.open() as stream:
            columns = list(zip(*csv.reader(stream), strict=True))
        read = {name: [float(value) for value in values] for name, *values in columns}
    else:
        read = json.loads(path.read_text())
    assert read == {name: values.tolist() for name, values in expected.trajectory.columns().items()}


def test_that_a_rejected_robot_has_no_trajectory_is_told(command: Run, tmp_path: Path) -> None:
    """The loop of legs so unequal does not close, so nothing moves: no file, and no old one is taken for new."""
    design, path = tmp_path / "open.toml", tmp_path / "path.csv"
    parameters = load_design("kenan-2.0").model_dump() | {"c_coef": 1.3, "d_coef": 0.5}
    design.write_text(Design(**parameters).to_toml())
    code, out, err = command(design, "--capsule", "--trajectory", path)
    assert (code, path.exists()) == (1, False)
    assert "loop" in out
    assert err.startswith(f"jumpcad: {path}: not written; loop: ")
    assert err.count("\n") == 1


def test_a_trajectory_replaces_nothing_unasked(command: Run, tmp_path: Path) -> None:
    path = tmp_path / "path.csv"
    path.write_text("mine")
    code, out, err = command("kenan-2.0", "--capsule", "--trajectory", path)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "path.csv: exists already; choose another name, or replace it with --force" in err
    assert path.read_text() == "mine"
    assert command("kenan-2.0", "--capsule", "--trajectory", path, "--force")[0] == 0
    assert path.read_text().startswith("time_s,")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["kenan-2.0", "--capsule", "--engine", "bulet"], "'bulet' is not an engine"),
        (["kenan-2.0", "--capsule", "--published"], "exclude each other"),
        (["kenan-2.0", "--published", "--engine", "mujoco"], "exists in pybullet alone"),
        (["kenan-2.0", "--capsule", "--trajectory", "path.txt"], "must end in .csv or .json"),
        (["kenan-2.0", "--capsule", "--trajectory", "nowhere/path.csv"], "there is no folder nowhere"),
        (["kenan-2.0", "--capsule", "--trajectory", "a.csv", "--engine", "both"], "records one engine"),
        (["kenan-2.0", "--published", "--trajectory", "a.csv"], "cannot apply to --published"),
        (["kenan-2.0", "--published", "--settings", "fine"], "--settings fine: --published has the study's own"),
        (["kenan-2.0", "--published", "--settings", "nowhere.toml"], "--published has the study's own"),
        (["kenan-2.0", "--seed", "3"], "--seed 3: is that of --uncertain alone"),
        (["kenan-2.0", "--capsule", "--workshop", "fine"], "--workshop fine: cannot apply"),
        (["kenan-2.0", "--capsule", "--settings", "quick"], "'quick' is neither a TOML file nor"),
        (["kenan-3.0", "--capsule"], "did you mean kenan-2.0"),
        (["kenan-2.0", "--engine", "both", "--uncertain"], "--uncertain takes one engine: choose --engine pybullet"),
    ],
)
def test_wrong_requests(command: Run, arguments: list[str], message: str) -> None:
    code, out, err = command(*arguments)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1


def test_published_is_named_so(command: Run) -> None:
    code, out, _ = command("kenan-1.0", "--published")
    assert code == 0
    assert "0.257138" in out
    assert "published distance" in out


def test_the_other_engine_steps_in_with_one_line(command: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    needs.package("mujoco")
    monkeypatch.setitem(__import__("sys").modules, "pybullet", None)
    code, out, err = command("kenan-2.0", "--capsule", "--json")
    assert code == 0
    assert json.loads(out)["engine"] == "mujoco"
    assert err == "jumpcad: pybullet is not installed; simulated with mujoco\n"


@pytest.mark.parametrize("name", ["fine", "default"])
def test_what_is_uncertain_is_the_jump_and_not_its_flight(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Hundreds of jumps by the settings that are named, without a simulated flight or a trajectory."""
    monkeypatch.setattr("jumpcad.cli.uncertain.uncertain", lambda *given: given)
    found: object = module._uncertain("robot", name, "planar", 7)  # type: ignore[arg-type]
    assert found == ("robot", load_settings(name), "planar", 7)
    assert (load_settings(name).flight, load_settings(name).trajectory) == ("ballistic", False)


def test_the_uncertain_robot_is_built_in_the_workshop_that_is_named(
    command: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As the one that jumps, and with the same settings."""
    built, uncertain = [], []

    def asked(_: object, *given: object) -> None:
        uncertain.append(given)
        raise JumpcadError("enough")

    monkeypatch.setattr(module, "printed_robot", lambda *given: built.append(given))
    monkeypatch.setattr(module, "_jumps", lambda *_: [])
    monkeypatch.setattr(module, "_uncertain", asked)
    words = ("--workshop", "light", "--settings", "fine", "--engine", "planar", "--uncertain")
    assert command("kenan-2.0", *words)[::2] == (2, "jumpcad: enough\n")
    assert built == [("kenan-2.0", "light")] * 2
    assert uncertain == [("fine", "planar", 0)]


def test_what_is_uncertain_of_a_bundle_is_not_known_of_its_urdf(
    command: Run, bundle: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Tolerances are those of its workshop, of which the URDF says nothing."""

    def begun(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr(module, "_jumps", begun)
    monkeypatch.setattr(module, "printed_robot", lambda *_: None)
    urdf = bundle / "urdf" / "kenan-2.0.urdf"
    assert command(bundle, "--uncertain")[2] == "jumpcad: begun\n"
    assert command(bundle / "design.toml", "--uncertain")[2] == "jumpcad: begun\n"
    refused = f"jumpcad: {urdf}: --uncertain is for printed robots: give the design, or its bundle\n"
    assert command(urdf, "--uncertain") == (2, "", refused)


def test_a_jump_says_of_which_model_it_is(command: Run, bundle: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Masses of a URDF are as it says, those of a design as it is printed; capsules are the study's."""
    headings = []

    def told(heading: dict[str, str], *_: object) -> None:
        headings.append(heading["model"])

    monkeypatch.setattr(module, "_jumps", lambda *_: [])
    monkeypatch.setattr(module, "printed_robot", lambda *_: None)
    monkeypatch.setattr(module, "_report", told)
    urdf = bundle / "urdf" / "kenan-2.0.urdf"
    for arguments in ((urdf,), (urdf, "--capsule"), ("kenan-2.0",), ("kenan-2.0", "--capsule")):
        command(*arguments)
    assert headings == ["URDF", "capsule", "printed", "capsule"]


def test_uncertain_jumps_and_trajectories_are_of_one_engine(command: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """By default, or named: what is asked for is begun."""

    def asked(*given: object) -> None:
        raise JumpcadError(f"asked with seed {given[-1]} in {given[-2]}")

    monkeypatch.setattr(module, "_jumps", lambda *_: [])
    monkeypatch.setattr(module, "_uncertain", asked)
    for engine in ("mujoco", "planar"):
        code, _, err = command("kenan-2.0", "--engine", engine, "--uncertain", "--seed", 7)
        assert (code, err) == (2, f"jumpcad: asked with seed 7 in {engine}\n")


def test_a_report_begins_with_what_was_simulated(command: Run) -> None:
    """Robot, model and settings as they were asked for, then the engine with its verdict."""
    code, out, _ = command("kenan-2.0", "--capsule", "--engine", "planar", "--settings", "screening")
    assert code == 0
    assert out.splitlines()[:2] == ["kenan-2.0, capsule robot, settings screening", "planar: jump"]


def test_published_quantities_are_printed_each_by_its_name(command: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    found = published.PublishedJump(distance_m=0.25, base_height_m=0.125, energy_j=0.0625)
    monkeypatch.setattr(published, "simulate", lambda design: found)
    code, out, _ = command("kenan-2.0", "--published")
    assert code == 0
    told = [re.match(r"(\w+ ?\w*?) +([\d.]+)", line) for line in out.splitlines()]
    assert [(one[1].strip(), float(one[2])) for one in told if one] == [
        ("published distance", 0.25), ("published height", 0.125), ("energy", 0.0625),
    ]  # fmt: skip


@pytest.mark.parametrize(("second", "code"), [("jump", 0), ("no_takeoff", 1)])
def test_of_two_engines_both_must_jump_and_the_second_is_compared_with_the_first(
    run: Run, monkeypatch: pytest.MonkeyPatch, second: str, code: int
) -> None:
    """1.1 m are 10 % more than 1.0 m; 1.0 would be 9.1 % less than 1.1."""
    reach = {"pybullet": 1.0, "mujoco": 1.1 if second == "jump" else None}

    def jumps(robot: object, settings: object, engines: list[str]) -> list[Jump]:
        verdicts = zip(engines, ("jump", second), strict=True)
        return [Jump(verdict, name, 0.1, 0.2, ballistic_range_m=reach[name]) for name, verdict in verdicts]

    monkeypatch.setattr(module, "_jumps", jumps)
    told = run("simulate", "kenan-2.0", "--capsule", "--engine", "both")
    assert told[0] == code
    assert ("range of mujoco: +10.000 % from that of pybullet" in told[1]) == (second == "jump")
    found = json.loads(run("simulate", "kenan-2.0", "--capsule", "--engine", "both", "--json")[1])
    assert found["range_difference_percent"] == (pytest.approx(10.0) if second == "jump" else None)
    assert list(found["engines"]) == ["pybullet", "mujoco"]


@pytest.mark.parametrize("trajectory", [False, True])
@pytest.mark.parametrize("flight", [False, True])
def test_a_flight_is_simulated_only_where_it_is_asked_for(flight: bool, trajectory: bool) -> None:
    """A trajectory alone ends at take-off; all else is as the settings say."""
    plain = load_settings("fine")
    found = module._settings("fine", flight, trajectory)
    assert found.flight == ("simulated" if flight else plain.flight) == ("simulated" if flight else "ballistic")
    assert found.trajectory == trajectory
    assert found.dt_s == plain.dt_s


JUMP = Jump(
    "jump", "planar", 0.125, 0.5, 7.125, 0.75, 0.25, 0.9375, 0.8125, 2.875, 61.25, 0.0625, 0.6875,
    -12.4, 347.6, 512.0, 0.8125, 1.5, EnergyBudget(0.11, 0.12, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09),
    PublishedQuantities(None, 0.375),
)  # fmt: skip
"""A made-up jump with a number of its own in every place."""


def test_every_figure_of_a_jump_is_told_with_its_name_and_unit(capsys: pytest.CaptureFixture[str]) -> None:
    heading = {"design": "d", "model": "printed", "settings": "fine"}
    module._report(heading, [JUMP], False, None)
    assert [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()] == [
        "d, printed robot, settings fine", "planar: jump",
        "ballistic range 0.7500 m", "rise of the centre of mass 0.2500 m", "touchdown distance 0.6875 m",
        "take-off speed 2.875 m/s", "take-off angle 61.2°", "take-off after 0.0625 s",
        "air time 0.812 s", "turn in flight, forwards 348°", "pitch at touchdown -12°",
        "centre of mass beside the leg, left 1.5 mm",
        "energy released / spring energy 0.9375", "energy at take-off / spring energy 0.8125",
        "spring energy 0.5000 J", "mass 0.1250 kg", "fitness (range / longest link) 7.125",
        "where the spring energy is at take-off (J):",
        "of the centre of mass: the jump 0.2700", "turning and swinging about the centre of mass 0.0300",
        "still in the springs 0.0500", "lost between cam and roller 0.0600", "lost in the joints' friction 0.0700",
        "lost by slipping on the ground 0.0800", "lost in impacts and rounding 0.0900",
        "published base distance none", "published base height 0.3750 m",
    ]  # fmt: skip


def test_a_jump_that_is_none_is_told_with_what_to_change_and_no_figures(capsys: pytest.CaptureFixture[str]) -> None:
    wrong = Finding("tips", "error", -1.0, "mm", "it falls over", "turn the toes")
    fine = Finding("loop", "info", 1.0, "mm", "it closes", "")
    module._report({"design": "d", "model": "URDF", "settings": "s"}, [
        Jump("tips", "mujoco", 0.125, 0.5, findings=(fine, wrong))
    ], False, None)  # fmt: skip
    assert [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()] == [
        "d, URDF robot, settings s", "mujoco: tips", "it falls over; turn the toes", "spring energy 0.5000 J",
        "mass 0.1250 kg", "fitness (range / longest link) 0.000",
    ]  # fmt: skip


def test_one_document_has_the_jump_its_heading_and_its_uncertainty(capsys: pytest.CaptureFixture[str]) -> None:
    heading = {"design": "d", "model": "printed", "settings": "fine"}
    module._report(heading, [JUMP], True, {"jumps": 8})
    found = json.loads(capsys.readouterr().out)
    assert found == json.loads(json.dumps(heading | JUMP.to_dict() | {"uncertain": {"jumps": 8}}))
    assert (found["ballistic_range_m"], found["energy"]["slip_j"], found["published"]["base_height_m"]) == (
        0.75, 0.08, 0.375
    )  # fmt: skip
    module._report(heading, [JUMP], True, None)
    assert "uncertain" not in json.loads(capsys.readouterr().out)


def ranges(*values: float | None) -> list[Jump]:
    return [Jump("jump", "x", 0.1, 0.2, ballistic_range_m=value) for value in values]


@pytest.mark.parametrize(
    ("values", "percent"),
    [((0.5, 0.6), 20.0), ((0.6, 0.5), -100.0 / 6.0), ((0.5,), None), ((None, 0.5), None), ((0.5, None), None)],
)
def test_two_ranges_differ_by_a_share_of_the_first(values: tuple[float | None, ...], percent: float | None) -> None:
    found = module._difference_percent(ranges(*values))
    assert found == (None if percent is None else pytest.approx(percent))


def test_engines_are_those_asked_for_or_the_first_that_is_there(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert module._engines("both") == ["pybullet", "mujoco"]
    assert module._engines("planar") == ["planar"]
    monkeypatch.setattr(module, "default_engine", lambda: "pybullet")
    assert module._engines(None) == ["pybullet"]
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(module, "default_engine", lambda: "mujoco")
    assert module._engines(None) == ["mujoco"]
    assert capsys.readouterr().err == "jumpcad: pybullet is not installed; simulated with mujoco\n"


@pytest.mark.usefixtures("inputs")
def test_a_trajectory_is_not_written_over_what_is_simulated(command: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Told before the jump; a bare name beside a bundle of that name is noted."""

    def built(*_: object) -> None:
        raise JumpcadError("begun")

    monkeypatch.setattr(module, "printed_robot", built)
    for words, itself in (
        (("own.toml", "--trajectory", "own.toml"), "the design"),
        (("kenan-1.0", "--workshop", "shop.toml", "--trajectory", "shop.toml"), "--workshop"),
        (("kenan-1.0", "--settings", "own.toml", "--trajectory", "own.toml"), "--settings"),
    ):
        assert f"is {itself} itself; choose another name" in command(*words)[2]
    note = "jumpcad: kenan-2.0 is the template; write ./kenan-2.0 for the bundle of this name\n"
    assert command("kenan-2.0")[2] == f"{note}jumpcad: begun\n"
