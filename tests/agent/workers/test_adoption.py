# SPDX-License-Identifier: Apache-2.0
"""Which client may be adopted from messages without a key, where several workers have clients to adopt."""

from __future__ import annotations

import io
import socket

from microros_gen.agent.log import EventLog
from microros_gen.agent.workers.adoption import Adoption
from microros_gen.agent.workers.channel import Channel, Kind
from microros_gen.agent.workers.worker_process import WorkerProcess

TWO, THREE, FIVE = (number.to_bytes(4, "big") for number in (2, 3, 5))


class Rig:
    """Two workers, and what they are told."""

    def __init__(self, *keys: bytes) -> None:
        log = EventLog(io.StringIO())
        self.workers = [WorkerProcess(number, (), (), b"", log) for number in (1, 2)]
        self._ends = []
        for worker in self.workers:
            near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
            worker.channel = Channel(near)
            self._ends.append(Channel(far))
        self.adoption = Adoption(self.workers, frozenset(keys))
        self.allowed = [b"", b""]

    def report(self, worker: int, *missing: bytes) -> None:
        self.adoption.reported(self.workers[worker], b"".join(missing))
        self._look()

    def ended(self, worker: int) -> None:
        self.adoption.ended(self.workers[worker])
        self._look()

    def state(self) -> tuple[int | None, list[bytes]]:
        return self.adoption.worker, self.allowed

    def _look(self) -> None:
        for number, (worker, end) in enumerate(zip(self.workers, self._ends, strict=True)):
            assert worker.channel is not None
            worker.channel.flush()
            for kind, content in end.receive():
                assert kind is Kind.ADOPT
                self.allowed[number] = content


def test_the_only_one_of_all_workers() -> None:
    rig = Rig(TWO, THREE)
    assert rig.adoption.worker is None
    rig.report(0, TWO)
    rig.report(1, THREE)
    assert rig.state() == (None, [b"", b""]), "it may be either"
    rig.report(1)
    assert rig.state() == (0, [TWO, b""])
    rig.report(0)
    assert rig.state() == (None, [b"", b""])
    rig.report(1, THREE)
    assert rig.state() == (1, [b"", THREE])


def test_the_clients_of_a_worker_that_ended_are_missing() -> None:
    rig = Rig(TWO, THREE)
    rig.report(0, TWO)
    rig.report(1)
    assert rig.allowed == [TWO, b""]
    rig.ended(1)
    assert rig.state() == (None, [b"", b""])
    rig.report(0)
    assert rig.state() == (1, [b"", THREE])


def test_one_worker_with_two_of_them() -> None:
    rig = Rig(THREE, FIVE)
    rig.report(1, THREE, FIVE)
    assert rig.allowed == [b"", b""]
    rig.report(1, FIVE)
    assert rig.state() == (1, [b"", FIVE])
    rig.report(0, TWO)
    assert rig.allowed == [b"", FIVE], "a key that is not to be adopted, or of another worker, does not count"


def test_without_clients_to_adopt() -> None:
    rig = Rig()
    rig.report(0)
    assert rig.state() == (None, [b"", b""])
