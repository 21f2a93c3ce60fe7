# SPDX-License-Identifier: Apache-2.0
"""The rules of `peer:` for services: a client calls one server, which has room for the requests of all its clients."""

from __future__ import annotations

from microros_gen.application.system_decl import Link
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.receiving import LARGEST_DEFAULT_QUEUE
from microros_gen.components.peer.check import OwnEnd, matches
from microros_gen.diagnostics import Diagnostics


def check_services(ends: tuple[OwnEnd, ...], context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report services and clients with `peer:` that cannot work together."""
    for own in ends:
        if own.endpoint.local != "never":
            diagnostics.error(
                f"'{own.end.topic}' has `local: {own.endpoint.local}` and `peer: {own.end.peer}`, "
                f"and a {own.end.kind} can have one of them",
                own.endpoint.span,
                "Remove `local` or `peer`",
                id="MG-7211",
            )
        if own.end.kind == "client":
            _check_client(own, context, diagnostics)
        elif own.end.kind == "service":
            _check_queue(own, context, diagnostics)


def _check_client(own: OwnEnd, context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report a client that would call several servers."""
    if own.end.peer == "also":
        diagnostics.error(
            f"a client calls one server: that of '{own.end.topic}' is on another board",
            own.endpoint.span,
            "Write `peer: only` at the client",
            id="MG-7212",
        )
    servers = [link.board for link in context.application.links for _ in matches(own, link)]
    if len(servers) > 1:
        names = ", ".join(f"'{name}'" for name in servers)
        diagnostics.error(
            f"a client calls one server: the boards {names} serve '{own.end.topic}'",
            own.endpoint.span,
            "Give each its own name, or remove `peer` at all servers but one",
            id="MG-7213",
        )


def requests_of(own: OwnEnd, link: Link) -> int:
    """Return how many requests the clients of a link may have under way at a service; 0: it is no service."""
    ends = matches(own, link) if own.end.kind == "service" else ()
    return sum(end.queue or LARGEST_DEFAULT_QUEUE for end in ends)


def _check_queue(own: OwnEnd, context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report a queue without room for the requests that may be under way at a time."""
    room = own.endpoint.queue or LARGEST_DEFAULT_QUEUE
    waiting = sum(requests_of(own, link) for link in context.application.links)
    besides = 1 if own.end.peer == "also" else 0
    if own.endpoint.queue_bytes is not None:
        diagnostics.error(
            f"the queue of '{own.end.topic}' has bytes, and room for no certain number of requests of other boards",
            own.endpoint.queue_bytes_span or own.endpoint.span,
            f"Write `queue: {waiting + besides}` instead of `queue_bytes`",
            id="MG-7215",
        )
    elif room < waiting + besides:
        others = ", and one of the agent" if besides else ""
        diagnostics.error(
            f"{waiting} requests of '{own.end.topic}' may come from other boards at a time{others}, and {room} fit its "
            "queue",
            own.endpoint.span,
            f"Write `queue: {waiting + besides}`, or a smaller one at the clients",
            id="MG-7214",
        )
