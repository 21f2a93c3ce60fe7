# SPDX-License-Identifier: Apache-2.0
"""The conversations in a recording: the messages between the agent and one client at one address."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import BinaryIO

from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.message_index import Entry, MessageIndex
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
    """Messages on a transport (`udp4 127.0.0.1:8888`) with the client at a place, in their order.

    `messages` can be read several times; those of a file are read from it each time.
    """

    transport: str
    client: Endpoint
    messages: Iterable[Message]

    @property
    def key(self) -> str:
        """The client's key as in the log, from its first CREATE_CLIENT."""
        return key_of(next(message.data for message in self.messages if opens_session(message.data)))


@dataclass(frozen=True)
class Recording:
    """The conversations that begin with a session, and the number of messages outside of them."""

    conversations: tuple[Conversation, ...]
    outside: int


def opens_session(data: bytes) -> bool:
    """Return whether a message begins with CREATE_CLIENT."""
    at = 4 if data and data[0] >= 0x80 else 8
    return len(data) >= at + 17 and data[at] == SubmessageId.CREATE_CLIENT and not data[1]


def key_of(data: bytes) -> str:
    """Return the key in a CREATE_CLIENT as the log has it."""
    at = 4 if data[0] >= 0x80 else 8
    return data[at + 12 : at + 16].hex().upper()


@contextmanager
def open_recording(path: Path, key: str | None = None) -> Iterator[Recording]:
    """Return what is in a file; its messages can be read as long as the context lasts.

    Messages before the first CREATE_CLIENT of a client cannot be replayed: its objects are not known. The file is read
    once to find the conversations; memory does not grow with the number of its messages. What cannot be read a second
    time, such as a pipe, is copied to a temporary file. With `key`, the messages of this client; of others, the first
    one. Raises UserError if the file cannot be read or has no such conversation.
    """
    with ExitStack() as stack:
        try:
            file: BinaryIO = stack.enter_context(path.open("rb"))
            if not file.seekable():
                copy = stack.enter_context(TemporaryFile())
                shutil.copyfileobj(file, copy)
                copy.seek(0)
                file = copy
            index = stack.enter_context(MessageIndex())
            recording = _find(path, file, index, key)
        except OSError as error:
            raise UserError([_unreadable(path, error.strerror or str(error))]) from error
        except PcapngError as error:
            raise UserError([_unreadable(path, str(error))]) from error
        if not recording.conversations:
            raise UserError([_unreadable(path, "it has no session of a client")])
        yield recording


def _find(path: Path, file: BinaryIO, index: MessageIndex, key: str | None) -> Recording:
    found: dict[tuple[str, Endpoint], bool] = {}
    outside = 0
    for number, packet in enumerate(pcapng.read_packets(file), 1):
        named = _message(number, packet)
        if named is None or not (named[0] in found or _begins(named[1])):
            outside += 1
            continue
        name, message = named
        if name not in found:
            found[name] = key is None or key_of(message.data) == key
        elif not found[name]:
            continue
        index.add(name, Entry(number, message.time_ns, message.of_client, packet.at, len(packet.data)))
    return Recording(tuple(Conversation(*name, _Stored(path, file, index, name)) for name in found), outside)


class _Stored:
    """The messages of a conversation in a file that is open."""

    def __init__(self, path: Path, file: BinaryIO, index: MessageIndex, name: tuple[str, Endpoint]) -> None:
        self._path = path
        self._file = file
        self._index = index
        self._name = name

    def __iter__(self) -> Iterator[Message]:
        """Read the messages. Raises UserError if the file cannot be read, or is not as it was."""
        try:
            for entry in self._index.entries(self._name):
                self._file.seek(entry.at)
                datagram = decode(self._file.read(entry.size))
                if datagram is None:
                    raise UserError([_unreadable(self._path, "it was changed meanwhile")])
                yield Message(entry.number, entry.time_ns, entry.of_client, datagram.message)
        except OSError as error:  # a disk or a network share; to a replay, an OSError is one of its link
            raise UserError([_unreadable(self._path, error.strerror or str(error))]) from error


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
