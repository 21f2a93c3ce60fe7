# SPDX-License-Identifier: Apache-2.0
"""Requesters and repliers: prefixes as captured with the public agent, correlation, many at once, limits."""

from __future__ import annotations

import random

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import Data, ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Create, StatusReply
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import participant_blob, service_blob
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench, FakeReplier, FakeRequester
from tests.support.agent.readers import FOREVER, Listener

NODE, REQUESTER, REPLIER = 0x11, 0x17, 0x18
SERVICE = "/set_bool [std_srvs/srv/SetBool]"
IDENTITY = bytes.fromhex("010f78fdca7032130200030000000103 00000000 01000000")
LITTLE, BIG = b"\0\1\0\0", b"\0\0\0\0"


def serving(kind: int, limits: Limits | None = None) -> tuple[Bench, Listener]:
    """Return a bench whose client has a requester or a replier, and reads it."""
    bench = Bench(limits)
    bench.say(CREATE_CLIENT)
    blob = service_blob("/set_bool", "std_srvs/srv/SetBool")
    listener = Listener(bench)
    for create in (
        Create(1, NODE, 1, Format.BINARY, participant_blob("a"), 0, 0, True, True),
        Create(2, kind, kind & 15, Format.BINARY, blob, NODE, 0, True, True),
    ):
        (answer,) = listener.say(create)
        assert isinstance(answer, StatusReply)
        assert answer.status == 0, bench.text.getvalue()
    assert listener.say(ReadData(0x0C, kind, 0x80, delivery=FOREVER)) == []
    assert bench.bridge.graph == ["0:/a", SERVICE]
    return bench, listener


def replier(bench: Bench) -> FakeReplier:
    found = bench.bridge.source(SERVICE)
    assert isinstance(found, FakeReplier)
    return found


def requester(bench: Bench) -> FakeRequester:
    found = bench.bridge.source(SERVICE)
    assert isinstance(found, FakeRequester)
    return found


def test_a_request_and_its_reply_as_captured() -> None:
    """xrce-facts 5: 24 bytes of SampleIdentity before the request, and before the reply."""
    bench, listener = serving(REPLIER)
    assert "service /set_bool [std_srvs/srv/SetBool]" in bench.text.getvalue()
    replier(bench).put((IDENTITY, LITTLE + b"\1"))
    listener.take()
    wanted = "81800000 09011d00 000c0018" + IDENTITY.hex() + "01"
    assert bench.transport.sent[0][1] == bytes.fromhex(wanted)
    listener.say(WriteData(0x0D, REPLIER, IDENTITY + b"\0\0\0\0\x0b\0\0\0xrce got 0\0"))
    assert replier(bench).replies == [(IDENTITY, LITTLE + b"\0\0\0\0\x0b\0\0\0xrce got 0\0")]


def test_a_call_and_its_answer_as_captured() -> None:
    """xrce-facts 5: no prefix on the request; request and object id of it before the reply."""
    bench, listener = serving(REQUESTER)
    assert "service client /set_bool [std_srvs/srv/SetBool]" in bench.text.getvalue()
    listener.say(WriteData(0x0D, REQUESTER, b"\1"))
    assert requester(bench).requests == [(1, LITTLE + b"\1")]
    requester(bench).put((1, LITTLE + b"ok"))
    listener.take()
    assert bench.transport.sent[0][1] == bytes.fromhex("81800000 09010a00 000c0017 000d0017") + b"ok"
    assert bench.agent.samples == 1


def test_byte_order_of_an_identity() -> None:
    """The sequence number in a SampleIdentity follows the byte order of the submessage, the GUID does not."""
    bench, listener = serving(REPLIER)
    big = IDENTITY[:16] + bytes.fromhex("00000000 00000001")
    replier(bench).put((IDENTITY, BIG + b"\1"))
    listener.take()
    assert bench.transport.sent[0][1][5] == 0
    assert bench.transport.sent[0][1][12:36] == big
    bench.say(message(WriteData(0x0D, REPLIER, big + b"\2"), sequence=500, little=False))
    assert replier(bench).replies == [(IDENTITY, BIG + b"\2")]


@pytest.mark.parametrize("seed", range(4))
def test_many_slow_requests_at_once_are_all_answered(seed: int) -> None:
    """The public agent loses all but one of three concurrent requests (issue 5): here none is lost."""
    chance = random.Random(seed)
    bench, listener = serving(REPLIER)
    identities = [IDENTITY[:20] + number.to_bytes(4, "little") for number in range(200)]
    replier(bench).put(*((identity, LITTLE + identity[20:]) for identity in identities))
    open_ones: list[bytes] = []
    acknowledged = 0
    listener.take()
    while acknowledged < 200:
        new = [a for a in listener.answers() if isinstance(a, Data)]
        open_ones += [a.data for a in new]
        acknowledged += len(new)
        chance.shuffle(open_ones)
        for data in [open_ones.pop() for _ in range(chance.randrange(len(open_ones) + 1))]:
            listener.say(WriteData(1, REPLIER, data))
        listener.acknowledge(acknowledged)
    for data in open_ones:
        listener.say(WriteData(1, REPLIER, data))
    assert sorted(replier(bench).replies) == sorted((i, LITTLE + i[20:]) for i in identities)


@pytest.mark.parametrize("seed", range(4))
def test_many_calls_at_once_each_get_their_reply(seed: int) -> None:
    chance = random.Random(seed)
    bench, listener = serving(REQUESTER)
    for request in range(100, 300):
        listener.say(WriteData(request, REQUESTER, request.to_bytes(2, "big")))
    requests = requester(bench).requests[:]
    assert len(requests) == 200
    chance.shuffle(requests)
    requester(bench).put(*((number, LITTLE + serialized[4:]) for number, serialized in requests))
    answers: list[Data] = []
    listener.take()
    while new := [a for a in listener.answers() if isinstance(a, Data)]:
        answers += new
        listener.acknowledge(len(answers))
    assert len(answers) == 200
    for answer in answers:
        assert answer.data == answer.data[4:] + b"\0\x17" + answer.data[4:]


def test_a_reply_without_a_client_is_counted() -> None:
    bench, listener = serving(REPLIER)
    replier(bench).put((IDENTITY, LITTLE))
    listener.take()
    forged = bytes(24)
    listener.say(WriteData(1, REPLIER, forged + b"x"))
    listener.say(WriteData(1, REPLIER, IDENTITY + b"x"))
    listener.say(WriteData(1, REPLIER, IDENTITY + b"x"))
    listener.say(WriteData(1, REPLIER, IDENTITY[:23]))
    assert len(replier(bench).replies) == 1
    assert bench.log.counters == {"unknown_request": 2, "truncated": 1}


def test_replies_after_a_reconnect_are_dropped() -> None:
    bench, listener = serving(REQUESTER)
    listener.say(WriteData(0x0D, REQUESTER, b"\1"))
    bench.say(CREATE_CLIENT)
    listener.sequence = 0
    listener.say(ReadData(0x0C, REQUESTER, 0x80, delivery=FOREVER))
    listener.say(WriteData(0x0E, REQUESTER, b"\1"))
    requester(bench).put((1, LITTLE + b"old"), (2, LITTLE + b"new"))
    (answer,) = listener.take()
    assert isinstance(answer, Data)
    assert answer.data == b"\0\x0e\0\x17new"
    assert bench.log.counters == {"late_reply": 1}


@pytest.mark.parametrize("kind", [REQUESTER, REPLIER])
def test_what_waits_for_an_answer_is_limited(kind: int) -> None:
    bench, listener = serving(kind, Limits(requests=10))
    if kind == REQUESTER:
        for i in range(15):
            listener.say(WriteData(i, kind, b""))
        requester(bench).put(*((number, LITTLE) for number, _ in requester(bench).requests))
        assert [a.data[1] for a in listener.take() if isinstance(a, Data)] == list(range(5, 15))
        assert bench.log.counters == {"request_forgotten": 5, "late_reply": 5}
    else:
        identities = [IDENTITY[:23] + bytes([i]) for i in range(15)]
        replier(bench).put(*((identity, LITTLE) for identity in identities))
        listener.take()
        for identity in identities:
            listener.say(WriteData(1, kind, identity))
        assert [i for i, _ in replier(bench).replies] == identities[5:]
        assert bench.log.counters == {"request_forgotten": 5, "unknown_request": 5}


def test_calls_have_one_format() -> None:
    bench, listener = serving(REQUESTER)
    listener.say(WriteData(1, REQUESTER, b"\0\0ab", format=2))
    (answer,) = listener.say(ReadData(1, REQUESTER, 1, format=8, delivery=FOREVER))
    assert isinstance(answer, StatusReply)
    assert answer.status == 0x85
    assert bench.log.counters == {"data_format": 1}


def test_a_service_sleeps_and_wakes_with_its_client() -> None:
    bench, listener = serving(REPLIER, Limits(client_timeout_s=1.0))
    bench.wait(1.2)
    assert bench.bridge.graph == []
    bench.say("81 00 00 00 06 01 04 00 00 00 ff fe")
    replier(bench).put((IDENTITY, LITTLE))
    assert len(listener.take()) == 1


def test_a_client_that_is_silent_for_too_long_cannot_answer_what_it_was_asked_before() -> None:
    """A callback blocked it for longer than its time-out: its service is another one in ROS 2, and the log says so."""
    bench, listener = serving(REPLIER, Limits(client_timeout_s=1.0))
    for number in (1, 2):
        replier(bench).put((IDENTITY[:-1] + bytes([number]), LITTLE + b"\1"))
        assert len(listener.take()) == 1
    bench.wait(1.2)
    assert bench.bridge.graph == []
    assert "was silent for too long: 2 requests that it received get no reply" in bench.text.getvalue()
    listener.say(WriteData(0x0D, REPLIER, IDENTITY + b"\2"))
    assert replier(bench).replies == []
    assert bench.log.counters["unanswered"] == bench.log.counters["unknown_request"] == 1


def test_a_service_that_ros_does_not_have() -> None:
    bench, listener = serving(REPLIER)
    blob = service_blob("/x", "std_srvs/srv/SetBool").replace(b"srv::dds_", b"msg::dds_")
    (answer,) = listener.say(Create(5, 0x28, 8, Format.BINARY, blob, NODE))
    assert isinstance(answer, StatusReply)
    assert answer.status == 0x85
    assert "is not a ROS service" in bench.text.getvalue()
