# SPDX-License-Identifier: Apache-2.0
"""A recording that several processes write: its order, what one that is killed or stopped leaves, and its counts."""

from __future__ import annotations

import io
import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from microros_gen.agent.log import EventLog
from microros_gen.agent.recording import pcapng
from microros_gen.agent.recording.packets import decode
from microros_gen.agent.recording.recorder import Recorder, SharedFile
from microros_gen.agent.recording.shared import SharedEnd
from tests.support.agent.recordings import dumped, fake

LABELS = ["udp4 127.0.0.1:8888", "serial /dev/ttyUSB0"]
PEER = "127.0.0.1:4000"
COUNT = 300


class Shared:
    """A file, and what its processes need."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.text = io.StringIO()
        self.recorder = Recorder(path, EventLog(self.text))
        self.file: SharedFile = self.recorder.shared(LABELS)
        self.recorder.begin()

    def packets(self) -> list[pcapng.Packet]:
        return list(pcapng.read_packets(io.BytesIO(self.path.read_bytes())))


def child(do: Callable[[], object]) -> int:
    """Do something in another process; return its number."""
    pid = os.fork()
    if pid == 0:
        try:
            do()
            os._exit(0)
        except BaseException:
            os._exit(1)
    return pid


def write(shared: SharedFile, number: int, count: int) -> None:
    recorder = Recorder.of_shared(shared, number, EventLog(io.StringIO()))
    for value in range(count):
        recorder.write(fake(LABELS[value % 2]), PEER, bytes([number]) * (1 + value), inbound=value % 2 == 0)


def test_packets_of_all_are_whole_and_in_the_order_of_their_times(tmp_path: Path) -> None:
    shared = Shared(tmp_path / "a.pcapng")
    children = [child(partial(write, shared.file, n, COUNT)) for n in (1, 2, 3)]
    assert [os.waitpid(pid, 0)[1] for pid in children] == [0, 0, 0]
    found = shared.packets()
    assert len(found) == 3 * COUNT == shared.recorder.written
    times = [packet.time_ns for packet in found]
    assert times == sorted(times)
    messages = [datagram.message for datagram in (decode(packet.data) for packet in found) if datagram]
    for number in (1, 2, 3):
        assert [len(m) for m in messages if m[0] == number] == list(range(1, COUNT + 1))
    assert {packet.interface.name for packet in found} == set(LABELS)
    shared.recorder.close()
    assert f"recorded {3 * COUNT} messages" in shared.text.getvalue()
    assert len(dumped(shared.path)) == 3 * COUNT


def test_what_one_that_was_killed_had_written_of_a_block_is_removed(tmp_path: Path) -> None:
    shared = Shared(tmp_path / "a.pcapng")
    write(shared.file, 1, 2)

    def die() -> None:
        end = SharedEnd(2, shared.file.memory)
        assert end.acquire()
        end.is_cut = True
        os.pwrite(shared.file.file, b"\6\0\0\0" + b"\xff" * 5000, end.size)
        os.kill(os.getpid(), signal.SIGKILL)

    os.waitpid(child(die), 0)
    with pytest.raises(pcapng.PcapngError):
        shared.packets()
    write(shared.file, 3, 1)
    assert len(shared.packets()) == 3
    os.waitpid(child(die), 0)
    shared.recorder.close()
    assert len(shared.packets()) == 3, "the end removes it, too"


@contextmanager
def stopped(shared: SharedFile) -> Iterator[int]:
    """Let another process be stopped in its turn."""
    read_end, write_end = os.pipe()

    def stop() -> None:
        end = SharedEnd(2, shared.memory)
        assert end.acquire()
        os.write(write_end, b"1")
        os.kill(os.getpid(), signal.SIGSTOP)
        end.release()
        time.sleep(1000)

    pid = child(stop)
    os.read(read_end, 1)
    os.waitpid(pid, os.WUNTRACED)
    try:
        yield pid
    finally:
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)


def test_one_that_was_stopped_in_its_turn_does_not_stop_the_others(tmp_path: Path) -> None:
    """What they lose meanwhile is counted, reported once, and noted in the next packet."""
    shared = Shared(tmp_path / "a.pcapng")
    text = io.StringIO()
    recorder = Recorder.of_shared(shared.file, 1, EventLog(text))
    with stopped(shared.file):
        began = time.thread_time()
        for _ in range(50):
            recorder.write(fake(LABELS[0]), PEER, b"lost", inbound=True)
        assert time.thread_time() - began < 0.5
    assert shared.packets() == []
    assert (shared.recorder.written, shared.recorder.lost) == (0, 50)
    assert text.getvalue().count("takes no more") == 1
    recorder.write(fake(LABELS[0]), PEER, b"kept", inbound=True)
    (packet,) = shared.packets()
    assert packet.dropped == 50
