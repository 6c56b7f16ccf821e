"""A study: what is asked for, its trials and its file, the workers that evaluate designs, and the run of a search."""
