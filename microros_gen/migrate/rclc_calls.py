# SPDX-License-Identifier: Apache-2.0
"""The calls of rclc and rcl that create something → nodes, endpoints and timers, each with what is not known of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from microros_gen.application.kinds import KIND, NAMES
from microros_gen.migrate.c_program import Call, Tokens
from microros_gen.migrate.c_values import TypeSupport, Unknown, Values, handle_of, shown
from microros_gen.migrate.draft import DraftEndpoint, DraftNode, DraftQos, DraftTimer, Remark, Setting
from microros_gen.records import dataclass

_SENSOR_DATA: Mapping[str, Setting] = {"reliability": "best_effort", "depth": 5}
# Profile of rmw/qos_profiles.h → what differs from the default.
_PROFILES: Mapping[str, Mapping[str, Setting]] = {
    "rmw_qos_profile_default": {},
    "rmw_qos_profile_services_default": {},
    "rmw_qos_profile_system_default": {},
    "rmw_qos_profile_sensor_data": _SENSOR_DATA,
    "rmw_qos_profile_parameters": {"depth": 1000},
}
_POLICIES = {"reliability": ("reliable", "best_effort"), "durability": ("volatile", "transient_local"),
             "history": ("keep_last", "keep_all")}  # fmt: skip
_DEFAULTS: Mapping[str, Setting] = {
    **{policy: values[0] for policy, values in _POLICIES.items()},
    "depth": 10,
}
# Function → (kind, how its QoS is given: nothing, sensor data, as its fifth argument, inside of its options).
ENDPOINT_CALLS = {
    **{f"rclc_{kind}_init_default": (kind, "") for kind in NAMES},
    **{f"rclc_{kind}_init_best_effort": (kind, "sensor") for kind in NAMES},
    **{f"rclc_{kind}_init": (kind, "argument") for kind in NAMES},
    **{f"rcl_{kind}_init": (kind, "options") for kind in NAMES},
}
_MOST_TURNS = 64
NODE_CALLS = ("rclc_node_init_default", "rclc_node_init_with_options", "rcl_node_init")
# Function → which argument is the period.
TIMER_CALLS = {
    "rclc_timer_init_default": 2,
    "rclc_timer_init_default2": 2,
    "rcl_timer_init": 3,
    "rcl_timer_init2": 3,
}


@dataclass(frozen=True)
class FoundNode:
    """A node, and the variable that it is in."""

    handle: str
    draft: DraftNode
    call: Call


@dataclass(frozen=True)
class FoundEndpoint:
    """An endpoint, its variable, and that of its node."""

    handle: str
    node: str
    draft: DraftEndpoint
    call: Call


@dataclass(frozen=True)
class FoundTimer:
    """A timer and its variable."""

    handle: str
    draft: DraftTimer


def find_nodes(calls: Iterable[Call], values: Values) -> list[FoundNode]:
    """Return the nodes in the order of the sources."""
    return [_node(call, values) for call in calls if call.name in NODE_CALLS and len(call.arguments) >= 4]


def find_endpoints(calls: Iterable[Call], values: Values) -> list[FoundEndpoint]:
    """Return publishers, subscriptions, services and clients in the order of the sources.

    A call in a loop whose count is known gives one for each turn.
    """
    return [
        _endpoint(turn, values)
        for call in calls
        if call.name in ENDPOINT_CALLS and len(call.arguments) >= 4
        for alternative in _alternatives(call)
        for turn in turns(alternative, values)
    ]


def _alternatives(call: Call) -> list[Call]:
    """Return the call once for each branch of an `#if … #else` among its arguments: only one of them is compiled."""
    inside = [
        t.condition for argument in call.arguments for t in argument if t.condition != call.token.condition
    ]
    branches = list(dict.fromkeys(inside))
    if len(branches) < 2 or not any(branch.startswith("#el") for branch in branches):
        return [call]
    return [
        replace(
            call,
            arguments=tuple(
                tuple(t for t in argument if t.condition in (call.token.condition, branch))
                for argument in call.arguments
            ),
            token=replace(call.token, condition=branch),
        )
        for branch in branches
    ]


def turns(call: Call, values: Values) -> list[Call]:
    """Return a call for each turn of the loops around it, with numbers for their variables.

    The call itself where a count is not known, or too large to be a number of entities.
    """
    found = [call]
    for loop in call.loops:
        count = values.number(loop.limit, call)
        if isinstance(count, Unknown) or not 0 < count + loop.inclusive <= _MOST_TURNS:
            return [call]
        found = [
            _with(found_call, loop.variable, n) for found_call in found for n in range(count + loop.inclusive)
        ]
    return found if len(found) <= _MOST_TURNS else [call]


def _with(call: Call, variable: str, number: int) -> Call:
    """Return the call with a number in place of a variable."""
    arguments = tuple(
        tuple(replace(t, kind="number", text=str(number)) if t.text == variable else t for t in argument)
        for argument in call.arguments
    )
    return replace(call, arguments=arguments, turn=(*call.turn, number))


def find_timers(calls: Iterable[Call], values: Values) -> list[FoundTimer]:
    """Return the timers in the order of the sources, each with its own name."""
    found: list[FoundTimer] = []
    for call in calls:
        if call.name in TIMER_CALLS and len(call.arguments) > TIMER_CALLS[call.name]:
            found.append(_timer(call, values, [timer.draft.name for timer in found]))
    return found


def _node(call: Call, values: Values) -> FoundNode:
    remarks = list(_conditional(call))
    name = values.text(call.arguments[1], call)
    if isinstance(name, Unknown):
        remarks.append(Remark(f"the name of the node: {name.reason}", call.span))
    namespace = values.text(call.arguments[2], call)
    if isinstance(namespace, Unknown):
        remarks.append(Remark(f"the namespace of the node: {namespace.reason}", call.span))
    draft = DraftNode(
        name if isinstance(name, str) else "",
        namespace if isinstance(namespace, str) else "",
        span=call.span,
        remarks=tuple(remarks),
    )
    return FoundNode(handle_of(call.arguments[0]), draft, call)


def _endpoint(call: Call, values: Values) -> FoundEndpoint:
    kind, way = ENDPOINT_CALLS[call.name]
    remarks = list(_conditional(call))
    name = values.text(call.arguments[3], call)
    if isinstance(name, Unknown):
        remarks.append(Remark(f"the {KIND[kind].name_key} of the {kind}: {name.reason}", call.span))
    support = values.type_support(call.arguments[2], call)
    if isinstance(support, Unknown):
        remarks.append(Remark(f"the type of the {kind}: {support.reason}", call.span))
    elif support.kind != KIND[kind].type_kind:
        remarks.append(Remark(f"the type of the {kind} is {support}", call.span))
        support = Unknown("")
    qos, not_known = _qos(way, kind, call, values)
    remarks += not_known
    draft = DraftEndpoint(
        kind,
        name if isinstance(name, str) else "",
        str(support) if isinstance(support, TypeSupport) else "",
        DraftQos(qos),
        call.span,
        tuple(remarks),
    )
    return FoundEndpoint(handle_of(call.arguments[0]), handle_of(call.arguments[1]), draft, call)


def _timer(call: Call, values: Values, taken: Sequence[str]) -> FoundTimer:
    handle = handle_of(call.arguments[0])
    period = values.number(call.arguments[TIMER_CALLS[call.name]], call)
    remarks = list(_conditional(call))
    if isinstance(period, Unknown):
        remarks.append(Remark(f"the period of the timer: {period.reason}", call.span))
    name = name_of(handle, "timer", taken)
    known = period if isinstance(period, int) else None
    return FoundTimer(handle, DraftTimer(name, known, call.span, tuple(remarks)))


def name_of(handle: str, otherwise: str, taken: Sequence[str]) -> str:
    """Return a name for what is in the variable `handle`, other than those that are taken."""
    last = "".join(c if c.isalnum() and c.isascii() else "_" for c in handle.split(".")[-1].lower()).strip(
        "_"
    )
    base = last if last[:1].isalpha() else otherwise
    number, name = 1, base
    while name in taken:
        number += 1
        name = f"{base}_{number}"
    return name


def _conditional(call: Call) -> Iterable[Remark]:
    if call.token.condition:
        yield Remark(f"only with `{call.token.condition}`", call.span, undecided=False)


def _qos(way: str, kind: str, call: Call, values: Values) -> tuple[Mapping[str, Setting], list[Remark]]:
    """Return what differs from the default QoS, and what is not known of it."""
    if KIND[kind].service_type:
        return {}, []
    if way == "sensor":
        return _SENSOR_DATA, []
    if way == "" or len(call.arguments) < 5:
        return {}, []
    qos: Tokens = call.arguments[4]
    handle = handle_of(qos)
    if handle in _PROFILES:
        return _PROFILES[handle], []
    if not handle:
        return {}, [Remark(f"the QoS: `{shown(qos)}` is worked out when the program runs", call.span)]
    return _changed_qos(handle, ".qos" if way == "options" else "", call, values)


def _changed_qos(
    handle: str, member: str, call: Call, values: Values
) -> tuple[Mapping[str, Setting], list[Remark]]:
    """Return the QoS of a variable: what it starts with, and what is assigned to its members before the call."""
    start = values.before(handle + member, call) or values.before(handle, call)
    profile = handle_of(start.value) if start else ""
    if not member and profile not in _PROFILES:
        return {}, [Remark(f"the QoS: what `{handle}` starts with is not known here", call.span)]
    qos = {**_DEFAULTS, **_PROFILES.get(profile, {})}
    remarks: list[Remark] = []
    for change in values.changes(handle + member, call):
        policy = change.target.removeprefix(f"{handle}{member}.")
        value = _policy_value(policy, change.value, call, values)
        if value is None:
            remarks.append(Remark(f"the QoS: `{policy}` = `{shown(change.value)}`", change.span))
        else:
            qos[policy] = value
    # A depth of 0 asks for that of the system, which is the default here.
    return {p: value for p, value in qos.items() if value != _DEFAULTS[p] and value != 0}, remarks


def _policy_value(policy: str, value: Tokens, call: Call, values: Values) -> Setting | None:
    if policy == "depth":
        depth = values.number(value, call)
        return depth if isinstance(depth, int) else None
    name = value[0].text if len(value) == 1 else ""
    word = name.removeprefix(f"RMW_QOS_POLICY_{policy.upper()}_").lower()
    return word if word in _POLICIES.get(policy, ()) else None
