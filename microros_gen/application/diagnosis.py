# SPDX-License-Identifier: Apache-2.0
"""`diagnosis:` of the application file → what the device reports of itself, and the checks of the application."""

from __future__ import annotations

from collections.abc import Sequence

from microros_gen.application.diagnosis_decl import CallbackDecl, CheckDecl, DiagnosisDecl, LevelLimits
from microros_gen.application.model import NodeDecl
from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    entries,
    int_of,
    items,
    span_of,
    text_of,
    time_of,
)
from microros_gen.documents.yaml_tree import YamlNode

PERIOD_US = (100_000, 3_600_000_000)
DEADLINE_US = (1, 60_000_000)
TIMEOUT_US = (1_000, 86_400_000_000)
"""Shortest and longest times, microseconds."""
_US_PER_MS = 1000


def parse_diagnosis(
    tree: YamlNode | None, nodes: Sequence[NodeDecl], diagnostics: Diagnostics
) -> DiagnosisDecl | None:
    """Return what is below `diagnosis:`; None: the file has no such key. Faults are errors at their places."""
    if tree is None:
        return None
    default = DiagnosisDecl()
    period = _time(child(tree, "period"), "period", PERIOD_US, "1 s", diagnostics)
    return DiagnosisDecl(
        period_ms=default.period_ms if period is None else period // _US_PER_MS,
        hardware_id=text_of(child(tree, "hardware_id")) or "",
        deadline_us=_time(child(tree, "deadline"), "deadline", DEADLINE_US, "10 ms", diagnostics) or 0,
        timers=bool_of(child(tree, "timers")) is True,
        stack=_limits(child(tree, "stack"), "stack", True, diagnostics) or default.stack,
        cpu=_limits(child(tree, "cpu"), "cpu", True, diagnostics) or default.cpu,
        supply=_limits(child(tree, "supply"), "supply", False, diagnostics) or default.supply,
        checks=_checks(child(tree, "checks"), nodes, diagnostics),
        callbacks=_callbacks(child(tree, "callbacks"), diagnostics),
        span=tree.span,
        hardware_span=span_of(child(tree, "hardware_id")),
        deadline_span=span_of(child(tree, "deadline")),
        timers_span=span_of(child(tree, "timers")),
        callbacks_span=span_of(child(tree, "callbacks")),
    )


def _time(
    node: YamlNode | None, key: str, bounds: tuple[int, int], example: str, diagnostics: Diagnostics
) -> int | None:
    """Return microseconds; None: the key is not there, or is wrong."""
    time = time_of(node)
    if time is not None and not bounds[0] <= time <= bounds[1]:
        shortest, longest = (_shown(bound) for bound in bounds)
        message = f"'{key}' of a diagnosis is {text_of(node)}; it must be {shortest} to {longest}"
        diagnostics.error(message, span_of(node), f"Write {key}: {example}", id="MG-3110")
        return None
    return time


def _shown(time_us: int) -> str:
    for unit, size in (("s", 1_000_000), ("ms", 1_000)):
        if time_us % size == 0:
            return f"{time_us // size} {unit}"
    return f"{time_us} us"


def _limits(node: YamlNode | None, what: str, above: bool, diagnostics: Diagnostics) -> LevelLimits | None:
    if node is None:
        return None
    warn, error = int_of(child(node, "warn")), int_of(child(node, "error"))
    if warn is not None and error is not None and (error < warn if above else error > warn):
        side = "below" if above else "above"
        message = f"the error of '{what}' begins at {error}, {side} its warning at {warn}"
        diagnostics.error(message, span_of(child(node, "error")), "Exchange them", id="MG-3111")
    return LevelLimits(warn, error, node.span)


def _checks(
    tree: YamlNode | None, nodes: Sequence[NodeDecl], diagnostics: Diagnostics
) -> tuple[CheckDecl, ...]:
    checks = tuple(_check(item, nodes, diagnostics) for item in items(tree))
    seen: dict[str, CheckDecl] = {}
    for check in checks:
        if seen.setdefault(check.name, check) is not check:
            message = f"duplicate check '{check.name}'"
            hint = "Give each a different name: it is a constant of the program"
            diagnostics.error(message, check.span, hint, id="MG-3112")
    return checks


def _callbacks(tree: YamlNode | None, diagnostics: Diagnostics) -> tuple[CallbackDecl, ...]:
    callbacks = tuple(_callback(item, diagnostics) for item in items(tree))
    seen: dict[str, CallbackDecl] = {}
    for callback in callbacks:
        if seen.setdefault(callback.name, callback) is not callback:
            message = f"duplicate callback '{callback.name}' of a diagnosis"
            hint = "Give each a different name: it is a constant of the program"
            diagnostics.error(message, callback.span, hint, id="MG-3300")
    return callbacks


def _callback(item: YamlNode, diagnostics: Diagnostics) -> CallbackDecl:
    limit = _time(child(item, "limit"), "limit", DEADLINE_US, "2 ms", diagnostics)
    return CallbackDecl(text_of(child(item, "name")) or "", limit or 0, item.span)


def _check(item: YamlNode, nodes: Sequence[NodeDecl], diagnostics: Diagnostics) -> CheckDecl:
    name = text_of(child(item, "name")) or ""
    sides = [entry for entry in entries(item) if entry.key in ("above", "below")]
    if len(sides) != 1:
        count = "two sides" if sides else "no limits"
        message = f"the check '{name}' has {count}"
        hint = "Write either above: {warn: 80, error: 90} or below: {error: 10}"
        diagnostics.error(message, item.span, hint, id="MG-3113")
    above = not sides or sides[0].key == "above"
    limits = _limits(sides[0].value, name, above, diagnostics) if sides else None
    limits = limits or LevelLimits()
    node = _node(child(item, "node"), nodes, diagnostics)
    timeout = _time(child(item, "timeout"), "timeout", TIMEOUT_US, "5 s", diagnostics)
    return CheckDecl(
        name=name,
        limits=limits,
        above=above,
        unit=text_of(child(item, "unit")) or "",
        node=node,
        hysteresis=int_of(child(item, "hysteresis")) or 0,
        timeout_ms=(timeout or 0) // _US_PER_MS,
        mode=_mode(child(item, "mode"), name, limits, nodes[node : node + 1], diagnostics),
        span=item.span,
    )


def _node(tree: YamlNode | None, nodes: Sequence[NodeDecl], diagnostics: Diagnostics) -> int:
    """Return the position of the node; 0 also where it is not found."""
    wanted = text_of(tree)
    if wanted is None:
        return 0
    names = [node.full_name if wanted.startswith("/") else node.name for node in nodes]
    found = [index for index, name in enumerate(names) if name == wanted]
    if len(found) == 1:
        return found[0]
    if found:
        hint = f"Write one of {', '.join(nodes[index].full_name for index in found)}"
        diagnostics.error(f"several nodes are named '{wanted}'", span_of(tree), hint, id="MG-3117")
    else:
        hint = nearest(wanted, names) or "Declare it below `nodes:`"
        diagnostics.error(f"unknown node '{wanted}' of a check", span_of(tree), hint, id="MG-3114")
    return 0


def _mode(
    tree: YamlNode | None,
    check: str,
    limits: LevelLimits,
    nodes: Sequence[NodeDecl],
    diagnostics: Diagnostics,
) -> str:
    """Return the name of a mode of the node; empty: none is requested, or the name is wrong."""
    wanted = text_of(tree)
    if wanted is None:
        return ""
    names = [mode.name for node in nodes for mode in node.modes]
    span: Span | None = span_of(tree)
    if limits.error is None:
        message = f"the check '{check}' requests a mode at an error, and has no limit of an error"
        diagnostics.error(message, span, "Add `error` to its limits", id="MG-3115")
    if wanted in names:
        return wanted
    of = f"the node '{nodes[0].name}'" if nodes else "the node"
    hint = nearest(wanted, names) or "Declare it below `modes:` of the node"
    diagnostics.error(f"{of} has no mode '{wanted}'", span, hint, id="MG-3116")
    return ""
