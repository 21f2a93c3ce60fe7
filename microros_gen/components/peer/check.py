# SPDX-License-Identifier: Apache-2.0
"""The rules of `peer:`: the ends of a topic or service on two boards have to agree, and what a link does not carry."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.kinds import KIND, NAMES, other_end
from microros_gen.application.model import EndpointDecl
from microros_gen.application.system_decl import CanFrames, Link, PeerEnd
from microros_gen.application.system_ends import peer_ends
from microros_gen.application.system_file import LARGEST_MTU, UART
from microros_gen.application.system_find import exchanged
from microros_gen.application.transport_decl import Transport
from microros_gen.client.plan.creation import MESSAGE_HEADER
from microros_gen.client.plan.declared import type_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.serving import IDENTITY_SIZE
from microros_gen.components.agentless.plan import is_alone
from microros_gen.components.peer.check_limits import LimitedEnds, check_client_keys, check_limits, sent_body
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

MESSAGE_OVERHEAD = 12
"""Bytes before the body of WRITE_DATA: headers of message and submessage, request and object."""

LARGEST_MESSAGE = MESSAGE_HEADER + 0xFFFF
"""Bytes of a message whose submessages have a size of 16 bits, as the client stores it, before it goes in fragments."""

Key = tuple[int, str]
"""Domain and name of a topic or service."""

_MISSING = dict(zip(NAMES, ("subscribes to", "publishes", "calls", "serves"), strict=True))
"""What no other board does, by the kind of this board's end."""


@dataclass(frozen=True)
class OwnEnd:
    """An endpoint of this board with `peer:`; `index` is that among the endpoints of its kind."""

    index: int
    endpoint: EndpointDecl
    end: PeerEnd

    @property
    def publishes(self) -> bool:
        """Return whether it is a publisher."""
        return self.end.kind == "publisher"

    @property
    def is_service(self) -> bool:
        """Return whether it is a service or a client of one."""
        return KIND[self.end.kind].service_type

    @property
    def key(self) -> Key:
        """Return domain and name of its topic or service."""
        return self.end.domain_id, self.end.topic

    @property
    def type(self) -> TypeName:
        """Return the type of its messages, or that of the service."""
        return type_name(self.end.type, KIND[self.end.kind].type_kind)

    @property
    def parts(self) -> tuple[tuple[TypeName, bool], ...]:
        """Return its messages, and whether it sends each."""
        sends = (sent for _, sent in KIND[self.end.kind].parts)
        return tuple(zip(exchanged(self.type), sends, strict=True))

    @property
    def sends(self) -> bool:
        """Return whether it sends anything on a link."""
        return any(sends for _, sends in self.parts)

    def sent_size(self, context: PlanContext) -> int:
        """Return the bytes of the largest message that it sends on a link; 0: it sends none."""
        sizes = (
            context.types[part].largest(self.end.kind, self.index) for part, sends in self.parts if sends
        )
        return max((size + head_of(self.end.kind) for size in sizes), default=0)

    def taken_size(self, end: PeerEnd, link: Link, context: PlanContext) -> int:
        """Return the bytes of the largest message that an end of the other board sends to it; 0: it sends none."""
        if end.type != self.end.type:
            return 0  # reported
        messages = {known: plan.message for known, plan in context.types.items()}
        sizes = (sent_body(end, link, part, messages) for part, sends in self.parts if not sends)
        return max((size + head_of(end.kind) for size in sizes), default=0)


def head_of(kind: str) -> int:
    """Return the bytes before the body of what an endpoint sends on a link: a reply has an identity there."""
    return MESSAGE_OVERHEAD + (IDENTITY_SIZE if kind == "service" else 0)


def own_ends(context: PlanContext) -> tuple[OwnEnd, ...]:
    """Return the endpoints of this board that have `peer:`."""
    return tuple(OwnEnd(index, endpoint, end) for index, endpoint, end in peer_ends(context.application))


def matches(own: OwnEnd, link: Link) -> Iterator[PeerEnd]:
    """Yield the ends of the other board that the messages of an endpoint go to, or come from."""
    for end in link.ends:
        if end.kind == other_end(own.end.kind) and (end.domain_id, end.topic) == own.key:
            yield end


def check_peers(context: PlanContext, ends: tuple[OwnEnd, ...], diagnostics: Diagnostics) -> None:
    """Report everything that this board and those that it is linked with do not agree about."""
    application = context.application
    if not ends:
        diagnostics.error(
            "the component 'peer' is for endpoints with `peer:`",
            application.spans.get("components") or application.spans.get("system"),
            "Write `peer: only` at an endpoint, or remove the component",
            id="MG-7190",
        )
    elif application.system is None:
        diagnostics.error(
            "`peer:` needs the system in which this board is",
            ends[0].endpoint.span,
            "Write `system: {file: system.yaml, board: NAME}`",
            id="MG-7191",
        )
    else:
        _check_links(context, diagnostics)
        check_client_keys(application, diagnostics)
        for own in ends:
            _check_end(own, context, diagnostics)


def _check_links(context: PlanContext, diagnostics: Diagnostics) -> None:
    application, kind = context.application, context.selection.transport
    if not application.links:
        assert application.system is not None
        board = application.system.board
        message = f"no link of the system ends at the board '{board.name}'"
        diagnostics.error(message, board.span, "Add it to `links` of the system", id="MG-7192")
    for link in application.links:
        if link.kind != kind:
            message = f"a {link.kind} link needs `transport: {{type: {link.kind}}}`; that of the application is {kind}"
            hint = f"Write `transport: {{type: {link.kind}}}`"
            diagnostics.error(message, link.span, hint, id="MG-7193")
        elif link.kind == "serial":
            _check_line(context, link, diagnostics)
        elif link.can is not None:
            _check_bit_rate(application.transport, link, link.can, diagnostics)


def _agent_lines(transport: Transport) -> tuple[str, ...]:
    return transport.devices or (transport.device,)


def _check_line(context: PlanContext, link: Link, diagnostics: Diagnostics) -> None:
    """Report a serial line that the board does not have, has for its agent, or that has two rates."""
    application, is_uart = context.application, link.own.name == UART
    if is_uart == bool(context.runtime.transport.device):
        what = f"write `{UART}`" if not is_uart else "write the name of its device"
        message = f"'{link.own.name}' is no line of the target '{context.target.name}'"
        diagnostics.error(message, link.own.span, f"For this target, {what}", id="MG-7194")
    elif is_uart and (not is_alone(application) or len(application.links) > 1):
        others = "a second link" if len(application.links) > 1 else "an agent"
        message = (
            f"the target '{context.target.name}' has one serial line, which a link cannot share with {others}: all of "
            "them send whenever they have something, and frames on one pair of wires would collide"
        )
        hint = (
            "Write `peer: only` at all endpoints, with one link, or use links and a transport of type canfd or udp, "
            "which are shared"
        )
        diagnostics.error(message, link.own.span, hint, id="MG-7195")
    elif not is_uart and not is_alone(application) and link.own.name in _agent_lines(application.transport):
        message = f"'{link.own.name}' is the line to the agent, too: a serial line has two ends"
        hint = "Give the link another device, or use links and a transport of type canfd or udp"
        diagnostics.error(message, link.own.span, hint, id="MG-7196")
    if application.transport.baud != link.baud:
        message = (
            f"the baud rate is {application.transport.baud} here and {link.baud} at the board '{link.board}'"
        )
        hint = "Write the same `transport: {baud: …}` in both applications"
        diagnostics.error(message, link.span, hint, id="MG-7197")


def _check_bit_rate(transport: Transport, link: Link, can: CanFrames, diagnostics: Diagnostics) -> None:
    """Report a bus with two bit rates; an application without one does not say it."""
    if transport.bitrate is None or can.bitrate in (None, transport.bitrate):
        return
    message = f"the bit rate is {transport.bitrate} here and {can.bitrate} at the board '{link.board}'"
    hint = "Write the same `transport: {bitrate: …}` in both applications"
    diagnostics.error(message, link.span, hint, id="MG-7268")


def _check_end(own: OwnEnd, context: PlanContext, diagnostics: Diagnostics) -> None:
    found = [(link, end) for link in context.application.links for end in matches(own, link)]
    if not found:
        diagnostics.error(
            f"no board that is linked with this one {_MISSING[own.end.kind]} '{own.end.topic}'",
            own.endpoint.span,
            "Remove `peer`, or write it at the other end, too",
            id="MG-7198",
        )
    _check_qos(own, diagnostics)
    for link, end in found:
        _check_pair(own, end, link, context, diagnostics)
    if own.sends:
        _check_output(own, [link for link, _ in found], context, diagnostics)


def _check_qos(own: OwnEnd, diagnostics: Diagnostics) -> None:
    """Report QoS that a link does not have."""
    qos = own.endpoint.qos
    for wrong, what in (
        (qos.history == "keep_all", "`history: keep_all`"),
        (qos.durability == "transient_local", "`durability: transient_local`"),
        (bool(qos.deadline_ms), "a deadline"),
        (bool(qos.lifespan_ms), "a lifespan"),
    ):
        if wrong:
            message = f"a link has no such QoS: '{own.end.topic}' has {what}"
            span = qos.span or own.endpoint.span
            diagnostics.error(message, span, "Remove it, or remove `peer`", id="MG-7199")


def _check_pair(
    own: OwnEnd, end: PeerEnd, link: Link, context: PlanContext, diagnostics: Diagnostics
) -> None:
    """Report what the two ends do not agree about; each board reports it for its own end."""
    topic, span = own.end.topic, own.endpoint.type_span or own.endpoint.span
    other = f"the {end.kind} of the board '{link.board}'{_at(end.span)}"
    if end.type != own.end.type:
        message = f"'{topic}' has the type {own.end.type} here, and {other} has {end.type}"
        diagnostics.error(message, span, "Give both the same type", id="MG-7200")
    elif end.type_hash not in (None, " ".join(context.types[part].type_hash for part, _ in own.parts)):
        message = f"{own.end.type} is defined otherwise than for {other}: their type hashes differ"
        diagnostics.error(message, span, "Use the same interface files for both boards", id="MG-7201")
    else:
        for part, sends in own.parts:
            ends = LimitedEnds(own.endpoint, own.index, end, link, part, sends)
            check_limits(ends, context, diagnostics)
    writer, reader = (own.end, end) if own.publishes else (end, own.end)
    if reader.reliability == "reliable" and writer.reliability != "reliable":
        needs = "is best effort" if own.publishes else "is reliable"
        message = f"'{topic}' {needs} here and never matches {other}"
        hint = "Write `qos: {reliability: best_effort}` at the subscription"
        diagnostics.error(message, own.endpoint.qos.span or own.endpoint.span, hint, id="MG-7202")
    if own.end.peer == end.peer == "also" and not own.is_service:
        message = (
            f"the messages of '{topic}' would arrive twice, over the link and over ROS: {other} has `also`"
        )
        diagnostics.error(message, own.endpoint.span, "Write `peer: only` at one of them", id="MG-7203")


def _check_output(own: OwnEnd, links: list[Link], context: PlanContext, diagnostics: Diagnostics) -> None:
    """Report messages that are too large for a link, and what happens to reliable ones that have no room."""
    size, reliable = own.sent_size(context), own.end.reliability == "reliable"
    if reliable and size > LARGEST_MESSAGE:
        message = f"a message of '{own.end.topic}' takes {size} bytes, and fragments of a link carry {LARGEST_MESSAGE}"
        diagnostics.error(message, own.endpoint.span, "Lower its limits", id="MG-7209")
    for link in links:
        if size > link.mtu and not reliable:
            message = (
                f"a message of '{own.end.topic}' takes {size} bytes on the link, which has an MTU of {link.mtu}, and "
                "only reliable messages go in fragments"
            )
            ways = [f"set mtu: {size} at the link"] if size <= LARGEST_MTU and link.can is None else []
            hint = ", ".join([*ways, "make it reliable, or lower limits"])
            diagnostics.error(message, own.endpoint.span, hint[0].upper() + hint[1:], id="MG-7204")
    if reliable and context.application.on_full != "error":
        message = f"`on_full: {context.application.on_full}` is not for links, and '{own.end.topic}' is reliable there"
        span = context.application.spans.get("on_full")
        diagnostics.error(message, span, "Write `on_full: error`, or make it best effort", id="MG-7205")


def _at(span: Span | None) -> str:
    return f" ({span.source.name}:{span.line})" if span else ""
