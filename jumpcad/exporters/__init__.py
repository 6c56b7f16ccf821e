"""File formats: one module each, and the registry of those that a bundle has."""
