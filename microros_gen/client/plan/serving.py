# SPDX-License-Identifier: Apache-2.0
"""Services and clients: their places, their queues, and what they send and receive.

Sources: OMG DDS-XRCE 1.0, 7.7.14 (a request comes after its SampleIdentity); a reply comes after request and object
id of its request, as the public agent sends it.
"""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application, EndpointDecl
from microros_gen.client.plan.declared import (
    declarations,
    full_name,
    named_at,
    pool,
    type_name,
)
from microros_gen.client.plan.queues import declared_queue, pooled_queue
from microros_gen.client.plan.receiving import LARGEST_DEFAULT_QUEUE, buffers_of
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.client.plan.services import ServicePlan, StoredMessage
from microros_gen.client.plan.streams import Received, Written, slot_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.names import include_path
from microros_gen.typesupport.plan.types import TypePlan

IDENTITY_SIZE = 24
RELATED_SIZE = 4
KINDS = ("service", "client")
_HEAD = {"service": IDENTITY_SIZE, "client": RELATED_SIZE}
_WRITTEN_HEAD = {"service": IDENTITY_SIZE, "client": 0}


@dataclass(frozen=True)
class Serving:
    """`queues` has one entry for each place: those of services, then those of clients."""

    services: tuple[ServicePlan, ...] = ()
    clients: tuple[ServicePlan, ...] = ()
    services_max: int = 0
    clients_max: int = 0
    queues: tuple[QueuePlan, ...] = ()
    received: tuple[Received, ...] = ()
    written: tuple[Written, ...] = ()


def plan_serving(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> Serving:
    """Plan services and clients; without `nodes:` each place can have any of `roots`, which are services."""
    if not selection.has("services"):
        return Serving()
    if not roots and not any(declarations(application, *KINDS)) and not selection.has("subscribe"):
        _report_nothing(application, diagnostics)
    if not application.nodes:
        return _pooled(application, types, roots, diagnostics)
    _check_names(application, diagnostics)
    plans: dict[str, list[ServicePlan]] = {kind: [] for kind in KINDS}
    queues, received, written = [], [], []
    for kind in KINDS:
        for index, (node_index, node, endpoint) in enumerate(declarations(application, kind)):
            name = full_name(node, endpoint)
            plans[kind].append(_plan(kind, index, node_index, name, endpoint, types))
            label = f"the {{}} of {endpoint.type} on {name}"
            arriving, leaving = _sizes(kind, index, endpoint, types)
            span = endpoint.type_span or endpoint.span
            slots = endpoint.queue or LARGEST_DEFAULT_QUEUE
            what = ("request", "reply") if kind == "service" else ("reply", "request")
            size = slot_of(arriving) + _HEAD[kind]
            queues.append(declared_queue(endpoint, slots, size, label.format(what[0]), diagnostics))
            received.append(
                Received(
                    label.format(what[0]),
                    size,
                    True,
                    False,
                    span,
                    alone=queues[-1].waits_alone,
                )
            )
            written.append(Written(label.format(what[1]), leaving + _WRITTEN_HEAD[kind], True, False, span))
    services, clients = (tuple(plans[kind]) for kind in KINDS)
    return Serving(
        services, clients, len(services), len(clients), tuple(queues), tuple(received), tuple(written)
    )


def _report_nothing(application: Application, diagnostics: Diagnostics) -> None:
    """Report a selection without any service: the receiver would have no queue."""
    declares = "of a node" if application.nodes else "in `interfaces:`"
    span = None if application.nodes else application.spans.get("interfaces")
    hint = f"Add a service {declares}, or leave `services` out of `components:`"
    diagnostics.error("'services' is selected, but no service is declared", span, hint, id="MG-7019")


def _check_names(application: Application, diagnostics: Diagnostics) -> None:
    """Report a service that is served twice, or whose declarations differ in type.

    ROS 2 has one server for a name: of two, a caller would get both answers. Several clients of one service are right.
    """
    first: dict[str, EndpointDecl] = {}
    server: dict[str, EndpointDecl] = {}
    for _, node, endpoint in declarations(application, *KINDS):
        name = full_name(node, endpoint)
        other = first.setdefault(name, endpoint)
        same = server.setdefault(name, endpoint) if endpoint.kind == "service" else endpoint
        if type_name(other.type, "srv") != type_name(endpoint.type, "srv"):
            diagnostics.error(
                f"{name} is a {endpoint.type} here and a {other.type} elsewhere ({other.span})",
                endpoint.type_span or endpoint.span,
                "Give both the same type, or rename one",
                id="MG-7020",
            )
        elif same is not endpoint:
            diagnostics.error(
                f"two servers for {name}: each request would have two answers (the other: {same.span})",
                endpoint.topic_span or endpoint.span,
                "Remove one of them, or give it another name",
                id="MG-7021",
            )


def _sizes(
    kind: str, index: int, endpoint: EndpointDecl, types: Mapping[TypeName, TypePlan]
) -> tuple[int, int]:
    """Return the largest body that comes, and the largest that goes."""
    service = type_name(endpoint.type, "srv")
    sizes = {
        sends: types[derived_name(service, part)].largest(kind, index) for part, sends in KIND[kind].parts
    }
    return sizes[False], sizes[True]


def _plan(
    kind: str, index: int, node: int, name: str, endpoint: EndpointDecl, types: Mapping[TypeName, TypePlan]
) -> ServicePlan:
    service = type_name(endpoint.type, "srv")
    messages = {known: plan.message for known, plan in types.items()}
    limited, stored = "", []
    for part, sends in KIND[kind].parts:
        type_ = types[derived_name(service, part)]
        own = type_.limit_set(kind, index) if sends else None
        limited = own.name if own else limited
        if type_.storage and endpoint.stored and not (sends and kind == "client"):
            stored.append(
                StoredMessage(
                    part.lower(),
                    type_.storage_name(name),
                    include_path(type_.files.storage),
                    type_.c_name,
                    tuple(buffers_of(type_.message, messages)),
                )
            )
    return ServicePlan(kind, index, node, name, service, limited, tuple(stored), endpoint.declared_as)


def _pooled(
    application: Application,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> Serving:
    services = pool(application, "services", len(roots), diagnostics)
    clients = pool(application, "clients", len(roots), diagnostics)
    slots = application.pools.get("queue", LARGEST_DEFAULT_QUEUE)
    requests = [(root, types[derived_name(root, "Request")].max_encoded_size) for root in roots]
    replies = [(root, types[derived_name(root, "Response")].max_encoded_size) for root in roots]
    request = slot_of(max((size for _, size in requests), default=0)) + IDENTITY_SIZE
    reply = slot_of(max((size for _, size in replies), default=0)) + RELATED_SIZE
    queues: list[QueuePlan] = []
    for places, size, label in ((services, request, "a request"), (clients, reply, "a reply")):
        if places:
            queues += [pooled_queue(application, slots, size, label, diagnostics)] * places
    at = {root: named_at(application, root) for root in roots}
    received = [
        *(
            Received(f"the request of {r}", slot_of(n) + IDENTITY_SIZE, True, False, at[r])
            for r, n in requests
        ),
        *(Received(f"the reply of {r}", slot_of(n) + RELATED_SIZE, True, False, at[r]) for r, n in replies),
    ]
    written = [
        *(Written(f"the request of {r}", n, True, False, at[r]) for r, n in requests),
        *(Written(f"the reply of {r}", n + IDENTITY_SIZE, True, False, at[r]) for r, n in replies),
    ]
    return Serving(
        services_max=services,
        clients_max=clients,
        queues=tuple(queues),
        received=tuple(received),
        written=tuple(written),
    )
