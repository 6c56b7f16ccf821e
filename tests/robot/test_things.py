"""Every thing is asked for its doors where a robot has it, and only there."""

import jumpcad
from jumpcad.building.assembly import layout_of
from jumpcad.robot.cage.thing import CAGE
from jumpcad.robot.steering.thing import STEERING
from jumpcad.robot.things import THINGS, things_on


def test_a_robot_has_the_things_that_its_workshop_asks_for() -> None:
    for name, without in (("kenan-2.0", [CAGE, STEERING]), ("best-jumper", [STEERING]), ("best-steered", [])):
        layout = layout_of(jumpcad.load_design(name), jumpcad.load_workshop(jumpcad.load_design(name).workshop_name))
        assert [thing for thing in THINGS if thing not in things_on(layout)] == without
