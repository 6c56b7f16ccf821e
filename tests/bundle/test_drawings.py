"""The drawings of a bundle as their reader sees them: all is on the page, words are apart, lines end at their parts."""

import itertools
import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
from support.built import built, geared, placed

from jumpcad.bundle.drawings.lead_lines import leads_of
from jumpcad.bundle.drawings.spring_sheet import spring_sheets
from jumpcad.bundle.drawings.wiring import drawings_of, wires
from jumpcad.bundle.facts import arms_off_deg, torque_shares
from jumpcad.robot.electronics.leads import plate_of
from jumpcad.robot.robot import Robot

SPACE = "{http://www.w3.org/2000/svg}"
ROBOTS = {"kenan-2.0": lambda: built("kenan-2.0"), "two pairs": geared}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request: pytest.FixtureRequest) -> Robot:
    return ROBOTS[request.param]()


@pytest.fixture(scope="module")
def drawings(robot: Robot) -> dict[str, ET.Element]:
    drawn = drawings_of(robot) | dict(spring_sheets(robot))
    return {name: ET.fromstring(text) for name, text in drawn.items() if text}


def points_of(one: ET.Element) -> list[tuple[float, float]]:
    """The places that an element names."""
    get = {key: float(value) for key, value in one.attrib.items() if re.fullmatch(r"-?[\d.]+", value)}
    if one.tag == f"{SPACE}polyline":
        return [tuple(map(float, pair.split(","))) for pair in one.get("points").split()]  # type: ignore[misc]
    if one.tag == f"{SPACE}line":
        return [(get["x1"], get["y1"]), (get["x2"], get["y2"])]
    if one.tag == f"{SPACE}rect":
        x, y = get.get("x", 0.0), get.get("y", 0.0)
        return [(x, y), (x + get["width"], y + get["height"])]
    if one.tag == f"{SPACE}circle":
        return [(get["cx"] - get["r"], get["cy"] - get["r"]), (get["cx"] + get["r"], get["cy"] + get["r"])]
    return [(get["x"], get["y"])] if one.tag == f"{SPACE}text" else []


def test_all_is_on_the_page(drawings: dict[str, ET.Element]) -> None:
    assert {"wiring.svg", "leads.svg", "soldering.svg"} <= set(drawings)
    for name, root in drawings.items():
        _, _, width, height = map(float, root.get("viewBox").split())
        clipped = {one for group in root.iter(f"{SPACE}g") for one in group.iter()}
        places = np.array([place for one in root.iter() if one not in clipped for place in points_of(one)])
        assert places.min() >= -0.5, name
        assert (places <= [width + 0.5, height + 0.5]).all(), name
        assert places[:, 1].max() > 0.8 * height, name  # and the page is no longer than needed
        if name == "wiring.svg":
            assert places[1:, 0][places[1:, 0] < width].max() > 0.8 * width  # nor wider


def test_a_spring_is_drawn_three_times_as_large(robot: Robot, drawings: dict[str, ET.Element]) -> None:
    """Circle of the mean diameter, wire as thick, two straight arms of their length; from the side a coil a turn."""
    spring = robot.layout.drive.spring
    for hand in spring.hands:
        root = drawings[f"order/spring-{hand}-hand.svg"]
        (coil,) = root.iter(f"{SPACE}circle")
        assert 2.0 * float(coil.get("r")) == pytest.approx(3.0 * spring.arms.mean_mm, abs=0.02)
        assert float(coil.get("stroke-width")) == pytest.approx(3.0 * spring.wire_mm, abs=0.01)
        middle = np.array([float(coil.get("cx")), float(coil.get("cy"))])
        wires = [one for one in root.iter(f"{SPACE}line") if float(one.get("stroke-width")) > 0.3]
        ends = [np.array(points_of(one)) for one in wires]
        arms = [line for line in ends if abs(np.hypot(*(line[0] - middle)) - float(coil.get("r"))) < 0.02]
        assert len(arms) == 3  # with the loaded one
        for line in arms:
            assert np.hypot(*(line[1] - line[0])) == pytest.approx(3.0 * spring.arm_length_mm, abs=0.03)
        coils = np.array([line for line in ends if not any(line is arm for arm in arms)])
        assert len(coils) == math.ceil(spring.turns)
        slope = (coils[:, 0, 1] - coils[:, 1, 1]) * np.sign(coils[:, 1, 0] - coils[:, 0, 0])
        assert (slope > 0.0).all() if hand == "right" else (slope < 0.0).all()  # y points down
        assert np.abs(slope) == pytest.approx(3.0 * spring.wire_mm, abs=0.02)
        assert np.diff(coils[:, :, 1].mean(axis=1)) == pytest.approx(3.0 * spring.wire_mm, abs=0.02)
        assert np.ptp(coils[0, :, 0]) == pytest.approx(3.0 * spring.outer_diameter_mm, abs=0.02)
        assert coils[:, :, 1].mean() == pytest.approx(middle[1], abs=0.02)


def test_a_spring_is_asked_for_with_its_figures(robot: Robot, drawings: dict[str, ET.Element]) -> None:
    """Rate of the wire by EN 13906-3: E·d⁴/(64·D·n), N·mm/rad; loaded inside is wider than the mandrel."""
    spring = robot.layout.drive.spring
    for side, hand in zip(("left", "right"), spring.hands, strict=True):
        said = [one.text or "" for one in drawings[f"order/spring-{hand}-hand.svg"].iter(f"{SPACE}text")]
        rows = dict(itertools.pairwise(said))
        assert f"on its {side} side" in rows["robot"]
        assert rows["hand"] == f"{hand}-hand wound"
        assert rows["rate"] == f"{spring.rate_nmm_per_deg:.2f} N·mm/° ±10 %"
        rate = 206000.0 * spring.wire_mm**4 / (64.0 * spring.arms.mean_mm * (spring.turns + spring.arms.arm_turns))
        assert float(rows["rate"].split()[0]) == pytest.approx(math.radians(rate), rel=0.02)
        assert float(rows["inside diameter"].split()[0]) == pytest.approx(
            spring.arms.mean_mm - spring.wire_mm, abs=0.01
        )
        torque, closed = re.findall(r"^(\d+) N·mm.*closed by ([\d.]+)°", rows["LOADED (requirement)"])[0]
        assert float(torque) == pytest.approx(spring.rate_nmm_per_deg * float(closed), rel=0.01)
        least, most = torque_shares(robot)
        assert f"N·mm, +{100.0 * most - 100.0:.0f} % / -{100.0 - 100.0 * least:.0f} %, " in rows["LOADED (requirement)"]
        wound = spring.turns + float(closed) / 360.0
        assert float(rows["body length, loaded"].split()[0]) == pytest.approx((wound + 1.0) * spring.wire_mm, abs=0.06)
        inside = spring.arms.mean_mm * spring.turns / wound - spring.wire_mm
        mandrel = float(rows["inside, loaded"].split()[-2])
        assert inside - 0.5 < mandrel < inside
        assert rows["turns of the body, relaxed"] == f"{spring.turns:.2f}"
        assert float(rows["arms, straight, tangent"].split()[0]) == pytest.approx(spring.arm_length_mm, abs=0.051)
        free = 180.0 - 360.0 * (spring.turns % 1.0)  # opposite after whole turns, and closer by what is beyond them
        angle, wider, narrower = re.findall(r"^(\d+)° \+(\d+)° / -(\d+)°", rows["angle between arms, relaxed"])[0]
        assert float(angle) == pytest.approx(free % 360.0, abs=0.51)
        assert (float(narrower), float(wider)) == arms_off_deg(robot)
        assert (rows["wire"], rows["article"][:14]) == (f"{spring.wire_mm:g} mm, EN 10270-1 SM", "torsion spring")


def test_plates_are_drawn_to_scale_seen_from_outside(robot: Robot, drawings: dict[str, ET.Element]) -> None:
    """From the left the front, x, is on the left; standoffs, trays and words stand where they are on the robot."""
    root, layout = drawings["leads.svg"], robot.layout
    titles = [one.text for one in root.iter(f"{SPACE}text") if "seen from" in (one.text or "")]
    assert titles == [f"{side} plate, seen from the {side}: leads inside it are dashed" for side in ("left", "right")]
    outlines = [np.array(re.findall(r"(-?[\d.]+),(-?[\d.]+)", one.get("d")), dtype=float)
                for one in root.iter(f"{SPACE}path") if one.get("fill") == "#e6e8eb"]  # fmt: skip
    heads = [(float(one.get("cx")), float(one.get("cy"))) for one in root.iter(f"{SPACE}circle")
             if one.get("fill") == "#c3c9d1"]  # fmt: skip
    texts = [(one.text, float(one.get("x")), float(one.get("y"))) for one in root.iter(f"{SPACE}text")]
    count = len(layout.standoffs_mm)
    assert len(heads) == 2 * count
    for side, sign, points, circles in zip(
        ("left", "right"), (-1.0, 1.0), outlines, (heads[:count], heads[count:]), strict=True
    ):
        mesh = placed(robot, f"body_plate_{side}")
        low, high = mesh.bounds[:, [0, 2]]
        scale = np.ptp(points[:, 0]) / (high[0] - low[0])
        assert np.ptp(points[:, 1]) / (high[1] - low[1]) == pytest.approx(scale, rel=0.02)
        left = points[:, 0].min() - scale * min(sign * low[0], sign * high[0])
        top = points[:, 1].max() + scale * low[1]

        def drawn(place: np.ndarray, left: float = left, top: float = top, scale: float = scale, sign: float = sign):
            return left + scale * sign * place[0], top - scale * place[1]

        for place, circle in zip(layout.standoffs_mm, circles, strict=True):
            assert circle == pytest.approx(drawn(place), abs=0.4)
        hole = layout.fittings.left_mm if side == "left" else layout.fittings.right_mm
        words = [(x, y) for text, x, y in texts if text == "wire hole, tie above it"]
        assert min(abs(x - drawn(hole)[0]) for x, _ in words) < 0.4
        if side == "right" and layout.fittings.usb_mm is not None:
            (usb,) = ((x, y) for text, x, y in texts if text == "USB")
            assert usb[0] == pytest.approx(drawn(layout.fittings.usb_mm)[0], abs=0.4)
        if side == "left" and layout.sensor is not None:
            assert any(
                text == "sensor" and math.dist((x, y), drawn(layout.sensor.place_mm)) < 40.0 for text, x, y in texts
            )


def views_of(root: ET.Element) -> list[list[ET.Element]]:
    """What leads.svg shows of the left plate, of the right one, and from above, in its order."""
    found: list[list[ET.Element]] = []
    for one in root.iter():
        if "are dashed" in (one.text or ""):
            found.append([])
        if found:
            found[-1].append(one)
    return found


def test_a_lead_is_one_line_from_end_to_end_dashed_where_a_plate_or_the_tray_hides_it(
    robot: Robot, drawings: dict[str, ET.Element]
) -> None:
    """Pieces of a lead meet, and dots are at its ends; heights and sides are those of the parts' meshes."""
    leads, views = leads_of(robot), views_of(drawings["leads.svg"])
    assert len(views) == 3
    left, right = (placed(robot, f"body_plate_{side}").vertices[:, 1] for side in ("left", "right"))
    tray = placed(robot, "electronics_tray_upper").vertices[:, 2]
    shown = (
        [(lead, lead.points_mm[:, 1] > left.max()) for lead in leads if plated(robot, lead.parts, "left")],
        [(lead, lead.points_mm[:, 1] < right.min()) for lead in leads if plated(robot, lead.parts, "right")],
        [(lead, lead.points_mm[:, 2] > tray.min()) for lead in leads],
    )
    for view, expected in zip(views, shown, strict=True):
        lines = [one for one in view if one.tag == f"{SPACE}polyline"]
        dots = [one for one in view if one.tag == f"{SPACE}circle" and one.get("r") == "0.7"]
        ends = [(float(one.get("cx")), float(one.get("cy"))) for one in dots]
        assert len(expected) > 1
        assert len(ends) == 2 * len(expected)
        for number, (lead, seen) in enumerate(expected):
            pieces = [bool(a and b) for a, b in itertools.pairwise(seen)]
            runs = [open_ for open_, _ in itertools.groupby(pieces)]
            own, lines = lines[: len(runs)], lines[len(runs) :]
            assert [one.get("stroke-dasharray") is None for one in own] == runs, lead.parts
            ways = [points_of(one) for one in own]
            assert sum(len(way) - 1 for way in ways) == len(pieces)
            assert [way[-1] for way in ways[:-1]] == [way[0] for way in ways[1:]]
            assert [ways[0][0], ways[-1][-1]] == ends[2 * number : 2 * number + 2]
        assert lines == []


def test_leads_end_at_the_pads_of_the_controller_in_their_order_from_the_usb_socket(robot: Robot) -> None:
    """From above with USB to the right, the row that is left with USB ahead lies in front, at the board's edge."""
    board = robot.layout.electronics.controller
    (item,) = (one for one in robot.hardware if one.name == "controller")
    corners = item.shown_mesh.vertices @ item.T_body_part[:3, :3].T + item.T_body_part[:3, 3]
    (back, right, _), (front, left, _) = corners.min(axis=0), corners.max(axis=0)
    found = {end.pin: at for lead in leads_of(robot) for end, at in zip(lead.ends, lead.points_mm[[0, -1]], strict=True)
             if end.part == "controller"}  # fmt: skip
    assert len(found) > 3
    for names, edge in ((board.left, front), (board.right, back)):
        rows = [found[pin] for pin in names if pin in found]
        assert all(abs(at[0] - edge) < 2.0 and right < at[1] < left for at in rows)
        assert [at[1] for at in rows] == sorted(at[1] for at in rows)  # away from the right plate


def plated(robot: Robot, parts: tuple[str, str], side: str) -> bool:
    return any(plate_of(robot.layout, part) == side for part in parts)


def test_numbers_of_leads_cover_each_other_in_no_view(drawings: dict[str, ET.Element]) -> None:
    for view in views_of(drawings["leads.svg"]):
        badges = [points_of(one) for one in view if one.tag == f"{SPACE}circle" and one.get("r") == "1.7"]
        middles = [np.mean(corners, axis=0) for corners in badges]
        assert len(middles) > 1
        assert min(math.dist(*two) for two in itertools.combinations(middles, 2)) > 2.0 * 1.7


def test_the_sensors_terminals_are_named_at_the_wires_of_their_colours(drawings: dict[str, ET.Element]) -> None:
    """COM at the black one, NC at the yellow one: each word is nearest to the end of its own."""
    page = drawings["leads.svg"]
    ends = [one for one in page.iter(f"{SPACE}circle") if one.get("r") == "0.7"]
    for word, colour in (("COM", "#222222"), ("NC", "#c9a400")):
        (text,) = [one for one in page.iter(f"{SPACE}text") if one.text == word]
        x, y = float(text.get("x", "")), float(text.get("y", "")) - 0.8  # the middle of its letters
        near = min(ends, key=lambda end: math.dist((x, y), (float(end.get("cx", "")), float(end.get("cy", "")))))
        assert near.get("fill") == colour, word


def test_leads_of_a_wheel_run_inside_along_the_right_plate_and_round_its_spring() -> None:
    """Wires of 1.2 mm never leave the plate's material by more than a pocket's width, and no spring's coil meets them.

    No longer than they are cut, soldered ends aside; the wheel's end is named in the plate's view.
    """
    robot = built("best-steered", "best-steered")
    (_, inside), cut = robot.layout.lateral.right_plate, {start: mm for _, start, _, _, mm in wires(robot)}
    cut_open = placed(robot, "body_plate_right").section((0.0, 1.0, 0.0), (0.0, inside - 1.0, 0.0))
    outline, *holes = sorted((shapely.Polygon(one[:, ::2]) for one in cut_open.discrete), key=lambda one: -one.area)
    plate = outline - shapely.union_all(holes)
    spring = robot.layout.drive.spring
    coil = shapely.Point(robot.layout.hub_mm).buffer(spring.inside_diameter_mm / 2.0 + spring.wire_mm)
    leads = [lead for lead in leads_of(robot) if "steering motor" in lead.parts]
    assert len(leads) == 2
    for lead in leads:
        beside = lead.points_mm[abs(lead.points_mm[:, 1] - inside - 2.0) < 0.5]
        way = shapely.LineString(beside[:, ::2])
        assert len(beside) > 6
        assert outline.contains(way.buffer(0.6))
        assert way.difference(plate).length < 5.0
        assert way.distance(coil) > 0.6 + 1.0
        assert sum(map(math.dist, lead.points_mm, lead.points_mm[1:])) <= cut[lead.ends[0]] - 10.0
    page = ET.fromstring(drawings_of(robot)["leads.svg"])
    assert {"steering motor", "← to the wheel"} <= {one.text for one in page.iter(f"{SPACE}text")}
