"""Landing, righting and the next jump, simulated in MuJoCo with the convex hulls of what is there."""
