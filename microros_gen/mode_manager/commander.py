# SPDX-License-Identifier: Apache-2.0
"""The next call to each leaf: queries first, then one command on the way to its target."""

from __future__ import annotations

from collections.abc import Callable

from microros_gen.mode_manager.calls import DEACTIVATE, Call, Kind, Link, Values
from microros_gen.mode_manager.hearing import expect
from microros_gen.mode_manager.knowledge import Knowledge
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.progress import Progress
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import ACTIVE, Status


class Commander:
    """Numbers the calls of one manager."""

    def __init__(
        self, knowledge: Knowledge, progress: Progress, settings: Settings, log: Callable[[str], object]
    ) -> None:
        """`log` gets a line about each part that cannot go on."""
        self._knowledge = knowledge
        self._progress = progress
        self._settings = settings
        self._log = log
        self._number = 0

    def next(self, leaf: Leaf, now: float) -> Call | None:
        """Return the call that is due; None: nothing is due, or a call is not answered yet."""
        if leaf.link is Link.ABSENT or leaf.call is not None or now < leaf.wait_until:
            return None
        status = self._knowledge.status(leaf)
        lacks_values = self._knowledge.lacks_values(leaf)
        is_settling = bool(leaf.settle_until) and not lacks_values
        is_done = bool(leaf.failure) or (leaf.is_settled(status) and not lacks_values)
        is_waiting = is_done or is_settling or bool(self._progress.blocker(leaf.name))
        self._doubt(leaf, now, is_waiting)
        for kind in Kind:
            if kind in leaf.stale:
                return self._call(leaf, now, kind)
        if is_waiting or self._is_passing(leaf, status, now) or leaf.deviates:
            return None
        wanted = self._knowledge.wanted(leaf)
        step = leaf.step(status, wanted, leaf.name in self._settings.reconfigured)
        if isinstance(step, str):
            leaf.failure = step
            self._log(f"{leaf.name}: {step}")
            return None
        kind, transition, mode, values = step
        assert leaf.target is not None
        leaf.reconfigures |= transition == DEACTIVATE and leaf.target.state == ACTIVE
        return self._call(leaf, now, kind, transition, mode, values)

    def _doubt(self, leaf: Leaf, now: float, is_waiting: bool) -> None:
        """Let a leaf that is not commanded be asked what it is, now and then and after doubtful events.

        All queries of a round come before the next round, however long the responses take.
        """
        interval_s = self._settings.pause_s if leaf.settle_until else self._settings.poll_s
        if is_waiting and not leaf.stale and now - leaf.polled >= interval_s:
            leaf.polled = now
            leaf.stale |= leaf.queries
        if (is_waiting or leaf.deviates) and leaf.doubts:
            leaf.stale |= leaf.doubts
            leaf.doubts.clear()

    def _is_passing(self, leaf: Leaf, status: Status, now: float) -> bool:
        """Return whether a node is between two states; if it stays there, it fails."""
        if not leaf.is_passing(status):
            leaf.passing_since = 0.0
            return False
        leaf.passing_since = leaf.passing_since or now
        leaf.stale.add(Kind.GET_STATE)
        leaf.wait_until = now + self._settings.pause_s
        if now - leaf.passing_since > self._settings.attempts * self._settings.call_s:
            leaf.failure = f"it stays {status.state}"
            self._log(f"{leaf.name}: {leaf.failure}")
        return True

    def _call(
        self,
        leaf: Leaf,
        now: float,
        kind: Kind,
        transition: int = 0,
        mode: str = "",
        values: Values | None = None,
    ) -> Call:
        self._number += 1
        call = Call(self._number, leaf.name, kind, transition, mode, values or {})
        leaf.call, leaf.late_at = call, now + self._settings.call_s
        if now - leaf.commanded >= self._settings.grace_s:
            leaf.expected.clear()
        expect(leaf, call)
        return call
