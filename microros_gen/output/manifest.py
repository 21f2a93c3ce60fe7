# SPDX-License-Identifier: Apache-2.0
"""OUT/manifest.json: what was selected, from what, and what came out. No path, time or host goes into it."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from microros_gen import __version__
from microros_gen.application.kinds import KINDS, RECEIVING, EntityKind
from microros_gen.application.model import Memory
from microros_gen.client.plan.project import Project
from microros_gen.client.plan.runtime_entities import PublisherPlan, QueuePlan, SubscriptionPlan
from microros_gen.client.plan.services import ServicePlan
from microros_gen.client.views.presence import manifest_entries
from microros_gen.client.views.project import without_folder
from microros_gen.interfaces.type_description import individual_type_description
from microros_gen.interfaces.types import Message, NamedType, TypeName, element_of
from microros_gen.selection.model import Selection


def manifest(project: Project, inputs: Mapping[str, bytes], outputs: Mapping[str, bytes]) -> bytes:
    """Return the manifest as JSON: keys sorted, UTF-8, one line end at its end.

    `types` holds the description of each type (REP-2016: `fields`, and in `parts` the types that it is made of).
    `inputs` are named by what they are (`microros.yaml`, `sensor_msgs/msg/Imu`), not by where they lie.
    """
    data = {
        "generator": {"name": "microros-gen", "version": __version__},
        "image": None if project.lacks_image else project.image,
        "target": project.target.name,
        "emulator": dataclasses.asdict(project.target.emulator) if project.target.emulator else None,
        "transport": _transport(project),
        "plan": project.runtime.plan_id,
        "selection": _selection(project),
        "entities": _entities(project),
        "pools": _pools(project),
        "message_storage": _message_storage(project),
        "memory": _memory(project.application.memory),
        **_features(project),
        "inputs": {name: _sha256(content) for name, content in inputs.items()},
        "outputs": {name: _sha256(content) for name, content in outputs.items()},
    }
    types = {
        str(plan.name): {
            "hash": plan.type_hash,
            "max_encoded_size": plan.max_encoded_size,
            "fields": individual_type_description(plan.message)["fields"],
            "parts": sorted(str(part) for part in closure(plan.name, project.messages)),
        }
        for plan in project.types
    }
    return manifest_text(data, types).encode()


def manifest_text(data: Mapping[str, Any], types: Mapping[str, Any]) -> str:
    """Print `data` over many lines and, as its last key, each type on one: that is quick, and a change is one line."""
    head = json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False).removesuffix("\n}")
    lines = ",\n".join(
        f"    {json.dumps(name)}: {json.dumps(entry, sort_keys=True, ensure_ascii=False)}"
        for name, entry in sorted(types.items())
    )
    return f'{head},\n  "types": {{\n{lines}\n  }}\n}}\n'


def _features(project: Project) -> dict[str, Any]:
    """Return what components say of themselves; nothing where none does."""
    entries = manifest_entries(project)
    return {"features": entries} if entries else {}


def _transport(project: Project) -> dict[str, Any]:
    runtime, kind = project.runtime, project.selection.transport
    common = {"type": kind, "mtu": runtime.streams.mtu}
    if kind == "serial":
        return {**common, "device": runtime.transport.device, "baud": runtime.transport.baud}
    if kind == "canfd":
        requested = project.application.transport
        return {**common, "device": requested.can_device, "id": requested.can_id}
    return common if kind == "custom" else {**common, "agent": runtime.transport.agent_place}


def _selection(project: Project) -> dict[str, Any]:
    selection = project.selection
    return {
        "profiles": list(selection.profiles),
        "components": [c.component.name for c in selection.components],
        "reasons": {
            c.component.name: [without_folder(reason) for reason in c.reasons] for c in selection.components
        },
        **_outside(selection),
        "entities": selection.entities,
        "transport": selection.transport,
        "liveliness": selection.liveliness,
        "xrce_profiles": [c.name for c in selection.xrce_profiles],
        "sends": [c.name for c in selection.sends],
        "receives": [c.name for c in selection.receives],
        "objects": [c.name for c in selection.objects],
    }


def _outside(selection: Selection) -> dict[str, Any]:
    """Return where the components are from that do not ship with the tool; nothing where all do."""
    found = (c.component for c in selection.components if c.component.origin)
    outside = {c.name: {"from": c.origin, "summary": c.summary} for c in found}
    return {"outside": outside} if outside else {}


def _entities(project: Project) -> dict[str, Any]:
    return {
        "nodes": [
            {"name": n.name, "namespace": n.namespace, "domain_id": n.domain_id}
            for n in project.runtime.entities.nodes.declared
        ],
        **{kind.key: _declared(project, kind) for kind in KINDS if _is_shown(project, kind)},
    }


def _is_shown(project: Project, kind: EntityKind) -> bool:
    """Return whether the manifest has a kind of entity: what sends messages always, services with any places."""
    entities = project.runtime.entities
    if kind.service_type:
        return entities.serves
    return not kind.receives or entities.places(kind.name).any


def _declared(project: Project, kind: EntityKind) -> list[dict[str, Any]]:
    """Return the declared entities of a kind, each with its queue where it receives."""
    declared = project.runtime.entities.places(kind.name).declared
    queues = iter(_queues(project, kind))
    return [_entity(project, entity, next(queues, None)) for entity in declared]


def _queues(project: Project, kind: EntityKind) -> tuple[QueuePlan, ...]:
    """Return the queues of a kind, in the order of its places; none of what only sends."""
    runtime = project.runtime
    first = 0
    for other in RECEIVING:
        count = runtime.entities.places(other.name).max
        if other == kind:
            return runtime.input.queues[first : first + count]
        first += count
    return ()


def _entity(
    project: Project, entity: PublisherPlan | SubscriptionPlan | ServicePlan, queue: QueuePlan | None
) -> dict[str, Any]:
    """Return a declared entity; with `max_encoded_size` where a publisher's limits are not those of its type."""
    if isinstance(entity, ServicePlan):
        return {"node": entity.node, "name": entity.name, "type": str(entity.type), **_queue(queue)}
    shown = {
        "node": entity.node,
        "topic": entity.topic,
        "type": str(entity.type),
        "reliable": entity.reliable,
    }
    if isinstance(entity, PublisherPlan):
        own = project.own_limits(entity)
        return {**shown, **({"max_encoded_size": own.max_encoded_size} if own else {})}
    in_input_buffer = entity.index == project.runtime.input.reader
    return {
        **shown,
        **_queue(queue),
        **({"slot": "input buffer"} if in_input_buffer else {}),
        **({"storage": "none"} if entity.storage and not entity.stored else {}),
    }


def _queue(queue: QueuePlan | None) -> dict[str, int]:
    """Return the size of a queue; with its bytes where its samples share them."""
    if queue is None:
        return {}
    shared = {} if queue.requested_bytes is None else {"queue_bytes": queue.requested_bytes}
    return {"queue": queue.slots, "slot_size": queue.slot_size, **shared}


def closure(name: TypeName, messages: Mapping[TypeName, Message]) -> frozenset[TypeName]:
    """Return the types that `name` is made of, at any depth, without itself."""
    found: set[TypeName] = set()
    waiting = [name]
    while waiting:
        elements = [element_of(field.type) for field in messages[waiting.pop()].fields]
        new = {e.name for e in elements if isinstance(e, NamedType)} - found
        found |= new
        waiting += sorted(new)
    return frozenset(found)


def _memory(memory: Memory) -> dict[str, Any]:
    """Return the budgets that the application sets, and where: `size` reads them from here."""
    budgets = (
        ("ram_budget", memory.ram_budget, memory.ram_span),
        ("flash_budget", memory.flash_budget, memory.flash_span),
        ("stack", memory.stack, memory.stack_span),
    )
    return {
        key: {"bytes": value, "place": f"{PurePath(span.source.name).name}:{span.line}" if span else None}
        for key, value, span in budgets
        if value is not None
    }


def _message_storage(project: Project) -> dict[str, Any]:
    """Return the blocks for strings and sequences of messages that are sent: pairs of elements and how many."""
    runtime = project.runtime
    pools = {p.kind: [[b.elements, b.count] for b in p.blocks] for p in runtime.memory.message_pools}
    return {"messages": runtime.memory.kept_messages, "blocks": pools}


def _pools(project: Project) -> dict[str, int]:
    runtime = project.runtime
    return {
        "nodes": runtime.entities.nodes.max,
        **{
            kind.key: places.max
            for kind in KINDS
            if (places := runtime.entities.places(kind.name)).any or not kind.receives
        },
        **({"queues": runtime.input.queues_size} if runtime.input.queues else {}),
        **({"timers": runtime.timers.max} if runtime.timers.any else {}),
        **(
            {
                "executors": runtime.executor.max,
                "handles": runtime.executor.handles_max,
                "guard_conditions": runtime.executor.guard_conditions_max,
            }
            if runtime.executor.any
            else {}
        ),
        "name_size": runtime.entities.name_size,
        "reliable_slots": runtime.streams.reliable_slots,
        "reliable_slot_size": runtime.streams.reliable_slot_size,
        "best_effort_size": runtime.streams.best_effort_size,
        **(
            {"best_effort_slots": runtime.streams.best_effort_slots}
            if runtime.streams.queues_best_effort
            else {}
        ),
        "input_size": runtime.input.size,
        **({"input_buffer": runtime.input.buffer_size} if runtime.input.lends else {}),
        "arena": runtime.memory.arena_size,
        "error_text": runtime.errors.text_size,
    }


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
