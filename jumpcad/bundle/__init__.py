"""A folder with everything to print, buy, assemble and simulate a robot: written, opened, verified, sliced."""
