"""What a printer makes of a part: beds, plates, layers, masses, and what a slicer says."""
