"""Loads, stresses, fatigue, bearings of the parts that move; factors by which their sections grow."""
