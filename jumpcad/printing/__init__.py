"""Printing: layers and their mass, and the slicer."""
