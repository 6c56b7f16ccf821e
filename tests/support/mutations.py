"""Named ways to damage a file: texts, JSON documents, bytes. Seeded, so that a case is the same in every run."""

import copy
import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

Place = tuple[str | int, ...]
"""Keys and indices that lead to a value of a JSON document."""

NESTED = 5000
DIGITS = "9" * 6000
"""An integer of more digits than Python converts."""
MARK = "@@value@@"

JSON_VALUES = {
    "null": "null",
    "true": "true",
    "minus": "-1",
    "nan": "NaN",
    "infinity": "-Infinity",
    "overflow": "1e999",
    "digits": DIGITS,
    "text": '"x"',
    "escape": '"\\u001b[31m\\n[/x]"',
    "half": '"\\ud800"',
    "list": "[]",
    "object": "{}",
    "deep": "[" * NESTED + "]" * NESTED,
}
"""Values that are right in hardly any place, as JSON text."""

NUMBERS = {
    "nan": "nan",
    "infinity": "inf",
    "minus-infinity": "-inf",
    "empty": "",
    "words": "heavy",
    "pair": "1 2",
    "hexadecimal": "0x10",
    "zero": "0",
    "minus": "-1",
    "overflow": "1e999",
    "huge": "1e300",
    "tiny": "1e-320",
    "digits": DIGITS,
}
"""Numbers as attributes of XML."""
NO_NUMBERS = {"nan", "infinity", "minus-infinity", "empty", "words", "pair", "hexadecimal", "overflow", "digits"}
"""Those that are not finite numbers."""

Spoil = Callable[[bytes], bytes]
DOCUMENTS: dict[str, Spoil] = {
    "empty": lambda data: b"",
    "blank": lambda data: b" \n",
    "zeros": lambda data: bytes(len(data)),
    "noise": lambda data: np.random.default_rng(5).bytes(3000),
    "nul-byte": lambda data: data[:50] + b"\0" + data[50:],
    "not-utf-8": lambda data: data[:50] + b"\xff\xfe\xfa" + data[50:],
    "utf-16": lambda data: data.decode("latin-1").encode("utf-16"),
    "byte-order-mark": lambda data: b"\xef\xbb\xbf" + data,
    "carriage-returns": lambda data: data.replace(b"\n", b"\r"),
    "twice": lambda data: data + data,
    "long-tail": lambda data: data + b"x" * 1_000_000,
}
"""Ways to damage any text file as a whole."""


def flipped(data: bytes, seed: int, count: int = 3) -> bytes:
    """Return data with some bits flipped, as by a faulty disk or line."""
    generator = np.random.default_rng(seed)
    spoilt = bytearray(data)
    for place in generator.integers(len(spoilt), size=count):
        spoilt[place] ^= 1 << int(generator.integers(8))
    return bytes(spoilt)


def cut(data: bytes, seed: int) -> bytes:
    """Return the beginning of data, as after an interrupted copy."""
    return data[: int(np.random.default_rng(seed).integers(1, len(data)))]


def accidents(flips: int, cuts: int) -> dict[str, Spoil]:
    """Return named accidents: flipped bits and cut ends."""
    return {f"flip-{seed}": lambda data, seed=seed: flipped(data, seed) for seed in range(flips)} | {
        f"cut-{seed}": lambda data, seed=seed: cut(data, seed) for seed in range(cuts)
    }


def places(data: Any, above: Place = ()) -> Iterator[Place]:
    """Yield the places of all values in a JSON document, groups included."""
    for key, value in data.items() if isinstance(data, dict) else enumerate(data):
        yield (*above, key)
        if isinstance(value, dict | list):
            yield from places(value, (*above, key))


def with_value(data: Any, place: Place, text: str) -> str:
    """Return a JSON document with a value replaced by a text that need not be JSON."""
    changed = copy.deepcopy(data)
    _group(changed, place)[place[-1]] = MARK
    return json.dumps(changed).replace(f'"{MARK}"', text)


def spoilt_value(data: Any, found: list[Place], number: int) -> tuple[str, str]:
    """Return what is done, and a JSON document with a drawn value at one of some places: first at the top ones."""
    generator = np.random.default_rng(number)
    tops = [place for place in found if len(place) == 1]
    place = tops[number] if number < len(tops) else found[int(generator.integers(len(found)))]
    value = str(generator.choice(list(JSON_VALUES)))
    return f"{place} = {value}", with_value(data, place, JSON_VALUES[value])


def without(data: Any, place: Place) -> str:
    """Return a JSON document without one of its values."""
    changed = copy.deepcopy(data)
    del _group(changed, place)[place[-1]]
    return json.dumps(changed)


def _group(data: Any, place: Place) -> Any:
    for key in place[:-1]:
        data = data[key]
    return data
