# SPDX-License-Identifier: Apache-2.0
"""All readings of all clients. A reading continues when ROS 2 has data, when its stream has space, or at a set time."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable
from typing import Final

from microros_gen.agent.clients import Client
from microros_gen.agent.entities import Entity, Readable
from microros_gen.agent.fairness import TURN_S, Fairness
from microros_gen.agent.log import EventLog
from microros_gen.agent.reading import RETRY_S, Reading
from microros_gen.agent.ros.bridge import Source
from microros_gen.agent.wire.data_messages import ReadData

CROWDED: Final = 256
"""Number of scheduled times above which those of finished readings are removed."""


class Deliveries:
    """Scheduler of readings; each object has at most one."""

    def __init__(
        self,
        log: EventLog,
        fault: Callable[[Exception], None],
        fair: Fairness,
        clock: Callable[[], float],
    ) -> None:
        """Call `fault` for unexpected errors, each of which ends the turn of one reading only."""
        self._fair = fair
        self._clock = clock
        self._log = log
        self._fault = fault
        self._by_source: dict[int, Reading] = {}
        """Readings by the identity of their source, which the reading keeps alive."""
        self._later: list[tuple[float, int, Reading]] = []
        self._with_room: dict[Client, None] = {}
        """Clients whose reliable streams may have space again, in order."""
        self._order = 0
        self._crowded = CROWDED
        self.delivered = 0
        """Number of samples, requests and replies sent to clients."""

    def start(self, client: Client, entity: Entity, wanted: ReadData, now: float) -> None:
        """Start what a READ_DATA requests; it replaces an earlier reading of the same object."""
        self._drop(client, entity.id)
        reading = Reading(client, entity, wanted, now, self._log)
        client.readings[entity.id] = reading
        self._attach(reading, entity.source)
        self._go(reading, now)

    def ready(self, sources: Iterable[Source], now: float) -> None:
        """Read from sources that have data; a source without a reading keeps its data."""
        found = (self._by_source.get(id(source)) for source in sources)
        self._round([reading for reading in found if reading is not None], now)

    def note_room(self, client: Client) -> None:
        """Continue at the next `use_room` what waits for space on a reliable stream of `client`.

        A client acknowledges each message by itself; those of a batch are answered together.
        """
        self._with_room[client] = None

    def use_room(self) -> None:
        """Continue the readings of the clients of `note_room`."""
        clients, self._with_room = self._with_room, {}
        for client in clients:
            began = self._clock()
            self.room(client, began)
            ended = self._clock()
            client.account.bill(self._fair.own(ended - began), ended)

    def room(self, client: Client, now: float) -> None:
        """Continue, in turn, the readings that wait for space on a reliable stream of `client`."""
        still = []
        for _ in range(len(client.waiting)):
            reading = client.waiting.popleft()
            if reading.has_room():
                reading.waiting = False
                self._go(reading, now)
            else:
                still.append(reading)
        client.waiting.extendleft(reversed(still))

    def refresh(self, client: Client, now: float) -> None:
        """Follow changes of the objects of `client`: end readings of removed objects, and use new sources."""
        for object_id, reading in list(client.readings.items()):
            entity = client.objects.find(object_id)
            if entity is not reading.entity:
                self._drop(client, object_id)
            elif entity.source is not reading.source:
                self._attach(reading, entity.source)
                if entity.source is not None:
                    self._go(reading, now)

    def forget(self, client: Client) -> None:
        """End all readings of `client`."""
        for object_id in list(client.readings):
            self._drop(client, object_id)
        client.waiting.clear()

    def due(self) -> float | None:
        """Return the time at which `run` is due."""
        while self._later and self._later[0][2].over:
            heapq.heappop(self._later)
        return self._later[0][0] if self._later else None

    def run(self, now: float) -> None:
        """Continue the deliveries that are due."""
        due = []
        while self._later and self._later[0][0] <= now:
            due.append(heapq.heappop(self._later)[2])
            due[-1].scheduled = False
        self._round(due, now)

    def _round(self, readings: list[Reading], now: float) -> None:
        """Continue readings, those of the clients with the lowest cost first; the rest wait for the next round."""
        self._fair.order(readings)
        at = now
        for reading in readings:
            if at >= now + TURN_S:
                self._retry(reading, now)
                continue
            self._go(reading, at)
            before, at = at, self._clock()
            reading.account.bill(self._fair.own(at - before), at)

    def _go(self, reading: Reading, now: float) -> None:
        if reading.over:
            return
        before = reading.entity.delivered
        try:
            at = reading.deliver(now)
        except Exception as error:
            self._fault(error)
            at = now + RETRY_S
        self.delivered += reading.entity.delivered - before
        if reading.over:
            self._drop(reading.client, reading.entity.id)
        elif at is not None:
            self._retry(reading, at)

    def _retry(self, reading: Reading, at: float) -> None:
        if reading.over or reading.scheduled:
            return
        reading.scheduled = True
        self._order += 1
        heapq.heappush(self._later, (at, self._order, reading))
        if len(self._later) > self._crowded:
            self._later = [item for item in self._later if not item[2].over]
            heapq.heapify(self._later)
            self._crowded = max(CROWDED, 2 * len(self._later))

    def _attach(self, reading: Reading, source: Readable | None) -> None:
        if reading.source is not None:
            self._by_source.pop(id(reading.source), None)
        reading.attach(source)
        if source is not None:
            self._by_source[id(source)] = reading

    def _drop(self, client: Client, object_id: int) -> None:
        reading = client.readings.pop(object_id, None)
        if reading is not None:
            reading.over = True
            reading.give_back()
            self._attach(reading, None)
            if reading.waiting:
                client.waiting.remove(reading)
                reading.waiting = False
