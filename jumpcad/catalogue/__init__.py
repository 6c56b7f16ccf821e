"""Bought parts: motors, bearings, batteries, boards, springs, fasteners and wire, shipped and the user's own."""

from jumpcad.catalogue.articles import Article, Battery, Bearing, Board, Component, Kit, Motor, OwnParts, StockSpring
from jumpcad.catalogue.shipped import Catalogue, Nut, PartsByName, Screw, Standoff, Washer, Wire, load_catalogue

__all__ = [
    "Article",
    "Battery",
    "Bearing",
    "Board",
    "Catalogue",
    "Component",
    "Kit",
    "Motor",
    "Nut",
    "OwnParts",
    "PartsByName",
    "Screw",
    "Standoff",
    "StockSpring",
    "Washer",
    "Wire",
    "load_catalogue",
]
