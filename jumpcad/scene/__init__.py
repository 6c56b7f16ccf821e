"""Pictures of a robot: placed meshes with colours, cameras, shading, the renderer."""
