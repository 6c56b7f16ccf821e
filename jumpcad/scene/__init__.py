"""What there is to see of a robot: meshes in their places, cameras, shading, the renderer, steps of assembly."""
