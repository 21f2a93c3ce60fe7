# SPDX-License-Identifier: Apache-2.0
"""Where the systems of a model end for every combination of failed nodes, computed system by system.

A node follows its commands, or it is stuck: in a state of the life cycle, on the way between two of them, or active in
one of its modes or in none. Seen from its
system, a part is therefore a function from commands to statuses, a *behavior*; a subsystem has one for each
combination of failures below it, and many combinations have the same. If rules can tell a node that is still
unconfigured from one that is inactive, a behavior has states besides (`machines`). A part belongs to one system, so
the behaviors of the parts of a system are independent of each other.

Besides, the statuses of a node on /diagnostics have levels, which rules of its system can want (`reports`). Statuses of
no part are taken as those of one more part, which every system has for itself.

The combinations of a system are not enumerated. Its parts are taken one after another. Of the parts so far these facts
are kept for each target of the system: whether one is in error processing, whether one is not what is commanded, and
which rule holds (the last one by name; separately of those that want diagnostics, which hold in the target, too).
Combinations that are equal in these stay equal whatever follows. At the end they say for each target which rule is
next, or is undone (`recovery`): a cycle of targets is an oscillation.

That proves more than requests: whatever happened before, the first rule that is applied commands all parts of its
system again, and from there on the functions above say what follows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from microros_gen.modes.inference import fulfills
from microros_gen.modes.machines import (
    Behaviors,
    Failures,
    Machine,
    Origin,
    constant,
    product,
    reduced,
    size_of,
)
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
from microros_gen.modes.reports import outside_reports, reports_of
from microros_gen.records import dataclass

_Led = Mapping[Status, frozenset[Status]]

_Seen = tuple[bool, bool, int, int, int, int, int]
"""Error processing, deviates, the index of the rule that holds or -1, that of one with diagnostics; as bits: the rules
whose part in `recover_if` is well, those that the diagnostics of another part or of no part keep, and those that hold
if statuses of no part do."""


@dataclass(frozen=True)
class Oscillation:
    """A system whose target never settles: the request and the failures that lead there, and the rules of the cycle.

    `configured` are the nodes that are inactive before the request; others are unconfigured.
    """

    system: str
    request: Status
    failures: Failures
    rules: tuple[str, ...]
    configured: tuple[str, ...] = ()


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


@dataclass(frozen=True)
class SettledSystem:
    """The same of one system, with what it can end in; `led` is for each of its targets."""

    kept: int
    oscillations: tuple[Oscillation, ...]
    behaviors: Behaviors
    led: _Led


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
    stuck = {
        constant((status,) * len(targets)): Origin(((node.name, status),)) for status in failure_states(node)
    }
    return {_following(targets): Origin((), ((), (node.name,))), **stuck}


def _following(targets: Sequence[Status]) -> Machine[Status]:
    """Return a node that follows: it is unconfigured in its first state, and stays so where it has to be inactive."""
    resting = Status(UNCONFIGURED)
    ends = tuple(resting if fulfills(resting, target) else target for target in targets), tuple(targets)
    after = tuple(
        tuple(_is_configured(end, bool(state)) for end in of_state) for state, of_state in enumerate(ends)
    )
    return ends, after


def _is_configured(end: Status, before: bool) -> int:
    return int(end.state != UNCONFIGURED and (before or end.state != INACTIVE))


def settle_system(
    model: Model,
    system: Part,
    behaviors: Mapping[str, Behaviors],
    most: int,
    outside: Mapping[int, Failures],
) -> SettledSystem | None:
    """Return where a system ends; None: it has more than `most` different combinations.

    `behaviors` are those of its parts. `outside` has the rules that see statuses of no part that they want, as bits,
    each with such statuses.
    """
    if len(outside) > most:
        return None
    try:
        combined = _combine(model, system, behaviors, most, outside)
    except _TooManyError:
        return None
    return SettledSystem(size_of(combined), *_outcomes(model, system, combined))


Settle = Callable[[Part, Mapping[str, Behaviors]], SettledSystem | None]
"""`settle_system` for a model and some levels of statuses of no part."""


def settle_all(
    model: Model,
    most: int,
    of_node: Callable[[Model, Part], Behaviors] = every_failure,
    settle: Settle | None = None,
) -> Settled:
    """Return what is known of all systems; one with more than `most` different combinations stays open.

    `of_node` says what a node can end in. `settle`: by which function a system is settled; None: `settle_system`, where
    statuses of no part have any levels, for each system other ones.
    """
    behaviors: dict[str, Behaviors] = {node.name: of_node(model, node) for node in model.nodes}
    oscillations: list[Oscillation] = []
    unproven: list[str] = []
    led: dict[str, _Led] = {}
    vague: set[str] = set()
    kept = 0
    for system in model.systems:
        found = None
        if not any(name in unproven for name in system.part_names):
            found = (
                settle(system, behaviors)
                if settle is not None
                else settle_system(model, system, behaviors, most, outside_reports(system.rules, most))
            )
        if found is None:
            unproven.append(system.name)
            continue
        kept += found.kept
        behaviors[system.name] = found.behaviors
        oscillations += found.oscillations
        if vague.isdisjoint(system.part_names):
            led[system.name] = found.led
        if found.oscillations or not vague.isdisjoint(system.part_names):
            vague.add(system.name)
    return Settled(tuple(oscillations), tuple(unproven), kept, led)


def _combine(
    model: Model,
    system: Part,
    behaviors: Mapping[str, Behaviors],
    most: int,
    outside: Mapping[int, Failures],
) -> dict[Machine[_Seen], Origin]:
    """Return what can be seen of all parts together, by target, with the fewest failures that this takes."""
    targets = model.targets(system)
    kept = {
        constant(((False, False, -1, -1, 0, held, 0),) * len(targets)): Origin(statuses)
        for held, statuses in outside.items()
    }
    for name in system.part_names:
        seen = _distinct(
            reduced(_seen(model, system, name, behavior, held), origin)
            for behavior, held, origin in _reporting(model.parts[name], system, behaviors[name], most)
        )
        if size_of(kept) * size_of(seen) > most * _WORK:
            raise _TooManyError
        kept = _distinct(product(before, own, _join) for before in kept.items() for own in seen.items())
        if size_of(kept) > most:
            raise _TooManyError
    return kept


def _reporting(
    part: Part, system: Part, behaviors: Behaviors, most: int
) -> Iterator[tuple[Machine[Status], int, Origin]]:
    """Yield each behavior of a part with each combination of its statuses: outcomes, rules whose diagnostics hold."""
    ends = next(iter(behaviors))[0][0]
    reports = reports_of(part, system.rules, most)
    if len(reports) > most:
        raise _TooManyError
    for report, statuses in reports.items():
        diagnosed = tuple((part.name, status) for status in statuses)
        if report.is_error:
            yield constant((Status(ERROR),) * len(ends)), report.held, Origin(diagnosed)
            continue
        for behavior, origin in behaviors.items():
            yield behavior, report.held, Origin(origin.failures + diagnosed, origin.configured)


def _distinct(found: Iterable[tuple[Machine[_Seen], Origin]]) -> dict[Machine[_Seen], Origin]:
    """Return the first of the fewest failures for each of what is seen."""
    kept: dict[Machine[_Seen], Origin] = {}
    for seen, origin in found:
        known = kept.get(seen)
        if known is None or len(origin.failures) < len(known.failures):
            kept[seen] = origin
    return kept


def _join(a: _Seen, b: _Seen) -> _Seen:
    rule = a[2] if a[2] > b[2] else b[2]
    urgent = a[3] if a[3] > b[3] else b[3]
    error = a[0] or b[0]
    return error, error or a[1] or b[1], rule, urgent, a[4] | b[4], a[5] | b[5], a[6] | b[6]


def _seen(model: Model, system: Part, name: str, behavior: Machine[Status], held: int) -> Machine[_Seen]:
    """Return what one part contributes, for each target of its system; `held`: rules whose diagnostics hold."""
    own = targets_of(model, model.parts[name])
    commands = [str(model.command(system, target, name)) for target in model.targets(system)]
    places = [list(map(str, own)).index(command) for command in commands]
    ends, after = behavior
    return (
        tuple(_seen_in(model, system, name, [row[i] for i in places], held) for row in ends),
        tuple(tuple(row[i] for i in places) for row in after),
    )


def _seen_in(
    model: Model, system: Part, name: str, outcomes: Sequence[Status], held: int
) -> tuple[_Seen, ...]:
    """Return the same for a part that ends in `outcomes` for the targets of its system."""
    lasting = held & sum(1 << i for i, r in enumerate(system.rules) if r.recover_part not in ("", name))
    others = sum(1 << i for i, r in enumerate(system.rules) if r.diagnostics and r.diagnostics.hardware)
    found: list[_Seen] = []
    for target, actual in zip(model.targets(system), outcomes, strict=True):
        command = model.command(system, target, name)
        holding = [
            (i, r.diagnostics is not None)
            for i, r in enumerate(system.rules)
            if r.if_part == name and r.if_target.is_same(target) and actual.is_same(r.if_status)
        ]
        rule = max((i for i, is_diagnosed in holding if not is_diagnosed), default=-1)
        urgent = max((i for i, is_diagnosed in holding if is_diagnosed and held >> i & 1), default=-1)
        undone = sum(
            1 << i
            for i, r in enumerate(system.rules)
            if r.recover_part == name and not held >> i & 1 and any(map(actual.is_same, r.recover_statuses))
        )
        deviates = not fulfills(actual, command)
        ready = sum(1 << i for i, is_diagnosed in holding if is_diagnosed and others >> i & 1)
        found.append((actual.state == ERROR, deviates, rule, urgent, undone, lasting, ready))
    return tuple(found)


def _outcomes(
    model: Model, system: Part, combined: Mapping[Machine[_Seen], Origin]
) -> tuple[tuple[Oscillation, ...], Behaviors, _Led]:
    targets = model.targets(system)
    cycles: dict[frozenset[str], Oscillation] = {}
    behaviors: Behaviors = {}
    led: dict[Status, set[Status]] = {target: set() for target in targets}
    for machine, origin in sorted(combined.items(), key=lambda item: len(item[1].failures)):
        ends: list[tuple[Status, ...]] = []
        after: list[tuple[int, ...]] = []
        for state, configured in enumerate(origin.configured):
            row: list[tuple[Status, int]] = []
            for start, target in enumerate(targets):
                path, (last, final), rules = _path(system, targets, (start, state), machine)
                led[target].update(targets[i] for i in path[1:])
                if not rules:
                    row.append((_infer(targets[last], machine[0][final][last]), machine[1][final][last]))
                    continue
                row.append((Status(UNKNOWN), state))
                found = Oscillation(system.name, target, origin.failures, rules, configured)
                cycles.setdefault(frozenset(rules), found)
            ends.append(tuple(end for end, _ in row))
            after.append(tuple(following for _, following in row))
        behavior, smallest = reduced((tuple(ends), tuple(after)), origin)
        behaviors.setdefault(behavior, smallest)
    return tuple(cycles.values()), behaviors, {target: frozenset(after) for target, after in led.items()}


_At = tuple[int, int, tuple[int, ...]]
"""The index of a target, the state in which it was commanded, and the rules that led there and can be undone, by their
indices: the history of `recovery`."""


def _next(system: Part, targets: tuple[Status, ...], at: _At, machine: Machine[_Seen]) -> tuple[_At, str]:
    """Return what follows, which may be the same, and the rule that leads there, or is undone; "": it is stable."""
    target, state, history = at
    error, deviates, rule, urgent, well, held, ready = machine[0][state][target]
    after = machine[1][state][target]
    urgent = max(urgent, (ready & held).bit_length() - 1)
    rule = max(rule, urgent) if error or deviates else urgent
    if rule >= 0:
        goal = targets.index(system.rules[rule].new_target)
        path = (*history, rule)
        cut = (path[:i] for i, r in enumerate(path) if targets.index(system.rules[r].if_target) == goal)
        return (goal, after, next(cut, path)), system.rules[rule].name
    if history and (well & ~held) >> history[-1] & 1:
        last = system.rules[history[-1]]
        return (targets.index(last.if_target), after, history[:-1]), last.name
    return at, ""


def _path(
    system: Part, targets: tuple[Status, ...], start: tuple[int, int], machine: Machine[_Seen]
) -> tuple[list[int], tuple[int, int], tuple[str, ...]]:
    """Return the targets from `start` until one is stable, the last one with its state, and the rules of a cycle."""
    at: _At = (*start, ())
    known: dict[_At, int] = {}
    path, rules = [start[0]], list[str]()
    while at not in known:
        known[at] = len(rules)
        at, rule = _next(system, targets, at, machine)
        if not rule:
            return path, at[:2], ()
        path.append(at[0])
        rules.append(rule)
    return path, at[:2], tuple(dict.fromkeys(rules[known[at] :]))


def _infer(target: Status, seen: _Seen) -> Status:
    """Return what `Inference.infer_system` returns of parts of which this is seen, without the mode while activating.

    That mode says nothing to rules (`Status.is_same`).
    """
    error, deviates, *_ = seen
    if error:
        return Status(ERROR)
    if not deviates:
        return target
    return Status(ACTIVATING if target.state == ACTIVE else DEACTIVATING)
