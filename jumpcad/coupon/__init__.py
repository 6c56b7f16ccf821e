"""The fit coupon: its printed pieces, its readings, and the workshop with the measured fits."""
