"""The two torsion springs: where it goes, how it is drawn, what is bought for it, what limits it."""
