"""Counts in words."""


def counted(number: int, noun: str) -> str:
    """Return a number and its noun, in the plural unless it is one: 1 design, 2 designs, 0 designs.

    The noun is the first word; what follows it stays: `counted(2, "design of the space")`.
    """
    first, space, rest = noun.partition(" ")
    return f"{number} {first}{'' if number == 1 else 's'}{space}{rest}"
