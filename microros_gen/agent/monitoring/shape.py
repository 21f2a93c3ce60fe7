# SPDX-License-Identifier: Apache-2.0
"""What an answer of version 1 (`document`) has at least: keys, and the kind of each value.

The other end of a socket may be any program, so nothing of its answer is used before it is compared.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

_LARGEST = 1 << 80
"""More than any counter; a larger number could not be shown."""
_NUMBER, _TEXT, _BOOL, _NUMBERS = "a number", "a text", "true or false", "numbers"
_OPTIONAL = "a number or null"
_DIRECTION = dict.fromkeys(("messages", "bytes", "messages_per_s", "bytes_per_s"), _NUMBER)
_CLIENT = {
    **dict.fromkeys(("name", "key", "state", "transport", "address", "last_error"), _TEXT),
    **dict.fromkeys(("silent_s", "lost", "resent", "repeated"), _NUMBER),
    **dict.fromkeys(("sessions", "reconnects", "silences", "denied"), _NUMBER),
    "round_trip_s": _OPTIONAL,
    "received": _DIRECTION,
    "sent": _DIRECTION,
    "queue": dict.fromkeys(("fill", "messages", "bytes", "input_bytes"), _NUMBER),
    "nodes": [_TEXT],
    "worker": _OPTIONAL,
}
_AGENT = {
    "pid": _NUMBER,
    "version": _TEXT,
    "core": _TEXT,
    "started": _NUMBER,
    "uptime_s": _NUMBER,
    "domain": _OPTIONAL,
    "transports": [{"kind": _TEXT, "address": _TEXT, "ready": _BOOL}],
    "clients_max": _NUMBER,
    "samples": {"from_clients": _NUMBER, "to_clients": _NUMBER},
    "faults": _NUMBERS,
    "workers": [{"number": _NUMBER, "pid": _NUMBER, "ready": _BOOL, "restarts": _NUMBER}],
}
_DOCUMENT: Mapping[str, Any] = MappingProxyType({"version": _NUMBER, "agent": _AGENT, "clients": [_CLIENT]})


def fault_of(document: Mapping[str, Any]) -> str:
    """Return the first thing that a document lacks, with its place (`clients[0].queue.fill`); empty: nothing."""
    return _fault(document, _DOCUMENT, "")


def _fault(value: Any, wanted: Any, place: str) -> str:
    if isinstance(wanted, Mapping):
        if not isinstance(value, dict):
            return f"{place or 'it'} is no object"
        for key, part in wanted.items():
            inner = f"{place}.{key}" if place else key
            fault = _fault(value[key], part, inner) if key in value else f"it lacks {inner}"
            if fault:
                return fault
        return ""
    if isinstance(wanted, list):
        if not isinstance(value, list):
            return f"{place} is no list"
        faults = (_fault(item, wanted[0], f"{place}[{index}]") for index, item in enumerate(value))
        return next(filter(None, faults), "")
    return "" if _fits(value, wanted) else f"{place} is not {wanted}"


def _fits(value: Any, wanted: str) -> bool:
    if wanted == _NUMBERS:
        return isinstance(value, dict) and all(map(_is_number, value.values()))
    if wanted == _TEXT:
        return isinstance(value, str)
    if wanted == _BOOL:
        return isinstance(value, bool)
    return _is_number(value) or (wanted == _OPTIONAL and value is None)


def _is_number(value: Any) -> bool:
    return (
        isinstance(value, int | float)
        and not isinstance(value, bool)
        and (isinstance(value, int) or math.isfinite(value))
        and abs(value) < _LARGEST
    )
