"""The studio: sliders for a design's eight numbers in a browser, and the robot that they give (extra `studio`)."""

from jumpcad.studio.app import Studio as Studio
from jumpcad.studio.points import Points as Points
