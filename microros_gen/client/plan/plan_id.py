# SPDX-License-Identifier: Apache-2.0
"""The plan id: what a library and the application that links with it must agree on, as a hash.

It is the hash of a record whose keys stand here and nowhere else, so no name or order in Python is part of what
users link against. A key that is added, removed or gets another meaning makes another id for every plan, as VERSION
does; then libraries have to be built again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from typing import Any

from microros_gen.client.plan.entities import Declared, EntitiesPlan, Places
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.services import ServicePlan
from microros_gen.client.plan.session_times import TimesPlan
from microros_gen.client.plan.slices import (
    CreationPlan,
    InputPlan,
    MemoryPlan,
    OutputPlan,
    SessionPlan,
    TransportPlan,
)
from microros_gen.typesupport.plan.size import TypeLimits
from microros_gen.typesupport.plan.types import TypePlan

VERSION = 1
"""Of the record. Raise it when what is generated for a plan changes and the record does not show that."""

_Record = dict[str, Any]


def plan_id(runtime: RuntimePlan, components: Iterable[str], types: Iterable[TypePlan]) -> str:
    """Return 16 hexadecimal digits that change whenever the library's layout or behavior does."""
    record = plan_record(runtime, components, types)
    text = json.dumps(record, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def plan_record(runtime: RuntimePlan, components: Iterable[str], types: Iterable[TypePlan]) -> _Record:
    """Return what the id is made of, as plain data."""
    return {
        "version": VERSION,
        "components": list(components),
        "session": _session(runtime.session),
        "times": _times(runtime.times),
        "transport": _transport(runtime.transport),
        "output": _output(runtime.streams),
        "input": _input(runtime.input),
        "creation": _creation(runtime.creation),
        "entities": _entities(runtime.entities),
        "memory": _memory(runtime.memory),
        "error_text": runtime.errors.text_size,
        **_running(runtime),
        **({"features": runtime.features.records} if runtime.features.slices else {}),
        "types": [_type(plan) for plan in types],
    }


def _creation(plan: CreationPlan) -> list[object]:
    return [plan.entities, plan.stream, plan.size, *(["fragments"] if plan.fragments else [])]


def _session(plan: SessionPlan) -> _Record:
    return {
        "id": plan.id,
        "key": plan.client_key,
        "multithread": plan.multithread,
        "hard_liveliness": plan.hard_liveliness_ms,
        "state": plan.has_state,
        "sleep": plan.has_sleep,
        "time_sync": plan.has_time_sync,
    }


def _times(plan: TimesPlan) -> _Record:
    return {
        "retry": [plan.retry_first_ms, plan.retry_most_ms],
        "heartbeat": plan.heartbeat_period_ms,
        "liveliness": [plan.liveliness_period_ms, plan.liveliness_wait_ms, plan.liveliness_attempts],
        "calls": [plan.connect_timeout_ms, plan.create_timeout_ms, plan.close_timeout_ms],
    }


def _transport(plan: TransportPlan) -> _Record:
    return {
        "kind": plan.kind,
        "agent": [plan.agent_host, plan.agent_port],
        "discovery": [plan.has_discovery, plan.discovery_port],
        "framing": plan.framing,
        "read_polls": plan.read_polls,
        "line": [plan.device, plan.baud, plan.own_line],
        "line_output": [plan.send_buffer, plan.keeps_output],
        "line_input": [plan.line_input, plan.line_chunk],
        **({"room": True} if plan.wakes_for_room else {}),
        **({"wakes": True} if plan.wakes else {}),
    }


def _output(plan: OutputPlan) -> _Record:
    return {
        "mtu": plan.mtu,
        "best_effort": plan.best_effort_size,
        **(
            {"best_effort_queue": [plan.best_effort_slots, plan.best_effort_places]}
            if plan.best_effort_slots or plan.best_effort_places > 1
            else {}
        ),
        "reliable": [plan.reliable_slots, plan.reliable_slot_size],
        "full": [plan.on_full, plan.on_full_block_ms],
        "fragments": plan.fragments,
    }


def _input(plan: InputPlan) -> _Record:
    return {
        "size": plan.size,
        "lent": [plan.reader, plan.free],
        "fragments": plan.arrives_in_fragments,
        "reliable": [plan.reliable_slots, plan.reliable_slot_size],
        "queues": [
            [q.slots, q.slot_size, q.requested_bytes, *(["streamed"] if q.streamed else [])]
            for q in plan.queues
        ],
    }


def _entities(plan: EntitiesPlan) -> _Record:
    return {
        "declared": plan.declared,
        "names": [plan.name_size, plan.type_name_size],
        "timed_qos": plan.timed_qos,
        "nodes": _places(plan.nodes, _node),
        "publishers": _places(plan.publishers, _publisher),
        "subscriptions": _places(plan.subscriptions, _subscription),
        "services": _places(plan.services, _service),
        "clients": _places(plan.clients, _service),
    }


def _places(places: Places[Declared], row: Callable[[Declared], list[Any]]) -> list[Any]:
    return [places.max, places.implied, [row(plan) for plan in places.declared]]


def _node(plan: NodePlan) -> list[Any]:
    return [
        *(plan.name, plan.namespace, plan.participant_name, plan.domain_id),
        *(plan.given_name, plan.given_namespace),
    ]


def _publisher(plan: PublisherPlan) -> list[Any]:
    return [
        plan.node,
        plan.topic,
        plan.dds_topic,
        str(plan.type),
        plan.reliable,
        plan.limited,
        plan.declared_as,
    ]


def _subscription(plan: SubscriptionPlan) -> list[Any]:
    return [
        *(plan.node, plan.topic, plan.dds_topic, str(plan.type), plan.reliable, plan.declared_as),
        *(plan.storage, plan.header, plan.c_type, list(plan.buffers), plan.stored),
    ]


def _service(plan: ServicePlan) -> list[Any]:
    stored = [[m.part, m.storage, m.header, m.c_type, list(m.buffers)] for m in plan.stored]
    return [plan.node, plan.name, str(plan.type), plan.limited, stored, plan.declared_as]


def _memory(plan: MemoryPlan) -> _Record:
    return {
        "arena": plan.arena_size,
        "fixed_messages": plan.fixed_messages,
        "kept_messages": plan.kept_messages,
        "pools": [
            [p.kind, p.element, p.header, [[b.elements, b.count] for b in p.blocks], list(p.sizes)]
            for p in plan.message_pools
        ],
    }


def _running(runtime: RuntimePlan) -> _Record:
    timers, executor, clock = runtime.timers, runtime.executor, runtime.clock
    return {
        "timers": [
            timers.max,
            [[t.node, t.name, t.period_ns, t.kind, *([True] * t.gated)] for t in timers.declared],
        ],
        "executors": [executor.max, executor.handles_max],
        "guard_conditions": executor.guard_conditions_max,
        "wait_sets": executor.wait_sets_max,
        "clocks": [clock.ros_clocks_max, clock.jump_callbacks_max, clock.has_ros_time],
    }


def _type(plan: TypePlan) -> list[Any]:
    sets = [[s.name, s.max_encoded_size, _limits(s.limits)] for s in plan.limit_sets]
    topics = sorted((name, list(sizes)) for name, sizes in plan.topic_sizes.items())
    return [
        *(str(plan.name), plan.type_hash, plan.max_encoded_size, _limits(plan.limits)),
        *(list(plan.struct_sizes), list(plan.storage_sizes), topics, sets),
    ]


def _limits(limits: TypeLimits | None) -> list[Any] | None:
    """Return sequence, string and nested limits of each member; None for a type, or a member, of fixed size."""
    if limits is None:
        return None
    return [f and [f.sequence, f.string, _limits(f.nested)] for f in limits.fields]
