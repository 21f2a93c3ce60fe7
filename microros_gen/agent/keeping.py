# SPDX-License-Identifier: Apache-2.0
"""Samples kept for the reliable readers of a client that timed out or opened a new session.

The agent has acknowledged these samples to DDS, which does not deliver them again. The agent keeps all that the client
has not acknowledged: samples that were sent and may or may not have arrived, samples that waited to be sent, and, when
a client times out, those still in DDS. When the client reads from the same reader again, it gets them in order, before
any newer sample; those that did arrive before come twice.
"""

from __future__ import annotations

from collections.abc import Iterable

from microros_gen.agent.clients import Client
from microros_gen.agent.deliveries import Deliveries
from microros_gen.agent.log import EventLog
from microros_gen.agent.objects import Heritage, described
from microros_gen.agent.streams_out import Kept


class Keeping:
    """Store of samples for `keep_s` seconds after the last message of a client, within the budget of its histories."""

    def __init__(self, keep_s: float, deliveries: Deliveries, log: EventLog) -> None:
        self._keep_s = keep_s
        self._deliveries = deliveries
        self._log = log

    def before_sleep(self, client: Client) -> None:
        """Take the samples that DDS has for a client whose readers are about to leave the ROS graph."""
        if self._keep_s:
            self._report_lost(client, sum(reading.save() for reading in client.readings.values()))

    def forget_old(self, client: Client, now: float) -> None:
        """Drop the samples of a client that is away for too long."""
        if now - client.last_received > self._keep_s:
            for entity in client.objects:
                entity.drop_kept(client.shares)

    def begin_again(self, client: Client, now: float) -> None:
        """End the readings of a client whose session begins again, and keep unacknowledged samples."""
        undelivered = client.session.undelivered()
        self._deliveries.forget(client)
        self._restore(client, undelivered)
        self.forget_old(client, now)

    def heritage(self, client: Client, now: float) -> Heritage:
        """Return what a new session with the same key receives when it creates the same readers."""
        self.before_sleep(client)
        self.begin_again(client, now)
        return {entity.id: (described(entity), entity.kept[::-1]) for entity in client.objects if entity.kept}

    def _restore(self, client: Client, undelivered: Iterable[Kept]) -> None:
        by_object: dict[int, list[bytes]] = {}
        for object_id, samples in undelivered:
            by_object.setdefault(object_id, []).extend(samples)
        lost = 0
        for object_id, samples_of in by_object.items():
            entity = client.objects.find(object_id)
            if entity is not None and entity.keeps and self._keep_s:
                lost += entity.keep(samples_of, client.shares)
        self._report_lost(client, lost)

    def _report_lost(self, client: Client, lost: int) -> None:
        for _ in range(lost):
            text = "client {client}: a sample was lost with its session: no room to keep it"
            self._log.count("not_kept", text, client=client.name)
