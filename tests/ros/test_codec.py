# SPDX-License-Identifier: Apache-2.0
"""The codec by itself: bytes made by hand, defaults, and what is refused."""

from __future__ import annotations

from typing import Any

import pytest

from microros_gen.interfaces.closure import InterfaceSet
from microros_gen.interfaces.types import Field, Message, Primitive, TypeName
from microros_gen.ros.codec import Codec
from microros_gen.ros.errors import CodecError

REPORT = "own_msgs/msg/Report"
EMPTY_REPORT: dict[str, Any] = {
    "here": {"x": 0.0, "y": -7},
    "trace": [],
    "corners": [{"x": 0.0, "y": -7}, {"x": 0.0, "y": -7}],
    "flags": [False, False, False],
    "key": b"\1\2\3\4",
    "raw": b"",
    "name": "abc",
    "wide": "",
    "notes": [],
    "count": 9,
    "large": [],
    "nothing": {},
}
FULL: dict[str, Any] = {
    "here": {"x": 1.0, "y": 2},
    "trace": [{"x": -2.0, "y": 3}],
    "corners": [{"x": 0.0, "y": 0}, {"x": 0.0, "y": 1}],
    "flags": [True, False, True],
    "key": b"\5\6\7\x08",
    "raw": b"\xff",
    "name": "äb",
    "wide": "a😀",
    "notes": ["", "n"],
    "count": 513,
    "large": [-1],
    "nothing": {},
}


def full_bytes(order: Any) -> bytes:
    """Return FULL by hand, with positions from the end of the header."""

    def number(value: int, size: int) -> bytes:
        return (value & (1 << 8 * size) - 1).to_bytes(size, order)

    one_bytes, minus_two = number(0x3FF0000000000000, 8), number(0xC000000000000000, 8)
    body = one_bytes + number(2, 2)  # here: 0 to 10
    body += bytes(2) + number(1, 4) + minus_two + number(3, 2)  # trace: 12, 16 to 26
    body += bytes(6) + bytes(8) + number(0, 2) + bytes(6) + bytes(8) + number(1, 2)  # corners: 32 to 58
    body += b"\1\0\1" + b"\5\6\7\x08"  # flags, key: to 65
    body += bytes(3) + number(1, 4) + b"\xff"  # raw: 68 to 73
    body += bytes(3) + number(4, 4) + "äb".encode() + b"\0"  # name: 76 to 84
    body += number(3, 4) + number(0x61, 4) + number(0xD83D, 4) + number(0xDE00, 4)  # wide: to 100
    body += number(2, 4) + number(1, 4) + b"\0" + bytes(3) + number(2, 4) + b"n\0"  # notes: to 118
    body += number(513, 2)  # count: to 120
    body += number(1, 4) + bytes(4) + number(-1, 8)  # large: 120, 128 to 136
    return (b"\0\1\0\0" if order == "little" else b"\0\0\0\0") + body + b"\0"  # nothing


def test_bytes_made_by_hand(own: InterfaceSet) -> None:
    codec = Codec(own)
    assert codec.encode(REPORT, FULL) == full_bytes("little")
    for order in ("little", "big"):
        assert codec.decode(REPORT, full_bytes(order)) == FULL
        assert codec.decode(TypeName("own_msgs", "msg", "Report"), full_bytes(order) + b"after it") == FULL


def test_missing_members_have_their_defaults(own: InterfaceSet) -> None:
    codec = Codec(own.messages)
    decoded = codec.decode(REPORT, codec.encode(REPORT, {}))
    assert decoded == EMPTY_REPORT
    assert list(decoded) == list(EMPTY_REPORT)
    assert codec.encode(REPORT, {"here": {"x": 0}, "key": [1, 2, 3, 4]}) == codec.encode(REPORT, EMPTY_REPORT)
    assert codec.encode("own_msgs/msg/Nothing", {}) == b"\0\1\0\0\0"


@pytest.mark.parametrize(
    ("value", "path", "reason"),
    [
        ({"heer": {}}, "", "unknown member 'heer'. Did you mean 'here'?"),
        ({"here": {"z": 1}}, "here", "unknown member 'z'"),
        ({"here": 3}, "here", "3 is not a message"),
        ({"here": None}, "here", "None is not a message"),
        ({"here": {"y": 32768}}, "here.y", "32768 is not an int16 (-32768 to 32767)"),
        ({"here": {"y": 1.0}}, "here.y", "1.0 is not an int16"),
        ({"here": {"x": "1"}}, "here.x", "'1' is not a float64"),
        ({"here": {"x": 10**400}}, "here.x", "is not a float64"),
        ({"count": -1}, "count", "-1 is not a uint16 (0 to 65535)"),
        ({"trace": {}}, "trace", "{} is not a list"),
        ({"trace": 4}, "trace", "4 is not a list"),
        ({"trace": [{}, {"y": "a"}]}, "trace[1].y", "'a' is not an int16"),
        ({"trace": [{}, {"why": 1}]}, "trace[1]", "unknown member 'why'"),
        ({"trace": ["a"]}, "trace[0]", "'a' is not a message"),
        ({"corners": [{}]}, "corners", "1 elements are not 2"),
        ({"flags": [True, 1, True]}, "flags[1]", "1 is not True or False"),
        ({"flags": [True]}, "flags", "1 elements are not 3"),
        ({"key": b"123"}, "key", "3 elements are not 4"),
        ({"key": [1, 2, 256, 4]}, "key[2]", "256 is not a uint8 (0 to 255)"),
        ({"raw": 5}, "raw", "5 is not a list"),
        ({"raw": "text"}, "raw", "'text' is not a list"),
        ({"name": "äöü"}, "name", "6 bytes are more than its bound, 5"),
        ({"name": b"abc"}, "name", "is not a string"),
        ({"name": "a\0b"}, "name", "NUL"),
        ({"wide": "\ud800"}, "wide", "half of a surrogate pair"),
        ({"notes": ["", 1]}, "notes[1]", "1 is not a string"),
        ({"notes": ["", "", ""]}, "notes", "3 elements are more than its bound, 2"),
        ({"large": [0, 1 << 63]}, "large[1]", "9223372036854775808 is not an int64"),
    ],
)
def test_values_that_do_not_fit_are_refused_by_name(
    own: InterfaceSet, value: dict[str, Any], path: str, reason: str
) -> None:
    with pytest.raises(CodecError) as caught:
        Codec(own).encode(REPORT, value)
    assert caught.value.path == path
    assert reason in str(caught.value)
    assert str(caught.value).startswith(f"{REPORT}: {path}")


def test_every_truncation_is_refused_with_the_first_member_that_is_missing(own: InterfaceSet) -> None:
    codec = Codec(own)
    data = full_bytes("little")
    assert len(data) == 4 + 137
    found: list[str] = []
    for size in range(len(data)):
        with pytest.raises(CodecError) as caught:
            codec.decode(REPORT, data[:size])
        if not found or found[-1] != caught.value.path:
            found.append(caught.value.path)
    assert found == [
        *("", "here.x", "here.y", "trace", "trace[0].x", "trace[0].y", "corners", "corners[0].x"),
        *("corners[0].y", "corners[1].x", "corners[1].y", "flags", "key", "raw", "name", "wide", "notes"),
        *("notes[0]", "notes[1]", "count", "large", ""),
    ]


@pytest.mark.parametrize(
    ("at", "new", "path", "reason"),
    [
        (12, b"\xff\xff\xff\xff", "trace", "4294967295 bytes are needed"),
        (68, b"\xff\xff\xff\x7f", "raw", "2147483647 bytes are needed"),
        (76, b"\x08\0\0\0", "name", "7 bytes are more than its bound, 5"),
        (84, b"\xff\xff\xff\xff", "wide", "bytes are needed"),
        (88, b"\0\0\1\0", "wide", "0x10000 is not a unit of UTF-16"),
        (100, b"\3\0\0\0", "notes", "3 elements are more than its bound, 2"),
        (120, b"\xff\xff\xff\xff", "large", "bytes are needed"),
    ],
)
def test_bytes_that_do_not_fit_are_refused_by_name(
    own: InterfaceSet, at: int, new: bytes, path: str, reason: str
) -> None:
    data = bytearray(full_bytes("little").replace("äb".encode(), b"abc"))
    data[4 + at : 4 + at + len(new)] = new
    if path == "name":
        data[4 + 80 : 4 + 88] = b"abcdefg\0"
    with pytest.raises(CodecError) as caught:
        Codec(own).decode(REPORT, bytes(data))
    assert caught.value.path == path
    assert reason in caught.value.reason


@pytest.mark.parametrize(
    "header", [b"", b"\0", b"\0\1\0", b"\0\2\0\0", b"\0\3\0\0", b"\0\7\0\0", b"\1\1\0\0"]
)
def test_other_encapsulations_are_refused(own: InterfaceSet, header: bytes) -> None:
    with pytest.raises(CodecError, match="is not an encapsulation header of plain CDR"):
        Codec(own).decode(REPORT, header + full_bytes("little")[4:] if len(header) == 4 else header)


def test_types_that_are_not_there(own: InterfaceSet) -> None:
    for text in ("own_msgs/msg/Other", "own_msgs/Report", "", "own_msgs/srv/Add"):
        with pytest.raises(CodecError, match="is not a message of these interfaces"):
            Codec(own).encode(text, {})
    name = TypeName("own_msgs", "msg", "Report")
    with pytest.raises(CodecError, match="here: its type own_msgs/msg/Point is not among"):
        Codec({name: own.messages[name]}).encode(name, {})
    wide = Message(TypeName("a", "msg", "Wide"), (Field("exact", Primitive.LONG_DOUBLE),))
    with pytest.raises(CodecError, match="exact: long double"):
        Codec({wide.name: wide}).decode(wide.name, b"\0\1\0\0")


def test_strings_are_read_as_ros_2_reads_them(own: InterfaceSet) -> None:
    """No byte at all, no NUL at the end, a NUL within, and what is no UTF-8."""
    codec = Codec(own)
    whole = codec.encode("own_msgs/srv/Add_Response", {"sum": 1})[:-4]
    data = whole + bytes.fromhex("04000000 00000000 02000000 6162 0000 04000000 61006200 02000000 ff00")
    assert codec.decode("own_msgs/srv/Add_Response", data) == {"sum": 1, "notes": ["", "ab", "a", "\ufffd"]}
