"""Atomically exchanges two directories, where the system can (docs/decisions/swap.md says why)."""

import ctypes
import os
import sys
from pathlib import Path

_HERE = -100
"""`AT_FDCWD` of Linux: names are relative to the working directory."""
_EXCHANGE = 2
"""`RENAME_EXCHANGE` of Linux's renameat2(2), which ext4, xfs, btrfs, tmpfs and overlay file systems support."""


def exchanged(one: Path, other: Path) -> bool:
    """Exchange two existing paths of one file system; return False, with nothing changed, if that is not possible."""
    if not sys.platform.startswith("linux"):
        return False
    try:
        rename = ctypes.CDLL(None).renameat2
    except AttributeError:  # a C library that does not have it
        return False
    return bool(rename(_HERE, os.fsencode(one), _HERE, os.fsencode(other), _EXCHANGE) == 0)
