"""The studio: sliders for the eight numbers in a browser, and the robot that follows from them (extra `studio`)."""

from jumpcad.studio.app import Studio as Studio

__all__ = ["Studio"]
