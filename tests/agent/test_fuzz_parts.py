# SPDX-License-Identifier: Apache-2.0
"""Datagrams and bytes for the parts that carry data both ways: samples in all formats, readings, calls, discovery, TCP
and serial framing. A slice by default; `-m long` goes on for FUZZ_SECONDS (default 600) with a new seed each time.
"""

from __future__ import annotations

import io
import os
import random
import time
from collections.abc import Callable
from ipaddress import IPv4Address

import pytest

from microros_gen.agent.framing import FrameDecoder, LengthDecoder, encode_length
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport import discovery
from microros_gen.agent.transport.addresses import OwnAddress
from microros_gen.agent.transport.discovery import Discovery
from microros_gen.agent.transport.sockets import UDP4
from microros_gen.agent.transport.udp import Udp
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import DataFormat
from microros_gen.agent.wire.data_messages import DeliveryControl, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Acknack, Delete, Fragment, Heartbeat
from microros_gen.agent.wire.message import Header, header_size, join, split
from microros_gen.agent.wire.samples import Sample, SampleInfo, write_samples
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent import captured
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities, sample
from tests.support.agent.serial_link import frame
from tests.support.agent.storm import bench_with_everything, check, services
from tests.support.examples import examples

FORMS = tuple(DataFormat)
COUNTS = (0, 1, 2, 0xFF, 0x7FFF, 0xFFFF, 0x10000, 0x7FFFFFFF, 0xFFFFFFFF)
OBJECTS = (0x15, 0x16, 0x17, 0x18)
SLOWEST_S = 0.5
"""Processor time for one message."""
FUZZERS: dict[str, Callable[[int, int], None]] = {}


def fuzzer(run: Callable[[int, int], None]) -> Callable[[int, int], None]:
    FUZZERS[run.__name__] = run
    return run


@pytest.mark.parametrize("name", ["datagrams", "tcp_bytes", "serial_bytes", "discovery_datagrams"])
@pytest.mark.examples
def test_a_slice(name: str) -> None:
    FUZZERS[name](1, examples(2_000, least=400))


@pytest.mark.long
def test_at_length() -> None:
    end = time.monotonic() + float(os.environ.get("FUZZ_SECONDS", "600"))
    seed = rounds = 0
    while time.monotonic() < end:
        seed += 1
        for name, run in FUZZERS.items():
            try:
                run(seed, 3_000)
            except Exception as error:
                raise AssertionError(f"{name} with seed {seed}") from error
            rounds += 3_000
    print(f"{rounds} messages and pieces, {seed} seeds")


def samples_of(chance: random.Random, form: int) -> bytes:
    """Return samples in a format, as they should be."""
    writer = Writer(True)
    number = chance.randrange(1, 5)
    infos = [SampleInfo(0, 7 + i, 100 * i) for i in range(number)]
    size = chance.choice((0, 3, 4, 40))
    bodies = [Sample(chance.randbytes(size), info) for info in infos]
    write_samples(writer, form, bodies)
    return writer.content()


def submessage_of(chance: random.Random) -> Submessage:
    """Return what belongs to data, right or nearly so."""
    form = chance.choice(FORMS)
    number = chance.randrange(0x10000)
    control = DeliveryControl(*(chance.choice((0, 1, 5, 0xFFFF)) for _ in range(4)))
    stream = chance.choice((0, 1, 2, 0x80, 0x81))
    identity = chance.choice((bytes(24), (chance.randrange(40)).to_bytes(24, "little"), b"\1" * 23, b""))
    return chance.choice(
        (
            WriteData(number, 0x15, samples_of(chance, form), form),
            WriteData(number, chance.choice(OBJECTS), samples_of(chance, form), chance.choice(FORMS)),
            WriteData(number, 0x18, identity + int32_body(number)),
            WriteData(number, 0x17, chance.randbytes(chance.choice((0, 1, 8, 200)))),
            ReadData(
                number, chance.choice(OBJECTS), stream, form, None, chance.choice((None, FOREVER, control))
            ),
            ReadData(number, 0x16, stream, chance.choice((1, 3, 4, 6, 12)), "x > 1", control),
            Acknack(chance.randrange(30), number, chance.choice((0x80, 0x81))),
            Heartbeat(chance.randrange(30), chance.randrange(30), stream),
            Delete(number, chance.choice(OBJECTS)),
            chance.choice((*entities(), *reader_entities(), *services())),
        )
    )


def distorted(data: bytes, chance: random.Random) -> bytes:
    """Return `data` with numbers that lie, bits that fell over, and ends that are missing."""
    out = bytearray(data)
    for _ in range(chance.choice((0, 0, 1, 1, 2, 4))):
        at = chance.randrange(len(out) + 1)
        what = chance.randrange(5)
        if what == 0:
            out[at & ~3 : (at & ~3) + 4] = chance.choice(COUNTS).to_bytes(4, "little")
        elif what == 1 and at < len(out):
            out[at] ^= 1 << chance.randrange(8)
        elif what == 2:
            del out[at:]
        elif what == 3:
            out[at:at] = chance.randbytes(chance.randrange(1, 9))
        else:
            del out[at : at + chance.randrange(1, 9)]
    return bytes(out)


class Talk:
    """A conversation with an agent that has one object of each kind."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.bench = bench_with_everything()
        self.sequence = 0

    def message(self) -> bytes:
        """Return the next message; nearly always one that the session takes."""
        chance = self.chance
        stream = chance.choice((0, 1, 0x80))
        self.sequence += 1
        parts = (
            encode(submessage_of(chance), chance.random() < 0.8) for _ in range(chance.choice((1, 1, 3)))
        )
        content = [distorted(part, chance) for part in parts]
        if chance.random() < 0.1:
            content = [encode(Fragment(b"".join(content), chance.random() < 0.7))]
            stream = 0x80
        return join(Header(0x81, stream, self.sequence if stream else 0), content)

    def between(self, number: int) -> None:
        """Let ROS 2 have something, time pass, and the client begin again."""
        bench, chance = self.bench, self.chance
        if number % 10 == 0:
            for source in bench.bridge.sources:
                body = sample(number) + bytes(chance.choice((0, 1, 600, 3_000)))
                kind = type(source).__name__
                number_of = {"FakeReplier": number.to_bytes(24, "little"), "FakeRequester": number % 40}
                source.waiting.clear()
                source.put(
                    *[body if kind == "FakeReader" else (number_of[kind], body)] * chance.randrange(1, 20)
                )
            bench.agent.take()
        if number % 50 == 0:
            bench.wait(chance.choice((0.1, 0.3, 3.0)), step=0.1)
        if number % 40 == 0:
            self.sequence = 0
            bench.say(captured.CREATE_CLIENT)
            for create in (*entities(), *reader_entities(), *services()):
                bench.say(message(create, stream=0))
            for object_id in OBJECTS[1:]:
                bench.say(message(ReadData(object_id, object_id, 0x80, delivery=FOREVER), stream=0))

    def end(self) -> None:
        """Nothing broke, samples went both ways, nothing is left behind."""
        check(self.bench)
        assert self.bench.agent.samples > 10
        assert self.bench.agent.delivered > 10
        answer = self.bench.say(captured.CREATE_CLIENT)
        assert answer == [captured.STATUS_AGENT]
        self.bench.agent.close()
        assert self.bench.bridge.graph == []


def answered(bench: Bench) -> None:
    """Whatever the agent sends can be read."""
    for _, data in bench.transport.sent:
        for span in split(data, header_size(data)):
            decode(*span[:2], data, *span[2:])


@fuzzer
def datagrams(seed: int, rounds: int) -> None:
    talk = Talk(random.Random(seed))
    slowest = 0.0
    for number in range(rounds):
        talk.between(number)
        data = talk.message()
        began = time.process_time()
        talk.bench.say(data)
        slowest = max(slowest, time.process_time() - began)
        answered(talk.bench)
    talk.end()
    assert slowest < SLOWEST_S


@fuzzer
def tcp_bytes(seed: int, rounds: int) -> None:
    """Messages after lengths that lie now and then, in any pieces; a connection with a lie in it is hung up."""
    talk = Talk(random.Random(seed))
    decoder = LengthDecoder()
    for number in range(rounds):
        talk.between(number)
        stream = encode_length(talk.message())
        if talk.chance.random() < 0.02:
            stream = distorted(stream, talk.chance)
        for chunk in chunks(stream, talk.chance):
            for data in decoder.feed(chunk):
                if data:
                    talk.bench.say(data)
            assert len(decoder._rest) < 2 + 0xFFFF
        if number % 25 == 0:
            decoder = LengthDecoder()
    talk.end()


@fuzzer
def serial_bytes(seed: int, rounds: int) -> None:
    """Frames with noise between and within them, in any pieces: a fault costs its frame, and no other."""
    talk = Talk(random.Random(seed))
    faults: list[str] = []
    decoder = FrameDecoder(lambda kind, _: faults.append(kind))
    whole = arrived = 0
    for number in range(rounds):
        talk.between(number)
        plain = talk.message()
        stream = frame(plain)
        broken = talk.chance.random() < 0.2
        if broken:
            stream = distorted(stream, talk.chance) + talk.chance.choice((b"", b"\x7d", b"\x7e", b"noise"))
        whole += not broken
        for chunk in chunks(stream, talk.chance):
            for _, data in decoder.feed(chunk):
                arrived += data == plain and not broken
                talk.bench.say(data)
            assert len(decoder._plain) <= 0xFFFF + 6
    assert arrived == whole
    assert faults
    talk.end()


def chunks(stream: bytes, chance: random.Random) -> list[bytes]:
    cuts = sorted(chance.randrange(len(stream) + 1) for _ in range(chance.choice((0, 1, 5))))
    return [stream[a:b] for a, b in zip([0, *cuts], [*cuts, len(stream)], strict=True)]


class Askers:
    """A socket that has what was put into it, from a new asker each time."""

    def __init__(self) -> None:
        self.waiting: list[bytes] = []
        self.sent: list[tuple[bytes, tuple[str, int]]] = []

    def recvfrom(self, _size: int) -> tuple[bytes, tuple[str, int]]:
        if not self.waiting:
            raise BlockingIOError
        return self.waiting.pop(0), ("127.0.0.1", 40_000 + len(self.sent))

    def sendto(self, data: bytes, asker: tuple[str, int]) -> None:
        self.sent.append((data, asker))

    def setsockopt(self, *_: object) -> None:
        """Takes any."""

    def close(self) -> None:
        """Nothing is open."""


@fuzzer
def discovery_datagrams(seed: int, rounds: int) -> None:
    """Whatever asks: at most one answer each, no larger than a client takes, not more than so many in a second."""
    chance = random.Random(seed)
    log = EventLog(io.StringIO())
    transport = Udp(UDP4, "127.0.0.1", 0)
    askers = Askers()
    own = [OwnAddress(IPv4Address(f"10.0.0.{i}"), i) for i in range(1, 40)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(discovery, "_open", lambda _port: askers)
        found = Discovery([transport], log, addresses=lambda: own)
    question = bytes.fromhex(captured.PING)
    questions = 0
    for number in range(rounds):
        data = chance.choice((question, distorted(question, chance), chance.randbytes(chance.randrange(60))))
        questions += data == question
        askers.waiting += [data] * chance.choice((1, 1, 30))
        while askers.waiting:
            before = len(askers.waiting)
            found.pump(lambda *_: pytest.fail("discovery hands nothing on"))
            assert len(askers.waiting) < before
        if number % 100 == 99:
            assert len(askers.sent) <= discovery.ANSWERS_PER_SECOND
            assert all(len(answer) <= 512 for answer, _ in askers.sent)
            askers.sent.clear()
            found.tick(float(number))
    transport.close()
    assert questions
    assert set(log.counters) <= {"discovery_input", "discovery_flood"}
    assert log.counters["discovery_input"]
    assert log.counters["discovery_flood"]
