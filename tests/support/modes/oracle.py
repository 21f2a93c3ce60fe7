# SPDX-License-Identifier: Apache-2.0
"""Systems as plain data, and where they end for a request and failures: found by trying, without the package."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import combinations, product
from types import MappingProxyType

DEFAULT = "active.__DEFAULT__"
STUCK = (
    "unknown",
    "unconfigured",
    "inactive",
    "finalized",
    "configuring",
    "cleaningup",
    "shuttingdown",
    "activating",
    "deactivating",
    "errorprocessing",
)
"""Where a node can stay without being active: the states of lifecycle_msgs/msg/State."""
NO_MODE = "active."
"""Active, with parameters of which no mode is."""


@dataclass(frozen=True)
class PlainRule:
    """Statuses are texts: `inactive`, `active.A`."""

    name: str
    if_target: str
    part: str
    status: str
    new_target: str
    recover: str = ""
    """`part status`: when the rule is undone."""
    wanted: str = ""
    """`level name`: the status of the part, a node, that it wants; `*` at the end of the name: any text."""


@dataclass(frozen=True)
class PlainSystem:
    """`modes`: mode → part → what it is commanded to be."""

    modes: Mapping[str, Mapping[str, str]]
    rules: tuple[PlainRule, ...]

    @property
    def parts(self) -> tuple[str, ...]:
        return tuple(self.modes["__DEFAULT__"])

    @property
    def targets(self) -> tuple[str, ...]:
        return ("inactive", *(f"active.{mode}" for mode in self.modes))


@dataclass(frozen=True)
class PlainModel:
    """`nodes`: node → its modes. The last system contains, or is, all others.

    `alike` are nodes of which all modes but the first have the same values.
    """

    nodes: Mapping[str, tuple[str, ...]]
    systems: Mapping[str, PlainSystem]
    alike: frozenset[str] = frozenset()

    def text(self) -> str:
        """Return the model as a file."""
        return "\n".join((*self._systems(), *self._nodes())) + "\n"

    def _systems(self) -> Iterator[str]:
        for name, system in self.systems.items():
            yield f"{name}:\n  ros__parameters:\n    type: system\n    parts:"
            yield from (f"      {part}" for part in system.parts)
            yield "    modes:"
            for mode, commands in system.modes.items():
                yield f"      {mode}:"
                yield from (f"        {part}: {command}" for part, command in commands.items())
            if system.rules:
                yield "    rules:"
            for rule in system.rules:
                yield f"      {rule.name}:\n        if_target: {rule.if_target}"
                yield f"        if_part: [{rule.part}, {rule.status}]"
                yield f"        new_target: {rule.new_target}"
                if rule.wanted:
                    level, wanted, *hardware = rule.wanted.split()
                    of = f", hardware: '{hardware[0]}'" if hardware else ""
                    yield f"        diagnostics: {{level: {level}, names: ['{wanted}']{of}}}"
                if rule.recover:
                    yield f"        recover_if: [{', '.join(rule.recover.split())}]"

    def _nodes(self) -> Iterator[str]:
        for name, modes in self.nodes.items():
            yield f"{name}:\n  ros__parameters:\n    type: node\n    modes:"
            for i, mode in enumerate(modes):
                level = min(i, 1) if name in self.alike else i
                yield f"      {mode}:\n        ros__parameters:\n          level: {level}"

    def failures(self) -> Iterator[dict[str, str]]:
        """Yield every combination of stuck nodes, the one without any first."""
        for states in product(*self._choices()):
            yield {node: state for node, state in zip(self.nodes, states, strict=True) if state}

    def failure(self, number: int) -> dict[str, str]:
        """Return one of the combinations of stuck nodes; they come again when `number` is above their count."""
        found = {}
        for node, choices in zip(self.nodes, self._choices(), strict=True):
            number, at = divmod(number, len(choices))
            found[node] = choices[at]
        return {node: state for node, state in found.items() if state}

    def _choices(self) -> list[tuple[str, ...]]:
        return [("", *STUCK, NO_MODE, *(f"active.{mode}" for mode in modes)) for modes in self.nodes.values()]


class OscillatesError(Exception):
    """The rules of the named system never end."""


Levels = Mapping[str, Mapping[str, str]]
"""Node, or `hardware ID` of what is no part → name of a status → its level."""


def settle(
    model: PlainModel,
    part: str,
    target: str,
    failures: Mapping[str, str],
    known: set[str] | None = None,
    levels: Levels = MappingProxyType({}),
    configured: set[str] | None = None,
) -> str:
    """Return the status that a part ends in; raises OscillatesError. `known` gets the targets that it has.

    `configured` are the nodes that are not unconfigured before, and gets those that are not in the end: one that is
    unconfigured and has to be inactive stays as it is.
    """
    configured = set() if configured is None else configured
    system = model.systems.get(part)
    if system is None:
        found = failures.get(part) or _follow(part, target, configured)
        return "errorprocessing" if "error" in levels.get(part, {}).values() else found
    known = set() if known is None else known
    passed: set[tuple[str, ...]] = set()
    way: list[tuple[str, PlainRule]] = []  # from which target each rule led on
    while True:
        known.add(target)
        place = (target, *(rule.name for _, rule in way), *sorted(configured))
        if place in passed:
            raise OscillatesError(part)
        passed.add(place)
        actual = {
            p: settle(model, p, _commanded(system, target, p), failures, None, levels, configured)
            for p in system.parts
        }
        status = _infer(system, target, actual)
        rule = _following(system, target, status, actual, levels)
        if rule is not None:
            way.append((target, rule))
            target = rule.new_target
            before = [start for start, _ in way]
            if target in before:
                del way[before.index(target) :]
        elif way and way[-1][1].recover and _is_over(way[-1][1], actual, levels):
            target = way.pop()[0]
        else:
            return status


def _follow(node: str, target: str, configured: set[str]) -> str:
    if target == "inactive":
        return "inactive" if node in configured else "unconfigured"
    (configured.discard if target == "unconfigured" else configured.add)(node)
    return target


def configurations(model: PlainModel, failures: Mapping[str, str]) -> Iterator[set[str]]:
    """Yield each combination of nodes, of those that are not stuck, that are configured before a request."""
    free = [node for node in model.nodes if node not in failures]
    for count in range(len(free) + 1):
        yield from map(set, combinations(free, count))


def _reports(rule: PlainRule, levels: Levels) -> bool:
    """Return whether the node of a rule, or what is no part, has the status that it wants."""
    level, wanted, *hardware = rule.wanted.split()
    enough = {"warn": ("warn", "error")}.get(level, (level,))
    owners = [f"hardware {hardware[0]}"] if hardware else [rule.part]
    return any(
        own in enough and fnmatchcase(name, wanted)
        for owner, statuses in levels.items()
        for name, own in statuses.items()
        if any(fnmatchcase(owner, each) for each in owners)
    )


def _is_over(rule: PlainRule, actual: Mapping[str, str], levels: Levels) -> bool:
    if rule.wanted and _reports(rule, levels):
        return False
    part, wanted = rule.recover.split()
    return actual[part] == wanted or (
        not wanted.startswith("active") and actual[part].split(".")[0] == wanted
    )


def _following(
    system: PlainSystem,
    target: str,
    status: str,
    actual: Mapping[str, str],
    levels: Levels = MappingProxyType({}),
) -> PlainRule | None:
    """Return the rule that holds."""
    holding = sorted(
        (rule.name, i)
        for i, rule in enumerate(system.rules)
        if rule.if_target == target
        and actual[rule.part].split(".")[0] == rule.status.split(".")[0]
        and (not rule.status.startswith("active.") or actual[rule.part] == rule.status)
        and (_reports(rule, levels) if rule.wanted else status != target)
    )
    return system.rules[holding[-1][1]] if holding else None


def reached(model: PlainModel, name: str, above: str) -> set[str]:
    """Return the targets that the system `name` has when `above` commands it, for some combination of failures."""
    parent = model.systems[above]
    found: set[str] = set()
    for target in {DEFAULT, *(_commanded(parent, target, name) for target in parent.targets)}:
        for failures in model.failures():
            for configured in configurations(model, failures):
                with suppress(OscillatesError):
                    settle(model, name, target, failures, found, {}, configured)
    return found


def looking_the_same(model: PlainModel, name: str) -> set[frozenset[str]]:
    """Return the pairs of modes of a system that some statuses of all nodes are both of."""
    modes = model.systems[name].modes
    wanted: dict[str, dict[str, str]] = {mode: {} for mode in modes}
    for mode, targets in wanted.items():
        _command(model, name, f"active.{mode}", targets)
    found = set()
    for statuses in model.failures():
        fitting = [mode for mode in modes if all(_fits(statuses, n, wanted[mode]) for n in model.nodes)]
        found |= {frozenset(pair) for pair in combinations(fitting, 2)}
    return found


def _fits(statuses: Mapping[str, str], node: str, wanted: Mapping[str, str]) -> bool:
    """Return whether a node is what is wanted; one of which nothing is wanted is."""
    target, actual = wanted.get(node), statuses.get(node)
    return target in (None, actual) or (target == "inactive" and actual == "unconfigured")


def reached_in_time(
    model: PlainModel, top: str, failures: Sequence[Mapping[str, str]]
) -> dict[str, set[str]]:
    """Return the targets that systems have while `top` is requested and failures follow each other in any order."""
    found: dict[str, set[str]] = {name: set() for name in model.systems}
    waiting: list[dict[str, str]] = []
    for target in model.systems[top].targets:
        waiting.append({})
        _command(model, top, target, waiting[-1])
    known = set()
    while waiting:
        targets = waiting.pop()
        if (state := tuple(sorted(targets.items()))) in known:
            continue
        known.add(state)
        for name, target in targets.items():
            found.get(name, set()).add(target)
        for stuck in failures:
            after = dict(targets)
            if _apply_one(model, after, stuck):
                waiting.append(after)
    return found


def _command(model: PlainModel, part: str, target: str, targets: dict[str, str]) -> None:
    targets[part] = target
    if part in model.systems:
        for below in model.systems[part].parts:
            _command(model, below, _commanded(model.systems[part], target, below), targets)


def _apply_one(model: PlainModel, targets: dict[str, str], failures: Mapping[str, str]) -> bool:
    """Apply the rule that holds in the lowest system."""
    actual = {node: failures.get(node, targets[node]) for node in model.nodes}
    for name, system in model.systems.items():
        actual[name] = _infer(system, targets[name], {part: actual[part] for part in system.parts})
        following = _following(system, targets[name], actual[name], actual)
        if following is not None:
            _command(model, name, following.new_target, targets)
            return True
    return False


def _commanded(system: PlainSystem, target: str, part: str) -> str:
    if target == "inactive":
        return "inactive"
    command = system.modes[target.removeprefix("active.")].get(part, system.modes["__DEFAULT__"][part])
    return DEFAULT if command == "active" else command


def _infer(system: PlainSystem, target: str, actual: Mapping[str, str]) -> str:
    if "errorprocessing" in actual.values():
        return "errorprocessing"
    if target == "inactive":
        resting = set(actual.values()) <= {"inactive", "unconfigured"}
        return "inactive" if resting else "deactivating"
    wanted = {part: _commanded(system, target, part) for part in system.parts}
    if all(actual[p] == w or (w == "inactive" and actual[p] == "unconfigured") for p, w in wanted.items()):
        return target
    for mode in sorted(system.modes):
        if all(actual[p] == _commanded(system, f"active.{mode}", p) for p in system.parts):
            return f"activating.{mode}"
    return "activating"
