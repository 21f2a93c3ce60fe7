# SPDX-License-Identifier: Apache-2.0
"""Log of messages in both directions: one line each for -v; all submessages decoded and all bytes for -vv."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import fields, is_dataclass
from enum import IntEnum
from typing import Any

from microros_gen.agent.log import EventLog, Json, Level
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.transport.observed import ObservedTransport
from microros_gen.agent.wire.constants import DataFormat, Format, ObjectKind, Status, SubmessageId
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.submessages import decode

_HEXADECIMAL = ("object", "parent")
_STREAMS = ("stream", "session")
_LONGEST_BYTES = 32
"""Maximum bytes of a payload shown with its submessage; all bytes follow below."""


class TracedTransport(ObservedTransport):
    """A transport that writes every message to the log."""

    def __init__(self, inner: Transport, log: EventLog) -> None:
        super().__init__(inner)
        self._log = log

    def _observe(self, data: bytes, address: Hashable, inbound: bool) -> None:
        peer = self._inner.name_of(address)
        head = {"way": "from" if inbound else "to", "peer": peer, "transport": self.label}
        whole = self._log.shows(Level.TRACE)
        level = Level.TRACE if whole else Level.DEBUG
        text = "{way} {peer} {line}"
        if self._log.as_json:
            more = {**record(data), "bytes": data.hex()} if whole else {}
            self._log.emit(level, "message", text, **head, line=summary(data), **more)
            return
        for line in dump(data) if whole else [summary(data)]:
            self._log.emit(level, "message", text, **head, line=line)


def summary(data: bytes) -> str:
    """Return header and names of the submessages of a message in one line; never raises."""
    try:
        head = Header.decode(data)
        names = [_name(span[0]) for span in split(data, header_size(data))]
    except MalformedError as error:
        return f"malformed: {error}"
    place = f"session {head.session:#04x} stream {head.stream:#04x} sequence {head.sequence}"
    return f"{place}: {', '.join(names) or 'nothing'}"


def record(data: bytes) -> dict[str, Json]:
    """Return header and submessages of a message as data for JSON; never raises."""
    try:
        head = Header.decode(data)
        spans = split(data, header_size(data))
    except MalformedError as error:
        return {"malformed": str(error)}
    return {
        "session": head.session,
        "stream": head.stream,
        "sequence": head.sequence,
        "key": head.key.hex(),
        "submessages": [_submessage(data, *span) for span in spans],
    }


def dump(data: bytes) -> list[str]:
    """Return the summary, every submessage decoded, then all bytes, 16 a line; never raises."""
    lines = [summary(data)]
    submessages = record(data).get("submessages", [])
    for submessage in submessages if isinstance(submessages, list) else []:
        assert isinstance(submessage, dict)
        about = ", ".join(f"{key} {_text(value)}" for key, value in submessage.items() if key != "name")
        lines.append(f"  {submessage['name']}: {about}")
    for at in range(0, len(data), 16):
        row = data[at : at + 16]
        shown = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in row)
        lines.append(f"  {at:04x}  {row.hex(' '):<47}  {shown}")
    return lines


def _submessage(data: bytes, identifier: int, flags: int, start: int, end: int) -> dict[str, Json]:
    about: dict[str, Json] = {"name": _name(identifier), "flags": f"{flags:#04x}", "length": end - start}
    try:
        decoded = decode(identifier, flags, data, start, end)
    except MalformedError as error:
        return {**about, "malformed": str(error)}
    return {**about, **_fields(decoded)}


def _fields(value: Any) -> dict[str, Json]:
    """Return the fields of a dataclass other than None, by name; without the byte order."""
    found = ((field.name, getattr(value, field.name)) for field in fields(value))
    return {name: _value(value, name, item) for name, item in found if item is not None and name != "little"}


def _value(owner: Any, name: str, value: Any) -> Json:
    if isinstance(value, bytes):
        if isinstance(owner, Create) and owner.format != Format.BINARY:
            return repr(value.rstrip(b"\0").decode("utf-8", "replace"))
        shown = value[:_LONGEST_BYTES].hex(" ")
        return f"{shown} … ({len(value)} bytes)" if len(value) > _LONGEST_BYTES else shown
    if is_dataclass(value):
        return _fields(value)
    if isinstance(value, tuple):
        return [_value(owner, name, item) for item in value]
    if isinstance(value, bool) or not isinstance(value, int):
        return value if isinstance(value, bool | float) else str(value)
    if name in _HEXADECIMAL:
        kind = value & 0x0F
        return f"{value:#06x} ({ObjectKind(kind).name.lower()})" if kind in _KINDS else f"{value:#06x}"
    if name in _STREAMS:
        return f"{value:#04x}"
    words = _words(owner, name)
    return words(value).name if words is not None and value in list(words) else value


def _words(owner: Any, name: str) -> type[IntEnum] | None:
    """Return the enumeration of a field's values, or None."""
    if name == "kind":
        return ObjectKind if isinstance(owner, Create) else None
    if name == "format":
        return Format if isinstance(owner, Create) else DataFormat
    return Status if name == "status" else None


_KINDS = frozenset(int(kind) for kind in ObjectKind if kind)


def _text(value: Json) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} {_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_text(item) for item in value) + "]"
    return str(value)


def _name(identifier: int) -> str:
    known = identifier <= SubmessageId.TIMESTAMP_REPLY
    return SubmessageId(identifier).name if known else f"{identifier:#04x}"
