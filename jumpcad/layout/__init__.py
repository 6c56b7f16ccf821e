"""Where everything goes: the lateral stack across the robot, and the places in the plane of motion (numpy only)."""
