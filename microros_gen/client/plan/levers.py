# SPDX-License-Identifier: Apache-2.0
"""The numbers of an application file that memory grows with: queues, the history and limits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from microros_gen.application.model import Application, EndpointDecl, LimitRule
from microros_gen.client.plan.project import Project
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Capacities, Capacity


@dataclass(frozen=True)
class Lever:
    """A number of the application file, which is `now`; `put` returns an application with another one."""

    now: int
    put: Callable[[Application, int], Application]


def queue_levers(project: Project) -> Iterator[Lever]:
    """Yield the queues that have more than one place, those of the largest messages first."""
    application, queues = project.application, project.runtime.input.queues
    if not application.nodes:
        now = application.pools.get("queue", max((q.slots for q in queues), default=1))
        if now > 1:
            yield _pool("queue", now)
        return
    for endpoint, queue in _declared_queues(project):
        yield _queue(endpoint, queue.slots)


def shared_queue_levers(project: Project) -> Iterator[tuple[Lever, int]]:
    """Yield the bytes of queues that hold more than one of the largest, and the fewest that each can have."""
    application, queues = project.application, project.runtime.input.queues
    if application.nodes:
        for endpoint, queue in _declared_queues(project):
            if queue.size > queue.slot_size:
                yield _queue_bytes(endpoint, queue.size), queue.slot_size
        return
    least = max((queue.slot_size for queue in queues), default=0)
    now = max((queue.size for queue in queues), default=0)
    if now > least:
        yield _pool("queue_bytes", now), least


def _declared_queues(project: Project) -> list[tuple[EndpointDecl, QueuePlan]]:
    """Return the declared queues of several samples, the largest first."""
    application, queues = project.application, project.runtime.input.queues
    endpoints = [e for kind in ("subscription", "service", "client") for e in _of_kind(application, kind)]
    of_endpoints = queues[len(queues) - len(endpoints) :]  # the library's own come first
    several = ((e, q) for e, q in zip(endpoints, of_endpoints, strict=True) if q.slots > 1)
    return sorted(several, key=lambda pair: -pair[1].size)


def history_lever(project: Project) -> Lever | None:
    """Return the history of reliable streams; None where it has one place or none."""
    slots = project.streams.reliable_slots
    return _pool("history", slots) if slots > 1 else None


def limit_levers(capacities: Capacities) -> Iterator[Lever]:
    """Yield the limits above 1, the largest first."""
    for capacity in sorted(capacities.decided, key=lambda c: (-c.value, str(c.root), c.path, c.kind)):
        if capacity.value > 1:
            yield _limit(capacity)


def _pool(key: str, now: int) -> Lever:
    return Lever(
        now,
        lambda application, value: replace(application, pools={**application.pools, key: value}),
    )


def _queue(endpoint: EndpointDecl, now: int) -> Lever:
    return Lever(
        now,
        lambda application, value: _with_changed(application, endpoint, replace(endpoint, queue=value)),
    )


def _queue_bytes(endpoint: EndpointDecl, now: int) -> Lever:
    return Lever(
        now,
        lambda application, value: _with_changed(application, endpoint, replace(endpoint, queue_bytes=value)),
    )


def _limit(capacity: Capacity) -> Lever:
    return Lever(
        capacity.value,
        lambda application, value: _with_limit(application, capacity, value),
    )


def _of_kind(application: Application, kind: str) -> list[EndpointDecl]:
    return [e for node in application.nodes for e in node.endpoints if e.kind == kind]


def _with_changed(application: Application, endpoint: EndpointDecl, changed: EndpointDecl) -> Application:
    nodes = tuple(
        replace(node, endpoints=tuple(changed if e == endpoint else e for e in node.endpoints))
        for node in application.nodes
    )
    return replace(application, nodes=nodes)


def _with_limit(application: Application, capacity: Capacity, value: int) -> Application:
    path = (str(capacity.root), *capacity.path)
    others = tuple(rule for rule in application.limits if rule.path != path)
    of_path = [rule for rule in application.limits if rule.path == path and not rule.single]
    rule = of_path[0] if of_path else LimitRule(path)
    rule = replace(rule, string=value) if capacity.kind == "string" else replace(rule, sequence=value)
    return replace(application, limits=(*others, rule))
