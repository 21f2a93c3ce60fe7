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
        first = next(message.data for message in self.messages if opens_session(message.data))
        at = 4 if first[0] >= 0x80 else 8
        return first[at + 12 : at + 16].hex().upper()


def opens_session(data: bytes) -> bool:
    """Return whether a message begins with CREATE_CLIENT."""
    at = 4 if data and data[0] >= 0x80 else 8
    return len(data) >= at + 17 and data[at] == SubmessageId.CREATE_CLIENT and not data[1]


def read_recording(path: Path) -> tuple[list[Conversation], int]:
    """Return the conversations that begin with a session, and the number of messages outside of them.

    Messages before the first CREATE_CLIENT of a client cannot be replayed: its objects are not known. Raises UserError
    if the file cannot be read or has no such conversation.
    """
    found: dict[tuple[str, Endpoint], list[Message]] = {}
    outside = 0
    try:
        for number, packet in enumerate(pcapng.read_packets(path.read_bytes()), 1):
            datagram = decode(packet.data) if packet.interface.linktype == pcapng.LINKTYPE_ETHERNET else None
            if datagram is None or packet.direction not in (pcapng.INBOUND, pcapng.OUTBOUND):
                outside += 1
                continue
            of_client = packet.direction == pcapng.INBOUND
            place = datagram.source if of_client else datagram.destination
            name = packet.interface.name, place
            if name not in found and not (of_client and opens_session(datagram.message)):
                outside += 1
                continue
            message = Message(number, packet.time_ns, of_client, datagram.message)
            found.setdefault(name, []).append(message)
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


def _unreadable(path: Path, why: str) -> Diagnostic:
    return Diagnostic(
        f"{path} cannot be replayed: {why}",
        hint="Record one from the start of a session: microros-gen agent record -o FILE udp4",
        id="MG-9796",
    )
