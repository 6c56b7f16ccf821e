"""The methods that propose designs: genetic, Bayesian, and fronts of two objectives."""
