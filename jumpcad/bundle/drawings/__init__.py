"""Drawings of the bundle: wiring, leads, soldering, springs."""
