"""Room: obstacles, places among them, and the lateral stack."""
