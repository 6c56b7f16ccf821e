"""Steps of the assembly: their order, parts and pictures."""
