# SPDX-License-Identifier: Apache-2.0
"""The rules of `local:` for services: one server in the image, and clients that call no other."""

from __future__ import annotations

from microros_gen.application.kinds import SERVICE_KINDS
from microros_gen.application.model import EndpointDecl
from microros_gen.client.plan.declared import declarations, full_name, type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.local_delivery.check import (
    report_limits,
    report_missing,
    report_not_local,
)
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.derived import derived_name
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import TypeLimits

SERVICE_SLOTS = 4
"""Requests, or replies, that wait without `queue`."""


@dataclass(frozen=True)
class ServiceEnd:
    """A service or a client, and its index among those of its kind."""

    index: int
    endpoint: EndpointDecl

    def limits(self, context: PlanContext) -> tuple[TypeLimits | None, ...]:
        """Return the limits of its requests and of its responses."""
        name = type_name(self.endpoint.type, "srv")
        parts = (context.types[derived_name(name, part)] for part in ("Request", "Response"))
        return tuple(part.limits_of(self.endpoint.kind, self.index) for part in parts)


def check_services(context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report each service with a local end whose ends do not agree."""
    services: dict[tuple[int, str], tuple[list[ServiceEnd], list[ServiceEnd]]] = {}
    for kind in SERVICE_KINDS:
        for index, (_, node, endpoint) in enumerate(declarations(context.application, kind)):
            ends = services.setdefault((node.domain_id, full_name(node, endpoint)), ([], []))
            if endpoint.local != "chip":
                ends[kind == "client"].append(ServiceEnd(index, endpoint))
    for (_, name), (servers, clients) in services.items():
        local = [end for end in (*servers, *clients) if end.endpoint.local != "never"]
        if local:
            _check_counts(name, servers, clients, local[0], diagnostics)
            _check_words(name, (*servers, *clients), local[0], diagnostics)
            _check_limits(name, servers, clients, context, diagnostics)


def _check_counts(
    name: str,
    servers: list[ServiceEnd],
    clients: list[ServiceEnd],
    local: ServiceEnd,
    diagnostics: Diagnostics,
) -> None:
    """Report a service without a client or a server in the image, and one with several servers."""
    for ends, missing in ((servers, "serves"), (clients, "calls")):
        if not ends:
            report_missing(name, missing, local.endpoint, diagnostics)
    for other in servers[1:]:
        diagnostics.error(
            f"a local service has one server: '{name}' has another one",
            other.endpoint.span,
            "Rename one of them, or remove `local`",
            id="MG-7186",
        )


def _check_words(
    name: str, ends: tuple[ServiceEnd, ...], local: ServiceEnd, diagnostics: Diagnostics
) -> None:
    """Report ends that are not local, and clients that would call two servers."""
    for end in ends:
        report_not_local(name, end.endpoint, local.endpoint, diagnostics)
        if end.endpoint.kind == "client" and end.endpoint.local == "also":
            diagnostics.error(
                f"a client calls one server: '{name}' is served in the image",
                end.endpoint.span,
                "Write `local: only` at the client",
                id="MG-7187",
            )


def _check_limits(
    name: str,
    servers: list[ServiceEnd],
    clients: list[ServiceEnd],
    context: PlanContext,
    diagnostics: Diagnostics,
) -> None:
    for server in servers[:1]:
        for client in clients:
            if client.limits(context) != server.limits(context):
                report_limits(name, client.endpoint, server.endpoint, diagnostics)
