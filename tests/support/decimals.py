"""How many decimals numbers have that are written into files: few enough that processors do not differ in them."""

from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any

import numpy as np


def decimals(data: Any) -> int:
    """Return the largest number of decimals of the numbers in a value, table, list or array, as they are written."""
    if isinstance(data, Mapping):
        return decimals(data.values())
    if isinstance(data, np.ndarray):
        return decimals(data.tolist())
    if isinstance(data, float | np.floating):
        return max(0, -int(Decimal(repr(float(data))).normalize().as_tuple().exponent))
    if isinstance(data, Iterable) and not isinstance(data, str):
        return max(map(decimals, data), default=0)
    return 0
