# SPDX-License-Identifier: Apache-2.0
"""The agent asks the driver of a serial device to pass on bytes at once; a double has the driver's place."""

from __future__ import annotations

import errno
import fcntl
import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.agent.transport.serial import make_prompt, open_device

GET, SET = 0x541E, 0x541F
LOW_LATENCY = 1 << 13
SKIP_TEST = 1 << 6
LAYOUT = """\
#include <linux/serial.h>
#include <linux/tty_flags.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/ioctl.h>
int main(void)
{
  printf("%x %x %zu %zu %d", TIOCGSERIAL, TIOCSSERIAL, sizeof(struct serial_struct),
         offsetof(struct serial_struct, flags), ASYNC_LOW_LATENCY);
  return 0;
}
"""


class Driver:
    """What a driver answers: its flags, or a refusal of one of both requests."""

    def __init__(self, flags: int, refuses: int) -> None:
        self.flags = flags
        self.refuses = refuses
        self.requests: list[int] = []

    def ioctl(self, descriptor: int, request: int, settings: bytearray) -> int:
        self.requests.append(request)
        if request == self.refuses:
            raise OSError(errno.EPERM, "Operation not permitted")
        if request == GET:
            settings[:] = bytes(range(100, 100 + len(settings)))
            settings[16:20] = self.flags.to_bytes(4, "little")
        else:
            assert settings[:16] == bytes(range(100, 116)), "other settings stay"
            assert settings[20:72] == bytes(range(120, 172))
            self.flags = int.from_bytes(settings[16:20], "little")
        return 0


@pytest.fixture
def line() -> Iterator[str]:
    master, slave = os.openpty()
    yield os.ttyname(slave)
    os.close(master)
    os.close(slave)


@pytest.mark.parametrize(
    ("before", "refuses", "prompt", "flags", "requests"),
    [
        (SKIP_TEST, 0, True, SKIP_TEST | LOW_LATENCY, (GET, SET)),
        (LOW_LATENCY, 0, True, LOW_LATENCY, (GET,)),
        (SKIP_TEST, GET, False, SKIP_TEST, (GET,)),
        (SKIP_TEST, SET, False, SKIP_TEST, (GET, SET)),
    ],
)
def test_the_flag_is_set_where_the_driver_takes_it(
    monkeypatch: pytest.MonkeyPatch,
    line: str,
    before: int,
    refuses: int,
    prompt: bool,
    flags: int,
    requests: tuple[int, ...],
) -> None:
    driver = Driver(before, refuses)
    monkeypatch.setattr(fcntl, "ioctl", driver.ioctl)
    os.close(open_device(line, 115_200))
    assert (driver.flags, tuple(driver.requests)) == (flags, requests)
    assert make_prompt(0) is prompt


def test_a_terminal_without_the_setting_is_opened(line: str) -> None:
    descriptor = open_device(line, 115_200)
    assert make_prompt(descriptor) is False
    os.close(descriptor)


@pytest.mark.builds
@pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc")
def test_the_layout_is_that_of_the_kernel(tmp_path: Path) -> None:
    (tmp_path / "layout.c").write_text(LAYOUT)
    subprocess.run(["gcc", str(tmp_path / "layout.c"), "-o", str(tmp_path / "layout")], check=True)
    found = subprocess.run([str(tmp_path / "layout")], capture_output=True, text=True, check=True).stdout
    assert found == f"{GET:x} {SET:x} 72 16 {LOW_LATENCY}"
