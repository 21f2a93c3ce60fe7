# SPDX-License-Identifier: Apache-2.0
"""What an application declares, as the other parts of the plan go through it."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.application.names import expand_topic_name
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.interfaces.closure import split_type_name
from microros_gen.interfaces.types import TypeName

LARGEST_POOL = 250


def declarations(application: Application, *kinds: str) -> tuple[tuple[int, NodeDecl, EndpointDecl], ...]:
    """Return every declared endpoint of these kinds with its node and the node's index, in the order of the file."""
    return tuple(
        (index, node, endpoint)
        for index, node in enumerate(application.nodes)
        for endpoint in node.endpoints
        if endpoint.kind in kinds
    )


def implied(application: Application, *kinds: str) -> int:
    """Return how many endpoints of these kinds the library opens by itself."""
    return sum(endpoint.of_the_library for endpoint in _endpoints(application, kinds))


def without_handle(application: Application, *kinds: str) -> int:
    """Return how many endpoints of these kinds no executor of the application runs."""
    return sum(not endpoint.takes_handle for endpoint in _endpoints(application, kinds))


def _endpoints(application: Application, kinds: tuple[str, ...]) -> Iterator[EndpointDecl]:
    yield from (endpoint for _, _, endpoint in declarations(application, *kinds))
    yield from (endpoint for endpoint in application.implied if endpoint.kind in kinds)


def timed_qos(application: Application, entities: str, diagnostics: Diagnostics) -> bool:
    """Return whether an endpoint has a deadline or lifespan; where objects are not described in binary: an error."""
    timed = [
        e for node in application.nodes for e in node.endpoints if e.qos.deadline_ms or e.qos.lifespan_ms
    ]
    for endpoint in timed if entities != "binary" else ():
        diagnostics.error(
            f"'entities: {entities}' carries neither deadline nor lifespan: '{endpoint.topic}' has one",
            endpoint.qos.span,
            "Use `entities: binary`, or remove it",
            id="MG-7011",
        )
    return bool(timed)


def check_types(application: Application, diagnostics: Diagnostics) -> None:
    """Report each topic and service that two declarations give different types: their endpoints would never match."""
    first: dict[tuple[int, bool, str], tuple[str, EndpointDecl]] = {}
    for node in application.nodes:
        for endpoint in node.endpoints:
            endpoint_kind = KIND[endpoint.kind]
            served = endpoint_kind.service_type
            name, kind = full_name(node, endpoint), str(type_name(endpoint.type, endpoint_kind.type_kind))
            known, other = first.setdefault((node.domain_id, served, name), (kind, endpoint))
            if known != kind:
                span = endpoint.type_span or endpoint.span
                line = f" in line {other.span.line}" if other.span else ""
                message = f"{name} has the type {kind} here and {known}{line}"
                diagnostics.error(message, span, "Give both the same type, or rename one", id="MG-7012")


def full_name(node: NodeDecl, endpoint: EndpointDecl) -> str:
    """Return the fully qualified name of an endpoint's topic or service, `/imu/data`, or that of a topic in DDS."""
    if endpoint.outside_ros:
        return endpoint.topic
    return expand_topic_name(endpoint.topic, node.name, node.namespace)


def node_name(node: NodeDecl) -> str:
    """Return the fully qualified name of a node: `/arm/imu`."""
    return node.full_name


def type_name(text: str, kind: str = "msg") -> TypeName:
    """Return the full name of `pkg/Type` or `pkg/msg/Type` (already checked); `kind` is srv for services."""
    name = split_type_name(text, kind)
    assert name is not None, text
    return name


def pool(application: Application, key: str, default: int, diagnostics: Diagnostics) -> int:
    """Return how many places `pools: {key: N}` gives, `default` without it; too many are an error."""
    value = application.pools.get(key, default)
    if value > LARGEST_POOL:
        diagnostics.error(
            f"{value} {key} are more than the {LARGEST_POOL} that one session holds",
            hint="Select fewer interfaces, or say how many there are at once with "
            f"`pools: {{{key}: N}}` in the application file",
            id="MG-7013",
        )
    return value


def named_at(application: Application, root: TypeName) -> Span | None:
    """Return where `interfaces:` or the command line names a type or its package; None: the application names none."""
    spans = {named.name: named.span for named in application.interfaces}
    return spans.get(str(root)) or spans.get(root.package)
