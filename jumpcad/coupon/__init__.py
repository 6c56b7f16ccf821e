"""The fit coupon: what is printed, its readings, and the workshop with the measured fits."""
