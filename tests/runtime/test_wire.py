# SPDX-License-Identifier: Apache-2.0
"""The client's bytes, against what the reference client was seen to send (pad bytes are zero here).

Request ids of objects begin at 11 here, and at 10 there, where a ping has the same.
"""

from __future__ import annotations

import pytest

from tests.support.plans import DECLARED, POOL, changed
from tests.support.runtime.bench import Bench

PARTICIPANT = "01071e00 000b0001 01030000 10000000 00 010000 08000000 6d795f6e6f646500 4d00"
TOPIC = (
    "01074300 000c0002 02030000 35000000 0b000000 72742f6368617474657200 00 01 000000"
    "1d000000 7374645f6d7367733a3a6d73673a3a6464735f3a3a537472696e675f00 0001"
)
PUBLISHER = "01071000 000d0003 03030000 02000000 0000 0001"
DATAWRITER = "01071c00 000e0005 05030000 0e000000 0002 0100 0300 0100 0a00 00000000 0003"


def _bytes(text: str) -> bytes:
    return bytes.fromhex(text)


def test_create_client_names_key_session_and_input_size(bench: Bench) -> None:
    client = bench.start()
    client.ok("init")
    assert client.sent == [_bytes("80000000 00011000 58524345 0100 010f a1b2c3d4 81 00 4000")]


def test_entities_are_created_as_captured(bench: Bench) -> None:
    client = bench.start()
    client.ok("init_options 77 192.168.1.2 8888 a1b2c3d4")
    client.ok("node 0 my_node -")
    client.ok("publisher 0 0 String chatter reliable")
    heads = [_bytes(f"8101{i:02x}00") for i in range(4)]
    bodies = [_bytes(x) for x in (PARTICIPANT, TOPIC, PUBLISHER, DATAWRITER)]
    assert client.sent[1:] == [head + body for head, body in zip(heads, bodies, strict=True)]


def test_options_win_over_the_plan(bench: Bench) -> None:
    client = bench.start()
    assert "open 10.0.0.9 4321" in client.ok("init_options 0 10.0.0.9 4321 01020304").lines
    assert client.sent[0][16:20] == _bytes("01020304")


@pytest.mark.parametrize(
    ("qos", "blob"),
    [
        ("best_effort", "0e000000 0002 0100 0200 0100 0500 00000000"),
        ("system_default", "0b000000 0002 0100 0300 00 00000000"),
        ("transient_local", "0e000000 0002 0100 0b00 0100 0a00 00000000"),
        ("keep_all", "0e000000 0002 0100 0100 0100 0a00 00000000"),
    ],
)
def test_qos_on_the_wire(bench: Bench, qos: str, blob: str) -> None:
    client = bench.start()
    for call in ("init", "node 0 n -", f"publisher 0 0 Int32 chatter {qos}"):
        client.ok(call)
    assert client.sent[-1][16:] == _bytes(blob) + _bytes("0003")


@pytest.mark.parametrize(
    ("name", "domain_offset"), [("a", 12), ("ab", 12), ("abc", 12), ("abcd", 14), ("abcde", 14)]
)
def test_domain_follows_the_name_at_an_even_place(bench: Bench, name: str, domain_offset: int) -> None:
    client = bench.start()
    client.ok("init_options 5 h 1 1")
    client.ok(f"node 0 {name} -")
    payload = client.sent[-1][8:]
    blob = int.from_bytes(payload[8:12], "little")
    assert blob == 8 + len(name) + 1
    assert payload[12 + blob + (blob & 1) :] == b"\x05\x00"
    assert payload[12 + 8 :][: len(name) + 1] == name.encode() + b"\0"
    assert len(payload) == 12 + blob + (blob & 1) + 2


def test_a_namespace_is_part_of_the_participant_name_and_of_the_topic(bench: Bench) -> None:
    client = bench.start()
    for call in (
        "init",
        "node 0 n /a/b",
        "publisher 0 0 Int32 ~/x reliable",
        "publisher 1 0 Int32 y reliable",
    ):
        client.ok(call)
    assert b"/a/b/n\0" in client.sent[1]
    assert b"rt/a/b/n/x\0" in client.sent[2]
    assert b"rt/a/b/y\0" in client.sent[5]


def test_write_data_on_both_streams(bench: Bench) -> None:
    client = bench.connected()
    client.ok("publisher 1 0 Int32 fast best_effort")
    client.sent.clear()
    client.ok("publish 0 -2")
    client.ok("publish 1 258")
    client.ok("publish 0 3")
    assert client.sent == [
        _bytes("81800000 07010800 00000005 feffffff"),
        _bytes("81010700 07010800 00000015 02010000"),
        _bytes("81800100 07010800 00000005 03000000"),
    ]


def test_deletion_in_reverse_order_and_goodbye(bench: Bench) -> None:
    client = bench.connected()
    client.ok("publisher_fini 0 0")
    client.ok("node_fini 0")
    client.ok("fini")
    assert [datagram[4:] for datagram in client.sent] == [
        _bytes("03010400 000f0005"),
        _bytes("03010400 00100003"),
        _bytes("03010400 00110002"),
        _bytes("03010400 00120001"),
        _bytes("03010400 0002fffe"),
    ]
    assert client.sent[-1][:4] == _bytes("81000000")


def test_serialized_message_goes_without_its_encapsulation(bench: Bench) -> None:
    client = bench.connected()
    client.ok("raw 0 8 1")
    assert client.sent[-1][8:] == _bytes("00000005 01020304")
    assert client.call("raw 0 8 0").code == 1
    assert client.call("raw 0 4 1").code == 1
    largest = POOL.streams.reliable_slot_size - 12 + 4
    assert client.call(f"raw 0 {largest} 1").code == 0
    assert client.call(f"raw 0 {largest + 1} 1").code == 1


def test_declared_entities_take_their_places(bench: Bench) -> None:
    client = bench.connected(DECLARED, qos="best_effort", topic="~/fast")
    assert client.ok("names 0 0").lines == ("names imu /arm /arm/imu/fast 77",)
    client.ok("publish 0 1")
    assert client.sent[-1][8:12] == _bytes("00000015"), "the second declared publisher has the second place"


def test_the_key_of_the_device(bench: Bench) -> None:
    client = bench.start(changed(POOL, session__client_key=None))
    client.ok("init")
    assert client.sent[0][16:20] == _bytes("feedbeef")
