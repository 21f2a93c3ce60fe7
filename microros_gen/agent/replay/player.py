# SPDX-License-Identifier: Apache-2.0
"""A player of one side of a conversation: sends its messages in the recorded order, and compares the answers.

A message is sent at its time, and after the answers that preceded it in the recording. Sequence numbers are the
recorded ones. Acknowledgements and heartbeats are those of this run. Towards a client, the session's id and key are
those that it has now; the identity in a reply is that of the request of this run.
"""

from __future__ import annotations

from collections import Counter, OrderedDict, deque
from collections.abc import Callable, Collection
from typing import Any

from microros_gen.agent.recording.recorded import Conversation, opens_session
from microros_gen.agent.replay.parts import IDENTITY, Part, Receiver, difference
from microros_gen.agent.replay.plan import AHEAD, Plan, Step, Where, content
from microros_gen.agent.replay.sender import Sender
from microros_gen.agent.wire.constants import (
    SESSION_NONE_WITHOUT_KEY,
    STREAM_NONE,
    ObjectKind,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import Data, WriteData
from microros_gen.agent.wire.entity_messages import Acknack
from microros_gen.agent.wire.message import Header, header_size, join
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import encode

_SHORTEST = 8
"""Bytes of the shortest message: a header and that of a submessage."""
HEARTBEAT_S = 0.1
"""Seconds between two questions whether messages have arrived."""
Send = Callable[[bytes], None]


class Player:
    """Plays the client's side of a conversation, or (`as_agent`) the agent's."""

    def __init__(
        self, conversation: Conversation, as_agent: bool, wait_s: float, skipped: Collection[str] = ()
    ) -> None:
        """Wait up to `wait_s` seconds for an answer; do not compare submessages with the names `skipped`."""
        self.conversation = conversation
        self._as_agent = as_agent
        self._wait_s = wait_s
        self._receiver, self._sender = Receiver(skipped), Sender()
        self._plan = Plan(conversation, as_agent, skipped)
        self._received: Counter[Where] = Counter()
        self._early: dict[Where, deque[Part]] = {}
        self._early_count = 0
        self._waiting_since: float | None = None
        self._beat_at = 0.0
        self._session, self._key = self._recorded_session()
        self._identities: OrderedDict[bytes, bytes] = OrderedDict()
        self._impatient = False
        self.difference = ""
        """The first difference, in words."""
        self.sent = 0
        self.compared = 0

    @property
    def done(self) -> bool:
        """Whether all messages were sent and all answers came, or are not waited for any more."""
        if not self._plan.complete or self._plan.steps:
            return False
        late = self._plan.acknowledged and self._sender.pending
        return self._impatient or not (late or self._plan.outstanding())

    def receive(self, data: bytes, send: Send) -> None:
        """Take a message of the other side."""
        taken = self._receiver.take(data)
        for part in taken.parts:
            self._compare(part)
        for acknack in taken.acknacks:
            for message in self._sender.take(acknack):
                send(message)
        for heartbeat in taken.heartbeats:
            for part in self._receiver.skip_to(heartbeat.stream, heartbeat.first):
                self._compare(part)
            self._acknowledge(heartbeat.stream, heartbeat.last, send)
        if len(data) >= _SHORTEST and is_reliable(data[1]):
            self._acknowledge(data[1], Header.decode(data).sequence, send)

    def tick(self, now: float, reached_ns: float, send: Send) -> None:
        """Send what is due: `now` in seconds, the recording has reached `reached_ns`."""
        self._read(reached_ns)
        while self._plan.steps and self._may_send(self._plan.steps[0], now):
            step = self._plan.steps.popleft()
            self._waiting_since = None
            self._play(step, send)
            self._read(reached_ns)
        if not self._plan.steps and not self.done and (self._plan.complete or self._plan.full):
            self._may_go_on(self._plan.outstanding(), now, "the last message was not acknowledged")
        if self._sender.pending and now >= self._beat_at:
            self._beat_at = now + HEARTBEAT_S
            for heartbeat in self._sender.heartbeats():
                send(self._flow(encode(heartbeat)))

    def _read(self, reached_ns: float) -> None:
        """Read on, and compare what came before its place in the recording was read."""
        while True:
            self._plan.read(reached_ns)
            for where in list(self._early):
                self._match(where)
            if not (self._impatient and self._plan.full and not self._plan.steps):
                break
            for where in self._plan.outstanding():
                self._drop(where)
        if self._plan.complete:
            for where in list(self._early):
                self._unexpected(where, self._early[where][0])

    def _recorded_session(self) -> tuple[int, bytes]:
        first = next(m.data for m in self.conversation.messages if opens_session(m.data))
        at = header_size(first)
        return first[at + 16], first[at + 12 : at + 16]

    def _missing(self, wanted: dict[Where, int]) -> Part | None:
        late = [
            part
            for where, count in wanted.items()
            if self._received[where] < count and (part := self._plan.next_expected(where))
        ]
        return min(late, key=lambda part: part.number, default=None)

    def _may_send(self, step: Step, now: float) -> bool:
        head = Header.decode(step.message.data)
        late = step.acknowledged and self._sender.pending
        if not late and self._sender.has_room(head.stream) and not self._missing(step.after):
            return True
        before = f"packet {step.message.number}: the messages before it were not acknowledged"
        return self._may_go_on(step.after, now, before)

    def _may_go_on(self, wanted: dict[Where, int], now: float, otherwise: str) -> bool:
        """Return whether the wait is over: an answer is later than allowed."""
        if self._impatient:
            return True
        first_of_client = self._as_agent and not self._received
        if self._waiting_since is None or first_of_client:
            self._waiting_since = now
        if now - self._waiting_since < self._wait_s:
            return False
        missing = self._missing(wanted)
        self._differ(
            f"packet {missing.number}: {missing.name} did not come within {self._wait_s:g} s"
            if missing
            else otherwise
        )
        self._impatient = True
        return True

    def _play(self, step: Step, send: Send) -> None:
        data = self._rewritten(step.message.data)
        if step.opens:
            self._receiver.reset()
            self._sender.reset()
        if self._sender.keep(Header.decode(data), data):
            self.sent += 1
            send(data)

    def _rewritten(self, data: bytes) -> bytes:
        """Return a message for this run: its session, identities in replies; without acknowledgements."""
        head = Header.decode(data)
        if self._as_agent:
            outside = head.session in (STREAM_NONE, SESSION_NONE_WITHOUT_KEY)
            session = self._session & SESSION_NONE_WITHOUT_KEY if outside else self._session
            head = Header(session, head.stream, head.sequence, self._key if session < 0x80 else b"")
        return join(head, [self._identified(each) for each in content(data)])

    def _identified(self, submessage: bytes) -> bytes:
        if self._as_agent or submessage[0] != WriteData.ID or len(submessage) < _SHORTEST:
            return submessage
        if submessage[7] & 0x0F != ObjectKind.REPLIER:
            return submessage
        identity = submessage[8 : 8 + IDENTITY]
        return submessage[:8] + self._identities.get(identity, identity) + submessage[8 + IDENTITY :]

    def _compare(self, part: Part) -> None:
        if isinstance(part.content, CreateClient):
            self._session, self._key = part.content.session, part.content.key
            self._sender.reset()
        where = part.session, part.stream
        self._early.setdefault(where, deque()).append(part)
        self._early_count += 1
        self._match(where)
        if self._early_count > AHEAD or (self._plan.complete and where in self._early):
            self._unexpected(where, part)

    def _match(self, where: Where) -> None:
        """Compare what came on a stream with the answers that were read."""
        early = self._early[where]
        while early and (recorded := self._plan.next_expected(where)):
            part = early.popleft()
            self._early_count -= 1
            self._drop(where)
            self.compared += 1
            if not (self._plan.steps or self._plan.complete):
                self._waiting_since = None
            found = difference(recorded, part)
            if found:
                self._differ(f"packet {recorded.number}: {found}")
            elif _is_request(recorded.content):
                self._remember(recorded.content.data[:IDENTITY], part.content.data[:IDENTITY])
        if not early:
            del self._early[where]

    def _drop(self, where: Where) -> None:
        self._plan.drop(where)
        self._received[where] += 1

    def _unexpected(self, where: Where, part: Part) -> None:
        """Forget what came on a stream and is not in the recording."""
        last = f"after packet {self._plan.last[where]}: " if where in self._plan.last else ""
        self._differ(f"{last}{part.name} was received, which the recording does not have")
        self._early_count -= len(self._early.pop(where))

    def _remember(self, recorded: bytes, now: bytes) -> None:
        self._identities[recorded] = now
        if len(self._identities) > AHEAD:
            self._identities.popitem(last=False)

    def _differ(self, text: str) -> None:
        self.difference = self.difference or text

    def _acknowledge(self, stream: int, last: int, send: Send) -> None:
        first, missing = self._receiver.expected.get(stream, 0), self._receiver.missing(stream, last)
        send(self._flow(encode(Acknack(first, missing, stream))))

    def _flow(self, submessage: bytes) -> bytes:
        return join(Header(self._session, STREAM_NONE, 0, self._key), [submessage])


def _is_request(content: Any) -> bool:
    return isinstance(content, Data) and content.object & 0x0F == ObjectKind.REPLIER
