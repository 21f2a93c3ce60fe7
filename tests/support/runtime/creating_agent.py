# SPDX-License-Identifier: Apache-2.0
"""The agent of fake_agent.py, which notes the requests that it acts on and announces what is unacknowledged."""

from __future__ import annotations

from dataclasses import dataclass, field

from tests.support.runtime.fake_agent import FakeAgent

CREATE, DELETE = 0x01, 0x03


@dataclass
class CreatingAgent(FakeAgent):
    """`requests` are those that it acted on, as (submessage, payload).

    It has no clock: where a reliable answer is unacknowledged, each further datagram of the client gets a HEARTBEAT.
    """

    requests: list[tuple[int, bytes]] = field(default_factory=list)

    def created(self) -> list[bytes]:
        """Return the ids of the objects that were created, in their order, each as often as it was."""
        return [payload[2:4] for identifier, payload in self.requests if identifier == CREATE]

    def _answers(self, datagram: bytes) -> list[bytes]:
        before = self.statuses
        answers = super()._answers(datagram)
        return answers if self.statuses != before else [*answers, *self.announce()]

    def _create(self, payload: bytes) -> bytes:
        self.requests.append((CREATE, payload))
        return super()._create(payload)

    def _delete(self, payload: bytes) -> bytes:
        self.requests.append((DELETE, payload))
        return super()._delete(payload)
