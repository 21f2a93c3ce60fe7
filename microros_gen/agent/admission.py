# SPDX-License-Identifier: Apache-2.0
"""How clients connect and disconnect: CREATE_CLIENT, messages without a session, sleep, waking and leaving."""

from __future__ import annotations

from collections.abc import Hashable

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.client_factory import ClientFactory
from microros_gen.agent.clients import Client, ClientTable, Job
from microros_gen.agent.deliveries import Deliveries
from microros_gen.agent.input_pool import InputPool
from microros_gen.agent.keeping import Keeping
from microros_gen.agent.key_conflicts import KeyConflicts
from microros_gen.agent.limits import Limits
from microros_gen.agent.liveliness import say_farewell
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.newcomers import Answer, Newcomer, Newcomers, Strangers, answer, check, timeout_of
from microros_gen.agent.operations import agent_info, report_outcome
from microros_gen.agent.places import Places
from microros_gen.agent.policy.access import Access
from microros_gen.agent.policy.gatekeeper import Gatekeeper
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import References
from microros_gen.agent.ros.bridge import Bridge
from microros_gen.agent.steps import Steps
from microros_gen.agent.streams_out import Link
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.turns import Turns
from microros_gen.agent.wire.constants import (
    SESSION_NONE_WITH_KEY,
    SESSION_NONE_WITHOUT_KEY,
    STREAM_NONE,
    ObjectKind,
    Status,
    is_reliable,
)
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Delete, Heartbeat, StatusReply
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, split
from microros_gen.agent.wire.session_messages import CreateClient, GetInfo, StatusAgent
from microros_gen.agent.wire.submessages import decode, encode
from microros_gen.records import dataclass

OUT_OF_SESSION = (SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY)
LOOK_AGAIN_S = 0.1
"""Seconds until the agent again looks for a client to remove, after it found no candidate."""


@dataclass(frozen=True)
class Held:
    """The contents of the agent's files: references, preconfigured objects, and types of clients."""

    references: References
    preconfigured: Preconfigured
    manifests: Manifests


class Admission:
    """Admits and removes clients; keeps the client table."""

    def __init__(
        self,
        clients: ClientTable,
        bridge: Bridge,
        log: EventLog,
        limits: Limits,
        held: Held,
        deliveries: Deliveries,
        pool: InputPool,
        turns: Turns,
        budgets: Budgets,
        gatekeeper: Gatekeeper,
    ) -> None:
        self.gatekeeper = gatekeeper
        self._clients = clients
        self._turns = turns
        self._log = log
        self._limits = limits
        self._held = held
        self._factory = ClientFactory(
            bridge, log, limits, held.references, held.manifests, pool, budgets, turns
        )
        self._deliveries = deliveries
        self.keeping = Keeping(limits.keep_s, deliveries, log)
        self._conflicts = KeyConflicts(log, limits.clients)
        self.newcomers = Newcomers(limits.newcomers)
        self._full_until = 0.0
        self._strangers = Strangers(limits.adopt_after_s, limits.clients, limits.strangers_per_second)
        self._places = Places(clients, limits, budgets, self.dismiss)
        self.welcome: Answer = answer

    def handle_outside_session(
        self,
        data: bytes,
        start: int,
        client: Client | None,
        address: Hashable,
        transport: Transport,
        now: float,
    ) -> Client | None:
        """Answer a message outside of any session: CREATE_CLIENT, GET_INFO, or DELETE of a client that has left.

        `client` is the known client of this address. All other messages are counted and not answered, except two: the
        message of a client that is to be adopted, and the first message of a newcomer. Their client is returned, for
        the caller to process the message.
        """
        header = Header.decode(data)
        if (newcomer := self.newcomers.proved(header, address)) is not None:
            return self._let_in(newcomer, now)
        if client is None:
            self._strangers.count(now)
        elif not client.rate.take(now):
            raise MalformedError("too_many_operations", "a client says too much outside of its session")
        # A message without a session may be from another client: systems reuse UDP ports.
        left = client is None and header.session not in OUT_OF_SESSION
        key = self._conflicts.observe(transport, address, now) if left else None
        holder = self._clients.with_key(key) if key else None
        if holder is not None:
            self._conflicts.fight(holder, transport, address)
        for identifier, flags, at, end in split(data, start)[:1]:
            submessage = decode(identifier, flags, data, at, end)
            if isinstance(submessage, WriteData | Heartbeat) and client is None:
                return self._adopt(header, submessage, address, transport, now)
            self._strangers.forget(transport, address)  # it opens its session again by itself
            if isinstance(submessage, GetInfo):
                known = header.session in OUT_OF_SESSION and bool(client or self.newcomers.at(address))
                if client is not None and known:
                    client.last_received = now
                answer = agent_info(submessage, known)
                transport.send(header.encode() + encode(answer), address)
            elif isinstance(submessage, CreateClient) and header.session in OUT_OF_SESSION:
                self._enter(header, submessage, address, transport, now)
            elif isinstance(submessage, Delete) and submessage.object & 0x0F == ObjectKind.CLIENT:
                status = StatusReply(submessage.request, submessage.object, Status.OK)
                transport.send(header.encode() + encode(status), address)
            else:
                raise MalformedError("no_session", f"{submessage.ID.name} without a session")
        return None

    def move(self, client: Client, transport: Transport, address: Hashable, now: float) -> None:
        """Register that `client` now sends from another address."""
        before = client.place
        self._conflicts.moved(client, transport, address, now)
        client.transport.release(client.address, moved=True)
        client.claimed = False
        evicted = self._clients.move(client, transport, address)
        if evicted is not None:
            self.dismiss(evicted, "dropped: another client uses its address")
        self._log.emit(
            Level.INFO,
            "moved",
            "client {client} moved from {before} to {peer}",
            client=client.name,
            before=before,
            peer=client.place,
        )

    def check_move(self, client: Client, transport: Transport, address: Hashable) -> None:
        """Raise MalformedError if the policy does not let `client` continue its session at another address."""
        if not self.gatekeeper.may_move(client.session.link.key, client.access, transport, address):
            text = f"client {client.name} may not continue its session there"
            raise MalformedError("move_denied", text)

    def leave(self, client: Client, data: bytes, at: int) -> None:
        """Remove `client` on its own DELETE, whose payload begins at `data[at]`, and answer it."""
        request = data[at] << 8 | data[at + 1]
        answer = client.session.unnumbered(StatusReply(request, data[at + 2] << 8 | data[at + 3], Status.OK))
        self.dismiss(client, "left")
        client.send(answer)

    def dismiss(self, client: Client, why: str) -> None:
        """Remove a client; its entities leave the ROS graph as fast as the rate limit of changes allows."""
        self._clients.remove(client)
        client.transport.release(client.address)
        self._deliveries.forget(client)
        client.ready.clear()
        client.work.clear()
        self._turns.begin(client, Job(client.objects.clearing(), adds=False))
        client.session.reset()  # release the contents of its streams, even if the client is still referenced
        self._report(client, "client_gone", "client {client} " + why)

    def send_away(self, client: Client) -> None:
        """Remove an adopted client that turned out to be a different one; it is not adopted again."""
        self._held.preconfigured.never_adopt(client.session.link.key)
        why = "it is not the client that its samples suggested; it is not adopted again"
        self.dismiss(client, f"disconnected: {why}")

    def put_to_sleep(self, client: Client) -> None:
        """Remove the entities of a silent client from the ROS graph; its session stays."""
        client.asleep = client.kept = True
        self.keeping.before_sleep(client)
        client.calls.report_unanswered(client.objects)
        self._turns.begin(client, Job(client.objects.suspending(), adds=False))
        for _ in range(client.session.rest()):
            text = "client {client} stopped within a fragmented message, which is lost"
            self._log.count("unfinished", text, client=client.name)
        self._deliveries.refresh(client, client.last_received)
        text = "client {client} was silent for {seconds} s: its entities left the ROS graph"
        self._report(client, "client_silent", text, seconds=client.timeout_s)

    def wake(self, client: Client) -> bool:
        """Restore the entities of a client that sends again; return whether all are in the ROS graph."""
        client.asleep = False
        return self._turns.begin(client, Job(self._waking(client), adds=True))

    def _waking(self, client: Client) -> Steps[None]:
        failed = yield from client.objects.resuming()
        self._deliveries.refresh(client, self._turns.clock())
        self._report(client, "client_back", "client {client} sent a message again: its entities are back")
        for entity, reason in failed:
            text = "client {client}: object {object} could not be created again: {reason}"
            self._report(client, "client_back_without", text, object=f"{entity.id:#06x}", reason=reason)

    def _enter(
        self, header: Header, wanted: CreateClient, address: Hashable, transport: Transport, now: float
    ) -> None:
        key = wanted.key if wanted.session < SESSION_NONE_WITHOUT_KEY else b""
        status = check(wanted, self._limits.minimum_mtu)
        send: Answer = answer
        holder = self._clients.with_key(wanted.key)
        if status is Status.OK and self.gatekeeper.decide(wanted.key, transport, address, holder) is None:
            status = Status.DENIED
        elif status is Status.OK:
            link = Link(wanted.session, wanted.key, wanted.mtu)
            newcomer = Newcomer(link, timeout_of(wanted, self._limits.client_timeout_s), address, transport)
            if self._is_known(newcomer):
                status = self._admit(newcomer, now)
            elif (status := self._note(newcomer, now)) is Status.OK and not key:
                send = self.welcome
        head = Header(wanted.session, STREAM_NONE, 0, key)
        send(head.encode() + encode(StatusAgent(status)), address, transport)
        if status not in (Status.OK, Status.DENIED):
            self._log.count(
                f"client_{status.name.lower()}",
                "a client at {peer} was refused: {status}",
                peer=transport.name_of(address),
                status=status.name,
            )

    def _is_known(self, newcomer: Newcomer) -> bool:
        """Return whether the address of a newcomer is genuine: a connection, or that of a client in session."""
        return not newcomer.transport.forgeable or self._clients.at(newcomer.address) is not None

    def _note(self, newcomer: Newcomer, now: float) -> Status:
        """Record a sender whose address may be forged, if a place for its session is available."""
        known = self._clients.with_key(newcomer.link.key) is not None
        if not known and now >= self._full_until and not self._places.has_room(now):
            self._full_until = now + LOOK_AGAIN_S
        if not known and now < self._full_until:
            return Status.RESOURCES
        self.newcomers.note(newcomer)
        return Status.OK

    def _let_in(self, newcomer: Newcomer, now: float) -> Client:
        """Open the session of a newcomer, which sent its first message in it; return the client."""
        status = self._admit(newcomer, now)
        if status is not Status.OK:
            why = "refused by now" if status is Status.DENIED else "its place is taken by now"
            raise MalformedError(f"client_{status.name.lower()}", why)
        client = self._clients.at(newcomer.address)
        assert client is not None
        return client

    def _admit(self, newcomer: Newcomer, now: float) -> Status:
        link, address, transport = newcomer.link, newcomer.address, newcomer.transport
        self.newcomers.forget(address)
        client, heritage = self._clients.with_key(link.key), {}
        access = self.gatekeeper.decide(link.key, transport, address, client)
        if access is None:  # the policy, or who has its key, has changed
            return Status.DENIED
        neighbor = self._clients.at(address)
        if neighbor is not None and neighbor.session.link.key != link.key:
            self.dismiss(neighbor, "replaced by another at its address")
        same = client is not None and client.session.link.session == link.session
        if client is not None and same and self._factory.fits(client, access):
            self._welcome_back(client, link, address, transport, now)
            return Status.OK
        if client is not None:
            if client.address != address:
                self._conflicts.moved(client, transport, address, now)
            heritage = self.keeping.heritage(client, now)
            why = "another rule of the policy is for it now" if same else "it came with another session id"
            self.dismiss(client, f"replaced: {why}")
        new = self._add(link, address, transport, newcomer.timeout_s, now, access)
        if new is None:
            return Status.RESOURCES
        new.objects.inherit(heritage)
        text = "client {client} connected from {peer} (session {session}, MTU {mtu})"
        self._report(
            new, "client_connected", text, peer=new.place, session=f"{link.session:#04x}", mtu=link.mtu
        )
        if client is not None and client.work:  # its old entities leave the ROS graph first
            self._turns.begin(new, client.work[0])
        self._give(new)
        return Status.OK

    def _add(
        self,
        link: Link,
        address: Hashable,
        transport: Transport,
        timeout_s: float,
        now: float,
        access: Access,
    ) -> Client | None:
        if not self._places.make_room(now):
            return None
        new = self._factory.make(link, address, transport, timeout_s, now, access)
        self._clients.add(new)
        return new

    def review(self, client: Client) -> None:
        """Apply a new policy to a client in session: it stays, or is told that its session ends."""
        try:
            access, reason = self.gatekeeper.review(client)
        except Exception:
            self.dismiss(client, "disconnected: the new policy could not be applied to it")
            raise
        if reason:
            self.expel(client, f"disconnected by the new policy: {reason}")
            return
        client.access.rule = access.rule
        self._factory.limit(client)

    def expel(self, client: Client, reason: str) -> None:
        """Tell a client that its session ends, and remove it."""
        say_farewell(client, Status.DENIED)
        self.dismiss(client, reason)

    def _give(self, client: Client) -> None:
        """Create the preconfigured objects of a client; existing ones stay."""
        if self._held.preconfigured.objects(client.session.link.key):
            self._turns.begin(client, Job(self._giving(client), adds=True))

    def _giving(self, client: Client) -> Steps[None]:
        for item in self._held.preconfigured.objects(client.session.link.key):
            outcome = yield from client.objects.giving(item.id, item.parent, item.description)
            report_outcome(self._log, client, item.id, outcome)
            yield

    def _adopt(
        self,
        header: Header,
        submessage: WriteData | Heartbeat,
        address: Hashable,
        transport: Transport,
        now: float,
    ) -> Client | None:
        """Return the client that sent a message without a session (see `preconfigured`), or raise MalformedError."""
        if isinstance(submessage, Heartbeat):
            writer, fits = None, is_reliable(submessage.stream)
        else:
            writer, fits = submessage.object, not is_reliable(header.stream)
        proved = header.key or transport.proved_key(address)
        key = self._held.preconfigured.to_adopt(proved, writer, self._clients.keys())
        if key is None or not fits or self._clients.at(address) or header.session in OUT_OF_SESSION:
            raise MalformedError("no_session", f"{submessage.ID.name} without a session")
        access = self.gatekeeper.decide(key, transport, address, None)
        if access is None:
            raise MalformedError("no_session", "a client that the policy refuses")
        if not header.key and not self._strangers.listened_to(transport, address, now):
            return None
        link = Link(header.session, key, self._limits.minimum_mtu)
        client = self._add(link, address, transport, self._limits.client_timeout_s, now, access)
        if client is None:
            raise MalformedError("no_session", "no room for the client")
        client.adopted = True
        if isinstance(submessage, Heartbeat):
            client.session.begin(submessage.stream, submessage.first)
        text = "client {client} adopted at {peer}: it continues an earlier session"
        self._report(client, "client_adopted", text, peer=client.place)
        self._give(client)
        return client

    def missing(self) -> frozenset[bytes]:
        """Return the keys of the clients to adopt that are not in session."""
        return self._held.preconfigured.missing(self._clients.keys())

    def _welcome_back(
        self, client: Client, link: Link, address: Hashable, transport: Transport, now: float
    ) -> None:
        self.keeping.begin_again(client, now)  # a client that restarted has not requested anything yet
        client.session.reset(link)
        client.unacknowledged.clear()
        client.objects.forget_requests()
        client.last_received = client.opened = now
        client.adopted = False
        if client.address != address:
            self.move(client, transport, address, now)
        if client.asleep:
            self.wake(client)
        self._report(client, "client_again", "client {client} connected again, its entities are kept")
        self._give(client)

    def _report(self, client: Client, event: str, text: str, **fields: str | int | float) -> None:
        self._clients.watch(client, event)
        self._log.emit(Level.INFO, event, text, client=client.name, **fields)
