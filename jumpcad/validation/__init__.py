"""The engines beside robots that others built and measured."""
