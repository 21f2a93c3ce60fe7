# SPDX-License-Identifier: Apache-2.0
"""The agent without sockets and clock: processes messages, answers them and checks time-outs.

`receive` never raises, whatever the bytes: malformed input is counted, and reported once for each kind.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Container, Hashable
from functools import partial
from pathlib import Path
from typing import Final

from microros_gen.agent.admission import Admission, Held
from microros_gen.agent.budgets import Budgets
from microros_gen.agent.clients import Client, ClientTable
from microros_gen.agent.deliveries import Deliveries
from microros_gen.agent.fairness import Account, Fairness
from microros_gen.agent.graph_work import GraphWork
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.liveliness import Verdict, ask, is_well, judge, say_farewell
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.memory import MemoryGuard, Relief
from microros_gen.agent.newcomers import Answer
from microros_gen.agent.operations import Operations
from microros_gen.agent.own_time import LONG_S
from microros_gen.agent.policy.gatekeeper import Gatekeeper
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.processing import Processor
from microros_gen.agent.representation import References
from microros_gen.agent.ros.bridge import Bridge
from microros_gen.agent.states import ClientState, ClientStates
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.turns import Turns
from microros_gen.agent.wire.constants import STREAM_RELIABLE
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, is_cut

WORDS = {
    "no_session": "message from {peer} ignored: it is of a session that this agent does not know ({detail}),"
    " perhaps of the agent before this one; a client with liveliness notices that, and opens a session here",
    "client_resources": "message from {peer} ignored: {detail}",
}
"""Log texts for messages that are well-formed and not accepted."""
TICK_S: Final = 0.05
"""Seconds between two checks of time-outs while a client is connected."""


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
        fair: Fairness | None = None,
        strangers: Account | None = None,
        processor: Callable[[], float] | None = None,
        memory: MemoryGuard | None = None,
        budgets: Budgets | None = None,
        watched: bool = False,
        policy: Policy | None = None,
    ) -> None:
        """Use parts that may be shared with the transports; by default the agent has its own.

        `watched`: keep what `client_states` returns. `policy`: who may do what; None: everybody everything.

        `pool` is the budget of input, `fair` the order of clients, and `strangers` the account of senders without a
        session. `processor` returns the processor time of this thread in seconds.
        """
        self._bridge = bridge
        self._log = log
        self._limits = limits
        self._clock = clock
        self._ticked = clock()
        self.clients = ClientTable()
        held = Held(references or References(), preconfigured or Preconfigured(), manifests or Manifests())
        self._fair = fair = fair or Fairness(clock)
        self._round_begins = True
        self._graph = graph = GraphWork(limits.graph_ms_per_second)
        self._payer = self._strangers = strangers or Account()
        """The accounts of the current work and of messages outside of any session."""
        turn_s = limits.turn_ms / 1000
        self._turns = Turns(clock, turn_s, fair, graph, self._inner_fault, processor or time.thread_time)
        self._deliveries = Deliveries(log, self._inner_fault, fair, clock)
        pool = pool or InputPool(limits.input_bytes, limits.clients)
        budgets = budgets or Budgets(limits)
        gatekeeper = Gatekeeper(log, policy)
        self._admission = Admission(
            self.clients, bridge, log, limits, held, self._deliveries, pool, self._turns, budgets, gatekeeper
        )
        self._relief = Relief(memory, self.clients, budgets, self._admission.dismiss, log)
        self._operations = Operations(log, self._deliveries, self._turns)
        self._processor = Processor(
            self.clients, limits, self._operations, self._admission, self._turns, graph, self._refuse_of
        )

        self.on_care: Callable[[float], None] | None = None
        """Called by `care` with its time."""
        self._states: ClientStates | None = None
        if watched:
            self._states = ClientStates(self.clients, clock, limits.clients)
            self.clients.watch = self._states.note
            log.on_warning = self._states.fault
            gatekeeper.refused = self._states.refused

    def welcome(self, send: Answer) -> None:
        """Let `send` give the answer to each admitted newcomer whose address may be forged.

        That is one whose messages name no key. Those of the client that was at this address look the same, so this
        client must be gone before the newcomer has its answer.
        """
        self._admission.welcome = send

    def apply_policy(self, policy: Policy | None) -> None:
        """Replace the policy; clients that it does not allow are told so and removed. Never raises."""
        self._admission.gatekeeper.policy = policy
        for client in self.clients:
            self._guarded(partial(self._admission.review, client))

    def end_sessions(self, keys: Container[int], reason: str) -> None:
        """Tell the clients with these client keys that their sessions end, and remove them. Never raises."""
        for client in self.clients:
            if int.from_bytes(client.session.link.key, "big") in keys:
                self._guarded(partial(self._admission.expel, client, reason))

    def release_to_other(self, address: Hashable) -> None:
        """Remove the client at an address, where one of another worker is in session now. Never raises."""
        client = self.clients.at(address)
        if client is not None:
            self._guarded(partial(self._admission.dismiss, client, "replaced by another at its address"))

    def missing(self) -> frozenset[bytes]:
        """Return the keys of the clients to adopt (see `Preconfigured`) that are not in session."""
        return self._admission.missing()

    def client_states(self) -> tuple[ClientState, ...]:
        """Return the view of all clients, also of those that have left; empty unless the agent is `watched`."""
        return self._states.snapshot() if self._states is not None else ()

    def latest_client_states(self) -> tuple[ClientState, ...]:
        """Return what `client_states` returned at one of the last calls of `care`; may be called in any thread.

        The next call of `care` updates it.
        """
        return self._states.ask() if self._states is not None else ()

    @property
    def samples(self) -> int:
        """Return how many samples, requests and replies were passed to ROS 2."""
        return self._processor.samples

    @property
    def delivered(self) -> int:
        """Return how many samples, requests and replies were sent to clients."""
        return self._deliveries.delivered

    def fileno(self) -> int:
        """Return the descriptor that is readable when ROS 2 has data for `take`."""
        return self._bridge.fileno()

    def due(self) -> float | None:
        """Return the time (of the agent's clock) at which `tick` is due; None: not before the next message or data."""
        moments = [self._deliveries.due(), self._turns.due(), self._processor.due()]
        if len(self.clients):
            moments.append(self._ticked + TICK_S)
        return min((time for time in moments if time is not None), default=None)

    def take(self) -> None:
        """Deliver what ROS 2 has for the clients. Never raises."""
        try:
            self._begin(self._clock())
            self._deliveries.ready(self._bridge.ready(), self._clock())
        except Exception as error:
            self._fault(error, b"")

    def receive(self, data: bytes, address: Hashable, transport: Transport) -> None:
        """Process one message; acknowledgements wait for `flush`. Never raises."""
        began = self._clock()
        if self._round_begins:
            self._begin(began)
        self._payer = self._strangers
        try:
            acknowledges = self._processor.acknack(data, address, began)
            if acknowledges is not None:
                self._payer = acknowledges
            else:
                self._receive(data, address, transport, began)
        except Exception as error:
            self._refuse(error, data, address, transport)
        now = self._clock()
        spent = now - began
        self._payer.bill(spent if spent < LONG_S else self._fair.own(spent), now)

    def flush(self) -> None:
        """Send the acknowledgements of what was received since the last call, and what these messages made room for."""
        self._guarded(self._deliveries.use_room)
        self._processor.flush()
        self._round_begins = True

    def _begin(self, now: float) -> None:
        """Begin a round of the main loop, if this is its first work."""
        if self._round_begins:
            self._round_begins = False
            self._fair.begin(now)

    def tick(self) -> None:
        """Send due messages and check time-outs. Never raises.

        To be called at the time that `due` returns, or some ten times a second.
        """
        now = self._clock()
        self._begin(now)
        self._guarded(partial(self._deliveries.run, now))
        self._guarded(partial(self._turns.run, now))
        self._guarded(partial(self._processor.try_again, now))
        if now >= self._ticked + TICK_S:
            self._ticked = now
            patience_s = self._patience_s()
            for client in self.clients:
                # With a thousand clients this loop takes a part of the agent's time: most of them need nothing.
                if client.asleep or not is_well(client, now, patience_s) or client.session.asks(now):
                    self._guarded(partial(self._look_after, client, now))

    def care(self, now: float) -> None:
        """Check the memory of the process; to be called some ten times a second. Never raises."""
        self._guarded(partial(self._relief.look, now))
        if self._states is not None:
            self._guarded(partial(self._states.look, now))
        if self.on_care is not None:
            self._guarded(partial(self.on_care, now))

    def _look_after(self, client: Client, now: float) -> None:
        waits = self._turns.waits(client)
        if waits and client.asleep:
            return
        silent = now - client.last_received
        self._turns.start(self._clock())
        if client.asleep:
            if silent > self._limits.sleep_timeout_s:
                self._admission.dismiss(client, "forgotten: it remained silent")
            elif client.kept and silent > self._limits.keep_s:
                client.kept = False
                self._admission.keeping.forget_old(client, now)
            return
        for message in client.session.heartbeats(now):
            client.send(message)
        if waits:
            return
        verdict = judge(client, now, self._patience_s())
        if verdict is Verdict.GONE:
            if self._graph.allows(client.account, now):
                self._admission.put_to_sleep(client)
        elif verdict is Verdict.ASK:
            ask(client, now)

    def _patience_s(self) -> float:
        """Return the seconds of silence after which a client is probed: fewer if few places are free."""
        return self._limits.client_timeout_s if len(self.clients) >= self._limits.clients else float("inf")

    def close(self) -> None:
        """Remove all clients and their entities from the ROS graph. Never raises.

        Before that, pending samples are published, and readers have at most `stop_s` seconds to acknowledge them: the
        clients were told that they arrived, and DDS drops undelivered samples together with their writer.
        A client that has another agent learns that it may go there: nothing more is taken from it here.
        """
        self._guarded(partial(self._settle, self._clock() + self._limits.stop_s))
        for client in self.clients:
            self._guarded(partial(self._admission.dismiss, client, "dropped: the agent stops"))
        self._guarded(self._turns.finish)
        self._guarded(self._bridge.close)

    def _settle(self, end: float) -> None:
        self._turns.drain(end)
        self.flush()
        for client in self.clients:
            self._guarded(partial(say_farewell, client))
            client.transport.flush()
        late = sum(
            not writer.settled(max(0.0, end - self._clock()))
            for client in self.clients
            for entity in client.objects
            if (writer := entity.writer) is not None
        )
        if late:
            text = "{writers} publishers end before all of their readers have acknowledged the last samples"
            self._log.emit(Level.WARNING, "stopped_early", text, writers=late)

    def _guarded(self, do: Callable[[], None]) -> None:
        """Work for one client; a fault in it does not affect the others."""
        try:
            do()
        except Exception as error:
            self._fault(error, b"")

    def _receive(self, data: bytes, address: Hashable, transport: Transport, now: float) -> None:
        start = header_size(data)
        session_id = data[0]
        client = self.clients.at(address) if start == 4 else self.clients.with_key(data[4:8])
        self._turns.start(now)
        elsewhere = start == 8 and client is not None and client.address != address
        restarted = elsewhere and self._admission.newcomers.knows(Header.decode(data), address)
        if client is None or restarted or session_id != client.session.link.session:
            client = self._admission.handle_outside_session(data, start, client, address, transport, now)
            if client is None:
                return
        elif elsewhere:
            self._admission.check_move(client, transport, address)
        self._payer = account = client.account
        client.received += 1
        client.received_bytes += len(data)
        if account.work is not None and not account.work.allows(now):
            account.dropped = True
            if not client.asleep:
                client.last_received = now  # it is there, although nothing is done for it
            raise MalformedError("too_much_work", "the policy allows no more time for it in this second")
        if now >= account.second:
            account.second, account.messages = now + 1.0, 0
        account.messages += 1
        if account.messages > client.messages_per_second:
            raise MalformedError("too_many_messages", f"more than {client.messages_per_second} in a second")
        client.last_received = now
        if start == 8 and client.address != address:
            self._admission.move(client, transport, address, now)
        if not client.claimed:
            client.claimed = True
            transport.claim(address, client.account)
        if client.asleep:
            self._admission.wake(client)
        stream = data[1]
        if stream >= STREAM_RELIABLE and is_cut(data, start):
            raise MalformedError("cut_message", f"{len(data)} bytes are not the whole message")
        waits = self._turns.waits(client)
        if waits and not self._turns.takes(client, len(data)):
            raise MalformedError("turn_full", "more than the client's next turns have room for")
        messages = client.session.incoming(stream, data[2] | data[3] << 8, data)
        if stream >= STREAM_RELIABLE:
            self._processor.note_arrival(client, stream)
        if len(messages) == 1 and not waits and not client.ready:
            self._processor.process_alone(client, messages[0], start, stream)
            return
        client.ready.extend((message, start, stream, False, 0) for message in messages)
        if not waits:
            self._processor.process(client)

    def _refuse_of(self, error: Exception, data: bytes, client: Client) -> None:
        self._refuse(error, data, client.address, client.transport)

    def _refuse(self, error: Exception, data: bytes, address: Hashable, transport: Transport) -> None:
        if isinstance(error, MalformedError):
            self._payer.refused = self._payer is not self._strangers
            if self._states is not None and (client := self.clients.at(address)) is not None:
                self._states.fault(client.name, error.detail or error.kind)
            self._log.count(
                error.kind,
                WORDS.get(error.kind, "malformed message from {peer} ignored: {detail}"),
                peer=transport.name_of(address),
                detail=error.detail or error.kind,
            )
            return
        self._fault(error, data)

    def _inner_fault(self, error: Exception) -> None:
        self._fault(error, b"")

    def _fault(self, error: Exception, data: bytes) -> None:
        """Report a defect of this program without ending the service of other clients."""
        self._log.count(
            f"internal_{type(error).__name__}",
            "internal error: {error} at {place}; please report it with the message {data}",
            error=repr(error),
            place=_place(error),
            data=data[:256].hex(),
        )


def _place(error: Exception) -> str:
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{Path(last.filename).name}:{last.lineno}"
