"""The robot's electricity: parts that a workshop chose, their voltages, the net list with the controller's pins."""
