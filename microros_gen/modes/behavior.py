# SPDX-License-Identifier: Apache-2.0
"""Where the systems of a model end for every combination of failed nodes, computed system by system.

A node follows its commands, or it is stuck: in a state of the life cycle, on the way between two of them, or active in
one of its modes or in none. Seen from its
system, a part is therefore a function from commands to statuses, a *behavior*; a subsystem has one for each
combination of failures below it, and many combinations have the same. A part belongs to one system, so the behaviors
of the parts of a system are independent of each other.

Besides, the statuses of a node on /diagnostics have levels, which rules of its system can want (`reports`). Statuses of
no part are taken as those of one more part, which every system has for itself.

The combinations of a system are not enumerated. Its parts are taken one after another. Of the parts so far these facts
are kept for each target of the system: whether one is in error processing, whether one is not what is commanded, which
rule holds (the last one by name; separately of those that want diagnostics, which hold in the target, too), and which
other modes fit. Combinations that are equal in these stay equal whatever
follows. At the end they say for each target which rule is next, or is undone (`recovery`): a cycle of targets is an
oscillation.

That proves more than requests: whatever happened before, the first rule that is applied commands all parts of its
system again, and from there on the functions above say what follows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from microros_gen.modes.inference import fulfills
from microros_gen.modes.model import (
    ACTIVATING,
    ACTIVE,
    DEACTIVATING,
    ERROR,
    INACTIVE,
    STATES,
    UNCONFIGURED,
    UNKNOWN,
    Model,
    Part,
    Status,
    active,
)
from microros_gen.modes.reports import Diagnosis, outside_reports, reports_of
from microros_gen.records import dataclass

Failures = tuple[tuple[str, Status | Diagnosis], ...]
"""The nodes that are stuck, and where; and the statuses of nodes that are not OK."""

Behaviors = dict[tuple[Status, ...], Failures]
"""For each target of a part in `targets_of` order what it ends in, with the fewest failures that this takes."""

_Led = Mapping[Status, frozenset[Status]]

_Seen = tuple[bool, bool, int, int, int, int, int, int]
"""Error processing, deviates, the index of the rule that holds or -1, that of one with diagnostics; as bits: the modes
that fit, the rules whose part in `recover_if` is well, those that the diagnostics of another part or of no part keep,
and those that hold if statuses of no part do."""


@dataclass(frozen=True)
class Oscillation:
    """A system whose target never settles: the request and the failures that lead there, and the rules of the cycle."""

    system: str
    request: Status
    failures: Failures
    rules: tuple[str, ...]


@dataclass(frozen=True)
class Settled:
    """What is known of all systems. `open`: those with too many combinations; `kept`: how many different ones exist.

    `led` has for each target of a system the targets that rules lead to from there, each for some combination of
    failures. Open systems are not in it, nor those above one that oscillates.
    """

    oscillations: tuple[Oscillation, ...]
    open: tuple[str, ...]
    kept: int
    led: Mapping[str, _Led]


_WORK = 64
"""How many pairs of combinations and behaviors are looked at, for each combination that may be kept."""


class _TooManyError(Exception):
    """More different combinations than allowed."""


def failure_states(node: Part) -> tuple[Status, ...]:
    """Return where a node can be stuck: in each state, those between two others included, and active in no mode."""
    resting = (Status(state) for state in STATES if state != ACTIVE)
    return (*resting, *map(active, node.modes), Status(ACTIVE))


def targets_of(model: Model, part: Part) -> tuple[Status, ...]:
    """Return everything that a part can be commanded to be, in a fixed order."""
    if part.is_system:
        return model.targets(part)
    return (Status(UNCONFIGURED), Status(INACTIVE), *map(active, part.modes))


def every_failure(model: Model, node: Part) -> Behaviors:
    """Return what a node ends in for each target: it follows, or is stuck in one status."""
    targets = targets_of(model, node)
    stuck = {(status,) * len(targets): ((node.name, status),) for status in failure_states(node)}
    return {targets: (), **stuck}


def settle_all(
    model: Model, most: int, of_node: Callable[[Model, Part], Behaviors] = every_failure
) -> Settled:
    """Return what is known of all systems; one with more than `most` different combinations stays open.

    `of_node` says what a node can end in.
    """
    behaviors: dict[str, Behaviors] = {node.name: of_node(model, node) for node in model.nodes}
    oscillations: list[Oscillation] = []
    unproven: list[str] = []
    led: dict[str, _Led] = {}
    vague: set[str] = set()
    kept = 0
    for system in model.systems:
        if any(name in unproven for name in system.part_names):
            unproven.append(system.name)
            continue
        try:
            combined = _combine(model, system, behaviors, most)
        except _TooManyError:
            unproven.append(system.name)
            continue
        kept += len(combined)
        found, behaviors[system.name], following = _outcomes(model, system, combined)
        oscillations += found
        if vague.isdisjoint(system.part_names):
            led[system.name] = following
        if found or not vague.isdisjoint(system.part_names):
            vague.add(system.name)
    return Settled(tuple(oscillations), tuple(unproven), kept, led)


def _combine(
    model: Model, system: Part, behaviors: Mapping[str, Behaviors], most: int
) -> dict[tuple[_Seen, ...], Failures]:
    """Return what can be seen of all parts together, by target, with the fewest failures that this takes."""
    targets = model.targets(system)
    every_mode = (1 << len(system.modes)) - 1
    kept: dict[tuple[_Seen, ...], Failures] = {
        ((False, False, -1, -1, every_mode, 0, held, 0),) * len(targets): statuses
        for held, statuses in outside_reports(system.rules).items()
    }
    for name in system.part_names:
        seen = _distinct(
            (_seen(model, system, name, outcomes, held), failures)
            for outcomes, held, failures in _reporting(model.parts[name], system, behaviors[name])
        )
        if len(kept) * len(seen) > most * _WORK:
            raise _TooManyError
        kept = _distinct(
            (tuple(map(_join, before, own)), known + failures)
            for before, known in kept.items()
            for own, failures in seen.items()
        )
        if len(kept) > most:
            raise _TooManyError
    return kept


def _reporting(
    part: Part, system: Part, behaviors: Behaviors
) -> Iterator[tuple[tuple[Status, ...], int, Failures]]:
    """Yield each behavior of a part with each combination of its statuses: outcomes, rules whose diagnostics hold."""
    ends = next(iter(behaviors))
    for report, statuses in reports_of(part, system.rules).items():
        diagnosed = tuple((part.name, status) for status in statuses)
        if report.is_error:
            yield (Status(ERROR),) * len(ends), report.held, diagnosed
            continue
        for outcomes, failures in behaviors.items():
            yield outcomes, report.held, failures + diagnosed


def _distinct(
    found: Iterable[tuple[tuple[_Seen, ...], Failures]],
) -> dict[tuple[_Seen, ...], Failures]:
    """Return the first of the fewest failures for each of what is seen."""
    kept: dict[tuple[_Seen, ...], Failures] = {}
    for seen, failures in found:
        known = kept.get(seen)
        if known is None or len(failures) < len(known):
            kept[seen] = failures
    return kept


def _join(a: _Seen, b: _Seen) -> _Seen:
    rule = a[2] if a[2] > b[2] else b[2]
    urgent = a[3] if a[3] > b[3] else b[3]
    if a[0] or b[0]:
        return True, True, rule, urgent, 0, a[5] | b[5], a[6] | b[6], a[7] | b[7]  # no mode can be seen then
    return False, a[1] or b[1], rule, urgent, a[4] & b[4], a[5] | b[5], a[6] | b[6], a[7] | b[7]


def _seen(
    model: Model, system: Part, name: str, outcomes: tuple[Status, ...], held: int
) -> tuple[_Seen, ...]:
    """Return what one part contributes, for each target of its system; `held`: rules whose diagnostics hold."""
    part = model.parts[name]
    answer = dict(zip(map(str, targets_of(model, part)), outcomes, strict=True))
    lasting = held & sum(1 << i for i, r in enumerate(system.rules) if r.recover_part not in ("", name))
    others = sum(1 << i for i, r in enumerate(system.rules) if r.diagnostics and r.diagnostics.hardware)
    found: list[_Seen] = []
    for target in model.targets(system):
        command = model.command(system, target, name)
        actual = answer[str(command)]
        holding = [
            (i, r.diagnostics is not None)
            for i, r in enumerate(system.rules)
            if r.if_part == name and r.if_target.is_same(target) and actual.is_same(r.if_status)
        ]
        rule = max((i for i, is_diagnosed in holding if not is_diagnosed), default=-1)
        urgent = max((i for i, is_diagnosed in holding if is_diagnosed and held >> i & 1), default=-1)
        modes = sum(
            1 << i for i, m in enumerate(system.modes.values()) if actual.is_same(m.commands[name].target)
        )
        undone = sum(
            1 << i
            for i, r in enumerate(system.rules)
            if r.recover_part == name and not held >> i & 1 and any(map(actual.is_same, r.recover_statuses))
        )
        deviates = not fulfills(actual, command)
        ready = sum(1 << i for i, is_diagnosed in holding if is_diagnosed and others >> i & 1)
        found.append((actual.state == ERROR, deviates, rule, urgent, modes, undone, lasting, ready))
    return tuple(found)


def _outcomes(
    model: Model, system: Part, combined: Mapping[tuple[_Seen, ...], Failures]
) -> tuple[list[Oscillation], Behaviors, _Led]:
    targets = model.targets(system)
    cycles: dict[frozenset[str], Oscillation] = {}
    behaviors: Behaviors = {}
    led: dict[Status, set[Status]] = {target: set() for target in targets}
    for seen, failures in sorted(combined.items(), key=lambda item: len(item[1])):
        outcomes: list[Status] = []
        for start, target in enumerate(targets):
            path, rules = _path(system, targets, start, seen)
            led[target].update(targets[i] for i in path[1:])
            if not rules:
                outcomes.append(_infer(system, targets[path[-1]], seen[path[-1]]))
                continue
            outcomes.append(Status(UNKNOWN))
            cycles.setdefault(frozenset(rules), Oscillation(system.name, target, failures, rules))
        behaviors.setdefault(tuple(outcomes), failures)
    return list(cycles.values()), behaviors, {target: frozenset(after) for target, after in led.items()}


_At = tuple[int, tuple[int, ...]]
"""The index of a target, and those of the rules that led there and can be undone: the history of `recovery`."""


def _next(system: Part, targets: tuple[Status, ...], at: _At, seen: tuple[_Seen, ...]) -> tuple[_At, str]:
    """Return what follows, which may be the same, and the rule that leads there, or is undone; "": it is stable."""
    target, history = at
    error, deviates, rule, urgent, _, well, held, ready = seen[target]
    urgent = max(urgent, (ready & held).bit_length() - 1)
    rule = max(rule, urgent) if error or deviates else urgent
    if rule >= 0:
        goal = targets.index(system.rules[rule].new_target)
        path = (*history, rule)
        cut = (path[:i] for i, r in enumerate(path) if targets.index(system.rules[r].if_target) == goal)
        return (goal, next(cut, path)), system.rules[rule].name
    if history and (well & ~held) >> history[-1] & 1:
        last = system.rules[history[-1]]
        return (targets.index(last.if_target), history[:-1]), last.name
    return at, ""


def _path(
    system: Part, targets: tuple[Status, ...], start: int, seen: tuple[_Seen, ...]
) -> tuple[list[int], tuple[str, ...]]:
    """Return the targets from `start` until one is stable, and none; or the rules of a cycle that follows."""
    at: _At = (start, ())
    known: dict[_At, int] = {}
    path, rules = [start], list[str]()
    while at not in known:
        known[at] = len(rules)
        at, rule = _next(system, targets, at, seen)
        if not rule:
            return path, ()
        path.append(at[0])
        rules.append(rule)
    return path, tuple(dict.fromkeys(rules[known[at] :]))


def _infer(system: Part, target: Status, seen: _Seen) -> Status:
    """Return what `Inference.infer_system` returns of parts of which this is seen."""
    error, deviates, _, _, modes, *_ = seen
    if error:
        return Status(ERROR)
    if not deviates:
        return target
    if target.state != ACTIVE:
        return Status(DEACTIVATING)
    fitting = (name for i, name in enumerate(system.modes) if modes >> i & 1)
    return Status(ACTIVATING, min(fitting, default=""))
