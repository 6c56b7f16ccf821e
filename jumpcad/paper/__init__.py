"""The published study: its simulation, bit for bit, and its table of results compared with jumpcad's."""
