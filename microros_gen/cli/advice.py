# SPDX-License-Identifier: Apache-2.0
"""What would bring static memory down: built again with one value of the application file changed, and measured."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from microros_gen.build.budget import Advice
from microros_gen.build.compile import OBJECTS, compile_project
from microros_gen.build.folder import Folder, read_folder
from microros_gen.build.report import static_memory
from microros_gen.build.toolchain import Toolchain, find_toolchain
from microros_gen.cli.options import SelectionOptions
from microros_gen.cli.pipeline import Planned, plan_request, render_request
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.model.application import Application, EndpointDecl, LimitRule
from microros_gen.output.tree import write_tree

_LOWERED = 4
"""A limit is tried at a quarter of what it is."""
_LIMITS = 4
_QUEUES = 3
_SHOWN = 4


@dataclass(frozen=True)
class _Trial:
    """A folder in which one plan after another is built; objects that a change does not reach stay."""

    folder: Path
    tools: Toolchain

    def ram(self, planned: Planned) -> int:
        """Return the static memory of the library in the example that is built of this plan, bytes."""
        write_tree(self.folder, render_request(planned))
        compile_project(self.folder, planned.project, self.tools)
        return static_memory(read_folder(self.folder))


def plan_advice(planned: Planned, folder: Folder, options: SelectionOptions) -> tuple[Advice, ...]:
    """Return the changes of queues, pools and limits that save most, the largest saving first.

    Each is built as the example of the application and measured; `folder` lends its objects. Nothing where there
    is no tool chain for that.
    """
    try:
        tools = find_toolchain(planned.project.target, os.environ)
        with tempfile.TemporaryDirectory(prefix="microros-gen-") as name:
            trial = _Trial(Path(name) / "out", tools)
            if (folder.path / OBJECTS / "stamps.json").is_file():
                shutil.copytree(folder.path, trial.folder, symlinks=True)
            now = trial.ram(planned)
            found = list(_tried(planned, options, trial, now))
    except (UserError, OSError):
        return ()
    return tuple(sorted(found, key=lambda a: (-a.saves, a.change))[:_SHOWN])


def _tried(planned: Planned, options: SelectionOptions, trial: _Trial, now: int) -> Iterator[Advice]:
    for change, application in _changes(planned):
        request = replace(planned.resolved.request, application=application)
        try:
            other = plan_request(replace(planned.resolved, request=request), options, Diagnostics())
        except UserError:
            continue  # a smaller number is not always possible
        saves = now - trial.ram(other)
        if saves > 0:
            yield Advice(change, saves, exact=True)


def _changes(planned: Planned) -> Iterator[tuple[str, Application]]:
    application = planned.resolved.request.application
    yield from _queues(planned)
    slots = planned.project.streams.reliable_slots
    if slots > 1:
        pools = {**application.pools, "history": slots - 1}
        yield f"pools.history {slots} → {slots - 1}", replace(application, pools=pools)
    decided = sorted(planned.capacities.decided, key=lambda c: (-c.value, str(c.root), c.path, c.kind))
    for capacity in decided[:_LIMITS]:
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


def _queues(planned: Planned) -> Iterator[tuple[str, Application]]:
    """Yield a queue of one sample for each endpoint that has more, those of the largest messages first."""
    application, runtime = planned.resolved.request.application, planned.project.runtime
    if not application.nodes:
        now = application.pools.get("queue", max((q.slots for q in runtime.queues), default=1))
        if now > 1:
            yield f"pools.queue {now} → 1", replace(application, pools={**application.pools, "queue": 1})
        return
    endpoints = [e for kind in ("subscription", "service", "client") for e in _of_kind(application, kind)]
    pairs = sorted(
        ((e, q) for e, q in zip(endpoints, runtime.queues, strict=False) if q.slots > 1),
        key=lambda pair: -pair[1].slots * pair[1].slot_size,
    )
    for endpoint, queue in pairs[:_QUEUES]:
        change = f"queue: 1 of the {endpoint.kind} {endpoint.given or endpoint.topic} (now {queue.slots})"
        yield change, _with_queue(application, endpoint)


def _of_kind(application: Application, kind: str) -> list[EndpointDecl]:
    return [e for node in application.nodes for e in node.endpoints if e.kind == kind]


def _with_queue(application: Application, endpoint: EndpointDecl) -> Application:
    nodes = tuple(
        replace(node, endpoints=tuple(replace(e, queue=1) if e is endpoint else e for e in node.endpoints))
        for node in application.nodes
    )
    return replace(application, nodes=nodes)


def _with(rule: LimitRule, kind: str, value: int | None) -> LimitRule:
    return replace(rule, string=value) if kind == "string" else replace(rule, sequence=value)
