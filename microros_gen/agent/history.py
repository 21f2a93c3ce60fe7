# SPDX-License-Identifier: Apache-2.0
"""Estimated memory of the histories in Fast DDS. They cannot be inspected, so the samples written to them are counted.

Fast DDS 2.14.5 has a buffer for each sample in a history. Buffers are reused, grow to the largest sample, and are freed
with the writer. A writer therefore has at most as many buffers as it ever had samples in its history, each as large as
its largest sample.
"""

from __future__ import annotations

from microros_gen.agent.budgets import Shares
from microros_gen.agent.representation import Durability, Qos
from microros_gen.agent.ros.bridge import BridgeError, BusyError, Writer
from microros_gen.agent.wire.constants import Status

CHANGE_BYTES = 512
"""Bytes of a sample in a history besides its payload."""
UNREAD_BYTES = 64
"""Bytes charged for each sample of a reader's depth. Most never exist; `memory` observes those that do."""
KEEP_ALL_DEPTH = 5_000
"""Maximum number of samples that Fast DDS keeps with KEEP_ALL."""


class HistoryFullError(BridgeError):
    """A sample is refused for good, because its history must not grow."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason, Status.RESOURCES)


def depth_of(qos: Qos) -> int:
    """Return how many samples the history of an endpoint has at most."""
    return (qos.depth or 1) if qos.keep_last else KEEP_ALL_DEPTH


class ReaderHistory:
    """The minimum memory of a full history of a reader; its samples are stored elsewhere."""

    def __init__(self, qos: Qos, shares: Shares) -> None:
        """Reserve the memory. Raises HistoryFullError if it exceeds a limit."""
        self._shares = shares
        _check(depth_of(qos), shares)
        self.bytes = depth_of(qos) * UNREAD_BYTES
        if not shares.history.take(self.bytes):
            self.bytes = 0
            raise HistoryFullError("its history does not fit into history_bytes, which all clients share")

    def give_back(self) -> None:
        """Release the memory of a destroyed reader."""
        self._shares.history.add(-self.bytes)
        self.bytes = 0


class WriterHistory:
    """The current memory of the history of a writer."""

    def __init__(self, qos: Qos, shares: Shares) -> None:
        """Start empty. Raises HistoryFullError if even empty samples would exceed a limit."""
        depth = depth_of(qos)
        _check(depth, shares)
        self._shares = shares
        self._lasting = qos.durability is not Durability.VOLATILE
        self._keeps_all = not qos.keep_last
        self.depth = (
            depth if qos.reliable or self._lasting else 1
        )  # best effort does not keep samples after sending them
        self.samples = 0
        """Upper bound of the samples in the history: those since it was last known to be empty."""
        self.largest = 0
        self.bytes = 0

    def fits(self, size: int) -> bool:
        """Return whether a sample of `size` bytes replaces another one; otherwise call `make_room`."""
        return size <= self.largest and self.samples >= self.depth

    def make_room(self, size: int, writer: Writer) -> None:
        """Reserve memory for a sample. Raises BusyError if it may fit later, HistoryFullError if it never will."""
        if self._take(size):
            return
        if not self._lasting and writer.settled():
            self.samples = 0
            if self._take(size):
                return
        reason = f"{writer.label}: its history would take more than {self._shares.object_history} bytes,"
        reason += " or than the client or all clients together may have"
        if self._lasting and not self._keeps_all:
            raise HistoryFullError(reason)
        raise BusyError(reason + ", while its readers have not taken earlier samples")

    def give_back(self) -> None:
        """Release the memory of a destroyed writer."""
        self._shares.history.add(-self.bytes)
        self.bytes = self.samples = self.largest = 0

    def _take(self, size: int) -> bool:
        samples, largest = min(self.samples + 1, self.depth), max(self.largest, size)
        more = max(0, samples * (largest + CHANGE_BYTES) - self.bytes)
        if more and (self.bytes + more > self._shares.object_history or not self._shares.history.take(more)):
            return False
        self.bytes += more
        self.samples, self.largest = samples, largest
        return True


def _check(depth: int, shares: Shares) -> None:
    least = depth * CHANGE_BYTES
    if least > shares.object_history:
        most = shares.object_history
        raise HistoryFullError(
            f"a history of {depth} samples takes {least} bytes or more, {most} are allowed"
        )
