# SPDX-License-Identifier: Apache-2.0
"""Processing of submessages of clients in session: now, in the client's next turn, or when ROS 2 has room."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Final

from microros_gen.agent.admission import Admission
from microros_gen.agent.clients import Client, ClientTable, Job
from microros_gen.agent.cutting import TurnOverError
from microros_gen.agent.fairness import Account
from microros_gen.agent.graph_work import GraphWork
from microros_gen.agent.limits import Limits
from microros_gen.agent.operations import Operations
from microros_gen.agent.ros.bridge import BridgeError, BusyError
from microros_gen.agent.services import ENCAPSULATION
from microros_gen.agent.session import Ready
from microros_gen.agent.turns import Turns
from microros_gen.agent.wire.constants import (
    DATA_FORMAT_MASK,
    FLAG_LAST_FRAGMENT,
    FLAG_LITTLE,
    STREAM_RELIABLE,
    ObjectKind,
    Status,
    SubmessageId,
)
from microros_gen.agent.wire.data_messages import DATA_PREFIX
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import SUBMESSAGE_HEADER, split
from microros_gen.agent.wire.submessages import decode

WRITE_DATA: Final = int(SubmessageId.WRITE_DATA)
ACKNACK: Final = int(SubmessageId.ACKNACK)
ACKNACK_HEAD: Final = bytes((ACKNACK, FLAG_LITTLE, 5, 0))
ACKNACK_BYTES: Final = 13
"""Size of a message that is one ACKNACK, with a header of 4 bytes."""
ACKNACK_BODY: Final = 5
FRAGMENT: Final = int(SubmessageId.FRAGMENT)
COSTLY: Final = (SubmessageId.CREATE, SubmessageId.DELETE)
"""Submessages that change the ROS graph, limited by a rate per client and a share of the agent's time for all."""
ANSWERED: Final = (SubmessageId.CREATE, SubmessageId.READ_DATA)
"""Submessages whose sender waits for a STATUS, also if they are refused or malformed."""
RETRY_S, LONGEST_RETRY_S = 0.002, 0.064
"""Seconds until a sample for which DDS had no room is retried: the first and the longest interval."""
Refuse = Callable[[Exception, bytes, Client], None]
"""Function that counts and reports an error in a client's message."""


class Processor:
    """Processor of ready input of clients; input that does not finish in its turn is postponed."""

    def __init__(
        self,
        clients: ClientTable,
        limits: Limits,
        operations: Operations,
        admission: Admission,
        turns: Turns,
        graph: GraphWork,
        refuse: Refuse,
    ) -> None:
        self._clients = clients
        self._limits = limits
        self._operations = operations
        self._admission = admission
        self._turns = turns
        self._graph = graph
        self._refuse = refuse
        self._clock = turns.clock
        self._to_acknowledge: set[Client] = set()
        self._stopped: set[Client] = set()
        """Clients with a reliable stream that waits for room in DDS."""
        self.samples = 0
        """Number of samples, requests and replies sent to ROS 2."""
        turns.messages = self._take_up

    def due(self) -> float | None:
        """Return the time at which `try_again` is due."""
        return min((client.retry_at for client in self._stopped), default=None) if self._stopped else None

    def flush(self) -> None:
        """Send the acknowledgements of what was received since the last call."""
        for client in self._to_acknowledge:
            client.acknowledge()
        self._to_acknowledge.clear()

    def note_arrival(self, client: Client, stream: int) -> None:
        """Record that a message arrived on a reliable stream and has to be acknowledged."""
        client.unacknowledged.add(stream)
        self._to_acknowledge.add(client)

    def _take_up(self, client: Client) -> None:
        """Continue postponed input; acknowledge processed messages."""
        if client.unacknowledged:
            self._to_acknowledge.add(client)
        self.process(client)

    def acknack(self, data: bytes, address: Hashable, now: float) -> Account | None:
        """Process a message of a client with nothing else to do that is one ACKNACK; return the account to charge.

        Return None for all other messages, of which nothing is done. A client sends an ACKNACK for each message that
        it receives: here it goes without the questions whose answers are known.
        """
        if len(data) != ACKNACK_BYTES or data[0] < 0x80 or data[1] or data[4:8] != ACKNACK_HEAD:
            return None
        client = self._clients.at(address)
        if client is None or data[0] != client.session.link.session or client.asleep or not client.claimed:
            return None
        account = client.account
        if (
            account.work is not None
            or now >= account.second
            or account.messages >= client.messages_per_second
        ):
            return None
        if client.ready or self._turns.waits(client):
            return None
        account.messages += 1
        client.received += 1
        client.received_bytes += ACKNACK_BYTES
        client.last_received = now
        self._acknowledged(client, data, ACKNACK_BYTES - ACKNACK_BODY, now)
        return account

    def process_alone(self, client: Client, data: bytes, start: int, stream: int) -> None:
        """Process one message of a client that has no other ready input."""
        try:
            at = start + SUBMESSAGE_HEADER
            if data[start:at] == ACKNACK_HEAD and len(data) == at + ACKNACK_BODY:
                self._acknowledged(client, data, at, self._clock())
                return
            self._process(client, data, start, stream, False, 0)
        except Exception as error:
            client.more = False
            self._refuse(error, data, client)
        if client.ready:
            if client.work or self._turns.over:
                self._turns.put_off(client)
            else:
                self.process(client)

    def _acknowledged(self, client: Client, data: bytes, at: int, now: float) -> None:
        """Process the body at `at` of an ACKNACK in little-endian order."""
        first, missing = data[at] | data[at + 1] << 8, data[at + 2] << 8 | data[at + 3]
        self._operations.acknowledged(client, data[at + 4], first, missing, now)

    def process(self, client: Client) -> None:
        """Process ready input of a client until its turn ends."""
        ready, turns = client.ready, self._turns
        while ready:
            message = ready.popleft()
            try:
                self._process(client, *message)
            except Exception as error:
                client.more = False
                self._refuse(error, message[0], client)
            if ready and (client.work or turns.over):
                turns.put_off(client)
                return

    def _process(self, client: Client, data: bytes, start: int, stream: int, whole: bool, done: int) -> None:
        client.stream = stream
        publish, turns = client.objects.publish, self._turns
        started = False
        for identifier, flags, at, end in split(data, start, whole):
            if started and turns.over:
                client.ready.appendleft((data, at - SUBMESSAGE_HEADER, stream, whole, 0))
                return
            started = True
            if identifier == WRITE_DATA:
                writer = publish.get(data[at + 2] << 8 | data[at + 3]) if end - at >= DATA_PREFIX else None
                try:
                    if writer is None or flags & DATA_FORMAT_MASK:
                        self.samples += self._operations.write(client, data, at, end, flags, done)
                        done = 0
                        continue
                    writer(ENCAPSULATION[flags & FLAG_LITTLE] + data[at + DATA_PREFIX : end])
                    self.samples += 1
                except BusyError as error:
                    self.samples += max(0, error.done - done)
                    if self._stop(client, (data, at - SUBMESSAGE_HEADER, stream, whole, error.done), error):
                        return
                    self._operations.not_written(client, error)
                except BridgeError as error:
                    self._operations.not_written(client, error)
                except TurnOverError as error:
                    self.samples += error.done - done
                    client.ready.appendleft((data, at - SUBMESSAGE_HEADER, stream, whole, error.done))
                    return
            elif identifier == ACKNACK and end - at == 5 and flags & FLAG_LITTLE:
                self._acknowledged(client, data, at, self._clock())
            elif identifier == FRAGMENT and not whole:
                joined = client.session.fragment(stream, data[at:end], bool(flags & FLAG_LAST_FRAGMENT))
                if joined is not None:
                    rest = (data, end + (-end & 3), stream, False, 0)
                    client.ready.extendleft((rest, (joined, 0, stream, True, 0)))
                    return
            elif identifier in COSTLY and not self._may_change(client, data, at, end):
                waits = BusyError("it creates and deletes faster than it may")
                if self._stop(
                    client, (data, at - SUBMESSAGE_HEADER, stream, whole, 0), waits, "operations_wait"
                ):
                    return
                self._refuse_costly(client, data, at, end)
            elif not self._operate(client, identifier, flags, data, at, end, whole):
                return

    def _operate(
        self, client: Client, identifier: int, flags: int, data: bytes, at: int, end: int, whole: bool
    ) -> bool:
        """Process a submessage other than a sample; return False if the rest of the message has to wait."""
        if identifier == SubmessageId.DELETE and _of_client(data, at, end):
            self._admission.leave(client, data, at)
            self._to_acknowledge.discard(client)
            client.ready.clear()
            return False
        if client.adopted and identifier in (SubmessageId.GET_INFO, SubmessageId.CREATE):
            self._admission.send_away(client)
            self._to_acknowledge.discard(client)
            client.ready.clear()
            return False
        if identifier == FRAGMENT:
            raise MalformedError("nested_fragment")
        if identifier == SubmessageId.INFO or (identifier == SubmessageId.CREATE_CLIENT and at == end):
            return (
                True  # a sign of life; the public client answers a probe without a submessage header: zeros
            )
        if identifier == SubmessageId.HEARTBEAT:
            self._to_acknowledge.add(client)
        now = self._clock()
        next_start = end + 3 & ~3
        client.more = not whole and next_start + SUBMESSAGE_HEADER <= len(data)
        try:
            submessage = decode(identifier, flags, data, at, end)
        except MalformedError:
            if identifier in ANSWERED and end - at >= DATA_PREFIX:
                self._operations.refuse(client, data, at, Status.INVALID_DATA, now)
            raise
        steps = self._operations.run(client, submessage, now)
        done = steps is None or self._turns.begin(client, Job(steps, adds=identifier == SubmessageId.CREATE))
        client.more = False
        if not done:
            client.ready.appendleft((data, next_start, client.stream, whole, 0))
            return False
        return True

    def _may_change(self, client: Client, data: bytes, at: int, end: int) -> bool:
        """Return whether a client may create or delete one more object now; it may always leave.

        Messages on a best-effort stream are not sent again, so such work is started, and then waits for its time.
        """
        now = self._clock()
        if _of_client(data, at, end):
            return True
        allowed = client.stream < STREAM_RELIABLE or self._graph.allows(client.account, now)
        return allowed and client.rate.take(now)

    def _refuse_costly(self, client: Client, data: bytes, at: int, end: int) -> None:
        if end - at >= DATA_PREFIX:
            self._operations.refuse(client, data, at, Status.RESOURCES, self._clock())
        detail = f"more than {self._limits.operations_per_second} CREATE and DELETE in a second"
        self._refuse(MalformedError("too_many_operations", detail), data, client)

    def _stop(self, client: Client, unfinished: Ready, error: BusyError, kind: str = "publish_waits") -> bool:
        """Keep unfinished input and what follows on its stream, unacknowledged; return False if it is lost."""
        stream = unfinished[2]
        followers_ready = [ready for ready in client.ready if ready[2] == stream]
        of_it = 1 if unfinished[3] else 0  # the rest of the message whose fragment completed it
        message, followers = (
            [unfinished, *followers_ready[:of_it]],
            [ready[0] for ready in followers_ready[of_it:]],
        )
        if stream < STREAM_RELIABLE or not client.session.stop(message, followers):
            return False
        others = [ready for ready in client.ready if ready[2] != stream]
        client.ready.clear()
        client.ready.extend(others)
        if client not in self._stopped:
            self._stopped.add(client)
            client.retry_s = RETRY_S
            client.retry_at = self._clock() + RETRY_S
            self._operations.waits(client, kind, error)
        return True

    def try_again(self, now: float) -> None:
        """Retry stopped streams: soon after each sample that DDS accepted, else at growing intervals."""
        self._turns.round([client for client in self._stopped if client.retry_at <= now], now, self._go_on)
        self.flush()

    def _go_on(self, client: Client) -> None:
        began = self._clock()
        known = self._clients.with_key(client.session.link.key) is client
        if known and client.asleep:
            client.retry_at = began + LONGEST_RETRY_S
            return
        samples = self.samples
        if known and client.session.stopped:
            client.ready.extend(client.session.go_on())
            client.unacknowledged.update(ready[2] for ready in client.ready)
            self._to_acknowledge.add(client)
            if not self._turns.waits(client):
                self.process(client)
        if not known or not client.session.stopped:
            self._stopped.discard(client)
            return
        elapsed = self._clock() - began
        client.retry_s = RETRY_S if self.samples > samples else min(2 * client.retry_s, LONGEST_RETRY_S)
        client.retry_at = began + elapsed + max(client.retry_s, 9 * elapsed if self.samples == samples else 0)


def _of_client(data: bytes, at: int, end: int) -> bool:
    """Return whether the ids at `data[at]` are those of a client itself."""
    return end - at >= DATA_PREFIX and data[at + 3] & 0x0F == ObjectKind.CLIENT
