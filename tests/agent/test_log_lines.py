# SPDX-License-Identifier: Apache-2.0
"""Lines of several processes in one log do not mix: each is one call of the system."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from microros_gen.agent.log import EventLog, Level

LONG = "x" * 20_000
"""More than Python's buffers hold, and more than a line without -v has."""


def test_a_line_is_one_write() -> None:
    """Of this kind of socket, each write is a separate message."""
    writes, reads = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with writes, reads, os.fdopen(os.dup(writes.fileno()), "w") as out:
        log = EventLog(out, worker=2, verbosity=2)
        log.emit(Level.TRACE, "message", "{text}", text=LONG)
        log.emit(Level.INFO, "other", "short")
        assert reads.recv(1 << 16) == f"worker 2: trace: {LONG}\n".encode()
        assert reads.recv(1 << 16) == b"worker 2: short\n"


def test_what_was_written_before_precedes(tmp_path: Path) -> None:
    with (tmp_path / "log").open("w") as out:
        out.write("before\n")
        EventLog(out).line("after")
        assert (tmp_path / "log").read_text() == "before\nafter\n"


def test_a_write_that_ends_early_is_continued(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = os.write
    monkeypatch.setattr(os, "write", lambda descriptor, data: write(descriptor, data[:7]))
    with (tmp_path / "log").open("w") as out:
        EventLog(out).line("more than seven bytes")
    assert (tmp_path / "log").read_text() == "more than seven bytes\n"


def test_a_descriptor_that_takes_nothing_is_no_fault() -> None:
    reads, writes = os.pipe()
    os.close(reads)
    with os.fdopen(writes, "w") as out:
        log = EventLog(out)
        log.line("lost")
        assert log.counters["log_lost"] == 1
