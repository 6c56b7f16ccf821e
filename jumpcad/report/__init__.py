"""What people see of robots and searches: pictures and pages."""

PICTURES = (
    "history", "slices", "parallel", "pareto", "acquisition-first", "acquisition",
    "sweeps", "pca", "importance", "feasibility",
)  # fmt: skip
"""The names of all pictures of a study, then of those of the design space."""
