"""Shapes that touch the ground: hulls of parts and rods, and the poses in which a robot lies."""
