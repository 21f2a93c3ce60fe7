# SPDX-License-Identifier: Apache-2.0
"""Brings the parts of a scope to their targets, in start order, and applies rules. No ROS, and the clock is given.

Each part has at most one call at a time. What a part does next follows from what is known of it and from its target
alone, so that lost responses, restarts and changes by others are no special cases. A part that cannot get its
target fails after some attempts; then, when no part of its system is on its way, the system's rules decide.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from microros_gen.mode_manager.adoption import adopted
from microros_gen.mode_manager.announcing import announce_request, changes
from microros_gen.mode_manager.calls import Announcement, Call, Kind, Link, Values
from microros_gen.mode_manager.commander import Commander
from microros_gen.mode_manager.contingency import await_reaction, note_reaction
from microros_gen.mode_manager.degrading import Degrading
from microros_gen.mode_manager.diagnosed import Diagnosed
from microros_gen.mode_manager.hearing import (
    SILENT,
    hear_link,
    hear_mode,
    hear_parameters,
    hear_refusal,
    hear_silence,
    hear_state,
    hear_success,
)
from microros_gen.mode_manager.knowledge import Knowledge
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.parent_values import refusal_of
from microros_gen.mode_manager.progress import Progress
from microros_gen.mode_manager.reports import Reports
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.targets import spread
from microros_gen.modes.model import (
    ACTIVE,
    ERROR,
    INACTIVE,
    UNCONFIGURED,
    UNKNOWN,
    Model,
    Part,
    Scalar,
    Status,
)

_NOT_THERE = "it is not there"


class Orchestrator:
    """Not thread-safe. Call `turn` after each event and when time has passed; it returns the calls to be sent."""

    def __init__(
        self,
        model: Model,
        scope: Scope,
        clock: Callable[[], float],
        settings: Settings | None = None,
        log: Callable[[str], object] = lambda _: None,
    ) -> None:
        """`clock` gives seconds and never goes back; `log` gets a line about each failure, rule and deviation."""
        self.model = model
        self.scope = scope
        self.settings = settings or Settings()
        self.targets: dict[str, Status] = {}
        repeat_s = self.settings.repeat_s
        self.leaves = {part.name: Leaf(part, reports=Reports(repeat_s)) for part in scope.leaves}
        self._clock = clock
        self._log = log
        self._knowledge = Knowledge(model, self.targets)
        self._started = clock()
        self._adopted = False
        self._parent_values: dict[str, Values] = {}
        self._announced: list[Announcement] = []
        self.progress = Progress(model, scope, self.leaves, self.targets, self.status)
        self._degrading = Degrading(model, self.settings, log)
        self._commander = Commander(self._knowledge, self.progress, self.settings, log)
        self._shown: Mapping[str, Status] = self.statuses()
        self.diagnosed = Diagnosed(scope, self.leaves, clock, log, repeat_s)
        """What /diagnostics has of the parts. For inference and rules, a part with an error is in error processing;
        commands to it go on."""

    @property
    def rules(self) -> Mapping[str, str]:
        """Return the rule that was applied last to each system since the last request, as far as it is not over."""
        return self._degrading.rules

    def cause(self, system: str) -> str:
        """Return the status on /diagnostics for which the rule of a system was applied; empty: for none."""
        return self._degrading.cause(system)

    @property
    def oscillating(self) -> Collection[str]:
        """Return the systems whose rules do not end."""
        return self._degrading.oscillating

    # What happens

    def request(self, name: str, target: Status, must_configure: bool = False) -> None:
        """Command a part to be `target`. `must_configure`: unconfigured nodes do not count as inactive."""
        self._degrading.request()
        self._set_target(self.model.parts[name], target, must_configure)

    def clean_up(self, name: str) -> None:
        """Command all nodes of a system to be unconfigured; the system is inactive then."""
        self.request(name, Status(INACTIVE))
        for leaf in self.leaves.values():
            if (
                leaf.target is not None
                and name in self.progress.systems_of(leaf.name)
                and leaf.link is not Link.SYSTEM
            ):
                leaf.target = self.targets[leaf.name] = Status(UNCONFIGURED)

    def parent_values(self, system: str) -> Values:
        """Return the values that another manager has set for a system whose parent it manages, by their names there."""
        return self._parent_values.get(system, {})

    def set_parent_values(self, system: str, values: Values) -> str:
        """Take such values, all or none; return why they are refused, empty: they are not."""
        reason = refusal_of(self.model, system, values)
        if reason:
            return reason
        self._parent_values[system] = {**self.parent_values(system), **values}
        self._knowledge.set_parent_values(system, self._parent_values[system])
        self._degrading.change()
        self._adopted = self._adopted and system in self.targets
        for leaf in self.progress.below(system):
            if (
                leaf.inherited
                and leaf.link is not Link.ABSENT
                and leaf.failure != SILENT
                and not leaf.reaction
            ):
                leaf.failure, leaf.attempts = "", 0
        return ""

    def link(self, name: str, link: Link, serves_parameters: bool = False) -> None:
        """Note how a leaf is reached from now on; `serves_parameters`: one with mode services does so, too."""
        leaf = self.leaves[name]
        if (link, serves_parameters) == (leaf.link, leaf.serves_parameters):
            return
        if link is Link.ABSENT:
            self._log(f"{name}: it has left")
        before = leaf.link
        hear_link(leaf, link, serves_parameters)
        self.diagnosed.link(leaf, before)
        if link in (Link.MODES, Link.SYSTEM) and leaf.inherited and not serves_parameters:
            names = ", ".join(leaf.inherited)
            self._log(f"{name}: it serves no parameters, and does not get {names} of its parent")
        leaf.failure = _NOT_THERE if link is Link.ABSENT else ""
        leaf.attempts = 0
        if leaf.has_reached and link is not Link.ABSENT:
            self._deviate(leaf)
            leaf.deviates = False  # it gets its target first; rules decide if it cannot

    def hear_state(self, name: str, state: str) -> None:
        """Note the goal of a transition event."""
        self._hear(name, lambda leaf, now: hear_state(leaf, state, now, self.settings, True))

    def hear_mode(self, name: str, mode: str) -> None:
        """Note the goal of a mode event of a part with mode services."""
        self._hear(name, lambda leaf, now: hear_mode(leaf, mode, now, self.settings, True))

    def hear_parameters(self, name: str, values: Mapping[str, Scalar | tuple[Scalar, ...] | None]) -> None:
        """Note a parameter event; None: the parameter was deleted."""
        self._hear(name, lambda leaf, now: hear_parameters(leaf, values, now, self.settings, True))

    def answer(self, call: Call, success: bool, reason: str = "", **facts: object) -> None:
        """Note a response. `facts` of a query: state, mode, or values."""
        leaf = self.leaves[call.part]
        if leaf.call is None or leaf.call.number != call.number:
            return
        leaf.call, leaf.unanswered, now = None, 0, self._clock()
        if call.kind in (Kind.GET_STATE, Kind.GET_MODE, Kind.GET_PARAMETERS):
            self._hear(call.part, lambda known, at: self._query(known, call, at, success, facts))
            if call.kind is Kind.GET_MODE and leaf.settle_until and self.status(leaf) == Status(ACTIVE):
                self._begin_again(leaf)
            return
        leaf.commanded = now
        if success:
            hear_success(leaf, call, now, self.settings)
            if leaf.is_settled(self.status(leaf)):
                leaf.attempts = 0
                if leaf.link is Link.SYSTEM and call.kind is Kind.SET_PARAMETERS:
                    leaf.settle_until = (
                        now + self.settings.system_s
                    )  # its parts get other values in the same mode
        else:
            hear_refusal(leaf, call, reason, now, self.settings)
            self._log(f"{call.part}: {leaf.failure or f'refused {call} {reason}'.rstrip()}")

    # What follows

    def turn(self) -> list[Call]:
        """Return the calls that are due now."""
        now = self._clock()
        self.diagnosed.step()
        for leaf in self.leaves.values():
            self._expire(leaf, now)
            leaf.has_reached |= leaf.target is not None and leaf.is_settled(self.status(leaf))
        self._adopt(now)
        self._settle()
        calls = [
            call for leaf in self.leaves.values() if (call := self._commander.next(leaf, now)) is not None
        ]
        statuses = self.statuses()
        self._announced += changes(self.leaves, self._shown, statuses)
        self._shown = statuses
        return calls

    def announcements(self) -> list[Announcement]:
        """Return what is to be published since the last call."""
        announced, self._announced = self._announced, []
        return announced

    def statuses(self) -> dict[str, Status]:
        """Return the status of each part of the scope; a part with a known problem is in error processing."""
        found = {n: Status(ERROR) if leaf.problem else self.status(leaf) for n, leaf in self.leaves.items()}
        for system in self.scope.systems:
            found[system.name] = self._knowledge.infer_system(system, found)
        return found

    def status(self, leaf: Leaf) -> Status:
        """Return the status of a leaf as it was last known."""
        return self._knowledge.status(leaf)

    # Inside

    def _hear(self, name: str, take: Callable[[Leaf, float], object]) -> None:
        """Take something that is known of a leaf; find out whether somebody else changed it."""
        leaf = self.leaves[name]
        if leaf.link is Link.ABSENT:
            return
        before, was_settled = self.status(leaf), leaf.is_settled(self.status(leaf))
        failure = leaf.failure
        take(leaf, self._clock())
        after = self.status(leaf)
        reaction = note_reaction(leaf, before, after, was_settled)
        if reaction:
            self._degrading.change()
            if reaction != failure:
                self._log(f"{name}: {reaction}")
            return
        if leaf.target is None or after == before or leaf.is_settled(after):
            if leaf.is_settled(after) and leaf.failure != SILENT:
                leaf.failure, leaf.deviates, leaf.settle_until, leaf.reaction = "", False, 0.0, ""
            return
        if leaf.link is Link.SYSTEM and _has_no_target(after) and (was_settled or leaf.settle_until):
            if was_settled or after.state != ACTIVE:  # its events arrive one by one: state, then mode
                self._begin_again(leaf)
        elif was_settled and leaf.link is Link.SYSTEM and (leaf.settle_until or leaf.is_commanded):
            return
        elif was_settled and leaf.link is Link.SYSTEM:
            leaf.failure = f"it left {leaf.target} for {after} by itself"
            self._log(f"{name}: {leaf.failure}")
        elif (was_settled and before.state != UNKNOWN) or self._is_foreign(leaf):
            self._log(f"{name}: others changed it from {before} to {after}")
            self._deviate(leaf)
            await_reaction(leaf, after, self._clock(), self.settings)

    def _begin_again(self, leaf: Leaf) -> None:
        """Command a system whose manager was started again, and knows neither its target nor values of its parent."""
        self._log(f"{leaf.name}: its manager was started again")
        leaf.settle_until = 0.0
        leaf.values.clear()
        leaf.stale |= leaf.queries
        self._deviate(leaf)
        leaf.deviates = False  # it gets its target first; rules decide if it cannot

    def _is_foreign(self, leaf: Leaf) -> bool:
        """Return whether a failed leaf changed although nothing was commanded.

        One that reacts to an error changes as it likes, until it is unconfigured: it was reset.
        """
        if leaf.reaction and self.status(leaf).state != UNCONFIGURED:
            return False
        return bool(leaf.failure) and self._clock() - leaf.commanded >= self.settings.grace_s

    def _deviate(self, leaf: Leaf) -> None:
        """Command a leaf to its target again if no rule decides otherwise; not again and again."""
        now = self._clock()
        since = now - self.settings.window_s
        leaf.deviations = [*(t for t in leaf.deviations if t > since), now]
        leaf.attempts, leaf.failure = 0, ""
        if len(leaf.deviations) > self.settings.attempts:
            leaf.failure = "others change it again and again"
            self._log(f"{leaf.name}: {leaf.failure}")
            return
        self._degrading.change()
        leaf.deviates = not leaf.is_settled(self.status(leaf))

    def _query(self, leaf: Leaf, call: Call, now: float, success: bool, facts: Mapping[str, object]) -> None:
        leaf.stale.discard(call.kind)
        if leaf.failure == SILENT:
            leaf.failure, leaf.attempts = "", 0
        if not success:
            return
        if call.kind is Kind.GET_STATE:
            hear_state(leaf, str(facts["state"]), now, self.settings, False)
        elif call.kind is Kind.GET_MODE:
            hear_mode(leaf, str(facts["mode"]), now, self.settings, False)
        else:
            values = facts["values"]
            assert isinstance(values, Mapping)
            hear_parameters(leaf, values, now, self.settings, False)
            byte_arrays = facts.get("byte_arrays", ())
            assert isinstance(byte_arrays, (list, tuple))
            leaf.byte_arrays = set(byte_arrays)

    def _expire(self, leaf: Leaf, now: float) -> None:
        call = leaf.call
        if leaf.link is Link.ABSENT and now - self._started >= self.settings.start_s:
            leaf.failure = _NOT_THERE
        if call is not None and now >= leaf.late_at:
            leaf.call = None
            before = leaf.failure
            hear_silence(leaf, call, now, self.settings)
            if leaf.failure and leaf.failure != before:
                self._log(f"{leaf.name}: {leaf.failure}")
        if leaf.settle_until and now >= leaf.settle_until:
            leaf.settle_until = 0.0
            leaf.failure = "it does not get its target in time"
            self._log(f"{leaf.name}: {leaf.failure}")

    def _adopt(self, now: float) -> None:
        """Take over the modes that systems are in when the manager starts."""
        if self._adopted:
            return
        age_s = now - self._started
        is_known = all(leaf.state != UNKNOWN and not leaf.stale for leaf in self.leaves.values())
        if not is_known and age_s < self.settings.start_s:
            return
        self._adopted = is_known or age_s >= self.settings.adopt_s
        for targets in adopted(self.model, self.scope, self.leaves, self._knowledge):
            if any(name in self.targets for name in targets):
                continue  # somebody has requested something meanwhile
            self.targets.update(targets)
            for name in targets.keys() & self.leaves.keys():
                self.leaves[name].target = targets[name]
            top = next(iter(targets))
            self._log(f"{top}: it is {targets[top]}, and stays so")

    def _settle(self) -> None:
        """Apply rules bottom up; where none holds, command again what others changed."""
        for system in self.scope.systems:
            if self.progress.is_moving(system.name) or system.name in self._degrading.oscillating:
                continue
            target, now = self.targets.get(system.name), self._clock()
            goal = self._degrading.next(system, target, self.statuses(), self.diagnosed.reported, now)
            if goal is not None:
                self._set_target(system, goal, by_rule=True)
        for leaf in self.leaves.values():
            is_known = leaf.call is None and not leaf.stale
            if (
                leaf.deviates
                and is_known
                and not any(self.progress.is_moving(name) for name in self.progress.systems_of(leaf.name))
            ):
                leaf.deviates = False
                leaf.retries += 1

    def _set_target(
        self, part: Part, target: Status, must_configure: bool = False, by_rule: bool = False
    ) -> None:
        statuses = self.statuses()
        for below, goal in spread(self.model, self.scope, part, target):
            if not self.scope.is_external(below.name):
                self._announced += announce_request(below.name, statuses[below.name], goal)
            self.targets[below.name] = goal
            if below is not part or not by_rule:
                self._degrading.command(below.name)
            leaf = self.leaves.get(below.name)
            if leaf is not None and not (by_rule and leaf.reaction and leaf.target == goal):
                leaf.begin(goal, must_configure, by_rule)
                if leaf.link is not Link.ABSENT and leaf.failure != SILENT:
                    leaf.failure = ""


def _has_no_target(system: Status) -> bool:
    """Return whether the manager of a system has no target for it; with one, it is never in any of these."""
    return system.state in (UNKNOWN, UNCONFIGURED) or system == Status(ACTIVE)
