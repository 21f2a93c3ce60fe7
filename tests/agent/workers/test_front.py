# SPDX-License-Identifier: Apache-2.0
"""The front with workers without ROS: what it passes on, and workers that end, hang, or do not start."""

from __future__ import annotations

import errno
import io
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.agent.fairness import Account
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.workers.front import Front
from microros_gen.agent.workers.views import SLOW_S
from microros_gen.agent.workers.worker_process import START_S, STEADY_S, STUCK_LOOKS, STUCK_S, WorkerProcess
from microros_gen.diagnostics import UserError
from tests.support.agent import small_worker
from tests.support.patience import deadline, seconds

COMMAND = [sys.executable, str(Path(small_worker.__file__))]


LIMITS = Limits(clients=16, stop_s=0.5)


class Line:
    """A transport whose clients are numbers."""

    label = "serial /dev/test"
    ready = True
    forgeable = False

    def __init__(self) -> None:
        self.sent: list[tuple[Hashable, bytes]] = []
        self.on_send: Callable[[], object] = list

    def fileno(self) -> int:
        return -1

    def pump(self, receive: Receive) -> None:
        """Deliver nothing: tests do."""

    def tick(self, now: float) -> None:
        """Need nothing."""

    def claim(self, address: Hashable, account: Account) -> None:
        """Need nothing."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """Need nothing."""

    def send(self, data: bytes, address: Hashable) -> None:
        self.sent.append((address, data))
        self.on_send()

    def flush(self) -> None:
        """Collect nothing."""

    def name_of(self, address: Hashable) -> str:
        return f"client {address}"

    def origin(self, address: Hashable) -> Origin:
        return "/dev/test"

    def proved_key(self, address: Hashable) -> bytes:
        return b""

    def close(self) -> None:
        """Have nothing."""


class Bench:
    """A front, its line, its log, and its time."""

    def __init__(self, workers: int, start: bytes, command: list[str]) -> None:
        self.text = io.StringIO()
        self.log = EventLog(self.text)
        self.line = Line()
        self.now = 1000.0
        self.workers = [WorkerProcess(n, command, (), start, self.log) for n in range(1, workers + 1)]
        self.front = Front(self.workers, [self.line], self.log, LIMITS)

    def say(self, word: bytes, key: int, address: int = 1) -> None:
        """Let the client at an address send a message that has its key in its header."""
        self.front.receive(b"\1\1\1\1" + key.to_bytes(4, "big") + bytes(4) + word, address, self.line)

    def until(self, seen: Callable[[], object]) -> None:
        end = deadline(10)
        while not seen():
            assert time.monotonic() < end, self.text.getvalue()
            self.front.flush()
            self.front.take()
            self.front.care(time.monotonic())
            time.sleep(0.002)


@contextmanager
def bench(workers: int = 2, start: bytes = b"", command: list[str] = COMMAND) -> Iterator[Bench]:
    rig = Bench(workers, start, command)
    try:
        rig.front.start(seconds(20))
        yield rig
    finally:
        rig.front.close()
    assert all(worker.pid == 0 for worker in rig.workers)


def test_answers_go_to_the_senders() -> None:
    with bench() as rig:
        for address in range(20):
            rig.say(b"echo %d" % address, address, address)
        rig.until(lambda: len(rig.line.sent) == 20)
        assert sorted((a, d.split()[-1]) for a, d in rig.line.sent) == sorted(
            (address, b"%d" % address) for address in range(20)
        )
        rig.until(lambda: rig.front.samples == 20)


def test_a_worker_that_ends_is_started_again_and_counts_go_on() -> None:
    with bench() as rig:
        rig.say(b"echo", 1)
        rig.say(b"echo", 2)
        rig.until(lambda: rig.front.samples == 2)
        first = rig.workers[1].pid
        rig.say(b"fall", 1)
        rig.until(lambda: "worker 2 ended (status 3)" in rig.text.getvalue())
        rig.say(b"echo", 1)
        assert rig.log.counters["worker_down"] == 1
        rig.until(lambda: rig.workers[1].ready)
        assert rig.workers[1].pid != first
        assert "worker 2 serves again" in rig.text.getvalue()
        rig.line.sent.clear()
        rig.say(b"echo", 1)
        rig.say(b"echo", 2)
        rig.until(lambda: len(rig.line.sent) == 2)
        rig.until(lambda: rig.front.samples == 4)


def test_one_that_ends_again_and_again_is_started_less_and_less_often() -> None:
    log = EventLog(io.StringIO())
    worker = WorkerProcess(1, [sys.executable, "-c", ""], (), b"", log)
    pauses = []
    for _ in range(9):
        worker.start()
        os.waitid(os.P_PID, worker.pid, os.WEXITED | os.WNOWAIT)
        now = time.monotonic()
        assert worker.ended(now) == "status 0"
        pauses.append(next(p for p in (0.5, 1, 2, 4, 8, 16, 30) if worker.is_due(now + p)))
    assert pauses == [0.5, 1, 2, 4, 8, 16, 30, 30, 30]
    worker.start()
    os.waitid(os.P_PID, worker.pid, os.WEXITED | os.WNOWAIT)
    later = time.monotonic() + 2 * STEADY_S
    assert worker.ended(later) == "status 0"
    assert worker.is_due(later), "it had served for long"
    worker.kill()


def test_one_that_does_not_answer_is_ended_and_started_again() -> None:
    with bench(1) as rig:
        worker = rig.workers[0]
        hung = worker.pid
        rig.say(b"hang", 0)
        rig.front.flush()
        worker.ask(0.0, states=False)
        for _ in range(STUCK_LOOKS - 1):
            worker.look(STUCK_S + 1)
        assert "has not answered" not in rig.text.getvalue()
        worker.look(STUCK_S + 1)
        assert "worker 1 has not answered" in rig.text.getvalue()
        rig.until(lambda: worker.ready and worker.pid not in (0, hung))


def test_one_that_answers_late_is_left_alone() -> None:
    """As when the whole machine stood still: the answer is there at the next look."""
    with bench(1) as rig:
        worker = rig.workers[0]
        worker.ask(0.0, states=False)
        worker.look(STUCK_S + 1)
        rig.until(lambda: worker._asked_at is None)
        for _ in range(STUCK_LOOKS):
            worker.look(STUCK_S + 1)
        assert "has not answered" not in rig.text.getvalue()


def test_a_newcomer_is_answered_when_the_other_worker_has_removed_its_client() -> None:
    with bench() as rig:
        rig.say(b"enter", 0)
        rig.until(lambda: rig.line.sent == [(1, b"welcome")])
        place = (0, rig.front._books[0].known(1).code)
        rig.say(b"claim", 1)
        rig.until(lambda: rig.front._router.other_at(place, 0) == 1)
        rig.line.sent.clear()
        rig.say(b"enter", 0)
        seen: list[int | None] = []
        rig.line.on_send = lambda: seen.append(rig.front._router.other_at(place, 0))
        rig.until(lambda: rig.line.sent == [(1, b"welcome")])
        assert seen == [None], "no other worker has a client there by then"


def test_a_newcomer_is_answered_when_the_other_worker_has_ended() -> None:
    with bench() as rig:
        place = (0, rig.front._books[0].known(1).code)
        rig.say(b"claim", 1)
        rig.until(lambda: rig.front._router.other_at(place, 0) == 1)
        os.kill(rig.workers[1].pid, signal.SIGSTOP)
        rig.say(b"enter", 0)
        rig.until(lambda: rig.front._welcomes)
        assert not rig.line.sent
        os.kill(rig.workers[1].pid, signal.SIGKILL)
        rig.until(lambda: rig.line.sent == [(1, b"welcome")])


def test_a_view_waits_for_all_workers_and_not_for_one_that_ended() -> None:
    with bench() as rig:
        assert not rig.front.has_new_view()
        rig.until(rig.front.has_new_view)
        rig.say(b"hang", 1)
        rig.until(lambda: rig.front.samples == 0)
        assert not rig.front.has_new_view()
        rig.until(lambda: rig.front._views._open == {2})
        assert not rig.front.has_new_view()
        os.kill(rig.workers[1].pid, signal.SIGKILL)
        rig.until(rig.front.has_new_view)


def test_a_view_is_taken_without_a_slow_worker_which_is_not_ready_then() -> None:
    with bench() as rig:
        slow = rig.workers[1]
        os.kill(slow.pid, signal.SIGSTOP)
        assert not rig.front.has_new_view()
        rig.until(rig.front.has_new_view)
        assert [worker.answers for worker in rig.workers] == [True, False]
        assert not rig.front.has_new_view()
        began = time.monotonic()
        rig.until(rig.front.has_new_view)
        assert time.monotonic() - began < SLOW_S, "the next view does not wait for it"
        os.kill(slow.pid, signal.SIGCONT)
        rig.until(lambda: slow.answers)


def test_the_number_of_clients_is_what_the_workers_last_said() -> None:
    with bench() as rig:
        for key in range(5):
            rig.say(b"echo", key, key)
        rig.until(lambda: len(rig.front.clients) == 5)


def test_a_fault_that_a_worker_finds_is_that_of_the_agent() -> None:
    with pytest.raises(UserError) as raised, bench(start=b"refuse"):
        pass
    assert [each.id for each in raised.value.diagnostics] == ["MG-9703"]


def test_a_fault_that_a_worker_finds_later_is_in_the_log_once() -> None:
    with bench() as rig:
        rig.workers[1].start_data = b"refuse"
        rig.say(b"fall", 1)
        rig.until(lambda: rig.workers[1].restarts == 3)
        assert rig.text.getvalue().count("worker 2 cannot start, and is tried again: a fault") == 1
        rig.workers[1].start_data = b""
        rig.until(lambda: rig.workers[1].ready)


def test_the_system_has_no_room_for_a_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    """The agent serves with the others, and tries again."""
    with bench() as rig:
        monkeypatch.setattr(subprocess, "Popen", full)
        rig.say(b"fall", 1)
        rig.until(lambda: "worker 2 cannot start" in rig.text.getvalue())
        descriptors = len(list(Path("/proc/self/fd").iterdir()))
        worker = rig.workers[1]
        for _ in range(3):
            rig.front.care(1e9)
            assert not worker.is_due(time.monotonic()), "there is a pause before the next attempt"
        assert len(list(Path("/proc/self/fd").iterdir())) == descriptors
        assert rig.text.getvalue().count("Resource temporarily unavailable") == 1
        rig.say(b"echo", 0)
        rig.until(lambda: rig.line.sent)
        monkeypatch.undo()
        worker.put_off(float("-inf"))
        rig.until(lambda: worker.ready)


def test_the_system_has_no_room_for_a_worker_at_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", full)
    with pytest.raises(UserError) as raised, bench():
        pass
    (found,) = raised.value.diagnostics
    assert (found.id, found.message) == (
        "MG-9841",
        "worker 1 does not start: Resource temporarily unavailable",
    )


def full(*_arguments: object, **_options: object) -> None:
    raise BlockingIOError(errno.EAGAIN, os.strerror(errno.EAGAIN))


def test_one_that_never_serves_after_its_restart_is_ended() -> None:
    with bench(1) as rig:
        worker = rig.workers[0]
        worker.start_data = b"sleep"
        rig.say(b"fall", 0)
        rig.until(lambda: worker.restarts == 1 and worker.pid)
        hung = worker.pid
        for _ in range(STUCK_LOOKS):
            worker.look(time.monotonic() + START_S - 5)
        assert "has not answered" not in rig.text.getvalue()
        worker.start_data = b""
        for _ in range(STUCK_LOOKS):
            worker.look(time.monotonic() + START_S + 1)
        assert "worker 1 has not answered for 60" in rig.text.getvalue()
        rig.until(lambda: worker.ready and worker.pid not in (0, hung))


def test_a_signal_ends_the_start() -> None:
    rig = Bench(2, b"sleep", COMMAND)
    began = time.monotonic()
    rig.front.start(1000.0, lambda: all(worker.pid for worker in rig.workers))
    rig.front.close()
    assert time.monotonic() - began < seconds(5), "workers without clients are not waited for"
    assert [worker.pid for worker in rig.workers] == [0, 0]
    assert "worker_stuck" not in rig.text.getvalue()


def test_a_fault_in_one_frame_does_not_end_the_agent() -> None:
    with bench() as rig:

        def refuse(_value: object) -> None:
            raise ValueError("refused")

        rig.front.on_care = refuse
        rig.front.on_type = refuse
        rig.say(b"type", 1)
        rig.say(b"echo", 1)
        rig.until(lambda: rig.line.sent)
        assert rig.log.counters["internal_ValueError"] > 1


def test_a_worker_that_does_not_start() -> None:
    with pytest.raises(UserError) as raised, bench(command=[sys.executable, "-c", ""]):
        pass
    (found,) = raised.value.diagnostics
    assert (found.id, found.message[-15:]) == ("MG-9841", " does not start")
