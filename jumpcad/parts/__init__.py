"""The printed parts, one module each: numbers in, shape and place out."""
