# SPDX-License-Identifier: Apache-2.0
"""The statuses of one part on /diagnostics: levels as rules want them, and errors of the part."""

from __future__ import annotations

REPEAT_S = 5.0
"""Default of the seconds after which a status that was not repeated does not count: one of a part that was away and is
back is forgotten, one of no part is stale. diagnostic_aggregator has the same default (`timeout`)."""


class Reports:
    """`levels` has the level of each status by its name without that of the part; empty: it is OK.

    What a part reported before it left still counts when it is back, until it says otherwise. So a rule is not over
    because a board has lost its agent for a moment. While the part is away, its state is unknown: an error from before
    does not hide that.
    """

    def __init__(self, repeat_s: float = REPEAT_S) -> None:
        """Begin with nothing; `repeat_s` is the time in which each status is repeated, seconds."""
        self._repeat_s = repeat_s
        self.levels: dict[str, str] = {}
        self._errors: dict[str, str] = {}
        self._unconfirmed: set[str] = set()
        self._is_away = False
        self._until = 0.0

    @property
    def error(self) -> str:
        """Return the text of the first error that counts; empty: no error counts."""
        return self.confirmed_error if self._is_away else next(iter(self._errors.values()), "")

    @property
    def confirmed_error(self) -> str:
        """Return the same of errors that were reported since the part left or came back."""
        return next((text for name, text in self._errors.items() if name not in self._unconfirmed), "")

    def hear(self, name: str, level: str, error: str = "") -> None:
        """Note a status. `error`: why it is an error of the part; empty: it is none."""
        if level or name in self.levels:  # one that is always OK says nothing to a rule
            self.levels[name] = level
        self._errors.pop(name, None)
        if error:
            self._errors[name] = error
        self._unconfirmed.discard(name)

    def leave(self) -> None:
        """Note that the part is not there any more."""
        self._is_away = True
        self._unconfirmed = {*self.levels, *self._errors}

    def arrive(self, now: float) -> None:
        """Note that the part is there; `now` in seconds."""
        self._is_away = False
        self._unconfirmed = {*self.levels, *self._errors}
        self._until = now + self._repeat_s

    def step(self, now: float) -> None:
        """Forget what was not repeated; `now` in seconds."""
        if self._is_away or not self._unconfirmed or now < self._until:
            return
        for name in self._unconfirmed:
            self.levels.pop(name, None)
            self._errors.pop(name, None)
        self._unconfirmed.clear()
