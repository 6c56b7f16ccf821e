"""Pictures of a robot: stills at rest, compressed and exploded, and the jump as an animation."""
