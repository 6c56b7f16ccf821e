"""`python -m jumpcad`: the command line of this very tree."""

from jumpcad.cli import program

program()
