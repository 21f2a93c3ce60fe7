# SPDX-License-Identifier: Apache-2.0
"""Bytes: what the public client and agent send, and every submessage there and back."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.agent.wire.cdr import Reader
from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.agent.wire.entity_messages import Acknack, Create, Heartbeat, Representation
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, join, split
from microros_gen.agent.wire.session_messages import AgentActivity, CreateClient, Info, Locator
from microros_gen.agent.wire.submessages import Submessage, decode, encode
from tests.support.agent import captured
from tests.support.agent.strategies import BY_NAME
from tests.support.examples import examples


def read(data: bytes) -> Submessage:
    ((identifier, flags, start, end),) = split(data, 0)
    return decode(identifier, flags, data, start, end)


@pytest.mark.parametrize("name", captured.SUBMESSAGES)
def test_captured_bytes_decode_and_encode_again(name: str) -> None:
    data = bytes.fromhex(captured.SUBMESSAGES[name])
    submessage = read(data)
    assert submessage.ID.name == name.split()[0]
    assert encode(submessage) == data


def test_the_meaning_of_captured_bytes() -> None:
    def of(name: str) -> Submessage:
        return read(bytes.fromhex(captured.SUBMESSAGES[name]))

    assert of("CREATE_CLIENT") == CreateClient(bytes.fromhex("a1b2c3d4"), 0x81, 508)
    participant = of("CREATE participant")
    blob = bytes.fromhex(captured.PARTICIPANT_BLOB)
    assert participant == Create(10, 0x11, 1, 3, blob, domain=77, reuse=True, replace=True)
    writer = of("CREATE datawriter")
    assert isinstance(writer, Create)
    assert (writer.request, writer.object, writer.parent) == (13, 0x15, 0x13)
    assert of("ACKNACK one missing") == Acknack(4, 1, 0x80)
    assert of("HEARTBEAT") == Heartbeat(7, 7, 0x80)
    info = of("INFO with locators")
    assert isinstance(info, Info)
    assert isinstance(info.activity, AgentActivity)
    assert info.activity.locators == (
        Locator(1, bytes((127, 0, 0, 1)), 8890),
        Locator(1, bytes((192, 0, 2, 2)), 8890),
    )


def test_every_submessage_has_a_strategy_and_captured_bytes() -> None:
    names = {member.name for member in SubmessageId}
    assert names == set(BY_NAME)
    assert names == {name.split()[0] for name in captured.SUBMESSAGES}


@pytest.mark.parametrize("name", BY_NAME)
@pytest.mark.parametrize("little", [True, False], ids=["little", "big"])
@settings(max_examples=examples(40), deadline=None)
@given(st.data())
def test_round_trip(name: str, little: bool, data: st.DataObject) -> None:
    submessage: Submessage = data.draw(BY_NAME[name])
    if isinstance(submessage, Create):
        submessage = replace(submessage, little=little)
    if isinstance(submessage, Info) and isinstance(submessage.config, Representation):
        submessage = replace(submessage, config=replace(submessage.config, little=little))
    message = encode(submessage, little)
    assert message[0] == SubmessageId[name]
    assert message[1] & 1 == little
    assert read(message) == submessage


@pytest.mark.parametrize("name", [n for n in BY_NAME if n not in ("WRITE_DATA", "DATA", "FRAGMENT", "RESET")])
@settings(max_examples=examples(20), deadline=None)
@given(st.data())
def test_a_truncated_payload_is_malformed(name: str, data: st.DataObject) -> None:
    drawn: Submessage = data.draw(BY_NAME[name])
    message = encode(drawn)
    size = data.draw(st.integers(4, len(message) - 1))
    with pytest.raises(MalformedError):
        decode(message[0], message[1], message, 4, size)


def test_byte_order_leaves_ids_and_keys_alone() -> None:
    big = encode(Create(0x0A0B, 0x0C11, 1, 3, b"", domain=0x0102), little=False)
    assert big == bytes.fromhex("01 00 0e 00 0a0b 0c11 01 03 0000 00000000 0102")


def test_headers() -> None:
    keyed = Header(0x01, 0x80, 0x1234, b"\xa1\xb2\xc3\xd4")
    assert keyed.encode() == bytes.fromhex("01 80 34 12 a1 b2 c3 d4")
    assert Header.decode(keyed.encode()) == keyed
    assert Header.decode(bytes.fromhex("81 01 02 00 ff")) == Header(0x81, 1, 2)
    for short in (b"", b"\x81\0\0", b"\x01\0\0\0\0\0\0"):
        with pytest.raises(MalformedError):
            header_size(short)


def test_submessages_begin_at_multiples_of_four_from_the_message_start() -> None:
    heartbeat = encode(Heartbeat(1, 2, 0x80))
    message = join(Header(0x81, 0, 0), [heartbeat, heartbeat])
    assert message == bytes.fromhex("81000000" + heartbeat.hex() + "000000" + heartbeat.hex())
    assert [span[2] for span in split(message, 4)] == [8, 20]


def test_a_payload_that_leaves_the_message_is_malformed() -> None:
    with pytest.raises(MalformedError, match="submessage_length"):
        split(bytes.fromhex("81000000 0b01 0600 0000000080"), 4)


def test_length_zero_takes_the_rest_only_when_asked_for() -> None:
    data = bytes.fromhex("07010000 000e0015 01020304")
    assert split(data, 0, rest_when_zero=True) == [(7, 1, 4, 12)]
    with pytest.raises(MalformedError):  # the data are read as the next submessage
        split(data, 0)


@pytest.mark.parametrize(
    ("payload", "kind"),
    [
        ("05000000 61626364 65", "string"),  # no NUL
        ("02000000 ff00", "string"),  # not UTF-8
        ("ffffffff 00", "truncated"),
    ],
)
def test_bad_strings(payload: str, kind: str) -> None:
    data = bytes.fromhex(payload)
    with pytest.raises(MalformedError) as caught:
        Reader(data, 0, len(data), True).string()
    assert caught.value.kind == kind


@pytest.mark.parametrize(
    ("submessage", "kind"),
    [
        ("10 01 00 00", "submessage_id"),
        ("01 07 08 00 000a 0011 01 04 0000", "representation"),
        ("01 07 0c 00 000a 001d 0d 03 0000 00000000", "object_kind"),
        ("00 01 10 00 58524345 0100 010f a1b2c3d4 81 02 fc01", "boolean"),
        ("06 01 09 00 000a fffd 0000 00 01 01", "info_kind"),
        ("06 01 16 00 000a fffd 0000 00 01 0d 00 0100 01000000 09 0000 0000 00", "locator"),
    ],
)
def test_malformed_payloads_name_their_kind(submessage: str, kind: str) -> None:
    with pytest.raises(MalformedError) as caught:
        read(bytes.fromhex(submessage))
    assert caught.value.kind == kind


@settings(max_examples=examples(300), deadline=None)
@given(st.binary(max_size=80), st.booleans())
def test_any_bytes_decode_or_are_malformed(data: bytes, whole: bool) -> None:
    with contextlib.suppress(MalformedError):
        for identifier, flags, start, end in split(data, header_size(data), whole):
            decode(identifier, flags, data, start, end)
