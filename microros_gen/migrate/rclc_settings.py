# SPDX-License-Identifier: Apache-2.0
"""The calls of an rclc application that are settings here: transport, session, memory."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.c_values import Unknown, Values
from microros_gen.migrate.draft import DraftValue, Remark, Setting, place
from microros_gen.migrate.rclc_calls import turns
from microros_gen.selection.component import Catalogue

_Groups = dict[str, dict[str, DraftValue]]
# Functions that return memory: for messages that are sent it comes from their storage, for others from the arena.
_TAKES_MEMORY = re.compile(
    r"micro_ros_utilities_create_message_memory|micro_ros_string_utilities_init\w*|\w+__(create|Sequence__init)"
)
_ARENA_ALONE = re.compile(r"micro_ros_utilities_type_info|\w+__Sequence__create")
_RECEIVES = re.compile(r"rclc?_(subscription|service|client)_init\w*")
# Lists of the ROS graph, whose length is that of the graph.
_LISTS_GRAPH = re.compile(r"rcl_get_((?!zero)\w+_names_and_types(_by_node)?|node_names|\w+_info_by_topic)")
_TRANSPORT = "transport_"
_CUSTOM = re.compile(r"rmw_uros_set_custom_transport|set_microros_\w+")
_ARENA = 4096
_GRAPH_ARENA = 16384
_MOST_ARENA = 1 << 20
# Function of an rcl_allocator_t that gives memory → how many arguments it has.
_ALLOCATES = {"allocate": 2, "zero_allocate": 3, "reallocate": 3}
# What has storage from the limits, unless there is an arena and nothing is said of messages.
_FROM_POOLS = re.compile(r"micro_ros_\w+|\w+__(create|assign\w*|copy|Sequence__init)")
_GUARDS_ARGUMENT = 2  # of rcl_wait_set_init
_BLOCK = 8  # the arena's unit: every piece is a multiple, after one more for its head


def _arena(calls: Sequence[Call], values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    """Give the default allocator what the calls take from it: of known sizes their sum, otherwise a guess."""
    receives = any(_RECEIVES.fullmatch(call.name) for call in calls)
    taking = [(call, _taken(call, values)) for call in calls if _is_of_allocator(call)]
    guessed = [call for call, size in taking if size is None]
    guessed += [
        call
        for call in calls
        if _ARENA_ALONE.fullmatch(call.name) or (receives and _TAKES_MEMORY.fullmatch(call.name))
    ]
    size = sum(size for _, size in taking if size is not None)
    size += _ARENA if guessed else 0
    listing = [call for call in calls if _LISTS_GRAPH.fullmatch(call.name)]
    guessed += listing
    size += _GRAPH_ARENA if listing else 0
    if not size:
        return
    first = guessed[0] if guessed else taking[0][0]
    groups["memory"] = {"arena": DraftValue(size, f"{first.name} ({place(first.span)})")}
    if not guessed and any(_FROM_POOLS.fullmatch(call.name) for call in calls):
        reason = "what is not of the allocator has storage from its limits"
        groups["memory"]["messages"] = DraftValue(1, reason)
    if guessed:
        text = f"{first.name} takes memory from `memory.arena`: {size} is a guess, it depends on the calls"
        remarks.append(Remark(text, first.span))


def _is_of_allocator(call: Call) -> bool:
    """Tell whether a call is one through an rcl_allocator_t: `a.allocate(size, a.state)`."""
    count = _ALLOCATES.get(call.name)
    return count == len(call.arguments) and [t.text for t in call.arguments[-1][-1:]] == ["state"]


def _taken(call: Call, values: Values) -> int | None:
    """Return how many bytes of the arena the call takes in all turns of its loops; None: not known."""
    total = 0
    for turn in turns(call, values):
        sizes = turn.arguments[1:2] if call.name == "reallocate" else turn.arguments[:-1]
        size = 1
        for argument in sizes:
            number = values.number(argument, turn)
            if isinstance(number, Unknown):
                return None
            size *= number
        total += _BLOCK * (1 + -(-size // _BLOCK))
    return total if 0 < total <= _MOST_ARENA else None


def transport_calls(catalogue: Catalogue) -> Mapping[str, str]:
    """Return the functions that set where the agent is, each with its type of transport."""
    return {
        option.function: component.name.removeprefix(_TRANSPORT)
        for component in catalogue.values()
        if component.name.startswith(_TRANSPORT)
        for option in component.contributes.init_options
    }


def find_settings(
    calls: Sequence[Call], values: Values, transports: Mapping[str, str], provided: Collection[str]
) -> tuple[Mapping[str, Mapping[str, DraftValue]], list[Remark]]:
    """Return what the sources say of transport, session and memory, and what of it is not known.

    `transports` are those of `transport_calls`, `provided` functions of the platform's package.
    """
    groups: dict[str, dict[str, DraftValue]] = {"transport": {}, "session": {}}
    remarks: list[Remark] = []
    for call in calls:
        reader = _SETTINGS.get(call.name)
        kind = transports.get(call.name, "custom" if _CUSTOM.fullmatch(call.name) else "")
        if kind:
            _set(groups["transport"], "type", kind, call)
        chosen = groups["transport"].get("type")
        if kind and chosen is not None and chosen.value != kind:
            text = (
                f"{call.name} is of the transport {kind}: `transport.type` has {chosen.value} ({chosen.note})"
            )
            remarks.append(Remark(text, call.span))
        elif reader:
            reader(call, values, groups, remarks)
        if call.name.startswith("set_microros_") and call.name not in provided:
            text = f"{call.name}() is of another library: here rmw_uros_set_custom_transport takes your four functions"
            remarks.append(Remark(text, call.span))
    _arena(calls, values, groups, remarks)
    groups["pools"] = _guard_conditions(calls, values)
    return {name: keys for name, keys in groups.items() if keys}, remarks


def _guard_conditions(calls: Sequence[Call], values: Values) -> dict[str, DraftValue]:
    """Return how many guard conditions there are or a wait set has room for: the larger number."""
    inits = [call for call in calls if call.name == "rcl_guard_condition_init"]
    found = [(len(inits), inits[-1])] if inits else []
    for call in calls:
        if call.name == "rcl_wait_set_init" and len(call.arguments) > _GUARDS_ARGUMENT:
            number = values.number(call.arguments[_GUARDS_ARGUMENT], call)
            found.append((number if isinstance(number, int) else 1, call))
    most, where = max(found, key=lambda counted: counted[0]) if found else (0, None)
    if not most or where is None:
        return {}
    return {"guard_conditions": DraftValue(most, f"{where.name} ({place(where.span)})")}


def _custom(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    framing = call.arguments[0][0].text if call.arguments and len(call.arguments[0]) == 1 else ""
    if framing in ("true", "false"):
        _set(groups["transport"], "framing", framing == "true", call)


def _address(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    if len(call.arguments) < 2:
        return
    host, port = (values.text(argument, call) for argument in call.arguments[:2])
    if isinstance(host, str) and isinstance(port, str):
        _set(groups["transport"], "agent", f"[{host}]:{port}" if ":" in host else f"{host}:{port}", call)
    else:
        reason = next(value.reason for value in (host, port) if isinstance(value, Unknown))
        remarks.append(Remark(f"the address of the agent: {reason}", call.span, undecided=False))


def _device(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    device = values.text(call.arguments[0], call) if call.arguments else Unknown("")
    if isinstance(device, str):
        _set(groups["transport"], "device", device, call)


def _key(call: Call, values: Values, groups: _Groups, remarks: list[Remark]) -> None:
    key = values.number(call.arguments[0], call) if call.arguments else Unknown("")
    if isinstance(key, int):
        _set(groups["session"], "key", key, call)


_SETTINGS: Mapping[str, Callable[[Call, Values, _Groups, list[Remark]], None]] = {
    "rmw_uros_set_custom_transport": _custom,
    "rmw_uros_options_set_udp_address": _address,
    "rmw_uros_options_set_tcp_address": _address,
    "rmw_uros_options_set_serial_device": _device,
    "rmw_uros_options_set_client_key": _key,
}


def _set(group: dict[str, DraftValue], key: str, value: Setting, call: Call) -> None:
    group.setdefault(key, DraftValue(value, place(call.span)))
