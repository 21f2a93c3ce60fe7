# SPDX-License-Identifier: Apache-2.0
"""Work of clients that does not finish within their turn: it pauses, and continues in their next turn.

The work of a client is done in order: first its jobs (its entities are created or removed in steps), then its messages.
Only clients with postponed work are stored here; all others were served at once.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from microros_gen.agent.clients import Client, Job
from microros_gen.agent.fairness import TURN_S, Fairness
from microros_gen.agent.graph_work import GraphWork
from microros_gen.agent.steps import finish

PAUSE_S: Final = 0.05
"""Seconds until a job that may not change the ROS graph now is retried."""
INBOX_BYTES: Final = 65_536
"""Maximum bytes that wait for the next turn of one client, besides the message in which it was stopped."""


class Turns:
    """The order of clients with postponed work, and the length of their turns."""

    def __init__(
        self,
        clock: Callable[[], float],
        turn_s: float,
        fair: Fairness,
        graph: GraphWork,
        fault: Callable[[Exception], None],
        processor: Callable[[], float],
    ) -> None:
        """Give each turn `turn_s` seconds; call `fault` for unexpected errors.

        `processor` is the processor time of this thread, in seconds, by which changes of the ROS graph are charged.
        """
        self._processor = processor
        self.clock = clock
        self.end = 0.0
        """When the current turn ends."""
        self.messages: Callable[[Client], None] = _nothing
        """Function that processes ready messages of a client; the rest stays in its `ready`."""
        self._turn_s = turn_s
        self._fair = fair
        self._graph = graph
        self._fault = fault
        self._waiting: set[Client] = set()

    def start(self, now: float) -> None:
        """Begin the turn of a client."""
        self.end = now + self._turn_s

    @property
    def over(self) -> bool:
        """Whether the turn is over."""
        return self.clock() >= self.end

    def begin(self, client: Client, job: Job) -> bool:
        """Start a job after the other jobs of the client, as far as its turn goes; return whether it is done."""
        client.work.append(job)
        if len(client.work) > 1:
            return False
        try:
            done = self._work(client)
        except BaseException:
            client.work.clear()
            raise
        if not done:
            self.put_off(client)
        return done

    def put_off(self, client: Client) -> None:
        """Continue the work of `client` in its next turn."""
        self._waiting.add(client)
        client.account.busy = client.turn_at <= self.clock()

    def waits(self, client: Client) -> bool:
        """Return whether a client has postponed work."""
        return client in self._waiting

    def takes(self, client: Client, size: int) -> bool:
        """Return whether a further message of a waiting client may wait, too."""
        if client.inbox_bytes >= INBOX_BYTES:  # some of it is done by now: see how much waits
            client.inbox_bytes = sum(len(ready[0]) for ready in client.ready)
        if client.inbox_bytes >= INBOX_BYTES:
            return False
        client.inbox_bytes += size
        return True

    def due(self) -> float | None:
        """Return the time at which `run` is due."""
        return min((client.turn_at for client in self._waiting), default=None) if self._waiting else None

    def run(self, now: float) -> None:
        """Continue the work of clients in turn, for one round."""
        self.round([client for client in self._waiting if client.turn_at <= now], now, self._go_on)

    def drain(self, end: float) -> None:
        """Continue the work of clients as long as some of it can go on, until `end` at most."""
        while (now := self.clock()) < end and any(client.turn_at <= now for client in self._waiting):
            self.run(now)

    def round(self, clients: list[Client], now: float, go_on: Callable[[Client], None]) -> None:
        """Continue the work of some clients, in their order; those without enough time left stay as they are."""
        self._fair.order(clients)
        for client in clients:
            began = self.clock()
            if began >= now + TURN_S:
                return
            self.start(began)
            go_on(client)
            ended = self.clock()
            client.account.bill(self._fair.own(ended - began), ended)

    def finish(self) -> None:
        """Finish all jobs at once."""
        for client in self._waiting:
            for job in client.work:
                finish(job.steps)
            client.work.clear()
        self._waiting.clear()

    def _go_on(self, client: Client) -> None:
        try:
            done = self._work(client)
            if done and client.ready:
                self.messages(client)
        except Exception as error:
            client.work.clear()
            self._fault(error)
        if client.work or client.ready:
            self.put_off(client)
            return
        self._waiting.discard(client)
        client.account.busy = False
        client.inbox_bytes = 0

    def _work(self, client: Client) -> bool:
        """Run steps of the jobs of a client until its turn is over; return whether all are done."""
        account = client.account
        while client.work:
            job, now = client.work[0], self.clock()
            if job.adds and not self._graph.allows(account, now):
                client.turn_at = now + PAUSE_S
                return False
            began = self._processor()
            try:
                next(job.steps)
            except StopIteration:
                client.work.popleft()
            now = self.clock()
            self._graph.charge(account, self._processor() - began, now)
            if now >= self.end:
                break
        return not client.work


def _nothing(_client: Client) -> None:
    """Ignore messages; the default."""
