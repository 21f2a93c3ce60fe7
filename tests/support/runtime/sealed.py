# SPDX-License-Identifier: Apache-2.0
"""The device's side of sealed messages as a shared library, with messages, clock and key from the test."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

from microros_gen.agent.framing import FrameDecoder, LengthDecoder, encode_frame, encode_length
from tests.support.paths import TESTS

CLIENT_KEY = 0xA1B2C3D4
APPLICATION = """\
profiles: [pure_sender]
liveliness: ping
session: {key: 0xA1B2C3D4}
transport: {transport}
nodes:
  - name: talker
    publishers: [{topic: chatter, type: std_msgs/msg/Int32}]
"""
SOURCES = ("seal/xrce_noise.c", "seal/xrce_seal.c", "seal/seal_psa.c")
TRANSPORTS = {
    "udp": ('{type: udp, agent: "127.0.0.1:8899", seal: psa}', ("transport_udp/xrce_transport_udp.c",)),
    "tcp": ('{type: tcp, agent: "127.0.0.1:8899", seal: psa}', ("transport_tcp/xrce_transport_tcp.c",)),
    "serial": (
        "{type: serial, device: /dev/ttyS7, seal: psa}",
        ("transport_serial/xrce_transport_serial.c", "framing/xrce_framing.c", "framing/xrce_framing_send.c"),
    ),
}
"""How an application file names each transport that can be sealed, and the sources of the transport."""
LARGEST = 2048
DEVICE_ADDRESS = 1
"""Address of a device in the frames of a serial line."""


def build_device(folder: Path, transport: str = "udp") -> Path:
    """Return a shared library of the component, in `folder`, over a transport and Debian's Mbed TLS."""
    declared, own = TRANSPORTS[transport]
    (folder / "microros.yaml").write_text(APPLICATION.replace("{transport}", declared))
    out, library = folder / "out", folder / "device.so"
    arguments = ["generate", "-c", str(folder / "microros.yaml"), "-o", str(out)]
    subprocess.run([sys.executable, "-m", "microros_gen", *arguments], check=True, stdout=subprocess.DEVNULL)
    sources = [str(out / "src" / name) for name in (*SOURCES, *own)]
    fixture = str(TESTS / "runtime" / "c" / "seal_port.c")
    command = ["gcc", "-std=c99", "-g", "-shared", "-fPIC", f"-I{out / 'include'}"]
    command += [f"-DSEAL_{transport.upper()}", fixture, *sources]
    subprocess.run([*command, "-lmbedcrypto", "-o", str(library)], check=True)
    return library


class Device:
    """One device. Its messages reach nobody by themselves: `sent` takes them, `arrives` delivers one."""

    def __init__(self, library: Path, psk: bytes | None, transport: str = "udp") -> None:
        self.transport = transport
        self.faults: list[str] = []
        """What is wrong with the frames that the device sent."""
        self._lengths = LengthDecoder()
        self._frames = FrameDecoder(lambda kind, _: self.faults.append(kind))
        self._c = ctypes.CDLL(str(library))
        self.set_key(psk)
        self._c.test_take.restype = self._c.test_receive.restype = ctypes.c_int32
        for name in ("open", "send", "deliver", "is_wiped"):
            getattr(self._c, f"test_{name}").restype = ctypes.c_bool
        self.clock(0)
        self._c.test_reset()

    def set_key(self, psk: bytes | None) -> None:
        """Change the pre-shared key; None: remove it."""
        self._c.test_set_key(psk)

    def clock(self, ms: int) -> None:
        """Set the time, modulo 2^32 ms."""
        self._c.test_set_clock(ctypes.c_uint32(ms))

    def open(self) -> bool:
        """Open the transport."""
        return bool(self._c.test_open())

    def close(self) -> None:
        """Close the transport."""
        self._c.test_close()

    def send(self, message: bytes) -> bool:
        """Return whether a message was accepted."""
        return bool(self._c.test_send(message, ctypes.c_size_t(len(message))))

    def sent(self) -> list[bytes]:
        """Return the records and messages of handshakes since the last call."""
        buffer, found = ctypes.create_string_buffer(LARGEST), []
        while (size := self._c.test_take(buffer, ctypes.c_size_t(LARGEST))) > 0:
            found.append(buffer.raw[:size])
        if self.transport == "tcp":
            return self._lengths.feed(b"".join(found))
        if self.transport == "serial":
            return [payload for _, payload in self._frames.feed(b"".join(found))]
        return found

    def on_the_wire(self, record: bytes) -> bytes:
        """Return a record or message of a handshake as the transport carries it to the device."""
        if self.transport == "tcp":
            return encode_length(record)
        return encode_frame(record, DEVICE_ADDRESS) if self.transport == "serial" else record

    def deliver(self, data: bytes) -> None:
        """Let bytes of the transport arrive."""
        assert self._c.test_deliver(data, ctypes.c_size_t(len(data)))

    def arrives(self, record: bytes, capacity: int = LARGEST) -> bytes | int:
        """Deliver a record or message of a handshake; return what `receives` does."""
        self.deliver(self.on_the_wire(record))
        return self.receives(capacity)

    def receives(self, capacity: int = LARGEST) -> bytes | int:
        """Return the next message, or what the C function returns without one."""
        buffer = ctypes.create_string_buffer(LARGEST)
        size: int = self._c.test_receive(buffer, ctypes.c_size_t(capacity))
        return buffer.raw[:size] if size > 0 else size

    def set_room(self, size: int) -> None:
        """Let the port of a stream accept so many bytes more."""
        self._c.test_set_room(ctypes.c_size_t(size))

    def hang_up(self) -> None:
        """Close the connection at its other end."""
        self._c.test_hang_up()

    def set_next(self, counter: int) -> None:
        """Set the counter of the next record."""
        self._c.test_set_next(ctypes.c_uint32(counter))

    def __getattr__(self, name: str) -> int:
        """Return a value of the device: fault, is_ready, refused, replayed, is_wiped."""
        return int(getattr(self._c, f"test_{name}")())
