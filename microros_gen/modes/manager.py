# SPDX-License-Identifier: Apache-2.0
"""What the proof takes a mode manager to do with requests and failures: commands, rules, repeated commands.

After each event the systems settle. Bottom up, a system that is not in its target applies one of its rules, which
changes its target and so commands its parts; then all begin again. Where no rule holds, nodes that were changed by
others are commanded to their target again. Of several rules that hold at once, the last one by name is applied: the
package system_modes applies all in this order, so that this one decides.

A node that is unconfigured stays so when it is commanded to be inactive: that counts as inactive.

A transition takes no time here: a node that can follow has reached its target when the next rule is looked for, so
that no rule sees a part on its way. The manager on ROS waits until no part is on its way, and then finds the same; what
it does with late, refusing and lost parts is simulated with its own decisions (mode_manager/simulation.py).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.modes.inference import Inference, fulfills
from microros_gen.modes.model import (
    ACTIVE,
    ERROR,
    UNCONFIGURED,
    Model,
    Part,
    Reported,
    Rule,
    Status,
    start_sequence,
)
from microros_gen.modes.recovery import History, extended, recovery_of
from microros_gen.records import dataclass

COMMAND, RULE, REPEAT, STATUS, OSCILLATION = "command", "rule", "repeat", "status", "oscillation"
RECOVERY = "recovery"
OSCILLATES = "oscillates: "
"""Begins the line of a step that is repeated forever."""


@dataclass(frozen=True)
class Step:
    """One step of a trace. `kind` is command, rule or recovery (name in `rule`), repeat, status or oscillation."""

    kind: str
    part: str
    status: Status
    rule: str = ""

    def __str__(self) -> str:
        if self.kind == RULE:
            return f"rule {self.rule}: {self.part} {self.status}"
        if self.kind == RECOVERY:
            return f"rule {self.rule}: {self.part} {self.status} again"
        if self.kind == OSCILLATION:
            return f"{OSCILLATES}{self.part} {self.status} again"
        return f"{self.kind} {self.part} {self.status}"


def rule_of(
    system: Part, target: Status | None, statuses: Mapping[str, Status], reported: Reported
) -> Rule | None:
    """Return the rule that changes the target of a system next; `statuses` are those of the system and its parts."""
    if target is None:
        return None
    is_reached = statuses[system.name].is_same(target)
    holding = [
        rule
        for rule in system.rules
        if rule.if_target.is_same(target) and rule.holds(statuses, reported, is_reached)
    ]
    return holding[-1] if holding else None


class Manager:
    """The targets of all parts and the status of each node; all nodes are unconfigured at first."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.targets: dict[str, Status] = {}
        self.nodes: dict[str, Status] = {node.name: Status(UNCONFIGURED) for node in model.nodes}
        self._inference = Inference(model)
        self._stuck: set[str] = set()
        self._reacted: set[str] = set()
        self._histories: dict[str, History] = {}
        self._reported: dict[str, dict[str, str]] = {}
        self._shown: Mapping[str, Status] = self.statuses()

    def statuses(self) -> Mapping[str, Status]:
        """Return the status of each part; that of systems is inferred."""
        return self._inference.infer_all(self.targets, {**self.nodes, **self._errors()})

    def request(self, part: str, target: Status) -> Iterator[Step]:
        """Command a part to be `target` and settle."""
        yield from self._command(self.model.parts[part], target, is_request=True)
        yield from self.settle()

    def fail(self, node: str, status: Status) -> Iterator[Step]:
        """Let a node be in `status`, where it stays whatever is commanded, and settle."""
        self._stuck.add(node)
        yield from self.change(node, status)

    def change(self, node: str, status: Status) -> Iterator[Step]:
        """Let a node be changed to `status` by somebody else, and settle.

        A contingency that it goes to by itself is left alone until it is back in its target, or was reset.
        """
        self.nodes[node] = status
        target = self.targets.get(node)
        if status.state == UNCONFIGURED or (target is not None and status.is_same(target)):
            self._reacted.discard(node)
        elif status.state == ACTIVE and status.mode in self.model.parts[node].contingencies:
            self._reacted.add(node)
        if status != self._shown.get(node):
            self._shown = {**self._shown, node: status}
            yield Step(STATUS, node, status)
        yield from self.settle()

    def diagnose(self, node: str, name: str, level: str) -> Iterator[Step]:
        """Let a status of a node on /diagnostics have a level from now on, and settle; `ok`: it is well.

        `name` is without that of the node. In place of a node, the key of what is no part (`outside`) can be given.
        """
        self._reported.setdefault(node, {})[name] = level
        yield from self.settle()

    def settle(self) -> Iterator[Step]:
        """Apply rules until none holds, command deviating nodes again, and say what changed."""
        known: set[object] = {self._snapshot()}
        while step := self._apply_rule():
            yield from step
            snapshot = self._snapshot()
            if snapshot in known:
                yield Step(OSCILLATION, step[0].part, step[0].status)
                break
            known.add(snapshot)
        yield from self._changes()

    def _apply_rule(self) -> list[Step]:
        """Return the steps of the rule that is applied next, else of repeated commands; empty: it is stable."""
        statuses = self.statuses()
        for system in self.model.systems:
            rule = rule_of(system, self.targets.get(system.name), statuses, self._reported)
            if rule is not None:
                step = Step(RULE, system.name, rule.new_target, rule.name)
                self._histories[system.name] = extended(self._histories.get(system.name, ()), rule)
                return [step, *self._command(system, rule.new_target, by_rule=True)]
            undone = recovery_of(self._histories.get(system.name, ()), statuses, self._reported)
            if undone is not None:
                self._histories[system.name] = self._histories[system.name][:-1]
                step = Step(RECOVERY, system.name, undone.if_target, undone.name)
                return [step, *self._command(system, undone.if_target, by_rule=True)]
        return list(self._repeat())

    def _errors(self) -> Mapping[str, Status]:
        """Return error processing for each node of which a status is an error."""
        levels = {node: self.model.parts[node].diagnostics for node in self._reported if node in self.nodes}
        return {
            node: Status(ERROR)
            for node, statuses in self._reported.items()
            if node in levels and any(levels[node].is_error(level, name) for name, level in statuses.items())
        }

    def _repeat(self) -> Iterator[Step]:
        for name, status in self.nodes.items():
            target = self.targets.get(name)
            if target is None or name in self._stuck or name in self._reacted:
                continue
            if not fulfills(status, target):
                self.nodes[name] = target
                yield Step(REPEAT, name, target)

    def _command(
        self, part: Part, target: Status, by_rule: bool = False, is_request: bool = False
    ) -> Iterator[Step]:
        """Set the target of a part and of all below it: first what is stopped, the last started one first.

        A node that went to a mode by itself stays there unless somebody requests another one, or a rule does.
        """
        stays = part.name in self._reacted and not is_request and self.targets.get(part.name) == target
        if stays:
            return
        self._reacted.discard(part.name)
        if not by_rule:
            self._histories.pop(part.name, None)
            if self.targets.get(part.name) == target and self.statuses()[part.name].is_same(target):
                return
            yield Step(COMMAND, part.name, target)
        self.targets[part.name] = target
        if not part.is_system:
            if part.name not in self._stuck and not fulfills(self.nodes[part.name], target):
                self.nodes[part.name] = target
            return
        sequence = start_sequence(part.part_names, part.start_after)
        commands = {name: self.model.command(part, target, name) for name in sequence}
        stopped = [name for name in reversed(sequence) if commands[name].state != ACTIVE]
        for name in [*stopped, *(name for name in sequence if name not in stopped)]:
            yield from self._command(self.model.parts[name], commands[name], is_request=is_request)

    def _snapshot(self) -> object:
        histories = ((name, tuple(r.name for r in h)) for name, h in self._histories.items() if h)
        targets = tuple(sorted(self.targets.items(), key=lambda i: i[0]))
        return targets, tuple(self.nodes.items()), tuple(sorted(histories)), tuple(sorted(self._reacted))

    def _changes(self) -> Iterator[Step]:
        """Yield the status of each part that is another one than before, parts before their systems."""
        statuses = self.statuses()
        for name in (*self.nodes, *(system.name for system in self.model.systems)):
            if statuses[name] != self._shown.get(name):
                yield Step(STATUS, name, statuses[name])
        self._shown = statuses
