# SPDX-License-Identifier: Apache-2.0
"""Clients that create nothing: the agent has their objects and creates them when they open their session.

Such objects behave like created ones: they sleep and wake with the client, a CREATE of an equal object finds them, a
DELETE removes them until the session is opened again, and they leave the ROS graph with the session.

A client with `liveliness: ping` or `acknack` detects a new agent and opens its session again. One with
`liveliness: none` never does. Its samples have a session id that many clients use (0x81) and no key: only the address
identifies their sender, and a new agent does not know it. If the agent assumed that such a sample came from the only
missing client, it would publish samples of other clients under wrong names and keep these clients from recovering. The
agent therefore adopts a client only if the file says `adopt: true`, which means that no other client connects, and if

- the message carries that client's key (session ids below 0x80), or exactly one client to adopt is not in session and
  its sender was observed for some seconds (`Limits.adopt_after_s`) without an answer: a client with liveliness searches
  for the agent before that;
- its first submessage is a WRITE_DATA to one of the client's data writers, requesters or repliers, or, on a reliable
  stream, the HEARTBEAT that precedes it: only this one tells where the stream continues;
- no client is in session at its address.

A client that only reads cannot be adopted, and readers of an adopted client receive nothing: the client sent its
READ_DATA to the earlier agent. Its address, the request id of its DATA and its sequence numbers are lost with that
agent, and the standard has no message with which an agent finds clients (DDS-XRCE 1.0, 8.4). A client that reads needs
liveliness; the parser of the file warns about it.

An adopted client that pings or creates an object turns out to be a different one: it is removed, and opens a session.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from microros_gen.agent.configuration.entities import PreconfiguredClient, PreconfiguredObject
from microros_gen.agent.representation import (
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    Service,
    Topic,
)
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.ros.names import ros_node, ros_service, ros_topic, ros_type
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

WRITTEN = (ObjectKind.DATAWRITER, ObjectKind.REQUESTER, ObjectKind.REPLIER)
"""Kinds of objects that a client can write to."""


@dataclass(frozen=True)
class PreconfiguredCreation:
    """An object that the agent creates: its id, that of its container, and its description."""

    id: int
    parent: int
    description: Description


class Preconfigured:
    """Objects by the key of their client."""

    def __init__(self, clients: Sequence[PreconfiguredClient] = ()) -> None:
        """Prepare the contents of a file. Raises UserError for names that are invalid in ROS 2."""
        diagnostics = Diagnostics()
        for client in clients:
            for item in client.objects:
                _check_names(item, diagnostics)
        diagnostics.check()
        self._by_key = {c.key: tuple(_creation(item) for item in c.objects) for c in clients}
        self.adopted = frozenset(c.key for c in clients if c.adopt and c.key is not None)
        """Keys of the clients that are adopted if they have not opened their session with this agent."""
        self._only: frozenset[bytes] | None = None

    def objects(self, key: bytes) -> tuple[PreconfiguredCreation, ...]:
        """Return the objects of the client `key`, parents first."""
        found = self._by_key.get(key)
        return self._by_key.get(None, ()) if found is None else found

    def adopt_only(self, keys: frozenset[bytes]) -> None:
        """In a worker: adopt these (at most one) alone from messages without a key."""
        self._only = keys

    def never_adopt(self, key: bytes) -> None:
        """Adopt a client no longer."""
        self.adopted -= {key}

    def missing(self, in_session: Iterable[bytes]) -> frozenset[bytes]:
        """Return the keys of the clients to adopt without those that are in session."""
        return self.adopted.difference(in_session) if self.adopted else self.adopted

    def to_adopt(self, key: bytes, writer: int | None, in_session: Iterable[bytes]) -> bytes | None:
        """Return the key of the client to adopt for a message without a session, or None.

        `key` is that of the message's header (may be empty), `writer` the object that it writes to (None: a HEARTBEAT).
        """
        missing = self.missing(in_session)
        candidates = missing & {key} if key else missing if self._only is None else missing & self._only
        if len(candidates) != 1:
            return None
        (found,) = candidates
        fits = writer is None or any(o.id == writer and o.id & 0x0F in WRITTEN for o in self._by_key[found])
        return found if fits else None


def _creation(item: PreconfiguredObject) -> PreconfiguredCreation:
    return PreconfiguredCreation(item.id, item.parent, _description(item))


def _description(item: PreconfiguredObject) -> Description:
    if item.kind == "participant":
        return Participant(item.name, item.domain)
    if item.kind == "topic":
        return Topic(item.name, item.type)
    if item.kind in ("publisher", "subscriber"):
        return Group()
    if item.kind in ("requester", "replier"):
        return _service(item)
    return Endpoint(
        None, item.topic, Qos(item.reliable, Durability(item.durability), item.keep_last, item.depth)
    )


def _service(item: PreconfiguredObject) -> Service:
    return Service(item.name, item.request_type, item.reply_type, item.request_topic, item.reply_topic)


def _check_names(item: PreconfiguredObject, diagnostics: Diagnostics) -> None:
    wanted = "rt/topic, package::msg::dds_::Type_"
    try:
        if item.kind == "participant":
            ros_node(item.name)
        elif item.kind == "topic":
            ros_topic(item.name)
            ros_type(item.type)
        elif item.kind in ("requester", "replier"):
            wanted = "rq/nameRequest, rr/nameReply, package::srv::dds_::Type_Request_, …_Response_"
            ros_service(_service(item))
    except BridgeError as error:
        diagnostics.error(str(error), item.span, f"Names are those of DDS: {wanted}", id="MG-9416")
