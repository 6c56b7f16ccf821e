"""Printing: fit to the bed, print plates, layers and their mass, and the slicer."""
