# SPDX-License-Identifier: Apache-2.0
"""Statuses on /diagnostics of what is no part of the model, as far as a rule wants them."""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.mode_manager.reports import REPEAT_S
from microros_gen.modes.model import STALE_LEVEL, Rule, outside

MOST = 1000
"""Statuses that are kept; with more, the one that was not repeated for the longest time is forgotten."""


class Outside:
    """Keeps `levels` true: hardware → name of a status → its level.

    A status that is not repeated is stale. Its publisher has no node that the manager knows, so that nothing else says
    whether it is still there.
    """

    def __init__(
        self, rules: Iterable[Rule], levels: dict[str, dict[str, str]], repeat_s: float = REPEAT_S
    ) -> None:
        """`rules` say which statuses count; each is repeated within `repeat_s` seconds."""
        self._repeat_s = repeat_s
        wanted = (rule.diagnostics for rule in rules)
        self._wanted = [each for each in wanted if each is not None and each.hardware]
        self._levels = levels
        self._received: dict[tuple[str, str], float] = {}

    def hear(self, hardware: str, name: str, level: str, now: float) -> None:
        """Note a status; `level` is empty: it is OK. `now` in seconds."""
        if not any(each.is_about(outside(hardware), name) for each in self._wanted):
            return
        self._received.pop((hardware, name), None)
        self._received[hardware, name] = now
        self._levels.setdefault(outside(hardware), {})[name] = level
        if len(self._received) > MOST:
            self._forget(*next(iter(self._received)))

    def step(self, now: float) -> None:
        """Note that time has passed; the statuses are in the order of their last repetition."""
        for (hardware, name), received in self._received.items():
            if now - received < self._repeat_s:
                break
            self._levels[outside(hardware)][name] = STALE_LEVEL

    def _forget(self, hardware: str, name: str) -> None:
        del self._received[hardware, name]
        key = outside(hardware)
        del self._levels[key][name]
        if not self._levels[key]:
            del self._levels[key]
