# SPDX-License-Identifier: Apache-2.0
"""Messages as UDP datagrams: written and read again; any other bytes are no message."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.recording.packets import (
    Datagram,
    Endpoint,
    decode,
    encode,
    endpoint,
    line_agent,
    line_client,
    line_number,
)

PORTS = st.integers(0, 65535)
PAIRS = st.one_of(
    *(
        st.tuples(*(st.builds(Endpoint, st.ip_addresses(v=version), PORTS) for _ in range(2)))
        for version in (4, 6)
    )
)


@given(places=PAIRS, message=st.binary(max_size=80))
def test_a_message_is_read_as_written(places: tuple[Endpoint, Endpoint], message: bytes) -> None:
    datagram = Datagram(*places, message)
    assert decode(encode(datagram)) == datagram


@pytest.mark.parametrize("host", ["127.0.0.1", "[::1]"])
def test_a_message_too_long_for_udp(host: str) -> None:
    """TCP and serial lines carry up to 65,535 bytes; the length fields are 0 then."""
    place = endpoint(f"{host}:8888")
    datagram = Datagram(place, place, bytes(65_535))
    assert decode(encode(datagram)) == datagram


def test_places() -> None:
    assert str(endpoint("127.0.0.1:8888")) == "127.0.0.1:8888"
    assert str(endpoint("[fe80::1%eth0]:7")) == "[fe80::1]:7"
    assert str(line_agent()) == "[fd58:5243:4500::1:0:0]:8888"
    assert str(line_client(0x1FFF_FFFF)) == "[fd58:5243:4500::1fff:ffff]:8888"
    assert line_number(line_client(0x1FFF_FFFF)) == 0x1FFF_FFFF


@given(st.binary(max_size=90), st.booleans())
def test_any_bytes(tail: bytes, wide: bool) -> None:
    head = bytes(12) + (b"\x86\xdd\x60" if wide else b"\x08\x00\x45")
    found = decode(head + tail)
    assert found is None or len(found.message) < len(tail)


def test_fragments_of_ip_are_no_messages() -> None:
    place = endpoint("127.0.0.1:8888")
    frame = bytearray(encode(Datagram(place, place, b"abc")))
    frame[20] |= 0x20  # more fragments
    assert decode(bytes(frame)) is None
