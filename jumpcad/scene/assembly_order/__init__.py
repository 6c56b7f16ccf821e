"""The order of assembly as data, by stage: for every step the parts, their direction of assembly, the tool, the texts.

The pin in the leg that the springs push comes late, through a hole in the left plate: without it they are slack, so
that both plates hold the springs' other pin before anything is loaded, the cam can be turned by hand, and the motor
turns it for the first time without springs.
"""

from jumpcad.scene.assembly_order.between_plates import BETWEEN_PLATES
from jumpcad.scene.assembly_order.first_jump import FIRST_JUMP
from jumpcad.scene.assembly_order.plan import Plan
from jumpcad.scene.assembly_order.subassemblies import SUBASSEMBLIES

ORDER: tuple[Plan, ...] = (*SUBASSEMBLIES, *BETWEEN_PLATES, *FIRST_JUMP)
"""What is done, in this order."""
