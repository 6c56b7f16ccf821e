"""This process and its cores: threads, garbage, Ctrl-C."""
