# SPDX-License-Identifier: Apache-2.0
"""Endpoints that receive: their places, the queues in which samples wait, and the largest sample of each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from microros_gen.application.model import Application, EndpointDecl, Qos
from microros_gen.client.plan.declared import declarations, full_name, named_at, pool, type_name
from microros_gen.client.plan.queues import declared_queue, pooled_queue
from microros_gen.client.plan.runtime_entities import QueuePlan, SubscriptionPlan
from microros_gen.client.plan.streams import STREAMED_FRAGMENT, Received, slot_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_topic
from microros_gen.interfaces.types import (
    ArrayType,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.records import dataclass
from microros_gen.selection.clock import CLOCK_ROS
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.names import include_path
from microros_gen.typesupport.plan.types import TypePlan

LARGEST_DEFAULT_QUEUE = 4
_SLOT_ALIGNMENT = 4


@dataclass(frozen=True)
class Receiving:
    """`queues` has one entry for each place that receives, in the order of the places."""

    subscriptions: tuple[SubscriptionPlan, ...] = ()
    subscriptions_max: int = 0
    queues: tuple[QueuePlan, ...] = ()
    received: tuple[Received, ...] = ()


def plan_receiving(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> Receiving:
    """Plan the subscriptions; without `nodes:` each of the pool can have any of the `roots`.

    A slot holds the largest sample under the subscription's own limits.
    """
    if not selection.has("subscribe"):
        return Receiving()
    if not application.nodes:
        least, default = (0, 0) if selection.serves_only("subscribe", CLOCK_ROS) else (1, len(roots))
        places = pool(application, "subscriptions", default, diagnostics)
        return _pooled(application, types, roots, max(places, least), diagnostics)
    subscriptions, queues, received = [], [], []
    for index, (node_index, node, endpoint) in enumerate(declarations(application, "subscription")):
        topic, name = full_name(node, endpoint), type_name(endpoint.type)
        reliable = endpoint.qos.reliability == "reliable"
        size = 0 if endpoint.streamed else types[name].largest("subscription", index)
        plan = SubscriptionPlan(
            index, node_index, topic, dds_topic(topic), name, reliable, declared_as=endpoint.declared_as
        )
        subscriptions.append(_with_storage(plan, types, endpoint.stored))
        label = f"{endpoint.type} on {topic}"
        slots = endpoint.queue or default_queue(endpoint.qos)
        queue = declared_queue(endpoint, slots, slot_of(size), label, diagnostics)
        queues.append(replace(queue, streamed=endpoint.streamed))
        received.append(
            Received(
                label,
                STREAMED_FRAGMENT if endpoint.streamed else size,
                reliable,
                not reliable,
                endpoint.type_span or endpoint.span,
                alone=queues[-1].waits_alone,
                streamed=endpoint.streamed,
            )
        )
    queues = queues or [QueuePlan(1, _SLOT_ALIGNMENT)]
    return Receiving(tuple(subscriptions), len(queues), tuple(queues), tuple(received))


def _with_storage(
    plan: SubscriptionPlan, types: Mapping[TypeName, TypePlan], stored: bool
) -> SubscriptionPlan:
    type_ = types[plan.type]
    if not type_.storage:
        return plan
    messages = {name: known.message for name, known in types.items()}
    return replace(
        plan,
        storage=type_.storage_name(plan.topic),
        header=include_path(type_.files.storage),
        c_type=type_.c_name,
        buffers=tuple(buffers_of(type_.message, messages)),
        stored=stored,
    )


def buffers_of(message: Message, messages: Mapping[TypeName, Message], prefix: str = "") -> Iterator[str]:
    """Yield what holds of each string and sequence without a buffer of the application: `frame_id.capacity <= 1u`.

    A message that was only initialized (`__init`) has none: its strings share one NUL, which is a capacity of 1.
    """
    for field in message.fields:
        element = element_of(field.type)
        indices = range(field.type.size) if isinstance(field.type, ArrayType) else (None,)
        for index in indices:
            member = f"{prefix}{field.name}" + ("" if index is None else f"[{index}]")
            if isinstance(field.type, SequenceType):
                yield f"{member}.data == NULL"
            elif isinstance(element, StringType):
                yield f"{member}.capacity <= 1u"
            elif isinstance(element, NamedType):
                yield from buffers_of(messages[element.name], messages, f"{member}.")


def default_queue(qos: Qos) -> int:
    """Return how many samples wait where the application file does not say."""
    return LARGEST_DEFAULT_QUEUE if qos.history == "keep_all" else min(qos.depth, LARGEST_DEFAULT_QUEUE)


def _implied_queue(endpoint: EndpointDecl, size: int) -> QueuePlan:
    return QueuePlan(endpoint.queue or default_queue(endpoint.qos), slot_of(size))


def _pooled(
    application: Application,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    places: int,
    diagnostics: Diagnostics,
) -> Receiving:
    """Return `places` for the application's subscriptions, after those of the library itself."""
    slots = application.pools.get("queue", LARGEST_DEFAULT_QUEUE)
    largest = max(roots, key=lambda root: types[root].max_encoded_size, default=None)
    slot_size = slot_of(types[largest].max_encoded_size if largest else 0)
    received = [
        Received(str(r), types[r].max_encoded_size, True, True, named_at(application, r))
        for r in roots
        if places
    ]
    queues = [_implied_queue(e, types[type_name(e.type)].max_encoded_size) for e in application.implied]
    received += [
        Received(f"{e.type} on {e.topic}", types[type_name(e.type)].max_encoded_size, False, True, e.span)
        for e in application.implied
    ]
    if places:
        queues += [pooled_queue(application, slots, slot_size, str(largest), diagnostics)] * places
    return Receiving((), len(queues), tuple(queues), tuple(received))
