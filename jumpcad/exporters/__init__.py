"""What leaves the house: one format a module, each reading finished parts or a finished robot."""
