# SPDX-License-Identifier: Apache-2.0
"""The loop: wakes up for transports, for ROS 2 and for the moment that the agent names, and for nothing else."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Hashable
from functools import partial
from pathlib import Path
from typing import Any

from microros_gen.agent.server import TICK_S, Server
from microros_gen.agent.transport.base import Origin, Receive
from tests.support.agent.fakes import Bench
from tests.support.agent.served import wait_until


class Pipe:
    """A transport on a pipe: each byte is a message."""

    label = "pipe"

    def __init__(self, note: Callable[[str], None]) -> None:
        self._note = note
        self.out, self.into = os.pipe()
        os.set_blocking(self.out, False)
        self.ready = True
        self.ticks = 0
        self.flushes = 0
        self.closed = False

    def fileno(self) -> int:
        return self.out

    def pump(self, receive: Receive) -> None:
        here: Any = self
        receive(os.read(self.out, 1), "peer", here)

    def tick(self, now: float) -> None:
        self.ticks += 1

    def send(self, data: bytes, address: Hashable) -> None:
        raise NotImplementedError

    def flush(self) -> None:
        self.flushes += 1
        self._note("sent")

    def name_of(self, address: Hashable) -> str:
        return str(address)

    def origin(self, address: Hashable) -> Origin:
        return str(address)

    def proved_key(self, address: Hashable) -> bytes:
        return b""

    def close(self) -> None:
        self.closed = True
        os.close(self.out)
        os.close(self.into)


class Recorder:
    """What the loop needs of an agent; writes down when it is called."""

    def __init__(self) -> None:
        self.event = os.eventfd(0, os.EFD_NONBLOCK)
        self.wanted: float | None = None
        self.calls: list[tuple[str, float]] = []
        self.clients: tuple[()] = ()
        self.samples = self.delivered = 0
        self.turns = 0

    def note(self, what: str) -> None:
        self.calls.append((what, time.monotonic()))

    def fileno(self) -> int:
        return self.event

    def due(self) -> float | None:
        self.note("due")
        return self.wanted

    def take(self) -> None:
        os.eventfd_read(self.event)
        self.note("take")

    def receive(self, data: bytes, address: Hashable, transport: object) -> None:
        self.note("receive")

    def flush(self) -> None:
        self.turns += 1

    def care(self, now: float) -> None:
        """There is memory."""

    def tick(self) -> None:
        self.note("tick")
        self.wanted = None

    def close(self) -> None:
        self.note("close")

    def has(self, what: str) -> bool:
        return bool(self.when(what))

    def after(self, what: str) -> list[str]:
        """Return what was called after the first call of `what`."""
        names = [called for called, _ in self.calls]
        return names[names.index(what) + 1 :]

    def when(self, what: str) -> list[float]:
        return [at for called, at in self.calls if called == what]


class Running:
    """A loop with a recorder and a pipe, in a thread."""

    def __init__(self) -> None:
        self.agent = Recorder()
        self.pipe = Pipe(self.agent.note)
        self.ready: list[str] = []
        agent: Any = self.agent
        pipes: Any = [self.pipe]
        self.server = Server(agent, pipes, Bench().log)
        self._thread = threading.Thread(
            target=lambda: self.server.run(lambda t: self.ready.append(t.label), time.monotonic)
        )

    def __enter__(self) -> Running:
        self._thread.start()
        wait_until(lambda: self.agent.turns > 0 or self.pipe.ticks > 0, "the loop does not run")
        return self

    def __exit__(self, *_: object) -> None:
        self.server.stop()
        self._thread.join(5)
        assert not self._thread.is_alive()


def test_messages_and_ros_wake_it_at_once() -> None:
    with Running() as running:
        for what, descriptor in (("receive", running.pipe.into), ("take", running.agent.event)):
            start = time.monotonic()
            os.write(descriptor, b"x" if what == "receive" else (1).to_bytes(8, "little"))
            wait_until(partial(running.agent.has, what), f"no {what}")
            assert running.agent.when(what)[0] - start < TICK_S / 2


def test_each_round_ends_with_the_output_of_the_transports() -> None:
    with Running() as running:
        wait_until(lambda: running.pipe.flushes == running.agent.turns > 0, "a round without flush")


def test_it_calls_when_the_agent_wants() -> None:
    with Running() as running:
        wanted = time.monotonic() + 0.03
        running.agent.wanted = wanted
        os.write(running.pipe.into, b"x")  # a turn, in which it asks
        wait_until(partial(running.agent.has, "tick"), "no tick")
        assert 0 <= running.agent.when("tick")[0] - wanted < 0.05


def test_what_a_tick_sends_does_not_wait_for_input() -> None:
    with Running() as running:
        running.agent.wanted = time.monotonic()
        wait_until(partial(running.agent.has, "tick"), "no tick")
        wait_until(lambda: "due" in running.agent.after("tick"), "no further round")
        following = running.agent.after("tick")
        assert "sent" in following[: following.index("due")], "the loop waits before it has sent"


def test_an_idle_loop_hardly_turns() -> None:
    with Running() as running:
        before, cpu = running.agent.turns, time.process_time()
        time.sleep(0.5)
        assert running.agent.turns - before <= 2 * (0.5 / TICK_S + 2), "a round sends once or twice"
        assert time.process_time() - cpu < 0.1


def test_stopping_takes_no_tick_and_closes_everything() -> None:
    running = Running()
    with running:
        start = time.monotonic()
        running.server.stop()
        running._thread.join(5)
        assert time.monotonic() - start < TICK_S
    assert running.agent.when("close")
    assert running.pipe.closed
    running.server.stop()  # a signal may come late


def test_a_transport_is_announced_when_it_is_ready_and_once() -> None:
    running = Running()
    running.pipe.ready = False
    with running:
        time.sleep(3 * TICK_S)
        assert running.ready == []
        running.pipe.ready = True
        wait_until(lambda: running.ready == ["pipe"], "not announced")
        time.sleep(3 * TICK_S)
        assert running.ready == ["pipe"]


def test_descriptors_are_given_back() -> None:
    before = len(list(Path("/proc/self/fd").iterdir()))
    for _ in range(5):
        with Running() as running:
            pass
        os.close(running.agent.event)
        del running
    assert len(list(Path("/proc/self/fd").iterdir())) <= before + 1
