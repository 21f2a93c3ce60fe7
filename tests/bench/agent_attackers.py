# SPDX-License-Identifier: Apache-2.0
"""Clients that do what the table of attacks says, each bounded in time and number, on the loopback interface alone.

`python agent_attackers.py ATTACK UDP_PORT TCP_PORT DOMAIN SECONDS`; it prints `attacking` when it begins.
"""

from __future__ import annotations

import contextlib
import os
import random
import select
import socket
import struct
import sys
import time
from collections.abc import Callable, Iterable
from functools import partial
from types import MappingProxyType

from microros_gen.agent.wire.constants import DataFormat, Format
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import CreateClient, GetInfo
from microros_gen.agent.wire.submessages import Submessage, encode
from tests.support.agent.client import (
    dds_type,
    int32_body,
    participant_blob,
    reader_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.soak_client import SoakClient
from tests.support.agent.soak_links import UdpLink

INT32 = dds_type("std_msgs/msg/Int32")
KEEP_ALL, LAST, LATCHED = 1, 3, 11
"""EndpointQosFlags: reliable; with KEEP_LAST; and transient local."""
NODE, TOPIC, PUBLISHER, SUBSCRIBER, WRITER, READER, TYPE, APPLICATION = 1, 2, 3, 4, 5, 6, 0x0A, 0x0C
SESSION = 0x81
BIG = 60_000


class Attacker:
    """A client that waits for nothing and keeps nothing."""

    def __init__(self, port: int, domain: int, key: int, properties: Iterable[tuple[str, str]] = ()) -> None:
        self.domain = domain
        self.key = key.to_bytes(4, "big")
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.socket.setblocking(False)
        self._number = 0
        self._reliable = 0
        hello = CreateClient(self.key, SESSION, 65_000, tuple(properties) or None)
        self.put(join(Header(0x80, 0, 0), [encode(hello)]))
        time.sleep(0.05)

    def put(self, datagram: bytes) -> None:
        """Send a datagram, or lose it."""
        try:
            self.socket.send(datagram)
        except OSError:
            return

    def say(self, *submessages: Submessage) -> None:
        """Send a message on the best-effort stream."""
        self.put(self.message(1, self._next(), submessages))

    def throw(self, submessages: bytes) -> None:
        """Send a message on the best-effort stream, of submessages that were encoded before: that costs little."""
        self.put(bytes((SESSION, 1)) + self._next().to_bytes(2, "little") + submessages)

    def say_reliably(self, *submessages: Submessage) -> None:
        """Send a message on the reliable stream, once."""
        self.put(self.message(0x80, self._reliable, submessages))
        self._reliable = (self._reliable + 1) & 0xFFFF

    def make(self, kind: int, number: int, body: bytes, parent: int = 0, form: int = Format.BINARY) -> Create:
        """Return a CREATE that replaces the existing object."""
        domain = self.domain if kind == NODE else 0
        return Create(1, number << 4 | kind, kind, form, body, parent, domain, True, True)

    def node(self, name: str) -> None:
        """Create a node with a publisher and a subscriber."""
        self.say_reliably(self.make(NODE, 1, participant_blob(name)))
        self.say_reliably(self.make(PUBLISHER, 1, b"\0\0", 0x11), self.make(SUBSCRIBER, 1, b"\0\0", 0x11))

    def writer(self, number: int, topic: str, flags: int, depth: int = 0) -> None:
        """Create a topic and its writer."""
        blob = topic_blob(f"rt/{topic}", INT32)
        self.say_reliably(
            self.make(TOPIC, number, blob, 0x11),
            self.make(WRITER, number, writer_blob(number << 4 | TOPIC, flags, depth), 0x13),
        )

    @staticmethod
    def message(stream: int, sequence: int, submessages: Iterable[Submessage]) -> bytes:
        """Return one message."""
        return join(Header(SESSION, stream, sequence), [encode(submessage) for submessage in submessages])

    def _next(self) -> int:
        self._number = (self._number + 1) & 0xFFFF
        return self._number


def paced(seconds: float, per_second: float, do: Callable[[int], None]) -> None:
    """Do something so many times a second, in bursts of a millisecond or more, for so many seconds."""
    began, done = time.monotonic(), 0
    while (now := time.monotonic()) < began + seconds:
        for _ in range(min(int((now - began) * per_second) - done, max(1, int(per_second / 20)))):
            do(done)
            done += 1
        time.sleep(max(0.001, 1 / per_second / 2))


def history(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S1: a transient-local writer of depth 60,000, and samples of 60 kB."""
    attacker = Attacker(port, domain, 0xBAD00100)
    attacker.node("s1")
    attacker.writer(1, "s1", LATCHED, 60_000)
    _begin()
    sample = encode(WriteData(1, 0x15, bytes(BIG)))
    paced(seconds, 600, lambda _: attacker.throw(sample))


def types(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S2: eight clients with 512 TYPE objects of 64 kB each."""
    clients = [Attacker(port, domain, 0xBAD00200 + n) for n in range(8)]
    messages = []
    for number in range(1, 513):
        text = f'<types><struct name="T{number}">{" " * (BIG - 60)}</struct></types>'.encode()
        messages.append(encode(clients[0].make(TYPE, number, text, form=Format.XML)))
    _begin()
    paced(seconds, 800, lambda place: clients[place % 8].throw(messages[place // 8 % 512]))


def creates(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S3: sixteen clients that create as fast as they can."""
    clients = [Attacker(port, domain, 0xBAD00300 + n) for n in range(16)]
    for place, client in enumerate(clients):
        client.node(f"s3_{place}")
    _begin()
    messages = [
        [_topic_with_ends(client, place, number) for number in range(2, 162)]
        for place, client in enumerate(clients)
    ]
    paced(seconds, 3_000, lambda place: clients[place % 16].throw(messages[place % 16][place // 16 % 160]))


def _topic_with_ends(client: Attacker, place: int, number: int) -> bytes:
    topic = number << 4 | TOPIC
    creates = (
        client.make(TOPIC, number, topic_blob(f"rt/s3_{place}_{number}", INT32), 0x11),
        client.make(WRITER, number, writer_blob(topic, LAST, 10), 0x13),
        client.make(READER, number, reader_blob(topic, LAST, 10), 0x14),
    )
    return client.message(1, 0, creates)[4:]


def leaves_and_returns(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S4: a time-out of 1 ms and 480 writers: each datagram creates all of them again."""
    attacker = Attacker(port, domain, 0xBAD00400, [("uxr_hl", "1")])
    attacker.node("s4")
    attacker.say_reliably(attacker.make(TOPIC, 1, topic_blob("rt/s4", INT32), 0x11))
    for number in range(2, 482):
        attacker.say(attacker.make(WRITER, number, writer_blob(0x12, LAST, 1), 0x13))
        time.sleep(0.001)
    _begin()
    paced(seconds, 50, lambda _: attacker.say(GetInfo(1, 0x15, 3)))


def blocked(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S5: 3,750 samples of 0 bytes in one datagram to a KEEP_ALL writer whose reader takes nothing."""
    attacker = Attacker(port, domain, 0xBAD00500)
    attacker.node("s5")
    attacker.writer(1, "s5", KEEP_ALL)
    attacker.say_reliably(attacker.make(READER, 1, reader_blob(0x12, KEEP_ALL, 0), 0x14))
    time.sleep(0.5)
    _begin()
    sequence = encode(WriteData(1, 0x15, struct.pack("<I", 3_750) + bytes(4 * 3_750), DataFormat.DATA_SEQ))
    paced(seconds, 9, lambda _: attacker.throw(sequence))


def forged(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S6: sessions that nobody means, under 2,000 keys and from as many ports as one process has."""
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(400)]
    _begin()

    def hello(place: int) -> None:
        body = CreateClient(
            struct.pack(">I", 0xBAD10000 + place % 2_000), SESSION, 512, (("uxr_hl", "600000"),)
        )
        sockets[place % 400].sendto(join(Header(0x80, 0, 0), [encode(body)]), ("127.0.0.1", port))

    paced(seconds, 1_000, hello)


def half_open(_port: int, tcp: int, domain: int, seconds: float) -> None:
    """S7: 500 TCP connections that say nothing."""
    held: list[socket.socket] = []
    _begin()

    def connect(_place: int) -> None:
        if len(held) >= 500:
            held.pop(0).close()
        opened = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        opened.setblocking(False)
        opened.connect_ex(("127.0.0.1", tcp))
        held.append(opened)

    paced(seconds, 500, connect)


def refused(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S8: CREATEs that are refused and have filters of 60 kB."""
    attacker = Attacker(port, domain, 0xBAD00800)
    attacker.node("s8")
    attacker.say_reliably(attacker.make(TOPIC, 1, topic_blob("rt/s8", INT32), 0x11))
    _begin()
    body = encode(attacker.make(READER, 1, reader_blob(0x12, LAST, 10, 0, "x" * (BIG - 4)), 0x14))
    paced(seconds, 250, lambda _: attacker.throw(body))


def amplified(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S9: 200 GET_INFO in one datagram, of a TYPE of 60 kB."""
    attacker = Attacker(port, domain, 0xBAD00900)
    text = f'<types><struct name="T">{" " * (BIG - 60)}</struct></types>'.encode()
    attacker.say(attacker.make(TYPE, 1, text, form=Format.XML))
    _begin()
    many = encode(GetInfo(1, 0x1A, 3)) * 200
    assert len(many) % 4 == 0
    paced(seconds, 20, lambda _: attacker.throw(many))


def application(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S10: an application of 500 writers of which the last cannot be."""
    attacker = Attacker(port, domain, 0xBAD01000)
    # The last one has a name that cannot be, or the type of its topic is another one with another client.
    texts = [_application(domain, last) for last in ("rt/bad name", "rt/s10_other")]
    bodies = [encode(attacker.make(APPLICATION, 1, text, form=Format.XML)) for text in texts]
    other = Attacker(port, domain, 0xBAD01001)
    other.node("s10_other")
    wrong = topic_blob("rt/s10_other", dds_type("std_msgs/msg/String"))
    other.say_reliably(
        other.make(TOPIC, 1, wrong, 0x11), other.make(WRITER, 1, writer_blob(0x12, LAST, 1), 0x13)
    )
    time.sleep(0.2)
    _begin()
    paced(seconds, 5, lambda place: attacker.throw(bodies[place % 2]))


def _application(domain: int, last: str) -> bytes:
    writers = "".join(f'<data_writer name="w{n}" topic_ref="rt/s10"/>' for n in range(498))
    return (
        f'<application_library name="l"><application name="a"><domain_participant name="s10" domain_id="{domain}">'
        f'<topic name="rt/s10" register_type_ref="{INT32}"/><topic name="{last}" register_type_ref="{INT32}"/>'
        f'<publisher name="p">{writers}<data_writer name="z" topic_ref="{last}"/></publisher>'
        "</domain_participant></application></application_library>"
    ).encode()


class LossyLink(UdpLink):
    """Loses 30 % each way, and doubles and reorders some."""

    chance = random.Random(11)

    def __init__(self, port: int, take: Callable[[bytes], None]) -> None:
        super().__init__(port, self._lose(take))
        self._late = b""

    def send(self, message: bytes) -> None:
        if self.chance.random() < 0.3:
            return
        if self._late:
            super().send(self._late)
            self._late = b""
        if self.chance.random() < 0.1:
            self._late = message
            return
        super().send(message)
        if self.chance.random() < 0.05:
            super().send(message)

    def _lose(self, take: Callable[[bytes], None]) -> Callable[[bytes], None]:
        def maybe(message: bytes) -> None:
            if self.chance.random() >= 0.3:
                take(message)

        return maybe


def lossy(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S11: five clients over a line that loses 30 %, doubles and reorders; they mean no harm."""
    clients = [SoakClient(0xBAD01100 + n, SESSION, 512, lambda _: None) for n in range(5)]
    for client in clients:
        client.link = LossyLink(port, client.hear)
    _begin()
    began = time.monotonic()
    hello_at = dict.fromkeys(clients, 0.0)
    created: set[SoakClient] = set()
    while (now := time.monotonic()) < began + seconds:
        for client in clients:
            if not client.connected and now >= hello_at[client]:
                hello_at[client] = now + 0.3
                client.introduce()
            elif client.connected and client not in created:
                created.add(client)
                _publisher(client, domain)
            elif client in created and client.acknowledged:
                client.ask(lambda request: WriteData(request, 0x15, int32_body(1)))
            client.tick(now)
        links = [client.link for client in clients if client.link is not None]
        readable, _, _ = select.select(links, [], [], 0.01)
        for link in readable:
            with contextlib.suppress(AssertionError):  # refused: it tries again
                link.read()


def _publisher(client: SoakClient, domain: int) -> None:
    for kind, body, parent in (
        (NODE, participant_blob(f"s11_{client.key.hex()}"), 0),
        (TOPIC, topic_blob("rt/s11", INT32), 0x11),
        (PUBLISHER, b"\0\0", 0x11),
        (WRITER, writer_blob(0x12, LAST, 10), 0x13),
    ):
        client.ask(partial(_create, kind, body, parent, domain if kind == NODE else 0))


def _create(kind: int, body: bytes, parent: int, domain: int, request: int) -> Create:
    return Create(request, 0x10 | kind, kind, Format.BINARY, body, parent, domain, True, True)


def small(port: int, _tcp: int, domain: int, seconds: float) -> None:
    """S12: 45,000 small messages a second."""
    attacker = Attacker(port, domain, 0xBAD01200)
    attacker.node("s12")
    attacker.writer(1, "s12", LAST, 10)
    _begin()
    body = encode(WriteData(1, 0x15, int32_body(1)))
    head, put = bytes((SESSION, 1)), attacker.put
    paced(seconds, 45_000, lambda place: put(head + (place & 0xFFFF).to_bytes(2, "little") + body))


def _begin() -> None:
    print("attacking", flush=True)


Attack = Callable[[int, int, int, float], None]
ATTACKS: MappingProxyType[str, Attack] = MappingProxyType(
    {
        "S1": history,
        "S2": types,
        "S3": creates,
        "S4": leaves_and_returns,
        "S5": blocked,
        "S6": forged,
        "S7": half_open,
        "S8": refused,
        "S9": amplified,
        "S10": application,
        "S11": lossy,
        "S12": small,
    }
)
LONGEST_S = 300.0

if __name__ == "__main__":
    os.nice(19)  # an attacker is elsewhere: on this machine it is not to take the agent's processor
    name, *numbers = sys.argv[1:]
    udp_port, tcp_port, ros_domain = map(int, numbers[:3])
    ATTACKS[name](udp_port, tcp_port, ros_domain, min(float(numbers[3]), LONGEST_S))
