"""Loads, stresses, fatigue, section sizes and bearings of the parts that move."""
