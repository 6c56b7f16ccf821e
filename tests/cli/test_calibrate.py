"""`jumpcad calibrate` and `jumpcad simulate --uncertain`: documents, files, one-line errors."""

import json
from pathlib import Path

import pytest
from support.calibrations import with_coarse_calibration
from support.commands import Run

from jumpcad.simulation import uncertain


@pytest.fixture(autouse=True)
def _short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Coarse jumps and short chains: the numbers are not what is tested here."""
    with_coarse_calibration(monkeypatch)
    monkeypatch.setattr(uncertain.uncertain_jump, "__defaults__", (0, 32))


@pytest.mark.thorough
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
    low, middle, high = found["quantiles"]["touchdown_distance_m"]
    assert low < middle < high


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("calibrate", "kenan-3.0"), "neither a TOML file nor one of the measurements kenan-1.0, kenan-2.0"),
        (("calibrate", "kenan-2.0", "-o", "mine.csv"), "must end in .toml"),
    ],
)
def test_wrong_requests(run: Run, arguments: tuple[str, ...], message: str) -> None:
    code, out, err = run(*arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err
