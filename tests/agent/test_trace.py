# SPDX-License-Identifier: Apache-2.0
"""What -v and -vv show of messages: every submessage by its name, and something of any bytes."""

from __future__ import annotations

import io
import json
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.log import EventLog
from microros_gen.agent.trace import TracedTransport, dump, record, summary
from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.agent.wire.message import Header, join
from tests.support.agent import captured
from tests.support.agent.fakes import FakeTransport


def test_captured_messages_by_name() -> None:
    create = "81 80 00 00 01 07 1e 00 00 0a 00 11 01 03 00 00 10 00 00 00 00 01 00 00"
    create += " 08 00 00 00 6d 79 5f 6e 6f 64 65 00 4d 00 00 00"
    assert dump(bytes.fromhex(create))[:3] == [
        "session 0x81 stream 0x80 sequence 0: CREATE",
        "  CREATE: flags 0x07, length 30, request 10, object 0x0011 (participant), kind PARTICIPANT, format BINARY,"
        " body 00 01 00 00 08 00 00 00 6d 79 5f 6e 6f 64 65 00, parent 0x0000, domain 77, reuse True, replace True",
        "  0000  81 80 00 00 01 07 1e 00 00 0a 00 11 01 03 00 00  ................",
    ]
    reported: Any = record(bytes.fromhex(captured.CREATE_CLIENT))
    (client,) = reported["submessages"]
    assert client["name"] == "CREATE_CLIENT"
    assert client["key"] == "a1 b2 c3 d4"


def test_a_text_is_shown_as_text() -> None:
    """XML and names of references come from the network: nothing in them steers a terminal."""
    body = b"<dds>\x1b[2J</dds>\0"
    payload = bytes((0, 10, 0, 0x12, 2, 2, 0, 0)) + len(body).to_bytes(4, "little") + body + b"\0\x11"
    message = join(Header(0x81, 0x80, 1), [bytes((1, 7, len(payload), 0)) + payload])
    assert "body '<dds>\\x1b[2J</dds>'" in dump(message)[1]


@given(st.binary(max_size=120))
def test_any_bytes(data: bytes) -> None:
    lines = dump(data)
    assert lines[0] == summary(data)
    shown = [line for line in lines if line[2:6] == f"{0:04x}"]
    assert bool(shown) is bool(data)
    json.dumps(record(data))
    assert all(line.isprintable() for line in lines)


@given(st.sampled_from(list(SubmessageId)), st.binary(max_size=60), st.integers(0, 255))
def test_any_payload_of_any_submessage(kind: SubmessageId, payload: bytes, flags: int) -> None:
    message = join(Header(0x81, 1, 0), [bytes((kind, flags, len(payload), 0)) + payload])
    lines = dump(message)
    assert kind.name in lines[0]
    assert lines[1].startswith(f"  {kind.name}: flags {flags:#04x}, length {len(payload)}")
    json.dumps(record(message))


def test_both_ways_and_levels() -> None:
    ping = bytes.fromhex("8000000002010800000afffd02000000")
    for verbosity, as_json in ((0, False), (1, False), (2, False), (1, True), (2, True)):
        text = io.StringIO()
        TracedTransport(FakeTransport(), EventLog(text, as_json, verbosity)).send(ping, "peer")
        lines = text.getvalue().splitlines()
        assert len(lines) == {(0, False): 0, (1, False): 1, (2, False): 3}.get((verbosity, as_json), 1)
        if as_json:
            event = json.loads(lines[0])
            assert (event["event"], event["way"], event["peer"]) == ("message", "to", "peer")
            assert ("bytes" in event) is (verbosity == 2)
