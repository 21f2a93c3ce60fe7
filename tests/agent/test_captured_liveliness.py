# SPDX-License-Identifier: Apache-2.0
"""The public client with hard liveliness, as recorded: its CREATE_CLIENT and its answer are not as in the standard."""

from __future__ import annotations

from tests.support.agent.fakes import Bench

CREATE_CLIENT = (
    "80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f 00 a1 c1 0f 81 01 00 00 01 00 00 00 07 00 00 00"
    "75 78 72 5f 68 6c 00 00 07 00 00 00 30 30 32 30 30 30 00 e3 fc 01"
)
"""Property uxr_hl = 002000 (ms). The length of the submessage leaves the properties and the MTU out."""
ANSWER = "81 00 00 00 00 00 00 00 00 00 00 00"
"""What the client sends when the agent asks for its INFO: the payload of an INFO, without a submessage header."""


def test_properties_beyond_the_length_are_read() -> None:
    bench = Bench()
    assert bench.say(CREATE_CLIENT) == ["81 00 00 00 04 01 0b 00 00 00 58 52 43 45 01 00 01 0f 00"]
    (client,) = bench.agent.clients
    assert (client.timeout_s, client.session.link.mtu) == (2.0, 0x1FC)


def test_a_plain_create_client_ends_where_its_length_says() -> None:
    bench = Bench()
    plain = "80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f 00 a1 c1 0f 81 00 fc 01"
    assert bench.say(plain + "0d 03 ff ff") == [], "what follows is a submessage, and cut off"
    assert len(bench.say(plain)) == 1


def test_its_answer_is_a_sign_of_life_and_no_fault() -> None:
    bench = Bench()
    bench.say(CREATE_CLIENT)
    for _ in range(6):
        assert any(" 02 01 08 00 " in answer for answer in bench.wait(1.1)), "the agent asks"
        assert bench.say(ANSWER) == []
    assert "was silent" not in bench.text.getvalue()
    assert "malformed" not in bench.text.getvalue()
    bench.wait(2.5)
    assert "client 00A1C10F was silent for 2.0 s" in bench.text.getvalue()
