"""The bushings on which the springs sit (mm)."""

from jumpcad.dimensions import BUSHING_PLAY_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_left, lying_on_right
from jumpcad.robot.layout import Layout
from jumpcad.solids.outline import disc, hole
from jumpcad.solids.stack import Stack
from jumpcad.workshop import Workshop


def spring_bushings(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return both bushings."""
    return [spring_bushing(layout, workshop, side) for side in ("left", "right")]


def spring_bushing(layout: Layout, workshop: Workshop, side: str) -> Drawing:
    """Return the bushing inside one spring: a mandrel from the leg under the coil, then a spacer out to the plate."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    lateral, spring = layout.lateral, layout.drive.spring
    inner, outer = lateral.leg[1] + BUSHING_PLAY_MM, lateral.spring_left[1]
    wall = (lateral.inside[1] if side == "left" else -lateral.inside[0]) - layout.boss_mm
    mandrel, spacer = disc(spring.mandrel_mm), disc(layout.spring_bore_room_mm)
    bore = hole(holes.running(layout.axle_mm))
    end = wall - BUSHING_PLAY_MM
    slabs = [(0.0, min(outer, end) - inner, mandrel - bore)]
    slabs += [(outer - inner, end - inner, spacer - bore)] if end > outer else []
    x, z = layout.hub_mm
    # printed mandrel down; on the left the mandrel lies to the right, on the right to the left
    pose = lying_on_right(inner, x, z) if side == "left" else lying_on_left(-inner, x, z)
    return Drawing(f"spring_bushing_{side}", "body", Stack.of(slabs), (Placement(BODY, pose),))
