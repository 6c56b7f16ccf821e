"""What every printed part shares: flat outlines, stacks of them, finished meshes, and what they weigh."""
