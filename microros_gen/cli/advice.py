# SPDX-License-Identifier: Apache-2.0
"""What would bring static memory down: the plan made again with one value of the application file changed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from microros_gen.build.budget import Advice
from microros_gen.cli.options import SelectionOptions
from microros_gen.cli.pipeline import Planned, plan_request
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.model.application import Application, LimitRule

_LOWERED = 4
"""A limit is tried at a quarter of what it is."""
_TRIED = 12
_SHOWN = 4


def plan_advice(planned: Planned, options: SelectionOptions) -> tuple[Advice, ...]:
    """Return the changes of pools and limits that make the streams smaller, the largest saving first."""
    now = planned.project.streams.ram
    found = []
    for change, application in _changes(planned):
        request = replace(planned.resolved.request, application=application)
        try:
            other = plan_request(replace(planned.resolved, request=request), options, Diagnostics())
        except UserError:
            continue
        saves = now - other.project.streams.ram
        if saves > 0:
            found.append(Advice(change, saves, exact=True))
    return tuple(sorted(found, key=lambda a: (-a.saves, a.change))[:_SHOWN])


def _changes(planned: Planned) -> Iterator[tuple[str, Application]]:
    application, slots = planned.resolved.request.application, planned.project.streams.reliable_slots
    if slots > 1:
        pools = {**application.pools, "history": slots - 1}
        yield f"pools.history {slots} → {slots - 1}", replace(application, pools=pools)
    decided = sorted(planned.capacities.decided, key=lambda c: (-c.value, str(c.root), c.path, c.kind))
    for capacity in decided[:_TRIED]:
        lower = capacity.value // _LOWERED
        if lower < 1:
            continue
        path = (str(capacity.root), *capacity.path)
        kept = tuple(r for r in application.limits if r.path != path)
        mine = [r for r in application.limits if r.path == path and not r.single]
        rule = _with(mine[0] if mine else LimitRule(path), capacity.kind, lower)
        change = (
            f"limits: {capacity.root} {'.'.join(capacity.path)} {capacity.kind} {capacity.value} → {lower}"
        )
        yield change, replace(application, limits=(*kept, rule))


def _with(rule: LimitRule, kind: str, value: int | None) -> LimitRule:
    return replace(rule, string=value) if kind == "string" else replace(rule, sequence=value)
