# SPDX-License-Identifier: Apache-2.0
"""The places for clients in session: whether one is free, and who gives one up."""

from __future__ import annotations

from collections.abc import Callable

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.limits import Limits
from microros_gen.agent.newcomers import who_gives_way

SILENT_PART = 0.75
"""Fraction of the time-out: a client that was silent for so long, despite a probe, may lose its place."""


class Places:
    """As many as `clients` of the limits, while the agent has memory."""

    def __init__(
        self, clients: ClientTable, limits: Limits, budgets: Budgets, dismiss: Callable[[Client, str], None]
    ) -> None:
        """`dismiss` removes a client for the reason in a text."""
        self._clients = clients
        self._limits = limits
        self._budgets = budgets
        self._dismiss = dismiss

    def has_room(self, now: float) -> bool:
        """Return whether a place is free, or a client can be replaced."""
        return not (self._budgets.gate.closed or (self._full and self._who_gives_way(now) is None))

    def make_room(self, now: float) -> bool:
        """Free a place if necessary; return whether one is free."""
        if not self.has_room(now):
            return False
        if self._full and (found := self._who_gives_way(now)):
            self._dismiss(found, "forgotten: its place is needed")
        return True

    @property
    def _full(self) -> bool:
        return len(self._clients) >= self._limits.clients

    def _who_gives_way(self, now: float) -> Client | None:
        return who_gives_way(self._clients, now, self._limits.client_timeout_s * SILENT_PART)
