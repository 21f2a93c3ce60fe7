# SPDX-License-Identifier: Apache-2.0
"""Publishers: their places, and the largest message that each writes."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.application.names import expand_topic_name
from microros_gen.client.plan.declared import declarations, named_at, pool, type_name
from microros_gen.client.plan.runtime_entities import PublisherPlan
from microros_gen.client.plan.streams import Written
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_topic
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.selection.model import Selection
from microros_gen.typesupport.plan.types import TypePlan


@dataclass(frozen=True)
class Publishing:
    """`written` has an entry for each publisher, or for each type that one of the pool can have."""

    publishers: tuple[PublisherPlan, ...] = ()
    publishers_max: int = 0
    written: tuple[Written, ...] = ()


def plan_publishing(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> Publishing:
    """Plan the publishers; without `nodes:` each of the pool can have any of the `roots`."""
    publishers = _declared(application, types)
    return Publishing(
        publishers,
        _publishers_max(application, selection, publishers, roots, diagnostics),
        _written_by_publishers(application, selection, types, roots),
    )


def _declared(application: Application, types: Mapping[TypeName, TypePlan]) -> tuple[PublisherPlan, ...]:
    publishers = []
    for index, (node_index, node, endpoint) in enumerate(declarations(application, "publisher")):
        topic = expand_topic_name(endpoint.topic, node.name, node.namespace)
        reliable = endpoint.qos.reliability == "reliable"
        name = type_name(endpoint.type)
        own = types[name].limit_set("publisher", index)
        publishers.append(
            PublisherPlan(
                index,
                node_index,
                topic,
                dds_topic(topic),
                name,
                reliable,
                own.name if own else "",
                endpoint.declared_as,
            )
        )
    return tuple(publishers)


def _publishers_max(
    application: Application,
    selection: Selection,
    publishers: tuple[PublisherPlan, ...],
    roots: tuple[TypeName, ...],
    diagnostics: Diagnostics,
) -> int:
    least = 1 if selection.has("publish") and selection.has("read") else 0
    if application.nodes:
        return max(len(publishers), least)
    default = len(roots) if selection.has("publish") else 0
    return max(pool(application, "publishers", default, diagnostics), least)


def _written_by_publishers(
    application: Application,
    selection: Selection,
    types: Mapping[TypeName, TypePlan],
    roots: tuple[TypeName, ...],
) -> tuple[Written, ...]:
    if not selection.has("publish"):
        return ()
    if not application.nodes:
        return tuple(
            Written(str(r), types[r].max_encoded_size, True, True, named_at(application, r)) for r in roots
        )
    declared = enumerate(declarations(application, "publisher"))
    return tuple(_written(index, node, endpoint, types) for index, (_, node, endpoint) in declared)


def _written(
    index: int, node: NodeDecl, endpoint: EndpointDecl, types: Mapping[TypeName, TypePlan]
) -> Written:
    size = types[type_name(endpoint.type)].largest("publisher", index)
    reliable = endpoint.qos.reliability == "reliable"
    label = f"{endpoint.type} on {expand_topic_name(endpoint.topic, node.name, node.namespace)}"
    return Written(label, size, reliable, not reliable, endpoint.type_span or endpoint.span)
