"""The studio: sliders for a design's eight numbers in a browser, and the robot that they give (extra `studio`)."""

from jumpcad.studio.app import Studio as Studio

__all__ = ["Studio"]
