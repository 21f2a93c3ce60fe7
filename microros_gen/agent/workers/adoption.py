# SPDX-License-Identifier: Apache-2.0
"""Which client may be adopted from messages without a key: the only one of all workers that is not in session.

See `microros_gen.agent.preconfigured`. Each worker reports which of its clients are missing; of one that does not
run, or has not reported, all are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from microros_gen.agent.workers.channel import Kind

if TYPE_CHECKING:
    from microros_gen.agent.workers.worker_process import WorkerProcess

KEY_BYTES = 4


class Adoption:
    """The front's view of the clients to adopt."""

    def __init__(self, workers: Sequence[WorkerProcess], keys: frozenset[bytes]) -> None:
        """`keys`: those of all clients to adopt."""
        self._workers = workers
        self._own = [
            frozenset(key for key in keys if worker_of_key(key, len(workers)) == number)
            for number in range(len(workers))
        ]
        self._missing = list(self._own)
        self._only: bytes | None = None
        self._choose()

    @property
    def worker(self) -> int | None:
        """The worker, from 0, of the client that may be adopted; None: there is not exactly one."""
        return worker_of_key(self._only, len(self._workers)) if self._only is not None else None

    def reported(self, worker: WorkerProcess, content: bytes) -> None:
        """Take which clients of a worker are missing (`missing_keys`)."""
        keys = (content[at : at + KEY_BYTES] for at in range(0, len(content), KEY_BYTES))
        self._set(worker, self._own[worker.number - 1] & frozenset(keys))

    def ended(self, worker: WorkerProcess) -> None:
        """Note that a worker has ended, with the sessions of its clients."""
        self._set(worker, self._own[worker.number - 1])

    def _set(self, worker: WorkerProcess, missing: frozenset[bytes]) -> None:
        self._missing[worker.number - 1] = missing
        before = self.worker
        self._choose()
        for number in {before, self.worker, worker.number - 1}:
            channel = self._workers[number].channel if number is not None else None
            if channel is not None:
                channel.send(Kind.ADOPT, (self._only or b"") if number == self.worker else b"")

    def _choose(self) -> None:
        missing = frozenset[bytes]().union(*self._missing)
        self._only = next(iter(missing)) if len(missing) == 1 else None


def worker_of_key(key: bytes, workers: int) -> int:
    """Return the worker, from 0, of a client key (4 bytes, big endian)."""
    return int.from_bytes(key, "big") % workers
