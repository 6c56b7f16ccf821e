"""The methods that propose designs, and what they learn from those that were evaluated."""
