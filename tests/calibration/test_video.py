"""A ballistic flight is recovered from its points, and its gravity and speed tell a wrong unit or clock."""

import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from jumpcad.calibration.video import read_points, seen_takeoff
from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

SPEED, ANGLE, FASTEST = 1.25, 48.0, 1.5


def flight(noise_m: float = 0.0, seed: int = 1) -> Array:
    """Return points (24, 3) of a flight, seen at 120 frames a second."""
    t = np.arange(24) / 120.0 + 3.0
    fall = t - t[0]
    x = SPEED * math.cos(math.radians(ANGLE)) * fall
    z = SPEED * math.sin(math.radians(ANGLE)) * fall - 0.5 * 9.81 * fall**2
    noise = noise_m * np.random.default_rng(seed).standard_normal((2, 24))
    return np.column_stack([t, x + 0.4 + noise[0], z + 0.1 + noise[1]])


def test_speed_and_angle_at_the_first_point() -> None:
    seen = seen_takeoff(flight(), "here", FASTEST)
    assert (seen.speed_m_s, seen.angle_deg) == pytest.approx((SPEED, ANGLE), rel=1e-9)
    assert seen.speed_error_m_s < 1e-9


def test_the_standard_error_is_that_of_repeated_fits() -> None:
    """Gauss: the slope of a line through points with deviation s has the deviation s / sqrt(sum((t - mean)²))."""
    t = np.arange(24) / 120.0
    expected = 0.002 / math.sqrt(float(np.sum((t - t.mean()) ** 2)))
    found = [seen_takeoff(flight(0.002, seed), "here", FASTEST).speed_error_m_s for seed in range(200)]
    assert np.mean(np.square(found)) == pytest.approx(expected**2, rel=0.04)  # four numbers are fitted to 48


def test_the_angles_error_is_in_degrees() -> None:
    """A velocity that is off by e square to it turns by e over the speed, as fits of 200 noisy flights do."""
    seen = [seen_takeoff(flight(0.002, seed), "here", FASTEST) for seed in range(200)]
    scatter = np.std([one.angle_deg for one in seen])
    assert np.mean([one.angle_error_deg for one in seen]) == pytest.approx(scatter, rel=0.15)
    assert np.mean([one.speed_error_m_s for one in seen]) == pytest.approx(
        np.std([s.speed_m_s for s in seen]), rel=0.15
    )


def test_a_wrong_unit_with_any_clock_is_put_right_by_what_the_error_says() -> None:
    """Lengths s times too large, seen n times too slow, fall with g·s/n² at s/n times the speed: n² = s hides in g."""
    for scale in (1.0, 100.0, 1000.0, 1.0 / 0.0254):
        for slow in (1.0, 1.25, 2.0, 4.8, 8.0, 9.6, 33.3, 1000.0, 0.5, 0.125, math.sqrt(scale)):
            points = flight() * np.array([slow, scale, scale])
            if scale == slow == 1.0:
                continue
            with pytest.raises(JumpcadError) as caught:
                seen_takeoff(points, "here", FASTEST)
            way = str(caught.value).split(": ", maxsplit=2)[2]
            found = []
            for one in way.split("; or x and z")[:2]:
                divide, clock = (re.search(f"{word} ([0-9.e-]+)", one) for word in ("by", "slow_motion ="))
                right = np.array([1.0, *[1.0 / float(divide[1]) if divide else 1.0] * 2])
                found.append(seen_takeoff(points * right, "here", FASTEST, float(clock[1]) if clock else 1.0).speed_m_s)
            assert any(abs(one - SPEED) < 1e-3 * SPEED for one in found), f"{scale}, {slow}: {caught.value}: {found}"


def test_a_slow_motion_that_is_wrong_is_corrected() -> None:
    with pytest.raises(JumpcadError, match=r"the clock is 8 times too fast: say slow_motion = 1 in \[\[videos\]\]"):
        seen_takeoff(flight(), "here", FASTEST, slow_motion=8.0)


def test_points_of_no_jump_of_this_robot() -> None:
    thrown = flight() + (flight() - flight()[0]) * [0.0, 3.0, 0.0]
    for points, message in (
        (flight() * [1.0, 1.0, -1.0], "z points down"),
        (flight() * [1.0, 1.0, 0.0], "keep only the points between take-off and touchdown"),
        (thrown, "start with 3.47 m/s, where the springs give up to 1.5: "),
    ):
        with pytest.raises(JumpcadError) as caught:
            seen_takeoff(points, "here", FASTEST)
        assert message in str(caught.value)


def test_noise_is_no_clock() -> None:
    """Half a millimetre over 12 points of 1/240 s leaves g uncertain by 19 %; points on the ground are no noise."""
    t, clocks = np.arange(12) / 240.0, 0
    for seed in range(1000):
        noise = 5e-4 * np.random.default_rng(seed).standard_normal((2, 12))
        points = np.column_stack([t, 0.9 * t + noise[0], 0.9 * t - 4.905 * t * t + noise[1]])
        try:
            assert seen_takeoff(points, "here", FASTEST).speed_m_s == pytest.approx(0.9 * math.sqrt(2.0), rel=0.05)
        except JumpcadError:
            clocks += 1
    assert clocks < 10  # beyond three standard errors are 3 of 1000
    t = np.arange(90) / 240.0
    noise = 5e-4 * np.random.default_rng(1).standard_normal((2, 90))
    landed = np.column_stack([t, 0.9 * t + noise[0], np.maximum(0.9 * t - 4.905 * t * t, 0.0) + noise[1]])
    with pytest.raises(JumpcadError, match="keep only the points between take-off and touchdown"):
        seen_takeoff(landed, "here", FASTEST)


def test_a_flight_backwards() -> None:
    with pytest.raises(JumpcadError, match="x must point forwards"):
        seen_takeoff(flight() * np.array([1.0, -1.0, 1.0]), "here", FASTEST)
    with pytest.raises(JumpcadError, match="z upwards"):  # the way down alone
        seen_takeoff(flight()[13:], "here", FASTEST)


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
