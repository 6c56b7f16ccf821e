"""Exact shapes of parts: outlines, stacks of slabs, blocks, their solids and moments."""
