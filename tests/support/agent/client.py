# SPDX-License-Identifier: Apache-2.0
"""A small XRCE client over UDP or a serial line: blocking, for tests of the agent and of whatever talks through it."""

from __future__ import annotations

import socket
import struct
import time
from collections import deque
from types import TracebackType
from typing import Any, Protocol

from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import OBJECT_AGENT, OBJECT_CLIENT, Format, ObjectKind
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Acknack, Create, Delete, Fragment, Heartbeat, StatusReply
from microros_gen.agent.wire.message import Header, header_size, join, split
from microros_gen.agent.wire.session_messages import CreateClient, GetInfo, Info, StatusAgent
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent.serial_link import SerialLink
from tests.support.patience import deadline

RELIABLE = 0x80
BEST_EFFORT = 0x01
WINDOW = 16


class NoAnswerError(AssertionError):
    """The agent did not answer in time."""


class Subscriber(Protocol):
    """What `wait_until_subscribed` needs of an observer."""

    def ask(self, **command: Any) -> Any:
        """Carry out a command."""


class XrceClient:
    """One client with one best-effort and one reliable stream each way."""

    def __init__(
        self,
        port: int | SerialLink,
        key: int = 0xA1B2C3D4,
        session: int = 0x81,
        mtu: int = 512,
        timeout_s: float = 10.0,
    ) -> None:
        self.key = key.to_bytes(4, "big")
        self.session = session
        self.mtu = mtu
        self.timeout_s = timeout_s
        self.socket = connected(port) if isinstance(port, int) else port
        self._request = 9
        self._reset_streams()

    def __enter__(self) -> XrceClient:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.socket.close()

    def _reset_streams(self) -> None:
        self._sequence = {BEST_EFFORT: 0, RELIABLE: 0}
        self._unacknowledged: deque[tuple[int, bytes]] = deque()
        self._next_in = 0
        self.inbox: deque[Submessage] = deque()

    # Session

    def connect(self) -> int:
        """Introduce the client; return the agent's status."""
        self._reset_streams()
        head = Header(self.session & 0x80, 0, 0, self._key(self.session))
        message = join(head, [encode(CreateClient(self.key, self.session, self.mtu))])
        status: int = self._ask(message, StatusAgent).status  # type: ignore[attr-defined]
        return status

    def ping(self, in_session: bool = True) -> int:
        """Return the implementation status of the agent's answer: 1 in session, 0 outside."""
        session = self.session if in_session else self.session & 0x80
        head = Header(session, 0, 0, self._key(session))
        message = join(head, [encode(GetInfo(self._next_request(), OBJECT_AGENT, 2))])
        status: int = self._ask(message, Info).implementation_status  # type: ignore[attr-defined]
        return status

    def leave(self) -> int:
        """Delete the client; return the status."""
        request = Delete(self._next_request(), OBJECT_CLIENT)
        message = join(self._head(0, 0), [encode(request)])
        status: int = self._ask(message, StatusReply).status  # type: ignore[attr-defined]
        return status

    # Entities

    def create(
        self,
        object_id: int,
        form: int,
        body: bytes,
        parent: int = 0,
        domain: int = 0,
        mode: str = "reuse replace",
        stream: int = RELIABLE,
    ) -> int:
        """Create an object; return the status."""
        request = Create(
            self._next_request(),
            object_id,
            object_id & 0x0F,
            form,
            body,
            parent,
            domain,
            "reuse" in mode,
            "replace" in mode,
        )
        return self._status(request, stream)

    def delete(self, object_id: int, stream: int = RELIABLE) -> int:
        """Delete an object; return the status."""
        return self._status(Delete(self._next_request(), object_id), stream)

    def publisher(
        self,
        node: str,
        topic: str,
        type_name: str,
        domain: int,
        number: int = 1,
        reliable: bool = True,
        transient_local: bool = False,
        depth: int = 10,
        stream: int = RELIABLE,
    ) -> int:
        """Create node, topic, publisher and writer in binary form; return the writer's id."""
        ids = {kind: number << 4 | kind for kind in (1, 2, 3, 5)}
        flags = (1 if reliable else 0) | 2 | (8 if transient_local else 0)
        bodies = {
            1: (participant_blob(node), 0),
            2: (topic_blob(f"rt/{topic}", dds_type(type_name)), ids[1]),
            3: (b"\0\0", ids[1]),
            5: (writer_blob(ids[2], flags, depth), ids[3]),
        }
        for kind, (body, parent) in bodies.items():
            status = self.create(ids[kind], Format.BINARY, body, parent, domain, stream=stream)
            assert status in (0, 1), f"{ObjectKind(kind).name}: status {status:#04x}"
        return ids[5]

    # Samples

    def write(self, writer: int, body: bytes, stream: int = RELIABLE) -> None:
        """Send a sample (CDR body); in fragments when it is larger than a message."""
        submessage = encode(WriteData(self._next_request(), writer, body))
        room = self.mtu - len(self._head(stream, 0).encode())
        if len(submessage) <= room:
            self.send(stream, submessage)
            return
        size = (room - 4) & ~3
        chunks = [submessage[at : at + size] for at in range(0, len(submessage), size)]
        for i, chunk in enumerate(chunks):
            self.send(stream, encode(Fragment(chunk, i == len(chunks) - 1)))

    def send(self, stream: int, submessage: bytes) -> None:
        """Send a submessage on a stream; waits for room in the window of a reliable one."""
        sequence = self._sequence[stream]
        self._sequence[stream] = (sequence + 1) & 0xFFFF
        message = join(self._head(stream, sequence), [submessage])
        if stream == RELIABLE:
            self._wait_for(lambda: len(self._unacknowledged) < WINDOW, "an acknowledgement")
            self._unacknowledged.append((sequence, message))
        self.socket.send(message)

    def drain(self) -> None:
        """Wait until everything on the reliable stream is acknowledged."""
        self._wait_for(lambda: not self._unacknowledged, "the last acknowledgement")

    def wait_until_subscribed(self, writer: int, body: bytes, observer: Subscriber, topic: str) -> None:
        """Send `body` until the observer's subscription gets it: discovery takes a moment."""
        end = deadline(15)
        while not any(name == topic for name, _ in observer.ask(do="samples")):
            assert time.monotonic() < end, f"the subscription on {topic} gets nothing"
            self.write(writer, body)
            self.drain()
            time.sleep(0.05)
        time.sleep(0.1)
        observer.ask(do="samples")

    # Input

    def take(self, kind: type, timeout_s: float | None = None) -> Submessage:
        """Wait for the next submessage of a kind."""
        found: list[Submessage] = []

        def there() -> bool:
            found.extend(s for s in self.inbox if isinstance(s, kind))
            return bool(found)

        self._wait_for(there, kind.__name__, timeout_s)
        self.inbox.remove(found[0])
        return found[0]

    def pump(self, timeout_s: float) -> bool:
        """Take one message from the agent; False when none came in time."""
        self.socket.settimeout(max(timeout_s, 0.001))
        try:
            data = self.socket.recv(65535)
        except (TimeoutError, ConnectionRefusedError):
            return False
        head = Header.decode(data)
        for identifier, flags, start, end in split(data, header_size(data)):
            self._handle(head, decode(identifier, flags, data, start, end))
        return True

    def _handle(self, head: Header, submessage: Submessage) -> None:
        if isinstance(submessage, Acknack):
            self._acknowledged(submessage)
        elif isinstance(submessage, Heartbeat):
            self._acknowledge()
        elif head.stream >= RELIABLE:
            fresh = head.sequence == self._next_in
            if fresh:
                self._next_in = (self._next_in + 1) & 0xFFFF
                self.inbox.append(submessage)
            self._acknowledge()
        else:
            self.inbox.append(submessage)

    def _acknowledge(self) -> None:
        answer = encode(Acknack(self._next_in, 0, RELIABLE))
        self.socket.send(join(self._head(0, 0), [answer]))

    def _acknowledged(self, acknack: Acknack) -> None:
        while self._unacknowledged and (acknack.first - self._unacknowledged[0][0] - 1) & 0xFFFF < 0x8000:
            self._unacknowledged.popleft()
        for i, (_, message) in enumerate(self._unacknowledged):
            if acknack.missing >> i & 1:
                self.socket.send(message)

    def _wait_for(self, done, what: str, timeout_s: float | None = None) -> None:  # type: ignore[no-untyped-def]
        end = deadline(self.timeout_s if timeout_s is None else timeout_s)
        beat = time.monotonic() + 0.1
        while not done():
            left = end - time.monotonic()
            if left <= 0:
                raise NoAnswerError(f"no {what} from the agent")
            self.pump(min(left, 0.05))
            if self._unacknowledged and time.monotonic() > beat:
                beat = time.monotonic() + 0.1
                first, last = self._unacknowledged[0][0], self._unacknowledged[-1][0]
                self.socket.send(join(self._head(0, 0), [encode(Heartbeat(first, last, RELIABLE))]))

    def _ask(self, message: bytes, kind: type) -> Submessage:
        self.socket.send(message)
        return self.take(kind)

    def _status(self, request: Create | Delete, stream: int) -> int:
        self.send(stream, encode(request))
        while True:
            answer = self.take(StatusReply)
            assert isinstance(answer, StatusReply)
            if answer.request == request.request:
                return answer.status

    def _head(self, stream: int, sequence: int) -> Header:
        return Header(self.session, stream, sequence, self._key(self.session))

    def _key(self, session: int) -> bytes:
        return self.key if session < 0x80 else b""

    def _next_request(self) -> int:
        self._request = self._request + 1 & 0xFFFF
        return self._request


def connected(port: int) -> socket.socket:
    """Return a UDP socket whose peer is a port of this machine."""
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    opened.connect(("127.0.0.1", port))
    return opened


def dds_type(ros_name: str) -> str:
    """Return `pkg::msg::dds_::Type_` for `pkg/msg/Type`."""
    package, _, name = ros_name.split("/")
    return f"{package}::msg::dds_::{name}_"


def participant_blob(name: str) -> bytes:
    """Return the binary form of a participant."""
    return Writer().flag(False).flag(True).string(name).content()


def topic_blob(name: str, type_name: str) -> bytes:
    """Return the binary form of a topic, by DDS names."""
    return Writer().string(name).flag(False).flag(True).string(type_name).content()


def writer_blob(topic: int, flags: int, depth: int) -> bytes:
    """Return the binary form of a data writer; `flags` as EndpointQosFlags, depth 0 for none."""
    blob = Writer().identifier(topic).flag(True).u16(flags)
    if depth:
        blob.flag(True).u16(depth)
    else:
        blob.flag(False)
    return blob.flag(False).flag(False).flag(False).flag(False).content()


def reader_blob(
    topic: int, flags: int, depth: int, separation_ms: int = 0, content_filter: str = ""
) -> bytes:
    """Return the binary form of a data reader; as `writer_blob`, and with its filters."""
    blob = Writer().raw(writer_blob(topic, flags, depth)[:-1])
    blob.optional(blob.u32, separation_ms or None)
    return blob.optional(blob.string, content_filter or None).content()


def service_blob(name: str, ros_type: str) -> bytes:
    """Return the binary form of a requester or replier of service `name` (`/add`), type `pkg/srv/Type`."""
    package, _, kind = ros_type.split("/")
    blob = Writer().string(name)
    for half in ("Request", "Response"):
        blob.string(f"{package}::srv::dds_::{kind}_{half}_")
    return blob.flag(True).string(f"rq{name}Request").flag(True).string(f"rr{name}Reply").content()


def int32_body(value: int) -> bytes:
    """Return the CDR body of std_msgs/msg/Int32."""
    return struct.pack("<i", value)


def imu_body(frame_id: str, stamp: tuple[int, int], numbers: list[float]) -> bytes:
    """Return the CDR body of sensor_msgs/msg/Imu; `numbers` are its 37 doubles in order."""
    text = frame_id.encode() + b"\0"
    head = struct.pack("<iII", *stamp, len(text)) + text
    return head + bytes(-len(head) % 8) + struct.pack("<37d", *numbers)
