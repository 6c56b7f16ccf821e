"""Bought parts: motors, bearings, batteries, boards, springs, pads, fasteners and wire, shipped and the user's own."""

from jumpcad.catalogue.articles import Article, OwnParts
from jumpcad.catalogue.bars import CageRod, ClevisPin, Clip, LegBar, Rod
from jumpcad.catalogue.boards import Board
from jumpcad.catalogue.electrical import Battery, Component, ElectricalParts, Kit, Motor, Travel
from jumpcad.catalogue.mechanical import Bearing, ORing, Pad, StockSpring
from jumpcad.catalogue.shipped import Catalogue, Nut, PartsByName, Screw, Standoff, Washer, Wire, load_catalogue

__all__ = [
    "Article", "Battery", "Bearing", "Board", "CageRod", "Catalogue", "ClevisPin", "Clip", "Component",
    "ElectricalParts", "Kit", "LegBar", "Motor", "Nut", "ORing", "OwnParts", "Pad", "PartsByName", "Rod", "Screw",
    "Standoff", "StockSpring", "Travel", "Washer", "Wire", "load_catalogue",
]  # fmt: skip
