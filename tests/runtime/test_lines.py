# SPDX-License-Identifier: Apache-2.0
"""Serial and custom transports over real lines: pseudo-terminals and sockets, with a fake agent in a thread."""

from __future__ import annotations

import os
import random
import select
import subprocess
import threading
import time
import tty
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan
from tests.support.patience import deadline, seconds
from tests.support.plans import INT32, POOL, changed
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.runtime.frames import AGENT, CLIENT, events, frame
from tests.support.runtime.harness import Tree, build, components, render
from tests.support.runtime.udp import UdpAgent
from tests.support.slices import first

PLAN = changed(
    POOL, times__connect_timeout_ms=3000, times__create_timeout_ms=3000, times__liveliness_period_ms=50
)
SERIAL = changed(PLAN, transport__kind="serial", transport__device="/dev/null")
CUSTOM = {
    way: changed(PLAN, transport__kind="custom", transport__framing=way) for way in ("on", "off", "either")
}


class LineAgent(threading.Thread):
    """An agent at the other end of a pseudo-terminal; `spoil` changes what comes in and what goes out."""

    def __init__(self, spoil: Callable[[bytes], bytes] = bytes) -> None:
        super().__init__(daemon=True)
        self.agent = FakeAgent()
        self._spoil = spoil
        self._master, self._slave = (
            os.openpty()
        )  # the other end stays open, or reading fails between two clients
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self.stopped = False  # it takes nothing of the line
        self._ended = threading.Event()

    def run(self) -> None:
        stream, known = b"", 0
        while not self._ended.is_set():
            if self.stopped:
                time.sleep(0.01)
            elif select.select([self._master], [], [], 0.05)[0]:
                stream += self._spoil(os.read(self._master, 4096))
                found = events(stream, source=CLIENT, destination=AGENT)
                for event in found[known:]:
                    if event.message is not None:
                        for answer in self.agent.receive(event.message):
                            os.write(self._master, self._spoil(frame(answer)))
                known = len(found)
                if stream.rfind(b"\x7e") > 2000:  # what is after the last flag is still to come
                    stream = stream[stream.rfind(b"\x7e") :]
                    known = len(events(stream, source=CLIENT, destination=AGENT))

    def stop(self) -> None:
        self._ended.set()
        self.join(5)
        os.close(self._master)
        os.close(self._slave)


def _program(tmp_path: Path, plan: RuntimePlan, source: str) -> Path:
    return build(render(tmp_path, plan, components(plan)), ["types.c", source], "program")


def _run(program: Path, arguments: Sequence[str] = ()) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [program, *arguments], capture_output=True, text=True, timeout=seconds(60), check=False
    )


def _noise(seed: int) -> Callable[[bytes], bytes]:
    """Return a line that hurts one byte of 300: changed, lost, or another one before it."""
    source = random.Random(seed)

    def spoil(data: bytes) -> bytes:
        out = bytearray()
        for byte in data:
            if source.random() < 1 / 300:
                out += source.choice([b"", b"\x7e", bytes([byte, 0x7D]), bytes([byte ^ 0x10])])
            else:
                out.append(byte)
        return bytes(out)

    return spoil


@pytest.mark.parametrize("noisy", [False, True])
def test_serial_over_a_pseudo_terminal(noisy: bool, tmp_path: Path) -> None:
    agent = LineAgent(_noise(7) if noisy else bytes)
    agent.start()
    done = _run(_program(tmp_path, changed(SERIAL, transport__device=agent.path), "udp.c"))
    agent.stop()
    assert done.returncode == 0, done.stdout + done.stderr
    values = agent.agent.values()
    assert values == sorted(set(values))
    assert values == list(range(100)) or noisy
    assert values[-1] == 99


def test_an_unread_terminal_blocks_nothing_and_gets_everything_later(tmp_path: Path) -> None:
    """The port alone: what the system has no room for waits in the port, and no call does."""
    plan = changed(SERIAL, executor__max=1, executor__handles_max=1)
    tree = render(tmp_path, plan, components(plan))
    wanted = ("port_posix_serial.c", "port_posix_wait.c", "port_posix_time.c")
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name in wanted))
    program = build(alone, ["stuck_line.c"], "stuck")
    master, slave = os.openpty()
    tty.setraw(slave)
    running = subprocess.Popen(
        [program, os.ttyname(slave)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert running.stdin is not None
    assert running.stdout is not None
    size, worst_ms = map(int, running.stdout.readline().split())
    assert size > plan.transport.send_buffer, "the system took some of it, and the port the rest"
    assert worst_ms < 90, "a write that waited for room gave up after 100 ms"
    running.stdin.write("\n")
    running.stdin.flush()
    arrived = b""
    while len(arrived) < size:
        assert select.select([master], [], [], 20)[0], f"{len(arrived)} of {size} bytes"
        arrived += os.read(master, 4096)
    assert arrived == bytes(i % 251 for i in range(size))
    assert int(running.stdout.readline()) < 20, "a wait ends when there is room, not by its time-out"
    assert running.wait(20) == 0
    os.close(master)
    os.close(slave)


def test_a_line_without_room_takes_no_processor_time(tmp_path: Path) -> None:
    """A reliable stream whose output waits for room asks for waits of 0 ms, 40 of them here."""
    plan = changed(SERIAL, executor__max=1, executor__handles_max=1)
    tree = render(tmp_path, plan, components(plan))
    wanted = ("port_posix_serial.c", "port_posix_wait.c", "port_posix_time.c")
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name in wanted))
    program = build(alone, ["lost_line.c"], "lost")
    master, slave = os.openpty()
    tty.setraw(slave)
    running = subprocess.Popen(
        [program, os.ttyname(slave)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert running.stdin is not None
    assert running.stdout is not None
    assert running.stdout.readline() == "full\n"
    os.close(master)
    os.close(slave)
    running.stdin.write("\n")
    running.stdin.flush()
    assert int(running.stdout.readline()) >= 38, "waits of 0 ms at a lost line"
    assert running.wait(20) == 0


def test_room_in_the_line_ends_a_wait_that_began_before_there_was_output(tmp_path: Path) -> None:
    """One task waits for the line, another one writes more than the system has room for."""
    plan = changed(SERIAL, executor__max=1, executor__handles_max=1, session__multithread=True)
    tree = render(tmp_path, plan, components(plan))
    wanted = ("port_posix_serial.c", "port_posix_wait.c", "port_posix_time.c", "port_posix_lock.c")
    alone = Tree(tree.folder, tuple(s for s in tree.sources if s.name in wanted))
    program = build(alone, ["waiting_line.c"], "waiting")
    master, slave = os.openpty()
    tty.setraw(slave)
    running = subprocess.Popen([program, os.ttyname(slave)], stdout=subprocess.PIPE, text=True)
    assert running.stdout is not None
    size = int(running.stdout.readline())
    arrived = 0
    while arrived < size:
        assert select.select([master], [], [], 20)[0], f"{arrived} of {size} bytes"
        arrived += len(os.read(master, 4096))
    assert running.wait(20) == 0
    os.close(master)
    os.close(slave)


CLOSING_MS = {"soon": 20_000, "never": 400}


@pytest.mark.parametrize("goes_on", ["soon", "never"])
@pytest.mark.parametrize("entities", first(["binary", "preconfigured"]))
def test_closing_lets_what_waits_for_the_line_leave(entities: str, goes_on: str, tmp_path: Path) -> None:
    """The port holds more than a kilobyte when the session is closed; a line that takes nothing holds it no longer than
    `close_timeout`.
    """
    plan = changed(
        SERIAL,
        entities__declared=True,
        entities__type_name_size=0,
        entities__nodes__max=1,
        entities__publishers__max=1,
        entities__name_size=0,
    )
    plan = changed(
        plan,
        creation__entities=entities,
        times__close_timeout_ms=CLOSING_MS[goes_on],
        times__liveliness_period_ms=30_000,
    )
    agent = LineAgent()
    agent.agent.objects[b"\0\x05"] = b""  # that of a preconfigured writer
    plan = changed(
        plan,
        transport__device=agent.path,
        entities__nodes__declared=(NodePlan(0, "talker", "/", "talker", 0),),
        entities__publishers__declared=(PublisherPlan(0, 0, "/chatter", "rt/chatter", INT32, False),),
    )
    agent.start()
    program = _program(tmp_path, plan, "closing.c")
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        assert running.stdout.readline() == "ready\n"
        agent.stopped = True
        time.sleep(0.1)
        running.stdin.write("\n")
        running.stdin.flush()
        count = int(running.stdout.readline())
        time.sleep(0.2)
        agent.stopped = goes_on == "never"
        took_ms = int(running.stdout.readline())
        assert running.wait(20) == 0
    if goes_on == "soon":
        _eventually(lambda: len(agent.agent.written) >= count)
        values = [int.from_bytes(body, "little") for _, body in agent.agent.written]
        assert values == list(range(count))
    else:
        assert took_ms >= CLOSING_MS["never"]
    agent.stop()
    assert took_ms < 5_000, "as soon as the line was free, or when the time was up"


def _eventually(condition: Callable[[], bool]) -> None:
    end = deadline(20)
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.mark.parametrize(
    ("device", "baud", "words"),
    [
        ("/dev/null", 115200, "no transport to /dev/null\n"),  # no terminal
        pytest.param("/nowhere/tty", 115200, "no transport to /nowhere/tty\n", marks=pytest.mark.variant),
    ],
)
def test_no_such_line(device: str, baud: int, words: str, tmp_path: Path) -> None:
    plan = changed(SERIAL, transport__device=device, transport__baud=baud, times__connect_timeout_ms=100)
    done = _run(_program(tmp_path, plan, "udp.c"))
    assert (done.returncode, done.stdout) == (2, words)


@pytest.mark.parametrize(
    ("baud", "code"), [pytest.param(9600, 0, marks=pytest.mark.variant), (921600, 0), (123456, 2)]
)
def test_speeds(baud: int, code: int, tmp_path: Path) -> None:
    agent = LineAgent()
    agent.start()
    plan = changed(SERIAL, transport__device=agent.path, transport__baud=baud, times__connect_timeout_ms=500)
    done = _run(_program(tmp_path, plan, "udp.c"))
    agent.stop()
    assert done.returncode == code, done.stdout + done.stderr


@pytest.mark.parametrize("way", first(["either", "on", "off"]))
def test_custom_over_udp(way: str, tmp_path: Path) -> None:
    agent = UdpAgent()
    agent.start()
    done = _run(_program(tmp_path, CUSTOM[way], "custom.c"), ["udp", str(agent.port)])
    agent.stop()
    if way == "on":
        assert (done.returncode, done.stdout) == (
            7,
            "custom transport: set transport: {framing: false} in microros.yaml\n",
        )
    else:
        assert done.returncode == 0, done.stdout + done.stderr
        assert agent.agent.values() == list(range(100))


@pytest.mark.parametrize("way", first(["either", "on", "off"]))
def test_custom_over_a_line(way: str, tmp_path: Path) -> None:
    agent = LineAgent()
    agent.start()
    done = _run(_program(tmp_path, CUSTOM[way], "custom.c"), ["line", agent.path])
    agent.stop()
    if way == "off":
        assert (done.returncode, done.stdout) == (
            7,
            "custom transport: set transport: {framing: true} in microros.yaml\n",
        )
    else:
        assert done.returncode == 0, done.stdout + done.stderr
        assert agent.agent.values() == list(range(100))


def test_custom_that_was_never_set(tmp_path: Path) -> None:
    done = _run(_program(tmp_path, CUSTOM["either"], "custom.c"))
    assert done.returncode == 2
    assert done.stdout == "rmw_uros_set_custom_transport was not called before, or refused its arguments\n"


@pytest.mark.parametrize("way", first(["either", "off"]))
def test_a_call_uses_a_transport_of_packets_once(way: str, tmp_path: Path) -> None:
    """One fragment a call, since the write function may wait; and no read, which waits, while somebody else reads."""
    plan = changed(
        CUSTOM[way],
        streams__fragments=True,
        streams__reliable_slots=4,
        streams__reliable_slot_size=1024,
        times__liveliness_period_ms=5000,
    )
    agent = UdpAgent()
    agent.start()
    done = _run(_program(tmp_path, plan, "custom_turns.c"), [str(agent.port)])
    agent.stop()
    assert (done.returncode, done.stdout) == (0, "1 0\n"), done.stderr
    sent = {m[2:4]: m for m in agent.agent.log if m[:2] == b"\x81\x80" and m[4] == 0x0D}
    assert len(sent) == 9, "an empty one and 912 bytes in fragments of 120"
