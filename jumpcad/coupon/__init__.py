"""The fit coupon: what is printed, how it is read, and the workshop that follows."""
