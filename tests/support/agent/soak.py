# SPDX-License-Identifier: Apache-2.0
"""Clients of all kinds that come and go at one agent process, and an rclpy process that keeps the ledger.

Each client publishes reliable samples, reads a topic, calls a service and serves one; each of its lives ends with a
word of good-bye, a crash, a sleep, or a move to another address. Lives of one place share a key, mostly.
"""

from __future__ import annotations

import contextlib
import random
import select
import time
from collections import Counter
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from functools import partial

from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Create
from tests.support.agent.bridging import GET_TYPES, names_body, read_names, read_types, types_body
from tests.support.agent.client import (
    dds_type,
    participant_blob,
    reader_blob,
    service_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.soak_client import RELIABLE, SoakClient
from tests.support.agent.soak_links import Link, SharedLine, TcpStream, UdpLink
from tests.support.agent.soak_processes import Agent

STRING = dds_type("std_msgs/msg/String")
NODE, UP, DOWN, PUBLISHER, SUBSCRIBER, WRITER, READER, CALLER, SERVER = (
    0x11, 0x12, 0x22, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18,
)  # fmt: skip
LATCHED = 1 | 2 | 8
"""Reliable, keep last, transient local: its reader also gets messages published before it was discovered."""
LITTLE = b"\0\1\0\0"
IDENTITY = 24
IDS = 4
PATIENCE_S = 180.0
"""Nothing in the soak takes this long; on a very busy machine neither."""
TRIES = 36
"""How often something is said again, each time after `AGAIN_S` seconds."""
AGAIN_S = 5.0
NEW_S = 15.0
"""A reader of DDS that is new may hear samples before their writer has found it, which on a busy machine takes some
seconds: what comes in between is not promised to it (it is volatile)."""
ENDS = ("leave", "again", "replaced", "vanish", "sleep", "move")
Step = Generator["Callable[[], object] | float", None, None]
"""A course of action: gives what it waits for, or for how many seconds."""


class Place:
    """One client after another, with what each has seen and done."""

    def __init__(self, number: int, world: World) -> None:
        self.number = number
        self.chance = random.Random(number * 7919 + world.seed)
        self.world = world
        self.key = 0x01000000 + number
        self.session = self.chance.choice((0x81, 0x01))
        self.life = 0
        self.replies: dict[int, list[int]] = {}
        self.last: int | None = None
        self.heard_count = 0
        self.connected_at = self.new_until = 0.0
        self.gap_allowed = False
        self.served = 0
        self.client = self._fresh()

    def lives(self) -> Step:
        """Live until the world ends."""
        yield self.chance.uniform(0, self.world.spread_s)
        while not self.world.over():
            yield from self._live()
        if self.client.link is not None:
            self.client.link.close()

    def _live(self) -> Step:
        self.life += 1
        world, client, chance = self.world, self.client, self.chance
        self._connect(client)
        for _ in range(TRIES):
            client.introduce()
            yield within(AGAIN_S, lambda: client.connected)
            if client.connected:
                break
        assert client.connected, "the agent does not answer"
        yield from self._create(client)
        written = yield from self._publish(client, chance.randrange(5, 25))
        if chance.random() < 0.5:
            yield from self._be_called(client)
        yield from self._account(client, written)
        how = chance.choices(ENDS, (40, 20, 10, 5, 15 if world.sleeping else 0, 10))[0]
        if how == "move" and self.session >= 0x80:
            how = "leave"
        world.ends[how] += 1
        if how == "sleep":
            yield from self._sleep(client, written)
        elif how == "move":
            yield from self._move(client, written)
        if how in ("leave", "sleep", "move"):
            yield from self._leave(client)
        elif chance.random() < 0.5:
            yield from self._crash_in_the_middle(client)
        assert client.link is not None
        client.link.close()
        client.link = None
        if how == "replaced":
            self.session ^= 0x03
        elif how == "vanish":
            self.key += 0x10000
        self.client = self._fresh()
        yield chance.uniform(0, 6)

    def _fresh(self) -> SoakClient:
        mtu = self.chance.choice((128, 256, 512, 1024))
        return SoakClient(self.key, self.session, mtu, self._data)

    def _connect(self, client: SoakClient) -> None:
        client.link = self.world.link(self.number, client.hear)
        self.last, self.gap_allowed = None, False
        self.heard_count, self.connected_at = 0, time.monotonic()
        self.new_until = self.connected_at + NEW_S
        self.replies.clear()

    def _create(self, client: SoakClient) -> Step:
        name = f"/soak/node_{self.number}"
        node = participant_blob(name)
        descriptions = (
            (NODE, node, 0),
            (UP, topic_blob("rt/soak/up", STRING), NODE),
            (DOWN, topic_blob("rt/soak/down", STRING), NODE),
            (PUBLISHER, b"\0\0", NODE),
            (SUBSCRIBER, b"\0\0", NODE),
            (WRITER, writer_blob(UP, LATCHED, 200), PUBLISHER),
            (READER, reader_blob(DOWN, 3, 200), SUBSCRIBER),
            (CALLER, service_blob("/soak/ledger", GET_TYPES), NODE),
            (SERVER, service_blob(self._service, GET_TYPES), NODE),
        )
        numbers = [
            client.ask(partial(_create, self.world.domain, *description)) for description in descriptions
        ]
        yield lambda: all(number in client.statuses for number in numbers)
        refused = {n: f"{client.statuses[n]:#04x}" for n in numbers if client.statuses[n] not in (0, 1)}
        assert not refused, f"requests {refused} of {numbers} were refused"
        for source in (READER, CALLER, SERVER):
            client.ask(partial(_read, source))

    @property
    def _service(self) -> str:
        return f"/soak/server_{self.number}"

    def _publish(self, client: SoakClient, count: int, first: int = 0) -> Generator[float, None, int]:
        for number in range(first, first + count):
            size = self.chance.choice((0, 10, 10, 10, 300, 2000))
            text = f"{self.key}:{self.life}:{number}:{size}:" + "x" * size
            body = (len(text) + 1).to_bytes(4, "little") + text.encode() + b"\0"
            client.ask(partial(_write, WRITER, body))
            self.world.count["samples up"] += 1
            yield self.chance.uniform(0.02, 0.4)
        return first + count

    def _call(self, client: SoakClient, *words: str) -> Generator[Callable[[], object], None, list[int]]:
        """Ask the ledger; several times when it is not there yet (the agent drops a request after some seconds)."""
        body = names_body(list(words))[4:]
        for _ in range(TRIES // 2):
            number = client.ask(partial(_write, CALLER, body))
            yield within(10, partial(self.replies.__contains__, number))
            if number in self.replies:
                self.world.count["calls"] += 1
                return self.replies.pop(number)
            self.world.count["calls again"] += 1
        raise AssertionError(f"no reply to {words}")

    def _account(self, client: SoakClient, written: int) -> Step:
        """Every sample has to be in the ledger, in order and once."""
        until = time.monotonic() + PATIENCE_S
        while True:
            good, bad = yield from self._call(client, "tally", str(self.key), str(self.life))
            assert not bad, f"{bad} samples out of order"
            if good == written:
                break
            assert time.monotonic() < until, f"the ledger has {good} of {written}"
            yield 0.3
        self.world.count["accounts that are right"] += 1

    def _be_called(self, client: SoakClient) -> Step:
        count = self.chance.randrange(1, 6)
        yield from self._call(client, "call", self._service, str(count))
        until = time.monotonic() + PATIENCE_S
        while True:
            right, wrong = yield from self._call(client, "called", self._service)
            assert not wrong
            if right == count:
                break
            assert time.monotonic() < until, f"{right} of {count} requests were answered"
            yield 0.3
        self.world.count["requests served"] += count
        yield from self._call(client, "done", self._service)

    def _sleep(self, client: SoakClient, written: int) -> Step:
        """Say and hear nothing for longer than the time-out; continue the session as it was."""
        yield lambda: client.acknowledged
        client.deaf = True
        yield self.world.agent.timeout_s * self.chance.uniform(1.3, 2)
        client.deaf = False
        self.gap_allowed = True
        self.new_until = time.monotonic() + NEW_S
        yield from self._account(client, (yield from self._publish(client, 5, written)))

    def _move(self, client: SoakClient, written: int) -> Step:
        """Go on from another address: the session has the key in its header."""
        assert client.link is not None
        client.link.close()
        client.link = self.world.link(self.number, client.hear)
        yield from self._account(client, (yield from self._publish(client, 5, written)))

    def _leave(self, client: SoakClient) -> Step:
        yield lambda: client.acknowledged
        for _ in range(TRIES):
            number = client.leave()
            yield within(AGAIN_S, partial(client.statuses.__contains__, number))
            if number in client.statuses:
                return
        raise AssertionError("DELETE of the client is not answered")

    def _crash_in_the_middle(self, client: SoakClient) -> Step:
        for _ in range(3):
            client.ask(partial(_write, CALLER, names_body(["tally", "0", "0"])[4:]))
        yield from self._publish(client, 2, 1000)

    def _data(self, data: Data) -> None:
        if data.object == READER:
            self._hear(data.data)
        elif data.object == SERVER:
            names = read_names(LITTLE + data.data[IDENTITY:])
            answer = data.data[:IDENTITY] + types_body([len(name) for name in names])[4:]
            self.client.ask(partial(_write, SERVER, answer))
        else:
            number = int.from_bytes(data.data[:2], "big")
            self.replies[number] = read_types(LITTLE + data.data[IDS:])

    def _hear(self, body: bytes) -> None:
        """Samples of ROS 2 come in order, whole, and without a gap unless the client slept."""
        end = 3 + int.from_bytes(body[:4], "little")  # DDS fills up to a multiple of four after it
        number, size, rest = body[4:end].decode().split(":", 2)
        assert rest == "x" * int(size)
        if self.last is not None and int(number) != self.last + 1:
            assert int(number) > self.last, f"{number} after {self.last}"
            seen = f"{self.heard_count} before, in {time.monotonic() - self.connected_at:.1f} s"
            new = time.monotonic() < self.new_until
            assert self.gap_allowed or new, f"samples between {self.last} and {number} are lost ({seen})"
            self.gap_allowed = self.gap_allowed and new
        self.last = int(number)
        self.heard_count += 1
        self.world.count["samples down"] += 1


@dataclass
class World:
    """All clients, driven from one loop."""

    agent: Agent
    domain: int
    seconds: float
    spread_s: float
    sleeping: bool = True
    seed: int = 0
    count: Counter[str] = field(default_factory=Counter)
    ends: Counter[str] = field(default_factory=Counter)
    rss: list[tuple[float, int]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.began = time.monotonic()
        self._minute = 0
        self._line = SharedLine(self.agent.places["serial"])
        self._links: dict[int, Link | SharedLine] = {self._line.fileno(): self._line}
        self._poll = select.poll()
        self._poll.register(self._line.fileno(), select.POLLIN)

    def over(self) -> bool:
        """Return whether no new life begins."""
        return time.monotonic() - self.began > self.seconds

    def link(self, number: int, take: Callable[[bytes], None]) -> Link:
        """Return a way for a place: of ten, six over UDP, three over TCP, one on the line."""
        if number % 10 == 9:
            return self._line.end(1 + number // 10, take)
        kind = UdpLink if number % 10 < 6 else TcpStream
        port = int(self.agent.places["udp4" if kind is UdpLink else "tcp4"].rpartition(":")[2])
        link: Link = kind(port, take)
        self._links[link.fileno()] = link
        self._poll.register(link.fileno(), select.POLLIN)
        return link

    def run(self, places: list[Place]) -> None:
        """Let all of them live to their ends."""
        courses = {place: _Course(place.lives()) for place in places}
        rss_at, before = 0.0, time.monotonic()
        while courses:
            for descriptor, _ in self._poll.poll(10):
                self._read(descriptor)
            now = time.monotonic()
            if now - before > self.agent.timeout_s / 3:
                self._stalled(places)
            before = now
            self._line.write()
            for place, course in list(courses.items()):
                place.client.tick(now)
                try:
                    if not course.go(now):
                        del courses[place]
                except AssertionError as error:
                    raise AssertionError(f"place {place.number}, life {place.life}: {error}") from error
            if now >= rss_at:
                rss_at = now + 2
                self.rss.append((now - self.began, self.agent.rss_kib))
                self._report_minute()
        self._line.close()

    def _report_minute(self) -> None:
        """Print a summary of the last minute, for an observer (`pytest -s`)."""
        minute = int(self.rss[-1][0]) // 60
        if minute > self._minute:
            self._minute = minute
            low, high = self.rss_of(minute - 1)
            lives = sum(self.ends.values())
            print(
                f"minute {minute}: RSS {low / 1024:.1f} to {high / 1024:.1f} MiB, {lives} lives", flush=True
            )

    def rss_of(self, minute: int) -> tuple[int, int]:
        """Return the agent's least and largest RSS in KiB in a minute (from 0), of samples every 2 s."""
        seen = [kib for at, kib in self.rss if at // 60 == minute]
        return min(seen, default=0), max(seen, default=0)

    def _stalled(self, places: list[Place]) -> None:
        """This process did not run for long: its clients may have been taken for asleep, and were."""
        self.count["stalls of this process"] += 1
        for place in places:
            place.gap_allowed = True

    def _read(self, descriptor: int) -> None:
        link = self._links[descriptor]
        if link.fileno() != descriptor:  # closed, and perhaps another's by now
            with contextlib.suppress(OSError, KeyError):
                self._poll.unregister(descriptor)
            return
        with contextlib.suppress(ConnectionRefusedError):
            link.read()


class _Course:
    """A step that is under way, and what it waits for."""

    def __init__(self, step: Step) -> None:
        self._step = step
        self._until: Callable[[], object] | None = None
        self._at = 0.0
        self._since = 0.0

    def go(self, now: float) -> bool:
        """Go on if it can; return whether there is more to come."""
        if self._until is not None and not self._until():
            assert now - self._since < PATIENCE_S, "no answer in time"
            return True
        if self._until is None and now < self._at:
            return True
        try:
            wanted = next(self._step)
        except StopIteration:
            return False
        self._until = wanted if callable(wanted) else None
        self._at, self._since = now + (0.0 if callable(wanted) else wanted), now
        return True


def within(seconds: float, done: Callable[[], object]) -> Callable[[], object]:
    """Return a condition that is true when `done` is, or when the time is over."""
    until = time.monotonic() + seconds
    return lambda: done() or time.monotonic() > until


def _write(object_id: int, body: bytes, request: int) -> WriteData:
    return WriteData(request, object_id, body)


def _read(object_id: int, request: int) -> ReadData:
    return ReadData(request, object_id, RELIABLE, delivery=DeliveryControl(0xFFFF))


def _create(domain: int, object_id: int, body: bytes, parent: int, request: int) -> Create:
    kind = object_id & 0x0F
    return Create(
        request, object_id, kind, Format.BINARY, body, parent, domain if kind == 1 else 0, True, True
    )
