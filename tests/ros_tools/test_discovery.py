# SPDX-License-Identifier: Apache-2.0
"""How long a command looks for a node: a busy machine, a graph that grows, and a name that arrives late."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import cast

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.ros.peer import Peer
from microros_gen.ros_tools.discovery import Discovery

GET_STATE = ("/arm/get_state", ("lifecycle_msgs/srv/GetState",))


class Watched:
    """A peer of which each turn takes `turn_s`, and whose graph has `/arm` after `turns`."""

    name = "/_command"

    def __init__(self, turn_s: float, turns: int, changes: bool = False) -> None:
        self.now = 100.0
        self.done = 0
        self._turn_s, self._turns, self._changes = turn_s, turns, changes
        self._callback: Callable[[], object] = lambda: None
        self.served: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def graph(self) -> Watched:
        return self

    def on_graph_change(self, callback: Callable[[], object]) -> None:
        self._callback = callback

    def spin_once(self, _timeout_s: float) -> bool:
        self.now += self._turn_s
        self.done += 1
        if self._changes:
            self._callback()
        return self._changes

    def nodes(self) -> tuple[str, ...]:
        return ("/_command", "/arm") if self.done >= self._turns else ("/_command",)

    def services(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        return self.served


def watching(watched: Watched, monkeypatch: pytest.MonkeyPatch) -> Discovery:
    monkeypatch.setattr(time, "monotonic", lambda: watched.now)
    return Discovery(cast(Peer, watched), 3.0)


def test_time_in_which_the_process_stood_still_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four turns of two seconds: there was no chance to discover anything in three seconds."""
    assert watching(Watched(2.0, 4), monkeypatch).has_node("/arm")


def test_a_graph_that_still_grows_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    assert watching(Watched(0.05, 100, changes=True), monkeypatch).has_node("/arm")
    assert not watching(Watched(0.05, 100), monkeypatch).has_node("/arm")


def test_a_search_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """After three times as long, whatever happens; in a quiet graph after the time that was asked for."""
    for watched, seconds in ((Watched(0.05, 10**6, changes=True), 9.0), (Watched(0.05, 10**6), 3.0)):
        found = watching(watched, monkeypatch)
        assert not found.has_node("/arm")
        assert watched.now - 100.0 == pytest.approx(seconds, abs=0.2)
    stuck = Watched(5.0, 10**6)
    assert not watching(stuck, monkeypatch).has_node("/arm")
    assert stuck.now - 100.0 <= 15.0


def test_a_service_of_a_node_proves_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The name of a node travels separately, and may come after what a command calls."""
    watched = Watched(0.05, 10**6)
    found = watching(watched, monkeypatch)
    watched.served = (GET_STATE,)
    found.require_node("/arm")
    watched.served = (("/arm/get_state", ("std_srvs/srv/Trigger",)),)
    with pytest.raises(UserError, match="unknown node"):
        found.require_node("/arm")
