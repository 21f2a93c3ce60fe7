# SPDX-License-Identifier: Apache-2.0
"""The device's side of sealed datagrams as a shared library, with datagrams, clock and key from the test."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

from tests.support.paths import TESTS

CLIENT_KEY = 0xA1B2C3D4
APPLICATION = """\
profiles: [pure_sender]
liveliness: ping
session: {key: 0xA1B2C3D4}
transport: {type: udp, agent: "127.0.0.1:8899", seal: psa}
nodes:
  - name: talker
    publishers: [{topic: chatter, type: std_msgs/msg/Int32}]
"""
SOURCES = ("seal/xrce_noise.c", "seal/xrce_seal.c", "seal/seal_psa.c")
LARGEST = 2048


def build_device(folder: Path) -> Path:
    """Return a shared library of the component, in `folder`, over Debian's Mbed TLS."""
    (folder / "microros.yaml").write_text(APPLICATION)
    out, library = folder / "out", folder / "device.so"
    arguments = ["generate", "-c", str(folder / "microros.yaml"), "-o", str(out)]
    subprocess.run([sys.executable, "-m", "microros_gen", *arguments], check=True, stdout=subprocess.DEVNULL)
    sources = [str(out / "src" / name) for name in SOURCES]
    fixture = str(TESTS / "runtime" / "c" / "seal_port.c")
    command = ["gcc", "-std=c99", "-g", "-shared", "-fPIC", f"-I{out / 'include'}", fixture, *sources]
    subprocess.run([*command, "-lmbedcrypto", "-o", str(library)], check=True)
    return library


class Device:
    """One device. Its datagrams reach nobody by themselves: `sent` takes them, `arrives` delivers one."""

    def __init__(self, library: Path, psk: bytes | None) -> None:
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
        """Return the datagrams since the last call."""
        buffer, found = ctypes.create_string_buffer(LARGEST), []
        while (size := self._c.test_take(buffer, ctypes.c_size_t(LARGEST))) > 0:
            found.append(buffer.raw[:size])
        return found

    def arrives(self, datagram: bytes, capacity: int = LARGEST) -> bytes | int:
        """Deliver a datagram; return its message, or what the C function returns without one."""
        assert self._c.test_deliver(datagram, ctypes.c_size_t(len(datagram)))
        buffer = ctypes.create_string_buffer(LARGEST)
        size: int = self._c.test_receive(buffer, ctypes.c_size_t(capacity))
        return buffer.raw[:size] if size > 0 else size

    def set_next(self, counter: int) -> None:
        """Set the counter of the next record."""
        self._c.test_set_next(ctypes.c_uint32(counter))

    def __getattr__(self, name: str) -> int:
        """Return a value of the device: fault, is_ready, refused, replayed, is_wiped."""
        return int(getattr(self._c, f"test_{name}")())
