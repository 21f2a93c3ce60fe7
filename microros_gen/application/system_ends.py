# SPDX-License-Identifier: Apache-2.0
"""The endpoints of a board that exchange messages over links, as the other boards see them."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.kinds import KIND, NAMES, other_end
from microros_gen.application.model import Application, EndpointDecl, NodeDecl
from microros_gen.application.names import expand_topic_name
from microros_gen.application.system_decl import Link, PeerEnd
from microros_gen.application.system_file import SystemFile
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.closure import split_type_name


def peer_ends(application: Application) -> Iterator[tuple[int, EndpointDecl, PeerEnd]]:
    """Yield the endpoints of an application that have `peer:`, and the index of each in its kind."""
    for kind in NAMES:
        declared = [(node, e) for node in application.nodes for e in node.endpoints if e.kind == kind]
        for index, (node, endpoint) in enumerate(declared):
            if endpoint.peer != "never":
                yield index, endpoint, end_of(node, endpoint)


def end_of(node: NodeDecl, endpoint: EndpointDecl) -> PeerEnd:
    """Return an endpoint of a node as another board sees it."""
    type_name = split_type_name(endpoint.type, KIND[endpoint.kind].type_kind)
    return PeerEnd(
        kind=endpoint.kind,
        domain_id=node.domain_id,
        topic=expand_topic_name(endpoint.topic, node.name, node.namespace),
        type=str(type_name or endpoint.type),
        reliability=endpoint.qos.reliability,
        peer=endpoint.peer,
        span=endpoint.span,
        limits=endpoint.limits,
        queue=endpoint.queue,
        interval_us=endpoint.interval_us,
        rate_span=endpoint.rate_span,
    )


def check_other_ends(
    application: Application, links: list[Link], system: SystemFile, diagnostics: Diagnostics
) -> None:
    """Report ends here without `peer:` of a topic or service that a board linked with this one alone has with it."""
    own = {(end.kind, end.domain_id, end.topic) for _, _, end in peer_ends(application)}
    others = [(node, e) for node in application.nodes for e in node.endpoints if e.peer == "never"]
    for link in links:
        linked = [
            link.board for every in system.links if link.board in dict(every.ends) for _ in every.ends[1:]
        ]
        wanted = {(other_end(end.kind), end.domain_id, end.topic): end for end in link.ends}
        for end in (end_of(node, endpoint) for node, endpoint in others if len(linked) == 1):
            its = wanted.get((end.kind, end.domain_id, end.topic))
            if its is None or (end.kind, end.domain_id, end.topic) in own:
                continue
            where = f" ({its.span.source.name}:{its.span.line})" if its.span else ""
            message = f"'{end.topic}' has no `peer:` here, and `peer: {its.peer}` at the board '{link.board}'{where}"
            diagnostics.error(message, end.span, "Write `peer: only`, or remove `peer` there", id="MG-9850")
