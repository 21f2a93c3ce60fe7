# SPDX-License-Identifier: Apache-2.0
"""The agent without sockets and without a clock of its own: takes messages, answers them, watches time-outs.

`receive` never raises, whatever the bytes: what is malformed is counted, and told once per kind.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Hashable
from functools import partial
from pathlib import Path

from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.deliveries import Deliveries
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.limits import PROBES, Limits
from microros_gen.agent.lobby import Held, Lobby
from microros_gen.agent.log import EventLog
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.operations import Operations
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import References
from microros_gen.agent.ros.bridge import Bridge, BridgeError, BusyError
from microros_gen.agent.services import ENCAPSULATION
from microros_gen.agent.session import Ready
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.wire.constants import (
    DATA_FORMAT_MASK,
    FLAG_LITTLE,
    STREAM_RELIABLE,
    ObjectKind,
    Status,
    SubmessageId,
)
from microros_gen.agent.wire.data_messages import DATA_PREFIX
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import SUBMESSAGE_HEADER, header_size, is_cut, split
from microros_gen.agent.wire.submessages import decode

WRITE_DATA = int(SubmessageId.WRITE_DATA)
ACKNACK = int(SubmessageId.ACKNACK)
COSTLY = (SubmessageId.CREATE, SubmessageId.DELETE)
"""What changes the ROS graph: each client has a rate for it."""
ANSWERED = (SubmessageId.CREATE, SubmessageId.READ_DATA)
"""Whoever sends these waits for a STATUS when they are refused, also for what cannot be read."""
RETRY_S, LONGEST_RETRY_S = 0.002, 0.064
"""Seconds until a sample for which DDS had no room is tried again: at first, and at last."""
TICK_S = 0.05
"""Seconds between two looks at time-outs while there are clients."""


class Agent:
    """Serves the clients of any number of transports with one bridge to ROS 2."""

    def __init__(
        self,
        bridge: Bridge,
        log: EventLog,
        limits: Limits,
        references: References | None = None,
        preconfigured: Preconfigured | None = None,
        clock: Callable[[], float] = time.monotonic,
        manifests: Manifests | None = None,
        pool: InputPool | None = None,
    ) -> None:
        """`pool` is shared with the transports that hold input too; default: one for the clients alone."""
        self._bridge = bridge
        self._log = log
        self._limits = limits
        self._clock = clock
        self._to_acknowledge: set[Client] = set()
        self._stopped: set[Client] = set()
        """Clients with a reliable stream that waits for room in DDS."""
        self._ticked = clock()
        self.clients = ClientTable()
        held = Held(references or References(), preconfigured or Preconfigured(), manifests or Manifests())
        self._deliveries = Deliveries(log, lambda error: self._fault(error, b""))
        pool = pool or InputPool(limits.input_bytes, limits.clients)
        self._lobby = Lobby(self.clients, bridge, log, limits, held, self._deliveries, pool)
        self._operations = Operations(log, self._deliveries)
        self.samples = 0
        """Samples, requests and replies that were handed to ROS 2."""

    @property
    def delivered(self) -> int:
        """Return how many samples, requests and replies went to clients."""
        return self._deliveries.delivered

    def fileno(self) -> int:
        """Return the descriptor that is readable when ROS 2 has something: then `take` is due."""
        return self._bridge.fileno()

    def due(self) -> float | None:
        """Return the moment (of the clock) at which `tick` is due; None: not before a message or data come."""
        later = self._deliveries.due()
        if self._stopped:
            again = min(client.retry_at for client in self._stopped)
            later = again if later is None else min(again, later)
        if not len(self.clients):
            return later
        tick = self._ticked + TICK_S
        return tick if later is None else min(tick, later)

    def take(self) -> None:
        """Hand on what ROS 2 has for the clients. Never raises."""
        try:
            self._deliveries.ready(self._bridge.ready(), self._clock())
        except Exception as error:
            self._fault(error, b"")

    def receive(self, data: bytes, address: Hashable, transport: Transport) -> None:
        """Take one message. Acknowledgements wait for `flush`."""
        try:
            self._receive(data, address, transport)
        except Exception as error:
            self._refuse(error, data, address, transport)

    def flush(self) -> None:
        """Send the acknowledgements of what was received since the last call."""
        for client in self._to_acknowledge:
            client.acknowledge()
        self._to_acknowledge.clear()

    def tick(self) -> None:
        """Send what is due and look for time-outs; to be called when `due` says, or some ten times a second.

        Never raises.
        """
        now = self._clock()
        self._guarded(partial(self._deliveries.run, now))
        if self._stopped:
            self._guarded(partial(self._try_again, now))
        if now >= self._ticked + TICK_S:
            self._ticked = now
            for client in self.clients:
                self._guarded(partial(self._look_after, client, now))

    def _look_after(self, client: Client, now: float) -> None:
        silent = now - client.heard
        if client.asleep:
            if silent > self._limits.sleep_timeout_s:
                self._lobby.dismiss(client, "forgotten: it was not heard any more")
            return
        for message in client.session.heartbeats(now):
            client.send(message)
        if silent > client.timeout_s:
            self._lobby.put_to_sleep(client)
        elif silent > client.timeout_s / 2 and now - client.probed > client.timeout_s / (2 * PROBES):
            client.probed = now
            client.send(client.session.probe())

    def close(self) -> None:
        """Take all clients and their entities out of the ROS graph. Never raises."""
        for client in self.clients:
            self._guarded(partial(self._lobby.dismiss, client, "dropped: the agent stops"))
        self._guarded(self._bridge.close)

    def _guarded(self, do: Callable[[], None]) -> None:
        """Do something for one client; a fault in it is not the others' concern."""
        try:
            do()
        except Exception as error:
            self._fault(error, b"")

    def _receive(self, data: bytes, address: Hashable, transport: Transport) -> None:
        start = header_size(data)
        session_id = data[0]
        client = self.clients.at(address) if start == 4 else self.clients.with_key(data[4:8])
        if client is None or session_id != client.session.link.session:
            client = self._lobby.visit(data, start, client, address, transport, self._clock())
            if client is None:
                return
        now = self._clock()
        if now >= client.second:
            client.second, client.messages = now + 1.0, 0
        client.messages += 1
        if client.messages > self._limits.messages_per_second:
            raise MalformedError(
                "too_many_messages", f"more than {self._limits.messages_per_second} in a second"
            )
        client.heard = now
        if start == 8 and client.address != address:
            self._lobby.move(client, transport, address, now)
        if client.asleep:
            self._lobby.wake(client, now)
        stream = data[1]
        if stream >= STREAM_RELIABLE and is_cut(data, start):
            raise MalformedError("cut_message", f"{len(data)} bytes are not the whole message")
        for message in client.session.incoming(stream, data[2] | data[3] << 8, data):
            client.ready.append((message, start, stream, False, 0))
        if stream >= STREAM_RELIABLE:
            client.unacknowledged.add(stream)
            self._to_acknowledge.add(client)
        self._process_ready(client)

    def _process_ready(self, client: Client) -> None:
        ready = client.ready
        while ready:
            message = ready.popleft()
            try:
                self._process(client, *message)
            except Exception as error:
                client.more = False
                self._refuse(error, message[0], client.address, client.transport)

    def _process(self, client: Client, data: bytes, start: int, stream: int, whole: bool, done: int) -> None:
        client.stream = stream
        publish = client.objects.publish
        for identifier, flags, at, end in split(data, start, whole):
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
            elif identifier == ACKNACK and end - at == 5 and flags & FLAG_LITTLE:
                first, missing = data[at] | data[at + 1] << 8, data[at + 2] << 8 | data[at + 3]
                self._operations.acknowledged(client, data[at + 4], first, missing, self._clock())
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
        """Carry out a submessage that is no sample; False: the rest of the message is not to be processed now."""
        if identifier == SubmessageId.DELETE and _of_client(data, at, end):
            self._lobby.leave(client, data, at)
            self._to_acknowledge.discard(client)
            client.ready.clear()
            return False
        if client.adopted and identifier in (SubmessageId.GET_INFO, SubmessageId.CREATE):
            self._lobby.send_away(client)
            self._to_acknowledge.discard(client)
            client.ready.clear()
            return False
        if identifier == SubmessageId.FRAGMENT and whole:
            raise MalformedError("nested_fragment")
        if identifier == SubmessageId.INFO or (identifier == SubmessageId.CREATE_CLIENT and at == end):
            return True  # a sign of life; the public client's answer to a probe lacks its submessage header: zeros
        if identifier == SubmessageId.HEARTBEAT:
            self._to_acknowledge.add(client)
        now = self._clock()
        behind = end + 3 & ~3
        client.more = not whole and behind + SUBMESSAGE_HEADER <= len(data)
        try:
            submessage = decode(identifier, flags, data, at, end)
        except MalformedError:
            if identifier in ANSWERED and end - at >= DATA_PREFIX:
                self._operations.refuse(client, data, at, Status.INVALID_DATA, now)
            raise
        self._operations.run(client, submessage, now)
        client.more = False
        if client.whole is None:
            return True
        client.ready.extendleft(
            ((data, behind, client.stream, False, 0), (client.whole, 0, client.stream, True, 0))
        )
        client.whole = None
        return False

    def _may_change(self, client: Client, data: bytes, at: int, end: int) -> bool:
        """Return whether a client may create or delete one more object now; it may always leave."""
        return client.rate.take(self._clock()) or _of_client(data, at, end)

    def _refuse_costly(self, client: Client, data: bytes, at: int, end: int) -> None:
        if end - at >= DATA_PREFIX:
            self._operations.refuse(client, data, at, Status.RESOURCES, self._clock())
        detail = f"more than {self._limits.operations_per_second} CREATE and DELETE in a second"
        self._refuse(MalformedError("too_many_operations", detail), data, client.address, client.transport)

    def _stop(self, client: Client, unfinished: Ready, error: BusyError, kind: str = "publish_waits") -> bool:
        """Keep what cannot be done now, and what follows on its stream, unacknowledged; False where it is lost."""
        stream = unfinished[2]
        behind = [ready for ready in client.ready if ready[2] == stream]
        of_it = 1 if unfinished[3] else 0  # the rest of the message whose fragment completed it
        message, followers = [unfinished, *behind[:of_it]], [ready[0] for ready in behind[of_it:]]
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

    def _try_again(self, now: float) -> None:
        """Go on with streams that stopped: soon after each sample that DDS took, else at growing intervals."""
        for client in [client for client in self._stopped if client.retry_at <= now]:
            known = self.clients.with_key(client.session.link.key) is client
            if known and client.asleep:
                client.retry_at = now + LONGEST_RETRY_S
                continue
            samples, began = self.samples, self._clock()
            if known and client.session.stopped:
                client.ready.extend(client.session.go_on())
                client.unacknowledged.update(ready[2] for ready in client.ready)
                self._to_acknowledge.add(client)
                self._process_ready(client)
            if not known or not client.session.stopped:
                self._stopped.discard(client)
                continue
            took = self._clock() - began
            client.retry_s = RETRY_S if self.samples > samples else min(2 * client.retry_s, LONGEST_RETRY_S)
            client.retry_at = now + took + max(client.retry_s, 9 * took if self.samples == samples else 0)
        self.flush()

    def _refuse(self, error: Exception, data: bytes, address: Hashable, transport: Transport) -> None:
        if isinstance(error, MalformedError):
            self._log.count(
                error.kind,
                "malformed message from {peer} ignored: {detail}",
                peer=transport.name_of(address),
                detail=error.detail or error.kind,
            )
            return
        self._fault(error, data)

    def _fault(self, error: Exception, data: bytes) -> None:
        """Tell of a fault of this program: it must not end the service of other clients."""
        self._log.count(
            f"internal_{type(error).__name__}",
            "internal error: {error} at {place}; please report it with the message {data}",
            error=repr(error),
            place=_place(error),
            data=data[:256].hex(),
        )


def _of_client(data: bytes, at: int, end: int) -> bool:
    """Return whether the ids at `data[at]` are those of a client itself."""
    return end - at >= DATA_PREFIX and data[at + 3] & 0x0F == ObjectKind.CLIENT


def _place(error: Exception) -> str:
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{Path(last.filename).name}:{last.lineno}"
