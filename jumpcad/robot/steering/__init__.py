"""The wheel under the tail that turns the robot while it crouches: its place, shapes, bought parts and limits."""
