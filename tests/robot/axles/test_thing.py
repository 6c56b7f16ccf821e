"""Axles and pins cannot come out: pushed to either side, each with what is on it meets what it carries."""

import math

import numpy as np
import pytest
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.checks.interference import interference_findings
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop

CHOICES = {"plates": {}, "clips": {"retention": "clips", "axle": "silver-steel"}, "nuts": {"retention": "nuts"}}


def workshop(**bought: object) -> Workshop:
    return workshop_with(bought=bought)


@pytest.fixture(scope="module", params=list(CHOICES))
def robot(request: pytest.FixtureRequest) -> Robot:
    return build(load_design("kenan-2.0"), workshop(**CHOICES[request.param]))


@pytest.mark.thorough
def test_nothing_meets(robot: Robot) -> None:
    assert [found.message for found in interference_findings(robot) if found.severity == "error"] == []


def test_a_nut_is_full_of_its_screw(robot: Robot) -> None:
    """A lock nut holds by its ring of plastic, which is its last turn: the screw reaches through all of it."""
    pieces = {item.name: item for item in robot.hardware}
    nuts = [name for name in pieces if name.endswith(("_axle_nut", "_pin_nut"))]
    assert bool(nuts) == (robot.workshop.bought.retention == "nuts")
    for name in nuts:
        nut, screw = pieces[name], pieces[name.removesuffix("_nut")]
        ends = [(one.T_body_part[:3, :3] @ one.shape.bounds_mm.T)[1] + one.T_body_part[1, 3] for one in (screw, nut)]
        assert ends[0].min() <= ends[1].min() + 1e-6
        assert ends[1].max() < ends[0].max()


def test_a_screw_that_is_an_axle_weighs_its_shank_and_its_head(robot: Robot) -> None:
    """ISO 4762, M3: a head of 5.5 x 3 mm, three tenths of which are its socket; 7.85 g/cm³."""
    screws = [item for item in robot.hardware if "ISO 4762" in item.article]
    assert bool(screws) == (robot.workshop.bought.retention == "nuts")
    for screw in screws:
        length = float(screw.article.split(" x ")[1].split()[0])
        volume = math.pi / 4.0 * (3.0**2 * length + 0.7 * 5.5**2 * 3.0)
        assert 1000.0 * screw.mass_kg == pytest.approx(7.85e-3 * volume, rel=0.01), screw.name
        assert reach(screw)[1] - reach(screw)[0] == pytest.approx(length + 3.0)


def test_an_axle_weighs_its_rod() -> None:
    """Aluminium, 2.81 g/cm³, less two grooves of 2.3 mm in 3 mm, 0.64 mm wide (DIN 6799)."""
    robot = build(load_design("kenan-2.0"), workshop(retention="clips", axle="aluminium-7075"))
    axle = next(item for item in robot.hardware if item.name == "leg_axle")
    length = float(axle.article.split(" x ")[1].split()[0])
    volume = math.pi / 4.0 * (9.0 * length - 2.0 * 0.64 * (9.0 - 2.3**2))
    assert 1000.0 * axle.mass_kg == pytest.approx(2.81e-3 * volume, rel=0.01)
    clips = [item for item in robot.hardware if item.article == "E-clip 2.3 DIN 6799"]
    assert len(clips) == 2 * (3 + 1 + 3)  # three axles, the springs' pin in the plates, three pins
    hollow = build(load_design("kenan-2.0"), workshop(axle="steel-tube"))
    tube = next(item for item in hollow.hardware if item.name == "cam_axle")
    assert np.isclose(tube.shape.moments[0] / (np.ptp(tube.shape.bounds_mm[:, 2])), math.pi / 4 * (9 - 4), rtol=0.01)
    assert 1e6 * tube.mass_kg / tube.shape.moments[0] == pytest.approx(7.9, rel=0.01)  # 1.4301, g/cm³


@pytest.mark.parametrize(
    ("bought", "message"),
    [
        (
            {"retention": "clips"},
            r"no groove can be cut into spring-steel at home: choose a bought.axle of silver-steel",
        ),
        ({"axle": "silversteel"}, r"bought.axle = 'silversteel': is no rod in the catalogue: .*did you mean"),
        ({"axle_mm": 6.0, "leg_bearing": "", "retention": "nuts"}, r"= 6: bought.retention = .nuts. .* make it 3, or"),
        ({"axle_mm": 2.4, "leg_bearing": ""}, r"bought.axle_mm = 2.4: no clip of that size \(2, 3 mm\)"),
        ({"axle_mm": 2.5, "leg_bearing": "", "retention": "clips", "axle": "silver-steel"}, r"no clip of that size"),
    ],
)
def test_what_cannot_be_kept_is_refused(bought: dict[str, object], message: str) -> None:
    with pytest.raises(JumpcadError, match=message):
        build(load_design("kenan-2.0"), workshop(**bought))


@pytest.mark.thorough
def test_axles_of_two_millimetres_have_pins_with_clips() -> None:
    """Clevis pins begin at 3 mm (ISO 2341); a clip for 2 mm has a groove of 1.5 mm (DIN 6799)."""
    robot = build(load_design("kenan-2.0"), workshop(axle_mm=2.0))
    articles = [item.article for item in robot.hardware]
    assert articles.count("E-clip 1.5 DIN 6799") == 6
    assert sum(article.startswith("spring steel rod 2 x ") for article in articles) == 4
    assert sum(article.startswith("silver steel rod 1.2210, annealed 2 x ") for article in articles) == 3
    assert robot.layout.hub_bearing.bore_mm == 2.0
    assert [found.message for found in interference_findings(robot) if found.severity == "error"] == []


def reach(item: BoughtPart) -> np.ndarray:
    """Least and greatest y of a bought part in its body's frame."""
    return np.sort(item.shape.bounds_mm[:, 2] * item.T_body_part[1, 2] + item.T_body_part[1, 3])


def test_a_clevis_pin_is_the_shortest_from_stock_whose_split_pin_is_outside() -> None:
    """ISO 2341 by the catalogue's lengths: head 0.2 mm outside of one face, split pin no nearer to the other."""
    robot = build(load_design("kenan-2.0"))
    layout, pin = robot.layout, robot.workshop.catalogue.clevis_pin_for(3.0)
    things = {item.name: item for item in robot.hardware}
    arm = layout.lateral.leg[1] + 0.5 + 2.0 * layout.drive.spring.wire_mm
    lug = layout.lateral.lug_left[1]
    for name, face in (("ankle_pin", layout.ankle_face_mm), ("front_eye_pin", lug), ("leg_spring_pin", arm)):
        low, high = reach(things[name])
        length = float(things[name].article.split(" x ")[1].split()[0])
        assert (high, low) == pytest.approx((face + 0.2 + pin.head_height_mm, face + 0.2 - length))
        needed = 2.0 * (face + 0.2) + pin.cotter_mm / 2.0 + pin.end_mm
        assert length == min(known for known in pin.lengths_mm if known >= needed - 1e-9)
        split = reach(things[f"{name}_split_pin"])
        assert split == pytest.approx(low + pin.end_mm + np.array([-0.5, 0.5]) * pin.cotter_mm)
        assert split[1] <= -face - 0.2 + 1e-6
        item = things[f"{name}_split_pin"]
        along, _, up = np.ptp(item.shown_mesh.copy().apply_transform(item.T_body_part).bounds, axis=0)
        assert (along > up) == (name != "leg_spring_pin")  # along the foot, and across the leg
        assert max(along, up) == pytest.approx(5.0, abs=0.05)
        x, y = item.shown_mesh.vertices[:, :2].T
        bent = np.abs(y) > pin.cotter_mm / 2.0 + 0.01
        assert np.hypot(x, y)[bent].min() == pytest.approx(1.5 + 0.1, abs=0.01)  # beside the pin, not in it
