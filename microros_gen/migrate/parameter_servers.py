# SPDX-License-Identifier: Apache-2.0
"""Parameter servers in the sources → places for their parameters, and room for strings and arrays."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.c_tokens import Token
from microros_gen.migrate.c_values import Unknown, Values, handle_of, shown
from microros_gen.migrate.draft import DraftValue, Flow, Remark, place
from microros_gen.migrate.rclc_calls import turns

SERVERS = ("rclc_parameter_server_init_default", "rclc_parameter_server_init_with_option")
_ADDS = "rclc_add_parameter"
_SIZES = ("rclc_add_parameter_constraint_string", "rclc_add_parameter_constraint_array")
_TYPE = re.compile(r"RCLC_PARAMETER_(STRING|(?:BYTE|BOOL|INT|DOUBLE|STRING)_ARRAY)")
_MEMBERS = {
    "STRING": "string_value",
    "BYTE_ARRAY": "byte_array_value",
    "BOOL_ARRAY": "bool_array_value",
    "INT_ARRAY": "integer_array_value",
    "DOUBLE_ARRAY": "double_array_value",
    "STRING_ARRAY": "string_array_value",
}
_VALUE = "rcl_interfaces/msg/ParameterValue"
_USUAL = 4
"""Parameters of a server where nothing says how many."""
_STRING, _ELEMENTS = 49, 8
"""Bytes of a string as in rclc, and a guess for arrays, which rclc does not have."""
_MAX_MEMBER = 1
"""Place of `max_params` in rclc_parameter_options_t."""


def server_pools(calls: Sequence[Call], values: Values) -> Mapping[str, DraftValue]:
    """Return `parameters` where a server has more than without it: of its options, or of those that it adds."""
    found = [(number, call) for call in calls if (number := _largest(call, values)) is not None]
    adding = [call for call in calls if call.name == _ADDS and len(call.arguments) == 3]
    for server in dict.fromkeys(handle_of(call.arguments[0]) for call in adding):
        own = [call for call in adding if handle_of(call.arguments[0]) == server]
        found.append((sum(len(turns(call, values)) for call in own), own[0]))
    most, where = max(found, key=lambda pair: pair[0], default=(0, None))
    if most <= _USUAL or where is None:
        return {}
    return {"parameters": DraftValue(most, f"{where.name} ({place(where.span)})")}


def _largest(call: Call, values: Values) -> int | None:
    """Return `max_params` of the options of a server; None: it has none, or it is not known."""
    if call.name != SERVERS[1] or len(call.arguments) != 3:
        return None
    name = handle_of(call.arguments[2])
    assigned = [a.value for a in values.changes(name, call) if a.target == f"{name}.max_params"]
    start = values.before(name, call)
    if not assigned and start is not None:
        assigned = list(_member(start.value))
    number = values.number(assigned[-1], call) if assigned else Unknown("")
    return number if isinstance(number, int) else None


def _member(tokens: Sequence[Token]) -> Iterator[tuple[Token, ...]]:
    """Yield `max_params` of a list of values, by its name or its place."""
    parts, part = list[tuple[Token, ...]](), list[Token]()
    for token in tokens:
        if token.text in ("{", "}", ","):
            parts += [tuple(part)] if part else []
            part = []
        else:
            part.append(token)
    parts += [tuple(part)] if part else []
    for named in parts:
        if [token.text for token in named[:3]] == [".", "max_params", "="]:
            yield named[3:]
            return
    if len(parts) > _MAX_MEMBER and parts[_MAX_MEMBER][0].text != ".":
        yield parts[_MAX_MEMBER]


def server_limits(calls: Sequence[Call], values: Values) -> tuple[Mapping[str, DraftValue], list[Remark]]:
    """Return the room for values that are strings or arrays, where the program adds such parameters."""
    room: dict[str, int] = {}
    remarks = list[Remark]()
    first: Call | None = None
    for call in calls:
        added = call.name == _ADDS and len(call.arguments) == 3
        kind = _TYPE.fullmatch(shown(call.arguments[2])) if added else None
        if kind is None:
            continue
        first = first or call
        member = _MEMBERS[kind.group(1)]
        size = _size(call, calls, values)
        if size is None and member != "string_value":
            text = f"how many elements {shown(call.arguments[1])} has at most: {_ELEMENTS} is a guess"
            remarks.append(Remark(text, call.span))
        usual = _STRING if member == "string_value" else _ELEMENTS
        room[member] = max(room.get(member, 0), size if size is not None else usual)
    if first is None:
        return {}, []
    texts = [
        f"{member}: {{sequence: {number}, string: {_STRING}}}"
        if member == "string_array_value"
        else f"{member}: {number}"
        for member, number in room.items()
    ]
    note = f"{first.name} ({place(first.span)})"
    return {_VALUE: DraftValue(Flow(f"{{{', '.join(texts)}}}"), note)}, remarks


def _size(added: Call, calls: Sequence[Call], values: Values) -> int | None:
    """Return what the constraint of a parameter says."""
    for call in calls:
        if call.name in _SIZES and [*map(shown, call.arguments)][:2] == [*map(shown, added.arguments)][:2]:
            number = values.number(call.arguments[-1], call)
            if isinstance(number, int) and number > 0:
                return number
    return None
