# SPDX-License-Identifier: Apache-2.0
"""What of the agent's time is its own: not that in which other programs had the processor."""

from __future__ import annotations

import os
import time

import pytest

from microros_gen.agent.own_time import LONG_S, OwnTime, Waited
from tests.support.patience import deadline


class Machine:
    """A clock, and what other programs took."""

    def __init__(self) -> None:
        self.now = 50.0
        self.taken = 7.0
        self.requested = 0
        self.own = OwnTime(self._waited)

    def _waited(self) -> float:
        self.requested += 1
        return self.taken

    def round(self, rest: float = 0.0, taken: float = 0.0) -> None:
        """Let a round begin after a rest, in which other programs had the processor for `taken` seconds."""
        self.now += rest
        self.taken += taken
        self.own.begin(self.now)

    def work(self, seconds: float, taken: float = 0.0) -> float:
        """Work for so long, of which other programs had the processor for `taken`; return what is charged."""
        self.now += seconds
        self.taken += taken
        return self.own.of(seconds)


def busy_machine() -> Machine:
    machine = Machine()
    machine.round()
    machine.round(1.0, 0.5)
    return machine


def test_what_other_programs_took_is_not_charged() -> None:
    machine = busy_machine()
    assert machine.work(0.01, 0.008) == pytest.approx(0.002)
    assert machine.work(0.01, 0.0) == pytest.approx(0.01), "as it waited itself"
    assert machine.work(0.01, 0.02) == 0.0


def test_what_they_took_before_the_round_does_not_count() -> None:
    machine = busy_machine()
    machine.round(0.05, 0.05)
    assert machine.work(0.01) == pytest.approx(0.01)


def test_an_idle_machine_is_hardly_asked() -> None:
    machine = Machine()
    machine.round()
    machine.round(1.0)
    requested = machine.requested
    for _ in range(1_000):
        machine.round(0.0001)
        machine.work(0.00001)
    machine.work(2 * LONG_S)
    assert machine.requested - requested <= 2


def test_short_work_requests_nothing() -> None:
    machine = busy_machine()
    requested = machine.requested
    for _ in range(100):
        assert machine.work(LONG_S / 2) == LONG_S / 2
    assert machine.requested == requested


def test_a_machine_that_is_idle_again_is_seen() -> None:
    machine = busy_machine()
    machine.round(1.0)
    requested = machine.requested
    machine.work(0.01)
    assert machine.requested == requested


def test_the_system_counts_while_another_thread_has_the_processor() -> None:
    """Two processes on one processor: each waits for about half of the time."""
    own = os.sched_getaffinity(0)
    child = os.fork()
    if child == 0:
        os.sched_setaffinity(0, {min(own)})
        while os.getppid() != 1:
            pass
        os._exit(0)
    try:
        os.sched_setaffinity(0, {min(own)})
        waited = Waited()
        before, end = waited(), deadline(20)
        while waited() < before + 0.02:
            assert time.monotonic() < end
    finally:
        os.sched_setaffinity(0, own)
        os.kill(child, 9)
        os.waitpid(child, 0)


@pytest.mark.parametrize("content", [None, b"", b"12", b"no numbers"], ids=str)
def test_a_system_that_does_not_count_charges_as_before(
    monkeypatch: pytest.MonkeyPatch, content: bytes | None
) -> None:
    def read(descriptor: int, _size: int, _offset: int) -> bytes:
        if content is None:
            raise FileNotFoundError(descriptor)
        return content

    monkeypatch.setattr(os, "pread", read)
    own = OwnTime(Waited())
    for second in range(5):
        own.begin(float(second))
        assert own.of(0.5) == 0.5
