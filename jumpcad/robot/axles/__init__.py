"""Axles, pins, and the tubes on them: where it goes, how it is drawn, what is bought for it, what limits it."""
