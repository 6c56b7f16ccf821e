"""One folder with everything that a robot is made, printed and simulated from."""
