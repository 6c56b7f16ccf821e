"""Every thing on the robot, in the order in which layout, drawings, bought parts and checks take them."""

from jumpcad.robot.axles.thing import AXLES
from jumpcad.robot.cage.thing import CAGE
from jumpcad.robot.electronics.thing import ELECTRONICS
from jumpcad.robot.foot.thing import FOOT
from jumpcad.robot.layout import Layout
from jumpcad.robot.leg.thing import LEG
from jumpcad.robot.plates.thing import PLATES
from jumpcad.robot.robot import Thing
from jumpcad.robot.sensor.thing import SENSOR
from jumpcad.robot.springs.thing import SPRINGS
from jumpcad.robot.steering.thing import STEERING
from jumpcad.robot.stop.thing import STOP
from jumpcad.robot.train.thing import TRAIN

THINGS = (LEG, FOOT, PLATES, TRAIN, SPRINGS, AXLES, ELECTRONICS, STOP, SENSOR, CAGE, STEERING)


def things_on(layout: Layout) -> list[Thing]:
    """Return the things on a robot: all but those that have looked for a place and go without."""
    places = iter(layout.things)
    return [thing for thing in THINGS if thing.place is None or next(places, None) is not None]
