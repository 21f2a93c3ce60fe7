# SPDX-License-Identifier: Apache-2.0
"""The conversations in a recording: the messages between the agent and one client at one address."""

from __future__ import annotations

from pathlib import Path

from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.packets import Endpoint, decode
from microros_gen.agent.recording.pcapng import PcapngError
from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Message:
    """A message: the number of its packet in the file, from 1, its time, and whether the client sent it."""

    number: int
    time_ns: int
    of_client: bool
    data: bytes


@dataclass(frozen=True)
class Conversation:
    """Messages on a transport (`udp4 127.0.0.1:8888`) with the client at a place, in their order."""

    transport: str
    client: Endpoint
    messages: tuple[Message, ...]

    @property
    def key(self) -> str:
        """The client's key as in the log, from its first CREATE_CLIENT."""
        return key_of(next(message.data for message in self.messages if opens_session(message.data)))


def opens_session(data: bytes) -> bool:
    """Return whether a message begins with CREATE_CLIENT."""
    at = 4 if data and data[0] >= 0x80 else 8
    return len(data) >= at + 17 and data[at] == SubmessageId.CREATE_CLIENT and not data[1]


def key_of(data: bytes) -> str:
    """Return the key in a CREATE_CLIENT as the log has it."""
    at = 4 if data[0] >= 0x80 else 8
    return data[at + 12 : at + 16].hex().upper()


def read_recording(path: Path, key: str | None = None) -> tuple[list[Conversation], int]:
    """Return the conversations that begin with a session, and the number of messages outside of them.

    Messages before the first CREATE_CLIENT of a client cannot be replayed: its objects are not known. The file is read
    as a stream; only messages that are replayed are kept. With `key`, those of this client; of others, the first one.
    Raises UserError if the file cannot be read or has no such conversation.
    """
    found: dict[tuple[str, Endpoint], list[Message]] = {}
    outside = 0
    try:
        with path.open("rb") as file:
            for number, packet in enumerate(pcapng.read_packets(file), 1):
                named = _message(number, packet)
                if named is None or not (named[0] in found or _begins(named[1])):
                    outside += 1
                    continue
                name, message = named
                kept = found.setdefault(name, [])
                if not kept or key is None or key_of(kept[0].data) == key:
                    kept.append(message)
    except OSError as error:
        raise UserError([_unreadable(path, error.strerror or str(error))]) from error
    except PcapngError as error:
        raise UserError([_unreadable(path, str(error))]) from error
    if not found:
        raise UserError([_unreadable(path, "it has no session of a client")])
    conversations = [
        Conversation(name, client, tuple(messages)) for (name, client), messages in found.items()
    ]
    return conversations, outside


def _begins(message: Message) -> bool:
    return message.of_client and opens_session(message.data)


def _message(number: int, packet: pcapng.Packet) -> tuple[tuple[str, Endpoint], Message] | None:
    """Return a message and its conversation, by transport and client; None for a packet that is none."""
    datagram = decode(packet.data) if packet.interface.linktype == pcapng.LINKTYPE_ETHERNET else None
    if datagram is None or packet.direction not in (pcapng.INBOUND, pcapng.OUTBOUND):
        return None
    of_client = packet.direction == pcapng.INBOUND
    place = datagram.source if of_client else datagram.destination
    return (packet.interface.name, place), Message(number, packet.time_ns, of_client, datagram.message)


def _unreadable(path: Path, why: str) -> Diagnostic:
    return Diagnostic(
        f"{path} cannot be replayed: {why}",
        hint="Record one from the start of a session: microros-gen agent record -o FILE udp4",
        id="MG-9796",
    )
