"""Battery, boards, trays, switch and leads: where they go, how they are drawn, what is bought, what limits them."""
