# SPDX-License-Identifier: Apache-2.0
"""A conversation divided into messages that are sent and answers that are expected, read a little ahead."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Collection

from microros_gen.agent.recording.recorded import Conversation, Message, opens_session
from microros_gen.agent.replay.parts import Part, Receiver
from microros_gen.agent.replay.sender import Sender
from microros_gen.agent.wire.constants import OBJECT_CLIENT, SubmessageId
from microros_gen.agent.wire.entity_messages import StatusReply
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.records import dataclass

AHEAD = 1024
"""Messages to send, and answers, of a conversation that are in memory at most."""
_FLOW = (SubmessageId.ACKNACK, SubmessageId.HEARTBEAT)
Where = tuple[int, int]
"""Session of the conversation, from 1, and stream."""


@dataclass(frozen=True)
class Step:
    """A message to send: after which answer of each stream, from 1, and whether all before it was acknowledged."""

    message: Message
    after: dict[Where, int]
    acknowledged: bool
    opens: bool


class Plan:
    """What of a conversation is next."""

    def __init__(self, conversation: Conversation, as_agent: bool, skipped: Collection[str]) -> None:
        """Plan for the client's side, or (`as_agent`) the agent's; expect nothing with a name in `skipped`."""
        self._as_agent = as_agent
        self._messages = iter(conversation.messages)
        self._next = next(self._messages, None)
        self._receiver, self._sender = Receiver(skipped), Sender()
        self._before: tuple[bytes, int] | None = None
        self.steps: deque[Step] = deque()
        """Messages that were read and not sent."""
        self._answers = 0
        self._totals: Counter[Where] = Counter()
        self.last: dict[Where, int] = {}
        """Number of the packet with the newest answer of each stream."""
        self._expected: dict[Where, deque[Part]] = {}
        self._waiting = 0
        self._leaves = False
        """Whether the client has asked for the end of its session, without an answer so far."""

    @property
    def complete(self) -> bool:
        """Whether all of the conversation was read."""
        return self._next is None

    @property
    def full(self) -> bool:
        """Whether more is read only after an answer has arrived, or a message was sent."""
        return len(self.steps) >= AHEAD or self._waiting >= AHEAD

    @property
    def acknowledged(self) -> bool:
        """Whether the recording has acknowledgements of all messages that were read."""
        return not self._sender.pending

    def read(self, reached_ns: float) -> None:
        """Read what was recorded up to a time, in nanoseconds. Raises UserError if the file was changed."""
        while self._next is not None and self._next.time_ns <= reached_ns and not self.full:
            message, self._next = self._next, next(self._messages, None)
            if message.of_client is self._as_agent:
                self._expect(message)
            else:
                self._send(message)

    def next_expected(self, where: Where) -> Part | None:
        """Return the answer that comes next on a stream; None: none was read."""
        parts = self._expected.get(where)
        return parts[0] if parts else None

    def drop(self, where: Where) -> None:
        """Do not expect the next answer of a stream any more."""
        parts = self._expected[where]
        parts.popleft()
        if not parts:
            del self._expected[where]
        self._waiting -= 1

    def outstanding(self) -> dict[Where, int]:
        """Return up to which answer of each stream, from 1, some that were read are still expected."""
        return {where: self._totals[where] for where in self._expected}

    def _expect(self, message: Message) -> None:
        taken = self._receiver.take(message.data, message.number)
        for part in taken.parts:
            if self._is_farewell(part):
                continue
            where = part.session, part.stream
            self._expected.setdefault(where, deque()).append(part)
            self._waiting += 1
            self._answers += 1
            self._totals[where] += 1
            self.last[where] = part.number
            if isinstance(part.content, CreateClient):
                self._sender.reset()
        for acknack in taken.acknacks:
            self._sender.take(acknack)

    def _is_farewell(self, part: Part) -> bool:
        """Take a part; return whether the recorded agent ended with it, unasked: the agent of the replay goes on."""
        reply = part.content
        of_client = isinstance(reply, StatusReply) and (reply.object, reply.status) == (OBJECT_CLIENT, 0)
        if not of_client:
            return False
        was_requested, self._leaves = self._leaves, False
        return not was_requested

    def _send(self, message: Message) -> None:
        if (message.data, self._answers) == self._before:  # sent again, without an answer
            return
        self._before = message.data, self._answers
        opens = opens_session(message.data) and not self._as_agent
        if opens:
            self._receiver.reset()
            self._sender.reset()
            self._leaves = False
        self._leaves = self._leaves or ends_session(message.data)
        if content(message.data):
            self.steps.append(Step(message, self.outstanding(), self.acknowledged, opens))
            self._sender.keep(Header.decode(message.data), message.data)


def content(data: bytes) -> list[bytes]:
    """Return the submessages of a message other than acknowledgements and heartbeats; a malformed one has none."""
    try:
        spans = split(data, header_size(data))
    except MalformedError:
        return []
    return [data[start - 4 : end] for identifier, _, start, end in spans if identifier not in _FLOW]


def ends_session(data: bytes) -> bool:
    """Return whether a message has a DELETE of the client."""
    client = OBJECT_CLIENT.to_bytes(2, "big")
    return any(part[0] == SubmessageId.DELETE and part[6:8] == client for part in content(data))
