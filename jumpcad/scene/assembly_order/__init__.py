"""The order of assembly (`order`), and what a step and a move are (`plan`)."""

from jumpcad.scene.assembly_order.order import ORDER as ORDER
