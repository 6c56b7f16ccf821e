"""DXF read back by ezdxf: outlines, holes, and a name that reads from the outside."""

import io
import os
import subprocess
import sys

import ezdxf
import numpy as np
import pytest
from support.built import built

from jumpcad.exporters.dxf import MILLIMETRES, sheet, write_dxf, write_dxfs
from jumpcad.parts.engraving import TEXT_HEIGHTS_MM
from jumpcad.robot import Robot
from jumpcad.solids.outline import disc, hole, rectangle
from jumpcad.solids.text import text


def read(text: str) -> ezdxf.document.Drawing:
    document = ezdxf.read(io.StringIO(text))
    assert document.audit().errors == []
    return document


def enclosed_mm2(document: ezdxf.document.Drawing, layer: str) -> float:
    """Return the area of a layer's outlines less that of its holes, by the shoelace formula."""
    total = 0.0
    for line in document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]'):
        assert line.closed
        x, y = np.array([point[:2] for point in line.get_points()]).T
        total += 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return total


def test_a_plate_with_a_hole_is_cut_and_engraved_in_millimetres() -> None:
    plate = rectangle((40.0, 20.0)) - hole(10.0)
    document = read(write_dxf(plate, disc(2.0, (15.0, 0.0))))
    assert document.units == MILLIMETRES
    colours = {name: document.layers.get(name).dxf.color for name in ("CUT", "ENGRAVE")}
    assert colours == {"CUT": 1, "ENGRAVE": 5}  # AutoCAD's index: red and blue, by which laser programs tell them
    assert enclosed_mm2(document, "CUT") == pytest.approx(800.0 - np.pi * 25.0, rel=0.001)
    assert enclosed_mm2(document, "ENGRAVE") == pytest.approx(np.pi, rel=0.005)


def test_a_sheet_is_the_same_text_whatever_the_hashes_of_strings() -> None:
    """Sets of strings are listed in an order that differs from process to process."""
    program = (
        "from jumpcad.exporters.dxf import write_dxf; from jumpcad.solids.outline import disc;"
        "print(hash('a'), write_dxf(disc(9.0), disc(2.0)))"
    )
    seed = {**os.environ, "PYTHONHASHSEED": "1"}
    done = subprocess.run([sys.executable, "-c", program], env=seed, capture_output=True, text=True, check=True)
    hashed, _, text = done.stdout.partition(" ")
    assert int(hashed) != hash("a")
    assert text == f"{write_dxf(disc(9.0), disc(2.0))}\n"
    assert "LWPOLYLINE" in text


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


def test_plates_are_drawn_with_their_axle_holes_and_their_names(robot: Robot) -> None:
    files = write_dxfs(robot)
    assert set(files) == {"body_plate_left", "body_plate_right"}
    assert robot.layout is not None
    for drawn in files.values():
        document = read(drawn)
        centres = []
        for line in document.modelspace().query('LWPOLYLINE[layer=="CUT"]'):
            points = np.array([point[:2] for point in line.get_points()])
            centres.append((points.min(axis=0) + points.max(axis=0)) / 2.0)
        for first, second in (("leg", "front"), ("leg", "cam"), ("cam", "front")):
            apart = np.linalg.norm(robot.layout.axles[first] - robot.layout.axles[second])
            gaps = np.linalg.norm(np.array(centres)[:, None] - np.array(centres)[None], axis=2)
            assert np.abs(gaps - apart).min() < 0.01
        assert enclosed_mm2(document, "ENGRAVE") > 10.0
    assert files == write_dxfs(robot)


@pytest.mark.parametrize(("side", "label"), [("left", "L"), ("right", "R")])
def test_the_name_reads_from_the_outside(robot: Robot, side: str, label: str) -> None:
    """The engraving covers the letters of the label, not their mirror image."""
    assert robot.layout is not None
    low, high = getattr(robot.layout.lateral, f"{side}_plate")
    part = next(part for part in robot.parts if part.name == f"body_plate_{side}")
    _, engraved = sheet(part, high - low)
    x0, y0, x1, y1 = engraved.bounds()
    tall, short = (text(f"{robot.name} {label}", height) for height in TEXT_HEIGHTS_MM)
    letters = tall if tall.area() < 1.05 * engraved.area() else short
    shared = []
    for wanted in (letters, letters.mirror((1.0, 0.0))):
        a0, b0, a1, b1 = wanted.bounds()
        moved = wanted.translate(((x0 + x1 - a0 - a1) / 2.0, (y0 + y1 - b0 - b1) / 2.0))
        shared.append((moved ^ engraved).area() / engraved.area())
    assert shared[0] > 0.8 > shared[1]


@pytest.mark.parametrize("before", [False, True])
def test_other_sheets_of_ezdxf_keep_their_time_of_day(before: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a program sets for its own sheets stays as it is, also where one of these fails."""
    monkeypatch.setattr(ezdxf.options, "write_fixed_meta_data_for_testing", before)
    write_dxf(disc(9.0), disc(2.0))
    assert ezdxf.options.write_fixed_meta_data_for_testing is before
    with pytest.raises(AttributeError):
        write_dxf(None, None)  # type: ignore[arg-type]
    assert ezdxf.options.write_fixed_meta_data_for_testing is before
