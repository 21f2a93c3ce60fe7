# SPDX-License-Identifier: Apache-2.0
"""The levels of the statuses of one part on /diagnostics, as rules want them."""

from __future__ import annotations

REPEAT_S = 5.0
"""A part that was away repeats its statuses by then; the others are not there any more."""


class Reports:
    """`levels` has the level of each status by its name without that of the part; empty: it is OK.

    What a part reported before it left still counts when it is back, until it says otherwise. So a rule is not over
    because a board has lost its agent for a moment.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        self.levels: dict[str, str] = {}
        self._unconfirmed: set[str] = set()
        self._until = 0.0

    def hear(self, name: str, level: str) -> None:
        """Note a status."""
        if level or name in self.levels:  # one that is always OK says nothing to a rule
            self.levels[name] = level
        self._unconfirmed.discard(name)

    def step(self, now: float, is_absent: bool) -> None:
        """Forget what was not repeated; `now` in seconds, `is_absent`: the part is not there."""
        if is_absent:
            self._unconfirmed = set(self.levels)
            self._until = now + REPEAT_S
        elif self._unconfirmed and now >= self._until:
            for name in self._unconfirmed:
                del self.levels[name]
            self._unconfirmed.clear()
