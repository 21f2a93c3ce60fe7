# SPDX-License-Identifier: Apache-2.0
"""The calls of an rclc application that are settings here: transport, session, memory."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from microros_gen.adopt.c_program import Call
from microros_gen.adopt.c_values import Unknown, Values
from microros_gen.model.draft import DraftValue, Remark, Setting, place

_Groups = dict[str, dict[str, DraftValue]]
# What hands memory out. For messages that are sent it has storage of its own; for others it comes from the arena.
_TAKES_MEMORY = re.compile(
    r"micro_ros_utilities_create_message_memory|micro_ros_string_utilities_init\w*|\w+__(create|Sequence__init)"
)
_ARENA_ALONE = re.compile(r"micro_ros_utilities_type_info|\w+__Sequence__create")
_RECEIVES = re.compile(r"rclc?_(subscription|service|client)_init\w*")
_ARENA = 4096


def _arena(calls: Iterable[Call], groups: _Groups, remarks: list[Remark]) -> None:
    calls = tuple(calls)
    receives = any(_RECEIVES.fullmatch(call.name) for call in calls)
    for call in calls:
        if _ARENA_ALONE.fullmatch(call.name) or (receives and _TAKES_MEMORY.fullmatch(call.name)):
            groups["memory"] = {"arena": DraftValue(_ARENA, f"{call.name} ({place(call.span)})")}
            text = (
                f"{call.name} takes memory from `memory.arena`: {_ARENA} is a guess, it depends on the calls"
            )
            remarks.append(Remark(text, call.span))
            return


def find_settings(
    calls: Sequence[Call], values: Values
) -> tuple[Mapping[str, Mapping[str, DraftValue]], list[Remark]]:
    """Return what the sources say of transport, session and memory, and what of it is not known."""
    groups: dict[str, dict[str, DraftValue]] = {"transport": {}, "session": {}}
    remarks: list[Remark] = []
    for call in calls:
        reader = _SETTINGS.get(call.name)
        if reader:
            reader(call, values, groups, remarks)
        elif call.name.startswith("set_microros_"):
            _set(groups["transport"], "type", "custom", call)
            text = f"{call.name}() is of another library: here rmw_uros_set_custom_transport takes your four functions"
            remarks.append(Remark(text, call.span))
    _arena(calls, groups, remarks)
    return {name: keys for name, keys in groups.items() if keys}, remarks


def _custom(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    _set(groups["transport"], "type", "custom", call)
    framing = call.arguments[0][0].text if call.arguments and len(call.arguments[0]) == 1 else ""
    if framing in ("true", "false"):
        _set(groups["transport"], "framing", framing == "true", call)


def _address(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    if len(call.arguments) < 2:
        return
    host, port = (values.text(argument, call) for argument in call.arguments[:2])
    if isinstance(host, str) and isinstance(port, str):
        _set(groups["transport"], "type", "udp", call)
        _set(groups["transport"], "agent", f"[{host}]:{port}" if ":" in host else f"{host}:{port}", call)
    else:
        reason = next(value.reason for value in (host, port) if isinstance(value, Unknown))
        remarks.append(Remark(f"the address of the agent: {reason}", call.span, undecided=False))


def _key(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    key = values.number(call.arguments[0], call) if call.arguments else Unknown("")
    if isinstance(key, int):
        _set(groups["session"], "key", key, call)


_SETTINGS: Mapping[str, Callable[[Call, Values, _Groups, list[Remark]], None]] = {
    "rmw_uros_set_custom_transport": _custom,
    "rmw_uros_options_set_udp_address": _address,
    "rmw_uros_options_set_client_key": _key,
}


def _set(group: dict[str, DraftValue], key: str, value: Setting, call: Call) -> None:
    group.setdefault(key, DraftValue(value, place(call.span)))
