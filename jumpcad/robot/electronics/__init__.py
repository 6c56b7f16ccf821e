"""Battery, boards, their trays, switch and leads: where it goes, how it is drawn, what is bought for it, what limits it."""
