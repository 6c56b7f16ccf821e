"""DXF read back by ezdxf: outlines, holes, and a name that reads from the outside."""

import io
import os
import subprocess
import sys

import ezdxf
import numpy as np
import pytest

from jumpcad.exporters.dxf import MILLIMETRES, dxf_files, write_dxf
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import disc, hole, rectangle


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


@pytest.mark.thorough
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


def test_plates_are_drawn_with_their_axle_holes_and_their_names(kenan: Robot) -> None:
    files = dict(dxf_files(kenan))
    assert set(files) == {"dxf/body_plate_left.dxf", "dxf/body_plate_right.dxf"}
    assert kenan.layout is not None
    for drawn in files.values():
        document = read(drawn)
        centres = []
        for line in document.modelspace().query('LWPOLYLINE[layer=="CUT"]'):
            points = np.array([point[:2] for point in line.get_points()])
            centres.append((points.min(axis=0) + points.max(axis=0)) / 2.0)
        for first, second in (("leg", "front"), ("leg", "cam"), ("cam", "front")):
            apart = np.linalg.norm(kenan.layout.axles[first] - kenan.layout.axles[second])
            gaps = np.linalg.norm(np.array(centres)[:, None] - np.array(centres)[None], axis=2)
            assert np.abs(gaps - apart).min() < 0.01
        assert enclosed_mm2(document, "ENGRAVE") > 10.0
    assert files == dict(dxf_files(kenan))
