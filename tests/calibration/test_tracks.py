"""One flight, as video tools export it, is read as the same points; what may mean two things is refused."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from jumpcad.calibration.tracks import read_points
from jumpcad.errors import JumpcadError

POINTS = [(0.125 * n, 0.25 + 0.5 * n, 1.0 + n - 0.125 * n * n) for n in range(8)]
"""t (s), x and z (m): exact in binary and with three decimals."""


def rows(pattern: str, t: float = 1.0, length: float = 1.0, comma: bool = False) -> str:
    """Return the points as lines, in other units, as a pattern has them."""
    number: Callable[[float], str] = lambda value: f"{value:.6f}".replace(".", "," if comma else ".")  # noqa: E731
    return "\n".join(pattern.format(number(a * t), number(b * length), number(c * length)) for a, b, c in POINTS) + "\n"


FILES = {
    "plain": "t,x,z\n" + rows("{},{},{}"),
    "columns in any order": "x, z, t\n" + rows("{1}, {2}, {0}"),
    "Tracker": "mass_A,,\nt,x,y\n" + rows("{},{},{}"),
    "Tracker, German": "Masse_A;;\nt;x;y\n" + rows("{};{};{}", comma=True),
    "Tracker, with speeds": ",mass_A,,,\nt,x,y,v_{x},v_{y}\n0,,,,\n" + rows("{},{},{},,"),
    "Kinovea, text": "#Kinovea Trajectory data export\n#T X Y\n\n# Ball\n" + rows("{} {} {}", comma=True),
    "Kinovea, table": '"Time (ms)";"Ball X (cm)";"Ball Y (cm)"\n' + rows("{};{};{}", 1e3, 1e2, comma=True),
    "Logger Pro": '"Latest: Time (s)","Video: X (m)","Video: X Velocity (m/s)","Video: Y (m)"\n' + rows("{},{},7,{}"),
    "Vernier text": "Vernier Format 2\nrun.cmbl\nVideo\nTime\tX\tY\nt\tX\tY\ns\tm\tm\n\n" + rows("{}\t{}\t{}"),
    "names in words": "Zeit (s);x-Position (cm);Höhe (mm)\n" + rows("{};{}e2;{}e3"),
    "units in words": "Time (seconds),X Position (centimeters),Y Position (metres)\n" + rows("{},{}e2,{}"),
    "slashes": "t/s\tx/mm\ty/mm\n" + rows("{}\t{}\t{}", 1.0, 1e3, comma=True),
    "brackets, trailing delimiters": "Zeit [ms];x [cm];y [cm];\n" + rows("{};{};{};", 1e3, 1e2),
    "units in names": "t_ms,x_mm,y in cm\n" + rows("{},{},{}e-1", 1e3, 1e3),
    "a row of units": "t;x;y\n[s];[cm];[cm]\n" + rows("{};{};{}", 1.0, 1e2),
    "spreadsheet": "sep=;\n\nt;x;y\n" + rows('"{}";"{}";"{}"\n', comma=True),
    "quoted decimal commas": "t,x,y\n" + rows('"{}","{}","{}"', comma=True),
    "aligned": "Time (s)   X (m)   Y (m)\n" + rows("  {}   {}   {}"),
    "a run's name behind": "Time (s) Run #1,x (m) Run #1,y (m) Run #1\n" + rows("{},{},{}"),
    "which of a track": "t;x_{A};y_{A}\n" + rows("{};{};{}", comma=True),
    "whole words": "Zeit [s];x-Koordinate [cm];y-Koordinate [cm]\n" + rows("{};{};{}", 1.0, 1e2),
    "across and up": "time,horizontal position (cm),vertical position (cm)\n" + rows("{},{},{}", 1.0, 1e2),
    "short": "t,x_pos,y_pos\n" + rows("{},{},{}"),
    "unmarked frames": "t,x,y\n-1,-,NaN\n-0.5,nan,n/a\n" + rows("{},{},{}") + "9,,\n",
    "comments": "% camera: 240/s\nt,x,z\n# first\n" + rows("{},{},{}") + "// end\n",
}


def test_exports_of_video_tools_are_the_same_flight(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    for name, text in FILES.items():
        for encoding in ("utf-8", "utf-8-sig", "utf-16", "cp1252"):
            path.write_bytes(text.replace("\n", "\r\n").encode(encoding))
            assert np.allclose(read_points(path), POINTS, rtol=1e-6, atol=0.0), (name, encoding)
    path.write_bytes(("Fläche;;\n" + FILES["Tracker, German"]).encode("cp1252"))
    assert np.array_equal(read_points(path), POINTS)


def test_what_cannot_be_points_of_one_flight_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    for text, message in {
        "": "no line names the columns t, x and z (or y): begin with t,x,z",
        "0,0,0\n1,1,1\n": "no line names the columns",
        "t,x,z\n0,0,0\n": "1 point: too few, mark at least 6",
        "t,x,z\n0,0,a\n": "points.csv:2: '0,0,a' must be three numbers",
        "t,x,z\n0,0,\n": "points.csv:2: '0,0,' must be three numbers",
        "t,x,z\n0,0,inf\n": "must be finite",
        "t,x,z\n1e300,0,0\n": "must be finite numbers within ±1e+15",
        "t,x,z\n0,0,nan\n": "points.csv:2: '0,0,' must be three numbers",
        "t,x,z\n" + "0,0,0\n" * 8: "t must grow",
        "t,x,y\n0,00,0,02,0,09\n": "points.csv:2: '0,00,0,02,0,09' has more values than columns: decimal commas need",
        "t;x;y\n0,1;0.5;2\n1;2;3\n": "has decimal points and decimal commas",
        "A,,,B,,\nt,x,y,t,x,y\n": "has 2 columns t: export one track alone",
        "t,A x,A y,B x,B y\n": "has 2 columns x: export one track alone",
        "t (s),x (px),y (px)\n": "x is in 'px', which is no unit that is known: set the scale",
        "t (frames),x,y\n": "t is in 'frames', which is no unit that is known: export seconds",
        "#T X Y\n0:00:00:03 1 2\n": "must be three numbers",
        "t,x,z\n" + "1" * 300_000 + ",1,1\n": "cannot be read as CSV: field larger than field limit",
        "(" + " " * 900_000 + "(": "no line names the columns",
    }.items():
        path.write_text(text)
        with pytest.raises(JumpcadError) as caught:
            read_points(path)
        said = str(caught.value)
        assert message in said, (text[:50], said)
        assert "\n" not in said, text[:50]
    path.write_bytes(b"\xff\xfet")
    with pytest.raises(JumpcadError, match="not a text file"):
        read_points(path)
