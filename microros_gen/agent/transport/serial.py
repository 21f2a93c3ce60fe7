# SPDX-License-Identifier: Apache-2.0
"""Serial devices (a UART, a USB serial converter, the terminal of an emulator) and pseudo-terminals.

Both use POSIX terminals (IEEE Std 1003.1, chapter 11) through Python's standard library: a selector can wait for
them, which it cannot for the serial ports of Windows, and rclpy's packages are for Linux.
"""

from __future__ import annotations

import errno
import fcntl
import os
import re
import stat
import struct
import termios
import tty
from pathlib import Path

from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.line import Line
from microros_gen.diagnostics import Diagnostic, UserError

DEFAULT_BAUD = 115_200
_GET_SERIAL, _SET_SERIAL = 0x541E, 0x541F
"""TIOCGSERIAL and TIOCSSERIAL of Linux (asm-generic/ioctls.h), which Python has no names for."""
_SERIAL_STRUCT = 128
"""Room for struct serial_struct of linux/serial.h: 72 bytes with 64-bit pointers."""
_FLAGS = 16
"""Where it has `flags`: after type, line, port and irq."""
_LOW_LATENCY = 1 << 13
"""ASYNC_LOW_LATENCY of linux/tty_flags.h."""
_ABSENT = (errno.ENOENT, errno.ENXIO, errno.ENODEV, errno.EIO)


def speeds() -> list[int]:
    """Return the rates in bit/s that this system has a constant for."""
    names = (re.fullmatch(r"B([1-9][0-9]*)", name) for name in dir(termios))
    return sorted(int(match[1]) for match in names if match)


def serial_line(device: str, baud: int, log: EventLog) -> Line:
    """Return the line of a device, opened if it exists. Raises UserError if it can never be opened."""
    if baud not in speeds():
        raise UserError([_no_such_speed(baud)])
    line = Line(device, lambda: open_device(device, baud), log)
    try:
        line.start()
    except OSError as error:
        if error.errno not in _ABSENT:
            line.close()
            raise UserError([_explain(error, device)]) from error
        line.wait()
    return line


def open_device(device: str, baud: int) -> int:
    """Open a terminal device, raw, 8N1 without flow control, for this process alone.

    Raises OSError if it does not exist, is in use (EBUSY), or is no terminal (ENOTTY).
    """
    descriptor = os.open(device, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        if not stat.S_ISCHR(os.fstat(descriptor).st_mode) or not os.isatty(descriptor):
            raise OSError(errno.ENOTTY, os.strerror(errno.ENOTTY))
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise OSError(errno.EBUSY, os.strerror(errno.EBUSY)) from error
        _make_raw(descriptor, baud)
        make_prompt(descriptor)
    except termios.error as error:
        os.close(descriptor)
        raise OSError(*error.args) from error
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def make_prompt(descriptor: int) -> bool:
    """Ask the driver of a device to pass on bytes at once; return whether it does.

    An FTDI adapter otherwise collects them for 16 ms. A device without the setting (USB CDC, a pseudo-terminal) and
    a user who may not change it are no errors.
    """
    settings = bytearray(_SERIAL_STRUCT)
    try:
        fcntl.ioctl(descriptor, _GET_SERIAL, settings)
        (flags,) = struct.unpack_from("=i", settings, _FLAGS)
        if not flags & _LOW_LATENCY:
            struct.pack_into("=i", settings, _FLAGS, flags | _LOW_LATENCY)
            fcntl.ioctl(descriptor, _SET_SERIAL, settings)
    except OSError:
        return False
    return True


class Pty(Line):
    """A pseudo-terminal: the agent has its master; its slave, for the client, stays open as long as the agent.

    A client that closes and opens it again finds the same one.
    """

    def __init__(self, log: EventLog, link: Path | None = None, baud: int = DEFAULT_BAUD) -> None:
        """Create it, and a symbolic link to it. Raises UserError if that is not possible.

        `baud` is the speed that programs see that open it; it does not delay bytes.
        """
        if baud not in speeds():
            raise UserError([_no_such_speed(baud)])
        self._master, self._slave = os.openpty()
        os.set_blocking(self._master, False)
        _make_raw(self._slave, baud)
        device = os.ttyname(self._slave)
        self._link = link
        if link is not None:
            try:
                _make_link(link, device)
            except OSError as error:
                os.close(self._master)
                os.close(self._slave)
                raise UserError(
                    [Diagnostic(f"cannot create the link {link}: {error.strerror}", id="MG-9430")]
                ) from error
        self.device = device
        super().__init__(str(link or device), lambda: os.dup(self._master), log)
        self.start()

    def close(self) -> None:
        """See Transport."""
        super().close()
        os.close(self._master)
        os.close(self._slave)
        if self._link is not None and self._link.is_symlink() and str(self._link.readlink()) == self.device:
            self._link.unlink()


def _make_raw(descriptor: int, baud: int) -> None:
    """Set what tty.setraw does and 8N1, no flow control, no modem lines; closing leaves DTR as it is."""
    tty.setraw(descriptor, termios.TCSANOW)
    mode = termios.tcgetattr(descriptor)
    mode[0] = 0
    mode[1] = 0
    mode[2] &= ~(termios.CSIZE | termios.PARENB | termios.CSTOPB | termios.CRTSCTS | termios.HUPCL)
    mode[2] |= termios.CS8 | termios.CREAD | termios.CLOCAL
    mode[3] = 0
    mode[4] = mode[5] = getattr(termios, f"B{baud}")
    termios.tcsetattr(descriptor, termios.TCSANOW, mode)


def _make_link(link: Path, device: str) -> None:
    """Create the link; one that an agent left is replaced, anything else is not."""
    if link.is_symlink() and str(link.readlink()).startswith("/dev/"):
        link.unlink()
    link.symlink_to(device)


def _no_such_speed(baud: int) -> Diagnostic:
    nearest_baud = min(speeds(), key=lambda speed: abs(speed - baud))
    known = ", ".join(str(speed) for speed in speeds() if speed >= 9600)
    return Diagnostic(
        f"this system has no serial speed of {baud} bit/s",
        hint=f"The nearest is {nearest_baud}; available: {known}",
        id="MG-9431",
    )


def _explain(error: OSError, device: str) -> Diagnostic:
    if error.errno in (errno.EACCES, errno.EPERM):
        return Diagnostic(
            f"{device}: permission denied",
            hint="Join the group that owns it (`ls -l` shows it, often dialout), then log in again",
            id="MG-9432",
        )
    if error.errno == errno.EBUSY:
        return Diagnostic(
            f"{device} is in use by another program",
            hint="End the other agent or terminal program",
            id="MG-9433",
        )
    if error.errno in (errno.ENOTTY, errno.EISDIR):
        return Diagnostic(
            f"{device} is not a serial device",
            hint="Give a terminal device such as /dev/ttyUSB0 or /dev/pts/3",
            id="MG-9434",
        )
    return Diagnostic(f"{device} cannot be opened: {error.strerror or error}", id="MG-9435")
