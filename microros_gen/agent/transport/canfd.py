# SPDX-License-Identifier: Apache-2.0
"""CAN FD: one message per frame; the identifier of a frame is the address of its client, and of the answers to it.

The layout is that of the public agent: extended identifiers, and a first byte that is the length of the message, since
frames longer than eight bytes have fixed lengths. Linux has CAN as sockets (SocketCAN). A program that plays a bus is
reached at `unix:PATH` (SOCK_SEQPACKET); it exchanges the same records, struct canfd_frame of linux/can.h.
"""

from __future__ import annotations

import errno
import fcntl
import os
import select
import socket
import struct
from collections import deque
from collections.abc import Hashable

from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.transport.outbox import is_sample
from microros_gen.diagnostics import Diagnostic, UserError

LARGEST_MESSAGE = 63
"""Bytes of a message: a frame has 64, and the first is the length."""
PLAYED = "unix:"
"""In front of the path of a program that plays the bus."""
BATCH = 256
"""Frames that are read before the answers are sent."""
QUEUE_FRAMES = 2_048
"""Maximum frames that wait for a busy bus; further ones are lost. Samples take an eighth of them."""
SAMPLE_SHARE = 8
RETRY_S = 0.25
"""Seconds between two attempts to open a missing device."""
RECEIVE_BUFFER = 1 << 20
"""Requested bytes of received frames at the system; it may grant less."""
SEND_BUFFER = 4_096
"""Requested bytes of frames at the system: fewer than an interface queues, so that the socket reports room."""

_FRAME = struct.Struct("=IBB2x64s")
_CLASSIC_SIZE = 16
_EXTENDED = 0x8000_0000
_IDENTIFIER = 0x1FFF_FFFF
_RAW_FD_FRAMES = 5
_GET_MTU = 0x8921  # SIOCGIFMTU of linux/sockios.h
_REQUEST = struct.Struct("=16si20x")
"""A struct ifreq of linux/if.h with ifr_mtu."""
_SOL_CAN_RAW = 101
_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
_NO_FD = errno.EMSGSIZE
"""With classic frames alone; `ip link set can0 type can fd on` changes that. No call that opens a bus fails so."""
_NO_SOCKETS = (errno.EAFNOSUPPORT, errno.EPROTONOSUPPORT)
"""The kernel has no CAN, or not the module can_raw."""
_ABSENT = (errno.ENODEV, errno.ENXIO, errno.ENOENT, errno.ECONNREFUSED, errno.ENETDOWN, _NO_FD)
_FULL = (errno.EAGAIN, errno.ENOBUFS)


def encode(identifier: int, message: bytes) -> bytes:
    """Return the record of the frame that carries a message of 1 to 63 bytes."""
    size = len(message) + 1
    length = next(length for length in _LENGTHS if length >= size)
    return _FRAME.pack(identifier | _EXTENDED, length, 0, bytes((len(message),)) + message)


def decode(record: bytes) -> tuple[int, bytes] | None:
    """Return identifier and message of a record; None: it is not a data frame with a message."""
    if len(record) not in (_FRAME.size, _CLASSIC_SIZE):
        return None
    identifier, length, _, data = _FRAME.unpack(record.ljust(_FRAME.size, b"\0"))
    size = data[0]
    if identifier & ~_IDENTIFIER != _EXTENDED or not 0 < size < length <= len(record) - 8:
        return None
    return identifier & _IDENTIFIER, data[1 : 1 + size]


class CanFd:
    """One bus; `device` is its network interface. While that is missing, down or without CAN FD, it tries to open it.

    What waits for the bus is lost with it: clients send again what is reliable.
    """

    def __init__(self, device: str, log: EventLog) -> None:
        """Open the device if it exists. Raises UserError if it can never be opened."""
        self._device = device
        self._log = log
        self._socket: socket.socket | None = None
        self._epoll = select.epoll()  # its descriptor stays the same when the device is reopened
        self._waiting: deque[tuple[bytes, bool]] = deque()
        self._samples = 0
        self._retry_at = 0.0
        self._was_open = False
        self._reported = ""
        self._watches_room = False
        try:
            self._start()
        except OSError as error:
            if error.errno not in _ABSENT:
                self.close()
                raise UserError([_explain(error, device)]) from error
            self._wait(error)

    @property
    def label(self) -> str:
        """See Transport."""
        return f"canfd {self._device}"

    @property
    def ready(self) -> bool:
        """See Transport."""
        return self._socket is not None

    @property
    def writing(self) -> bool:
        """Whether output waits for the bus."""
        return bool(self._waiting)

    @property
    def forgeable(self) -> bool:
        """See Transport: like a serial line, a bus is wired, and a frame is no answer to a third party."""
        return False

    def fileno(self) -> int:
        """See Transport."""
        return self._epoll.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        self._write()
        for _ in range(BATCH):
            if self._socket is None:
                return
            try:
                record = self._socket.recv(_FRAME.size)
            except BlockingIOError:
                return
            except OSError as error:
                self._lose(error)
                return
            if not record:
                self._lose(OSError(errno.EPIPE, "it hung up"))
                return
            self._take(record, receive)

    def _take(self, record: bytes, receive: Receive) -> None:
        found = decode(record)
        if found is None:
            text = "canfd {device}: ignored: a frame of another kind"
            self._log.count("can_frame", text, device=self._device)
            return
        identifier, message = found
        receive(message, (self.label, identifier), self)

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport: the clients of a bus are read in the order of their frames."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport: likewise."""

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        if self._socket is None or not isinstance(address, tuple) or not 0 < len(data) <= LARGEST_MESSAGE:
            return
        sample = is_sample(data)
        if sample and self._samples >= QUEUE_FRAMES // SAMPLE_SHARE:
            self._drop_oldest_sample()
        elif len(self._waiting) >= QUEUE_FRAMES:
            self._log.count(
                "bus_full", "canfd {device} takes no frames: messages are lost", device=self._device
            )
            return
        self._waiting.append((encode(address[1], data), sample))
        self._samples += sample
        if len(self._waiting) == 1:
            self._write()

    def _drop_oldest_sample(self) -> None:
        del self._waiting[next(i for i, (_, sample) in enumerate(self._waiting) if sample)]
        self._samples -= 1
        text = "canfd {device} is slower than the samples for it: the oldest best-effort ones are dropped"
        self._log.count("bus_slow", text, device=self._device)

    def _write(self) -> None:
        self._write_some()
        wanted = bool(self._waiting) and self._socket is not None
        if self._socket is not None and wanted is not self._watches_room:
            self._epoll.modify(self._socket, select.EPOLLIN | (select.EPOLLOUT if wanted else 0))
        self._watches_room = wanted

    def _write_some(self) -> None:
        while self._waiting and self._socket is not None:
            record, sample = self._waiting[0]
            try:
                self._socket.send(record, socket.MSG_NOSIGNAL)
            except OSError as error:
                if error.errno not in _FULL:
                    self._lose(error)
                return
            self._waiting.popleft()
            self._samples -= sample

    def tick(self, now: float) -> None:
        """See Transport."""
        if self._socket is not None or now < self._retry_at:
            return
        self._retry_at = now + RETRY_S
        known = self._was_open
        try:
            self._start()
        except OSError as error:
            if _why(error) != self._reported:
                self._wait(error)
            return
        text = "canfd {device} is back" if known else "canfd {device} is available"
        self._report("device_back", text)

    def flush(self) -> None:
        """See Transport: nothing is collected."""

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return f"{self._device} identifier {address[1]:#x}" if isinstance(address, tuple) else str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return self._device

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    def close(self) -> None:
        """See Transport: what waits is sent if the bus takes it at once."""
        self._write()
        self._give_back()
        self._epoll.close()

    def _start(self) -> None:
        self._socket = _open(self._device)
        self._epoll.register(self._socket, select.EPOLLIN)
        self._was_open = True
        self._reported = ""

    def _wait(self, error: OSError) -> None:
        self._reported = _why(error)
        self._report("device_waiting", "canfd {device} cannot be opened ({why}); waiting for it", error)

    def _give_back(self) -> None:
        if self._socket is not None:
            self._epoll.unregister(self._socket)
            self._socket.close()
            self._socket = None
        self._waiting.clear()
        self._samples = 0
        self._watches_room = False

    def _lose(self, error: OSError) -> None:
        self._give_back()
        self._log.counters["bus_lost"] += 1
        self._reported = _why(error)
        self._report("device_lost", "canfd {device} is gone ({why}); waiting for it", error)

    def _report(self, event: str, text: str, error: OSError | None = None) -> None:
        why = _why(error) if error else ""
        self._log.emit(Level.INFO, event, text, device=self._device, why=why)


def _open(device: str) -> socket.socket:
    """Return a non-blocking socket of a bus. Raises OSError if it does not exist, is down or has no CAN FD."""
    if device.startswith(PLAYED):
        opened = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    else:
        opened = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    try:
        opened.setblocking(False)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
        if device.startswith(PLAYED):
            opened.connect(device.removeprefix(PLAYED))
        else:
            opened.setsockopt(_SOL_CAN_RAW, _RAW_FD_FRAMES, 1)
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER)
            opened.bind((device,))
            down = opened.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
            if down:  # such an interface can be bound
                raise OSError(down, os.strerror(down))
            _check_mtu(opened, device)
    except OSError:
        opened.close()
        raise
    return opened


def _check_mtu(opened: socket.socket, device: str) -> None:
    """Raise OSError if an interface has no CAN FD: it can be bound as well, and refuses each frame that is sent."""
    answer = fcntl.ioctl(opened, _GET_MTU, _REQUEST.pack(device.encode(), 0))
    mtu = _REQUEST.unpack(answer)[1]
    if mtu < _FRAME.size:
        raise OSError(_NO_FD, f"no CAN FD: its MTU is {mtu}, not {_FRAME.size}")


def _why(error: OSError) -> str:
    return error.strerror or str(error)


def _explain(error: OSError, device: str) -> Diagnostic:
    if error.errno in _NO_SOCKETS:
        return Diagnostic(
            "this kernel has no CAN sockets",
            hint="Load the module can_raw (modprobe can_raw), or use a kernel with CAN",
            id="MG-9441",
        )
    return Diagnostic(
        f"the CAN device {device} cannot be opened: {error.strerror or error}",
        hint="Give a network interface that `ip link show type can` or `type vcan` lists",
        id="MG-9442",
    )
