# SPDX-License-Identifier: Apache-2.0
"""Recorder: writes every message of an agent's clients, in both directions, to a pcapng file.

Each packet is one write to the file, at its end, so a process that is killed leaves whole packets, and nothing waits in
memory. What the file system does not take is lost and counted; the agent continues. Workers of one agent write the same
file in turn (`shared`), each packet with the time of its turn, so the packets are in the order of their times.
"""

from __future__ import annotations

import fcntl
import os
import stat
import time
from collections.abc import Callable, Hashable, Sequence
from functools import lru_cache
from pathlib import Path

from microros_gen import __version__
from microros_gen.agent.log import EventLog, Level, printable
from microros_gen.agent.recording import packets, pcapng
from microros_gen.agent.recording.packets import Datagram, Endpoint
from microros_gen.agent.recording.shared import End, SharedEnd
from microros_gen.agent.representation import References, describe
from microros_gen.agent.representation.description import (
    Participant,
    UnknownNameError,
    UnsupportedKindError,
)
from microros_gen.agent.representation.reference import UnknownReferenceError
from microros_gen.agent.transport.base import Transport, number_at
from microros_gen.agent.transport.observed import ObservedTransport
from microros_gen.agent.wire.constants import ObjectKind, SubmessageId
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import header_size, split
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import decode
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass

MOST_KEYS = 4_096
"""Maximum number of addresses whose client key is kept for comments."""
LONGEST_DESCRIBED = 2_048
"""Maximum bytes of a description that is read for the name of a node in a comment."""
_SOCKETS = ("udp4", "udp6", "tcp4", "tcp6")
_DESCRIPTIONS = {
    "udp4": "XRCE over UDP",
    "udp6": "XRCE over UDP",
    "tcp4": "XRCE over TCP; each message as a UDP datagram",
    "tcp6": "XRCE over TCP; each message as a UDP datagram",
    "canfd": "XRCE over CAN FD; each message as a UDP datagram, the identifier in the client's address",
    "serial": "XRCE over a serial line; each message as a UDP datagram, the client's address in its address",
}


@dataclass(frozen=True)
class SharedFile:
    """What another process that writes the same file needs."""

    path: Path
    file: int
    """Descriptor of the file."""
    memory: int
    """Descriptor of the memory that all of them share (`shared.SharedEnd`)."""
    head: bytes
    """First blocks of the file."""
    labels: tuple[str, ...]
    """Those of the transports, in the order of the interfaces in the file."""


class Recorder:
    """A file that is being written; one writer at a time."""

    def __init__(self, path: Path, log: EventLog, clock: Callable[[], int] = time.time_ns) -> None:
        """Open the file for this writer alone; what it holds stays until `begin`. `clock` returns ns since 1970.

        Raises UserError if it cannot be written.
        """
        self._path = path
        self._log = log
        self._clock = clock
        self._file, self._is_new = _open(path)
        self._end = End()
        self._interfaces: dict[str, int] = {}
        self._head = pcapng.section(f"microros-gen {__version__}")
        self._keys: dict[str, str] = {}
        self._dropped = 0
        """Messages that were lost since the last one in the file."""
        self._reported = False

    def shared(self, labels: Sequence[str]) -> SharedFile:
        """Let other processes write, too, all of them about the transports with these labels. Raises OSError."""
        end = self._end = SharedEnd(0)
        self._interfaces = {label: number for number, label in enumerate(labels)}
        self._head += b"".join(map(_interface, labels))
        return SharedFile(self._path, self._file, end.descriptor, self._head, tuple(labels))

    @staticmethod
    def of_shared(shared: SharedFile, writer: int, log: EventLog) -> Recorder:
        """Return the recorder of another process, which has the descriptors; each has a number from 1."""
        recorder = Recorder.__new__(Recorder)
        recorder._path = shared.path
        recorder._log = log
        recorder._clock = time.time_ns
        recorder._file, recorder._is_new = shared.file, False
        recorder._end = SharedEnd(writer, shared.memory)
        recorder._interfaces = {label: number for number, label in enumerate(shared.labels)}
        recorder._head = shared.head
        recorder._keys = {}
        recorder._dropped = 0
        recorder._reported = False
        return recorder

    @property
    def written(self) -> int:
        """Number of messages in the file."""
        return self._end.totals[0]

    @property
    def lost(self) -> int:
        """Number of messages that the file system did not take."""
        return self._end.totals[1]

    def begin(self) -> None:
        """Replace what the file holds. Call it when nothing else can fail any more, and before the first `write`."""
        os.ftruncate(self._file, 0)
        self._append(b"")

    def give_up(self) -> None:
        """Close the file without `begin`: an earlier one stays as it is, and a new one goes."""
        if self._is_new:
            self._path.unlink(missing_ok=True)
        os.close(self._file)

    def write(self, transport: Transport, address: Hashable, message: bytes, inbound: bool) -> None:
        """Append a message from (`inbound`) or to the client at an address of `transport`. Never raises."""
        label = transport.label
        name = transport.name_of(address)
        agent, client = _places(label, name, number_at(address))
        new = label not in self._interfaces
        number = len(self._interfaces) if new else self._interfaces[label]
        described = _interface(label) if new else b""
        datagram = Datagram(client, agent, message) if inbound else Datagram(agent, client, message)
        packet = packets.encode(datagram)
        direction = pcapng.INBOUND if inbound else pcapng.OUTBOUND
        comment = self._comment(message, name) if inbound else ""
        is_written = False
        if self._end.acquire():  # the time of what follows in the file is not earlier
            try:
                time_ns = self._clock()
                block = pcapng.packet(number, time_ns, packet, direction, comment, self._dropped)
                is_written = self._append(described + block)
            finally:
                self._end.release()
        else:
            self._report_lost("another process of the agent does not end its turn")
        if is_written:
            self._interfaces[label] = number
        self._dropped = 0 if is_written else self._dropped + 1
        self._end.count(is_written)

    def close(self) -> None:
        """Close the file and log what it has, of all processes."""
        if self._end.is_cut:
            os.ftruncate(self._file, self._end.size)
        os.close(self._file)
        written, lost = self._end.totals
        text = "recorded {count} messages in {path}; {lost} lost"
        self._log.emit(Level.INFO, "recorded", text, count=written, lost=lost, path=str(self._path))

    def _append(self, blocks: bytes) -> bool:
        """Write blocks at the end of the whole ones; return whether the file took them."""
        end = self._end
        data = blocks if end.size else self._head + blocks
        try:
            if end.is_cut:  # another process was killed while it wrote
                os.ftruncate(self._file, end.size)
            end.is_cut = True
            taken = os.pwrite(self._file, data, end.size)
            if taken == len(data):
                end.size += taken
                end.is_cut = False
                return True
            why = "only a part was written"
            os.ftruncate(self._file, end.size)
        except OSError as error:
            why = error.strerror or str(error)
        if blocks:
            self._report_lost(why)
        return False

    def _report_lost(self, why: str) -> None:
        if not self._reported:
            self._reported = True
            text = "recording: {path} takes no more ({why}): messages are missing in it, and counted"
            self._log.emit(Level.WARNING, "record_lost", text, path=str(self._path), why=why)

    def _comment(self, message: bytes, name: str) -> str:
        """Return what a message says about its client: its key, or the name of its node; else nothing."""
        at = 4 if message and message[0] >= 0x80 else 8
        if len(message) <= at or message[at] > SubmessageId.CREATE:
            return ""
        try:
            found = [
                decode(identifier, flags, message, start, end)
                for identifier, flags, start, end in split(message, header_size(message))
                if identifier <= SubmessageId.CREATE
            ]
        except MalformedError:
            return ""
        remarks = []
        for submessage in found:
            if isinstance(submessage, CreateClient):
                if len(self._keys) >= MOST_KEYS:
                    self._keys.clear()
                self._keys[name] = submessage.key.hex().upper()
                remarks.append(f"client {self._keys[name]}")
            elif isinstance(submessage, Create) and submessage.kind == ObjectKind.PARTICIPANT:
                remarks.append(f"client {self._keys.get(name, '?')}: node {_node(submessage)}")
        return printable(", ".join(remarks))


class RecordedTransport(ObservedTransport):
    """A transport whose messages are recorded."""

    def __init__(self, inner: Transport, recorder: Recorder) -> None:
        super().__init__(inner)
        self._recorder = recorder

    def _observe(self, data: bytes, address: Hashable, inbound: bool) -> None:
        self._recorder.write(self._inner, address, data, inbound)


def _open(path: Path) -> tuple[int, bool]:
    """Return the descriptor of a file that no other process writes, and whether it is new. Raises UserError."""
    wanted = os.O_WRONLY | os.O_NONBLOCK | os.O_CLOEXEC
    try:
        try:
            opened, is_new = os.open(path, wanted | os.O_CREAT | os.O_EXCL, 0o644), True
        except FileExistsError:
            opened, is_new = os.open(path, wanted | os.O_CREAT, 0o644), False
    except OSError as error:
        raise UserError([_refused(path, error.strerror or str(error))]) from error
    why = ""
    if not stat.S_ISREG(os.fstat(opened).st_mode):
        why = "it is not a regular file"
    else:
        try:
            fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            why = (
                "another agent writes it"
                if isinstance(error, BlockingIOError)
                else error.strerror or str(error)
            )
    if why:
        os.close(opened)
        raise UserError([_refused(path, why)])
    return opened, is_new


def _refused(path: Path, why: str) -> Diagnostic:
    return Diagnostic(
        f"{path} cannot be written: {why}",
        hint="Give --record a file in a folder that exists, such as --record agent.pcapng",
        id="MG-9793",
    )


def _interface(label: str) -> bytes:
    return pcapng.interface(label, _DESCRIPTIONS.get(label.partition(" ")[0], "XRCE"))


@lru_cache(maxsize=1024)
def _places(label: str, name: str, number: int) -> tuple[Endpoint, Endpoint]:
    """Return the places of the agent and of a client, which the log calls `name`."""
    kind, _, own = label.partition(" ")
    if kind in _SOCKETS:
        return packets.endpoint(own), packets.endpoint(name)
    return packets.line_agent(), packets.line_client(number)


def _node(create: Create) -> str:
    if len(create.body) > LONGEST_DESCRIBED:  # anybody may send it: 64 kB of XML take 12 ms
        return "?"
    try:
        described = describe(create, References())
    except (MalformedError, UnknownReferenceError, UnknownNameError, UnsupportedKindError):
        return "?"
    return described.name if isinstance(described, Participant) else "?"
