"""A program that knows only the bundle rebuilds the springs: their arms meet their pins, their hands close."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from clients import spring_pins

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.design import load_design
from jumpcad.workshop import load_workshop

VARIANTS: dict[str, dict[str, dict[str, Any]]] = {
    "kenan-2.0": {},
    "best-printable": {},
    "kenan-2.0 preloaded": {"spring": {"preload_deg": 4.0}},
    "kenan-1.0 from stock": {"bought": {"spring": "9271K589"}},
}


@pytest.fixture(scope="module", params=VARIANTS)
def bundle(
    request: pytest.FixtureRequest, bundle_of: Callable[[str], Path], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """A bundle of a template, in the default workshop with other springs."""
    workshop, name = load_workshop(), request.param.split()[0]
    if not VARIANTS[request.param]:
        return Path(shutil.copytree(bundle_of(name), tmp_path_factory.mktemp("bundle") / "it"))
    for table, values in VARIANTS[request.param].items():
        workshop = workshop.model_copy(update={table: getattr(workshop, table).model_copy(update=values)})
    robot = build(load_design(name), workshop, name)
    return export(robot, tmp_path_factory.mktemp("bundle") / "it", pictures=False).folder


def test_relaxed_arms_meet_their_pins_and_winding_closes_the_coils(bundle: Path) -> None:
    found = spring_pins.fits(bundle)
    assert [fit.side for fit in found] == ["left", "right"]
    for fit in found:
        assert fit.wrong == []
        assert abs(fit.angle_error_deg) < 0.01


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"turns": 0.01}, "the relaxed arms miss their pins"),
        ({"hand": "other"}, "winding opens the coil"),
        ({"hand": "other"}, "-hand coil is drawn for a "),
        ({"wire_mm": 0.3}, "the relaxed arms miss their pins"),
        ({"arm_length_mm": -3.0}, "the arms end before their pins"),
    ],
)
def test_the_program_sees_springs_that_do_not_fit(bundle: Path, changed: dict[str, Any], words: str) -> None:
    path = bundle / "manifest.json"
    kept = path.read_text()
    manifest = json.loads(kept)
    for spring in manifest["drive"]["springs"]:
        for key, more in changed.items():
            other = "left" if spring["hand"] == "right" else "right"
            spring[key] = other if key == "hand" else spring[key] + more
    path.write_text(json.dumps(manifest))
    try:
        assert all(any(words in reason for reason in fit.wrong) for fit in spring_pins.fits(bundle))
    finally:
        path.write_text(kept)


def test_the_program_sees_pins_without_holes(bundle: Path) -> None:
    manifest = json.loads((bundle / "manifest.json").read_text())
    urdf = spring_pins.ET.parse(bundle / "urdf" / f"{manifest['name']}.urdf").getroot()
    hub, pitch = spring_pins._leg_joint(urdf)
    (spring, _) = manifest["drive"]["springs"]
    assert spring_pins._holes(bundle, urdf, spring, hub, pitch) == []
    beside = spring | {key: [value + 1.0 for value in spring[key]] for key in ("plate_pin_mm", "leg_pin_mm")}
    assert len(spring_pins._holes(bundle, urdf, beside, hub, pitch)) == 2
