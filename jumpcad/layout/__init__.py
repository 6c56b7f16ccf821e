"""Where everything goes: across the robot, and in the plane of motion."""
