"""`jumpcad simulate`: documents, exit codes, one-line errors, trajectories."""

import csv
import json
from pathlib import Path

import pytest
from support import needs
from support.built import built
from support.commands import Run
from support.places import ROOT

import jumpcad
from jumpcad.design import Design, load_design
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.engines import default_engine
from jumpcad.simulation.uncertain import uncertainty_of


@pytest.fixture
def command(run: Run) -> Run:
    """`jumpcad simulate` as a function."""
    return lambda *arguments: run("simulate", *arguments)


def test_one_document_with_what_python_says(command: Run) -> None:
    code, out, err = command("kenan-2.0", "--capsule", "--json")
    document = json.loads(out)
    jump = simulate(capsule_robot(load_design("kenan-2.0")))
    assert (code, err) == (0, "")
    assert (document["model"], document["verdict"], document["engine"]) == ("capsule", "jump", default_engine())
    assert document["ballistic_range_m"] == jump.ballistic_range_m
    assert document["energy"]["joint_damping_j"] == jump.energy.joint_damping_j


def test_command_and_page_tell_one_median_of_robots_as_made(command: Run) -> None:
    """Beside the headline, in the uncertainty, and on the page that `build` writes."""
    robot = built("kenan-2.0")
    said = json.loads(command("kenan-2.0", "--uncertain", "--json")[1])
    page = uncertainty_of(robot)
    assert page is not None
    assert said["as_made"] == said["uncertain"]["quantiles"] == page.quantiles
    low, middle, high = said["as_made"]["touchdown_distance_m"]
    assert low < middle < said["touchdown_distance_m"] < high
    assert f"as made {middle:.4f} m in the median" in command("kenan-2.0")[1].splitlines()[2]


def test_both_engines_and_their_difference(command: Run) -> None:
    needs.package("pybullet")
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
    assert f"{default_engine()}: loop" in out
    assert "lower compression_ratio" in out
    code, out, _ = command(path, "--capsule", "--json")
    assert code == 1
    assert json.loads(out)["verdict"] == "loop"
    assert json.loads(out)["ballistic_range_m"] is None


def test_landings_and_jumps_of_a_robot_that_stays_on_the_floor_say_its_verdict(command: Run, tmp_path: Path) -> None:
    needs.package("mujoco")
    path = tmp_path / "still.toml"
    path.write_text(load_design("kenan-2.0").model_copy(update={"compression_ratio": 0.05}).to_toml(), encoding="utf-8")
    said = command(path, "--engine", "mujoco")
    assert (said[0], said[2]) == (1, "")
    for option in (["--landing"], ["--jumps", "2"]):
        assert command(path, *option) == said, option


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
        (["kenan-2.0", "--landing", "--jumps", "2"], "--jumps 2 and --landing exclude each other"),
        (["kenan-2.0", "--jumps", "2", "--flight"], "--flight and --jumps 2 exclude each other"),
        (["kenan-2.0", "--seed", "3"], "--seed 3: is that of --uncertain, --landing, --jumps, --to"),
        (["kenan-2.0", "--to", "3;0"], "--to 3;0: must be x and y in metres, as 3,0, or a distance"),
        (
            ["kenan-2.0", "--to", "-3"],
            "--to -3: must be x and y in metres, as 3,0, or a distance above 0, as 3; at most",
        ),
        (["kenan-2.0", "--to", "nan,1"], "--to nan,1: must be x and y in metres"),
        (["kenan-2.0", "--to", "3,0", "--jumps", "2"], "--to 3,0 and --jumps 2 exclude each other"),
        (["kenan-2.0", "--to", "3,0", "--course", "c.toml"], "--to 3,0 and --course c.toml exclude each other"),
        (["kenan-2.0", "--heading-noise", "5"], "--heading-noise 5.0: is that of --to and --course"),
        (["kenan-2.0", "--to", "3,0"], 'kenan-2.0 has no steering: set [steering] wheel = "o-ring" in its workshop'),
        (["kenan-2.0", "--capsule", "--workshop", "fine"], "--workshop fine: cannot apply"),
        (["kenan-2.0", "--capsule", "--settings", "quick"], "'quick' is neither a TOML file nor"),
        (["kenan-3.0", "--capsule"], "did you mean kenan-2.0"),
        (["kenan-2.0", "--capsule", "--uncertain"], "--uncertain is for printed robots"),
        (["kenan-2.0", "--engine", "both", "--uncertain"], "--uncertain takes one engine: choose --engine pybullet"),
    ],
)
def test_wrong_requests(command: Run, arguments: list[str], message: str) -> None:
    code, out, err = command(*arguments)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1


def test_the_other_engine_steps_in(command: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    needs.package("mujoco")
    monkeypatch.setitem(__import__("sys").modules, "pybullet", None)
    code, out, err = command("kenan-2.0", "--capsule", "--json")
    assert (code, json.loads(out)["engine"], err) == (0, "mujoco", "")


def test_what_is_uncertain_of_a_bundle_is_not_known_of_its_urdf(command: Run, bundle: Path) -> None:
    """Tolerances are those of its workshop, of which the URDF says nothing."""
    urdf = bundle / "urdf" / "kenan-2.0.urdf"
    refused = f"jumpcad: {urdf}: --uncertain is for printed robots: give the design, or its bundle\n"
    assert command(urdf, "--uncertain") == (2, "", refused)


@pytest.mark.thorough
def test_a_bundle_lands_and_jumps_on_as_its_design_and_as_python_says_and_its_urdf_alone_is_refused(
    command: Run, bundle: Path
) -> None:
    needs.package("mujoco")
    robot = built("kenan-2.0")
    told = {"landing": jumpcad.land(robot, 1).to_dict()}, {"series": jumpcad.jumps(robot, 1).to_dict()}
    for options, python in zip((["--landing", "--tries", "1"], ["--jumps", "1"]), told, strict=True):
        (code, out, _), design = command(bundle, *options, "--json"), command("kenan-2.0", *options, "--json")[1]
        assert json.loads(json.dumps(python)).items() <= json.loads(design).items(), options
        assert (code, json.loads(out) | {"design": "kenan-2.0"}) == (0, json.loads(design)), options
        refused = command(bundle / "urdf" / "kenan-2.0.urdf", *options)
        assert (refused[0], "is for printed robots: give the design" in refused[2]) == (2, True)


def test_robots_with_bodies_of_their_own(command: Run) -> None:
    needs.package("mujoco")
    for name, model, engine in (("light_jumper", "own bodies", default_engine()), ("chain_jumper", "chain", "mujoco")):
        path = ROOT / "examples" / f"{name}.toml"
        code, out, err = command(path, "--json")
        document = json.loads(out)
        assert (code, err, document["verdict"], document["model"]) == (0, "", "jump", model)
        assert document["engine"] == engine
        for options in (["--uncertain"], ["--landing"], ["--workshop", "fine"]):
            assert command(path, *options)[::2][0] == 2, (name, options)
    assert command(path, "--engine", "planar")[0] == command(path, "--capsule")[0] == 2


def test_the_share_of_the_springs_energy_in_the_flight_stands_beside_that_of_other_robots(command: Run) -> None:
    jump = simulate(capsule_robot(load_design("kenan-2.0")))
    share = 0.5 * jump.mass_kg * jump.takeoff_speed_m_s**2 / jump.spring_energy_j
    assert jump.kinetic_ratio == pytest.approx(share)
    (line,) = [line for line in command("kenan-2.0", "--capsule")[1].splitlines() if "other robots" in line]
    assert f"{share:.2f}; other robots: CLOVER 0.63, EPFL 7 g jumper 0.81 (?), SNU flea catapult, 30 mm 0.82" in line
