"""`jumpcad calibrate` and `jumpcad simulate --uncertain`: documents, files, one-line errors."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import NoReturn

import numpy as np
import pytest
from support.calibrations import with_coarse_calibration
from support.commands import Run

from jumpcad.calibration import plots
from jumpcad.cli.calibrate import _document, _lines, _pictures
from jumpcad.errors import JumpcadError
from jumpcad.files.templates import templates_folder
from jumpcad.simulation import uncertain


@pytest.fixture(autouse=True)
def _short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Coarse jumps and short chains: the numbers are not what is tested here."""
    with_coarse_calibration(monkeypatch)
    monkeypatch.setattr(uncertain.uncertain_jump, "__defaults__", (0, 32))


def test_calibrated_settings_are_what_uncertain_takes(run: Run, tmp_path: Path) -> None:
    code, out, err = run(
        "calibrate", "kenan-2.0", "--predict", "kenan-1.0", "-o", "mine.toml", "--plots", "pictures", "--json"
    )
    document = json.loads(out)
    assert (code, err) == (0, "")
    assert document["robots"] == ["kenan-2.0"]
    keys = [row["key"] for row in document["parameters"]]
    assert keys[:4] == ["spring_efficiency", "pin_friction", "back_efficiency", "drive_efficiency"]
    assert "mass:kenan-2.0" in keys
    assert {row["what"] for row in document["residuals"]} == {"distance", "height", "battery"}
    assert {row["as"] for row in document["predictions"]["kenan-1.0"]["beside"]} >= {"resting-place", "absolute"}
    assert document["sampler"]["converged"] is False
    error = document["model_error"]["kenan-2.0"]
    assert 0.0 <= error["median"] < error["largest"]
    assert sorted(path.name for path in (tmp_path / "pictures").iterdir()) == [
        "measurements.png",
        "measurements.svg",
        "parameters.png",
        "parameters.svg",
    ]
    code, out, err = run(
        "simulate", "kenan-2.0", "--engine", "planar", "--uncertain", "--settings", "mine.toml", "--json"
    )
    found = json.loads(out)["uncertain"]
    assert (code, err) == (0, "")
    assert found["calibrated"] is True
    assert set(found["first_order"]) == {"calibration", "lengths", "springs", "mass", "floor"}
    low, middle, high = found["quantiles"]["ballistic_range_m"]
    assert low < middle < high


def test_people_read_what_the_data_leave_open(run: Run) -> None:
    code, out, _ = run("calibrate", "kenan-2.0")
    assert code == 0
    assert "stays at its prior" in out
    assert "likeliest as" in out
    # what the study measured
    assert "kenan-2.0: distance 350 mm, calibrated model" in out
    assert "kenan-2.0: height 120 mm, calibrated model" in out
    assert "the chains have not converged" in out
    code, out, _ = run("simulate", "kenan-2.0", "--engine", "planar", "--uncertain")
    assert code == 0
    assert "the priors of a calibration: none was given" in out
    assert "first-order indices" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("calibrate", "kenan-3.0"), "neither a TOML file nor one of the measurements kenan-1.0, kenan-2.0"),
        (("calibrate", "kenan-2.0", "-o", "mine.csv"), "must end in .toml"),
        (("simulate", "kenan-2.0", "--capsule", "--uncertain"), "--uncertain is for printed robots"),
        (("simulate", "kenan-2.0", "--engine", "both", "--uncertain"), "--uncertain takes one engine"),
    ],
)
def test_wrong_requests(run: Run, arguments: tuple[str, ...], message: str) -> None:
    code, out, err = run(*arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err


@pytest.mark.parametrize("name", ["parameters.svg", "measurements.svg", "parameters.png", "measurements.png"])
def test_pictures_of_one_s_own_are_not_replaced_unasked(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def sampling(files: object, seed: int) -> NoReturn:
        raise JumpcadError("begun")

    monkeypatch.setattr("jumpcad.calibration.calibrate", sampling)
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / name).write_text("mine")
    command = ("calibrate", "kenan-2.0", "--plots", "pictures")
    assert f"pictures/{name}: exists already" in run(*command)[2]
    assert run(*command, "--force")[2] == "jumpcad: begun\n"


@dataclass(frozen=True)
class Measured:
    """A robot of a name, which names its springs too."""

    name: str

    @property
    def pair(self) -> str:
        return self.name


def test_a_predicted_robot_has_a_name_and_springs_of_its_own(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of `a/measured.toml` and `b/measured.toml` too; posterior and predictions are drawn by one seed."""
    asked = []

    def predicting(*given: object) -> NoReturn:
        asked.append(given)
        raise JumpcadError("enough")

    given = SimpleNamespace(model=SimpleNamespace(subjects=[Measured("measured")]))

    def calibrated(files: list[str], seed: int = 0) -> SimpleNamespace:
        given.of = files, seed
        return given

    monkeypatch.setattr("jumpcad.calibration.calibrate", calibrated)
    monkeypatch.setattr("jumpcad.calibration.load_subject", lambda _: Measured("measured"))
    monkeypatch.setattr("jumpcad.calibration.predicted_jump", predicting)
    assert run("calibrate", "kenan-2.0", "--predict", "kenan-1.0", "--seed", 7)[2] == "jumpcad: enough\n"
    assert asked == [(given, Measured("measured 2"), 7)]
    assert given.of == (["kenan-2.0"], 7)


def test_an_output_over_the_measurements(run: Run, tmp_path: Path) -> None:
    text = (templates_folder() / "measurements" / "kenan-2.0.toml").read_text()
    (tmp_path / "mine.toml").write_text(text)
    code, _, err = run("calibrate", "mine.toml", "-o", "mine.toml")
    assert code == 2
    assert "is measurements mine.toml itself" in err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("kenan-1.0", "kenan-1.0"), "kenan-1.0: is given twice"),
        (("kenan-1.0", "--predict", "kenan-1.0"), "kenan-1.0: is given twice"),
        (("kenan-2.0", "--predict", "kenan-1.0", "--predict", "kenan-1.0"), "kenan-1.0: is given twice"),
        (("kenan-1.0", "copy.toml"), "copy.toml: is given too, under the name kenan-1.0"),
        (("linked.toml", "--predict", "copy.toml"), "copy.toml: is given too, under the name linked.toml"),
    ],
)
def test_jumps_count_once(run: Run, tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    shutil.copy(templates_folder() / "measurements" / "kenan-1.0.toml", tmp_path / "copy.toml")
    (tmp_path / "linked.toml").symlink_to("copy.toml")
    expected = f"jumpcad: {message}: name the measurements of each robot once\n"
    assert run("calibrate", *arguments) == (2, "", expected)


def test_a_calibration_is_told_in_millimetres_joules_and_per_cent() -> None:
    """Documents hold metres and shares; distances and heights are read in mm, energies in J, speeds in m/s."""
    row = {"what": "distance", "as": "resting-place", "measured": 0.25, "predicted": [0.2, 0.24, 0.3]}
    battery = {"what": "battery", "as": "battery", "measured": 1.5, "predicted": [1.2, 1.4, 1.7]}
    residual = {"robot": "k", "of": "distance", "readings": {"resting-place": 0.75}, "off_by_deviations": -1.25}
    document = {
        "parameters": [
            {"label": "pins", "prior": [0.1, 0.2, 0.3], "posterior": [0.11, 0.22, 0.33], "verdict": "stays"}
        ],
        "energy_per_mass": {"k": [0.8, 0.9, 1.0]}, "together": [["a", "b", -0.813]],
        "residuals": [
            residual | row, residual | battery | {"of": "battery"},
            *(residual | battery | {"what": what, "of": "battery"} for what in ("height", "speed", "angle")),
        ],
        "predictions": {"j": {
            "ballistic_range_m": [0.1, 0.12, 0.14], "com_rise_m": [0.05, 0.06, 0.07],
            "beside": [row | {"below_share": 0.6296}],
        }},
        "model_error": {"k": {"largest": 0.012}, "l": {"largest": 0.034}},
        "sampler": {"effective": 812.4, "converged": True}, "settings": "mine.toml",
        "elsewhere": ["k, in its workshop: [ground] friction = 0.79"],
    }  # fmt: skip
    lines = _lines(document)
    assert [" ".join(line.split()) for line in lines[1:]] == [
        "pins 0.1…0.2…0.3 0.11…0.22…0.33 stays",
        "k: spring energy over mass / model 0.8…0.9…1",
        "correlated, not determined alone: a and b (-0.81)",
        "k: distance 250 mm, calibrated model 200…240…300, likeliest as resting-place (75 %), "
        "off by -1.2 standard deviations",
        "k: battery 1.5 J, calibrated model 1.2…1.4…1.7, off by -1.2 standard deviations",
        "k: height 1.5e+03 mm, calibrated model 1.2e+03…1.4e+03…1.7e+03, off by -1.2 standard deviations",
        "k: speed 1.5 m/s, calibrated model 1.2…1.4…1.7, off by -1.2 standard deviations",
        "k: angle 1.5 °, calibrated model 1.2…1.4…1.7, off by -1.2 standard deviations",
        "j, predicted: range 100…120…140 mm, rise 50…60…70 mm",
        "distance as resting-place: 200…240…300 mm predicted with its errors, measured 250, "
        "above 62 % of the predictions",
        "812 independent draws; ranges of interpolated jumps are within 3.4 % of the engine's",
        "not in the settings file: k, in its workshop: [ground] friction = 0.79",
        "mine.toml: jumpcad simulate DESIGN --uncertain --settings mine.toml",
    ]


def test_a_document_has_every_figure_of_the_posterior_under_its_name() -> None:
    """The model's error is that of each robot's surface: its median, and its largest."""
    subjects = [
        SimpleNamespace(name=name, surface=SimpleNamespace(error=error, errors=np.array([error, 5.0 * error])))
        for name, error in (("k", 0.01), ("l", 0.02))
    ]
    posterior = SimpleNamespace(
        model=SimpleNamespace(subjects=subjects), summaries=lambda: ["s"], energies=lambda: {"k": [1.0]},
        correlated=lambda: [("a", "b", 0.75)], residuals=lambda: ["r"], walkers=12, steps=345, autocorrelation=6.5,
        effective=637.0, converged=False,
    )  # fmt: skip
    assert _document(posterior, 7) == {  # type: ignore[arg-type]
        "robots": ["k", "l"], "parameters": ["s"], "energy_per_mass": {"k": [1.0]}, "together": [["a", "b", 0.75]],
        "residuals": ["r"],
        "model_error": {
            "k": {"median": 0.01, "largest": pytest.approx(0.05)}, "l": {"median": 0.02, "largest": pytest.approx(0.1)}
        },
        "sampler": {
            "seed": 7, "walkers": 12, "steps": 345, "autocorrelation": 6.5, "effective": 637.0, "converged": False
        },
    }  # fmt: skip


def test_each_picture_is_drawn_under_its_own_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plots, "parameters", lambda posterior: ("parameters", posterior))
    monkeypatch.setattr(plots, "measurements", lambda posterior: ("measurements", posterior))
    monkeypatch.setattr(
        "jumpcad.search.report.figures.save_figure", lambda figure, folder, name: (folder / name, figure)
    )
    assert _pictures("p", Path("pics")) == [  # type: ignore[arg-type]
        str((Path("pics") / name, (name, "p"))) for name in ("parameters", "measurements")
    ]
