"""Printed and bought parts: numbers in, shapes and places out."""
