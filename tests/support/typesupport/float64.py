# SPDX-License-Identifier: Apache-2.0
"""What a float64 becomes in a binary32 and back, by numpy; and the bit patterns to try it with."""

from __future__ import annotations

import random
import struct

import numpy as np

QUIET = 1 << 22
"""The bit of the fraction of a binary32 that a quiet NaN has (IEEE 754, 6.2.1)."""


def edge_patterns() -> list[int]:
    """Return binary64 bit patterns around every place where the result changes its kind, with both signs."""
    values = [0, 1, (1 << 52) - 1, 1 << 52, 0x7FEFFFFFFFFFFFFF, 0x7FF0000000000000]
    nans = [
        0x7FF8000000000000,
        0x7FF0000000000001,
        0x7FFFFFFFFFFFFFFF,
        0x7FF000001FFFFFFF,
        0x7FF0000020000000,
    ]
    singles = [0, 1, 2, 3, 0x7FFFFE, 0x7FFFFF, 0x800000, 0x800001, 0x3F800000, 0x4B7FFFFF, 0x7F7FFFFE]
    singles += [1 << bit for bit in range(23)]
    for low in singles:
        below, above = (struct.unpack("<f", struct.pack("<I", low + more))[0] for more in (0, 1))
        exact, halfway = _bits(below), _bits((below + above) / 2)
        values += [exact, halfway - 1, halfway, halfway + 1, exact + 1, max(exact - 1, 0)]
    largest = _bits(float(np.finfo(np.float32).max))
    values += [
        largest + (1 << 28) + step for step in (-1, 0, 1)
    ]  # the middle between it and the next power of two
    values += [exponent << 52 | fraction for exponent in range(0x360, 0x390) for fraction in (0, 1 << 51, 1)]
    return [value | sign for value in values + nans for sign in (0, 1 << 63)]


def random_patterns(count: int, seed: int) -> list[int]:
    """Return random bit patterns, half of them with exponents that a binary32 nearly has."""
    numbers = random.Random(seed)
    found = []
    for _ in range(count // 2):
        found.append(numbers.getrandbits(64))
        exponent = numbers.randrange(0x360, 0x482)
        fraction = numbers.getrandbits(52) & ~((1 << numbers.randrange(52)) - 1)
        found.append(numbers.getrandbits(1) << 63 | exponent << 52 | fraction)
    return found


def expected(pattern: int) -> tuple[int, int]:
    """Return the bits of the nearest binary32, and of the binary64 that this one becomes.

    Hardware makes a signaling NaN quiet; here it stays what it is, with what fits of its payload.
    """
    if (pattern >> 52) & 0x7FF == 0x7FF and pattern & ((1 << 52) - 1):
        fraction = (pattern >> 29) & 0x7FFFFF
        narrow = (pattern >> 63) << 31 | 0xFF << 23 | (fraction or 1)
        return narrow, (pattern >> 63) << 63 | 0x7FF << 52 | (fraction or 1) << 29
    with np.errstate(all="ignore"):
        single = np.array([pattern], dtype=np.uint64).view(np.float64).astype(np.float32)
    return int(single.view(np.uint32)[0]), int(single.astype(np.float64).view(np.uint64)[0])


def is_quiet(bits: int) -> bool:
    """Return whether a NaN of binary32 is quiet."""
    return bool(bits & QUIET)


def _bits(value: float) -> int:
    return int(struct.unpack("<Q", struct.pack("<d", value))[0])
