"""The robot's electricity: parts that a workshop chose, their voltages, their net list and its drawing."""
