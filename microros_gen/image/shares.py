# SPDX-License-Identifier: Apache-2.0
"""Parts of a path that have a total: loops, and calls, of which one call of a function has so many rounds in all.

A loop within a loop has as many rounds as both numbers multiplied, unless something that is used up bounds them
together, such as the room of a text that each round puts a character into. Then the sum counts and not the product: all
rounds take as long as that many of the longest one (Cormen et al., "Introduction to Algorithms", aggregate analysis).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from microros_gen.records import dataclass

HOLD = "a hold of the lock"
"""The scope of a total that holds for the whole of it."""


@dataclass(frozen=True)
class Total:
    """Rounds that count together, as `key`: `most` in each call of any function of `scopes`, or in HOLD."""

    scopes: tuple[str, ...]
    key: str
    most: int


@dataclass(frozen=True)
class Split:
    """A length in parts: `base` without what has a total, and the length of all rounds of each total."""

    base: int
    parts: Mapping[str, int]

    @property
    def length(self) -> int:
        """Return all of it, where each total counts once."""
        return self.base + sum(self.parts.values())


Shares = Mapping[str, Split]
"""By the scope of the totals. In a scope that it lacks a length has no parts."""
NONE: Shares = {}


def joined(counts: tuple[int, int], shares: tuple[Shares, Shares], join: Callable[[int, int], int]) -> Shares:
    """Return those of two lengths, one after the other (`join`: their sum) or one of them (`max`).

    Each part is the total of its rounds already: both lengths together have no more of them.
    """
    if not shares[0] and not shares[1]:
        return NONE
    found: dict[str, Split] = {}
    for scope in {**shares[0], **shares[1]}:
        left, right = (each.get(scope, Split(n, {})) for n, each in zip(counts, shares, strict=True))
        parts = {k: max(left.parts.get(k, 0), right.parts.get(k, 0)) for k in {**left.parts, **right.parts}}
        found[scope] = Split(join(left.base, right.base), parts)
    return found


def repeated(count: int, shares: Shares, rounds: int, total: Total | None) -> Shares:
    """Return those of so many rounds of a length, of which there are `total.most` in its scope."""
    found = {scope: Split(split.base * rounds, split.parts) for scope, split in shares.items()}
    if total is None:
        return found
    for scope in total.scopes:
        split = shares.get(scope, Split(count, {}))
        longest = max(split.base * total.most, split.parts.get(total.key, 0))
        found[scope] = Split(0, {**split.parts, total.key: longest})
    return found
