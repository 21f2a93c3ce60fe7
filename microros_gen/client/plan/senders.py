# SPDX-License-Identifier: Apache-2.0
"""What an application sends, with the limits of each sender; and the storage that its messages get."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.layout import DataModel, StructLayouts
from microros_gen.typesupport.plan.message_pools import (
    DEFAULT_MESSAGES,
    MessagePool,
    Sender,
    plan_message_pools,
)
from microros_gen.typesupport.plan.types import TypePlan


@dataclass(frozen=True)
class SentStorage:
    """`kept` messages of each of `senders` get their strings and sequences from `pools`; 0: from the allocator."""

    kept: int
    senders: tuple[Sender, ...]
    pools: tuple[MessagePool, ...]


def plan_sent_storage(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    services: tuple[TypeName, ...],
    models: Sequence[DataModel],
) -> SentStorage:
    """Plan the storage of messages that are sent; `roots`, `services` as of plan_project, `models` of the target.

    An arena serves them as it does everything else, unless the application file names a number of messages.
    """
    memory = application.memory
    kept = memory.messages if memory.messages is not None else 0 if memory.arena else DEFAULT_MESSAGES
    if application.nodes:
        senders = tuple(_declared(application, types))
    else:
        senders = tuple(_pooled(application, selection, types, roots, services))
    messages = {name: plan.message for name, plan in types.items()}
    layouts = [StructLayouts(messages, model) for model in models]
    return SentStorage(kept, senders, plan_message_pools(senders, messages, layouts, kept))


def _declared(application: Application, types: Mapping[TypeName, TypePlan]) -> Iterator[Sender]:
    """Yield what the application fills; what the library encodes itself needs no memory of messages."""
    for kind in ("publisher", "service", "client"):
        for index, (_, node, endpoint) in enumerate(declarations(application, kind)):
            for name in _sent_types(kind, endpoint.type) if endpoint.stored else ():
                own = types[name].limit_set(kind, index)
                limits = own.limits if own else types[name].limits
                yield Sender(name, limits, full_name(node, endpoint))


def _sent_types(kind: str, text: str) -> Iterator[TypeName]:
    if kind == "publisher":
        yield type_name(text)
        return
    service = type_name(text, "srv")
    yield from (derived_name(service, part) for part, sends in KIND[kind].parts if sends)


def _pooled(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    services: tuple[TypeName, ...],
) -> Iterator[Sender]:
    """Yield a sender of each type; without `nodes:` any of them may be opened."""
    if selection.has("publish"):
        yield from (Sender(name, types[name].limits) for name in roots)
    if selection.has("services"):
        for service in services:
            for kind, key in (("service", "services"), ("client", "clients")):
                if application.pools.get(key, 1):
                    for name in _sent_types(kind, str(service)):
                        yield Sender(name, types[name].limits)
