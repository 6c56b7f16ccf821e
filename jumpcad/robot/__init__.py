"""The robot: a folder for each thing on it, its layout, and the registry of all things."""
