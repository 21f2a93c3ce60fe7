# SPDX-License-Identifier: Apache-2.0
"""The calls of clients of parameters → the other nodes, with what is called and what its values need."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from microros_gen.application.model import ParameterClientDecl
from microros_gen.application.parameter_clients import ARRAYS
from microros_gen.migrate.c_program import Call, CFile
from microros_gen.migrate.c_values import Unknown, Values, handle_of
from microros_gen.migrate.draft import DraftClient, Flow, Remark, Setting
from microros_gen.migrate.rclc_calls import FoundNode
from microros_gen.records import dataclass

_PREFIX = "rclc_parameter_client_"
_OPENS = f"{_PREFIX}init_default"
_TYPED = {
    "bool": "",
    "int": "",
    "double": "",
    "string": "string",
    "byte_array": "byte[]",
    "bool_array": "bool[]",
    "int_array": "integer[]",
    "double_array": "double[]",
    "string_array": "string[]",
}
"""End of a function's name → the type of value in the application file; empty: it needs no size."""
_MEMBERS = {
    "string_value": "string",
    **{f"{kind.removesuffix('[]')}_array_value": kind for kind in ARRAYS},
}
"""Member of a value in C → its type."""
_OPERATIONS = {
    **{f"{call}{form}": call for call in ("get", "set", "set_atomically", "list") for form in ("", "_async")},
    **{f"{call}{form}": call for call in ("describe", "get_types") for form in ("", "_async")},
    **{f"{call}_{kind}": call for call in ("get", "set") for kind in _TYPED},
    "get_descriptor": "describe",
    "get_type": "get_types",
    "watch": "watch",
}
"""Function without its prefix → operation."""
_ORDER = ("get", "set", "set_atomically", "list", "describe", "get_types", "watch")
_SEVERAL = {f"{call}{form}" for call in (*_ORDER[:3], "describe", "get_types") for form in ("", "_async")}
"""Functions that get names or values, and as their third argument how many."""
_ANY_NUMBER = {"list", "watch"}
_ELEMENTS = 8
"""Proposed where nothing says how long the arrays of another node are."""
_DEFAULT = ParameterClientDecl("")


@dataclass(frozen=True)
class FoundClient:
    """A client, and the variable with its node."""

    node: str
    draft: DraftClient
    call: Call


def watches(calls: Iterable[Call]) -> bool:
    """Return whether the parameters of another node are watched."""
    return any(call.name == f"{_PREFIX}watch" for call in calls)


def find_clients(files: Iterable[CFile], calls: Iterable[Call], values: Values) -> list[FoundClient]:
    """Return the clients in the order of the sources; one that is opened again is there once."""
    calls = list(calls)
    opened = [call for call in calls if call.name == _OPENS and len(call.arguments) == 3]
    handles = {handle_of(call.arguments[0]) for call in opened}
    members = {token.text for file in files for token in file.text.tokens} & {*_MEMBERS}
    found: dict[tuple[str, str], FoundClient] = {}
    for call in opened:
        own = [used for used in calls if _is_of(used, handle_of(call.arguments[0]), handles)]
        client = _client(call, own, {_MEMBERS[name] for name in members}, values)
        found.setdefault((client.node, client.draft.node or str(call.span)), client)
    return list(found.values())


def owner(client: FoundClient, nodes: list[FoundNode]) -> int:
    """Return the index of the node that a client is of: the one in its variable, else the first."""
    return next((i for i, node in enumerate(nodes) if node.handle and node.handle == client.node), 0)


def _is_of(call: Call, handle: str, handles: set[str]) -> bool:
    """Return whether a call uses a client: what is called with another variable may be any of them."""
    if call.name.removeprefix(_PREFIX) not in _OPERATIONS or not call.name.startswith(_PREFIX):
        return False
    used = handle_of(call.arguments[0]) if call.arguments else ""
    return used == handle or used not in handles


def _client(call: Call, calls: list[Call], members: set[str], values: Values) -> FoundClient:
    remarks: list[Remark] = []
    name = values.text(call.arguments[2], call)
    if isinstance(name, Unknown):
        remarks.append(Remark(f"the other node: {name.reason}", call.span))
    if call.token.condition:
        remarks.append(Remark(f"only with `{call.token.condition}`", call.span, undecided=False))
    used = {_OPERATIONS[c.name.removeprefix(_PREFIX)] for c in calls} or {*_DEFAULT.operations}
    if used == {"watch"}:
        used = {"get", "watch"}  # an executor runs a client for a call
    settings: dict[str, Setting] = {"operations": Flow(f"[{', '.join(o for o in _ORDER if o in used)}]")}
    settings |= _count(calls, values, remarks)
    if used & {"get", "set", "set_atomically", "watch"}:
        settings |= _sizes(calls, members, values, remarks)
    if settings["operations"] == f"[{', '.join(_DEFAULT.operations)}]":
        del settings["operations"]
    draft = DraftClient(name if isinstance(name, str) else "", settings, call.span, tuple(remarks))
    return FoundClient(handle_of(call.arguments[1]), draft, call)


def _count(calls: list[Call], values: Values, remarks: list[Remark]) -> Mapping[str, Setting]:
    """Return the most parameters of a call; a list or an event may have as many as by default."""
    functions = {call.name.removeprefix(_PREFIX) for call in calls}
    open_ended = {_OPERATIONS[function] for function in functions} & _ANY_NUMBER
    most = _DEFAULT.parameters if open_ended or not functions else 1
    for call in calls:
        if call.name.removeprefix(_PREFIX) not in _SEVERAL or len(call.arguments) < 3:
            continue
        count = values.number(call.arguments[2], call)
        if isinstance(count, Unknown):
            remarks.append(Remark(f"how many parameters a call has: {count.reason}", call.span))
            most = max(most, _DEFAULT.parameters)
        else:
            most = max(most, count)
    return {} if most == _DEFAULT.parameters else {"parameters": most}


def _sizes(
    calls: list[Call], members: set[str], values: Values, remarks: list[Remark]
) -> Mapping[str, Setting]:
    """Return the types of values, and their sizes where these differ from the defaults."""
    kinds = members | {kind for call in calls if (kind := _kind(call))}
    settings: dict[str, Setting] = {}
    if kinds != {*_DEFAULT.types}:
        quoted = (f'"{kind}"' if "[" in kind else kind for kind in ("string", *ARRAYS) if kind in kinds)
        settings["types"] = Flow(f"[{', '.join(quoted)}]")
    texts = list(_texts(calls, values))
    longest = max((len(text.encode()) for text in texts), default=0)
    if longest > _DEFAULT.string:
        settings["string"] = longest
    if kinds & {*ARRAYS}:
        settings["elements"] = _elements(calls, values, remarks)
    return settings


def _kind(call: Call) -> str:
    function = call.name.removeprefix(_PREFIX)
    return _TYPED.get(function.removeprefix("get_").removeprefix("set_"), "")


def _texts(calls: Iterable[Call], values: Values) -> Iterator[str]:
    for call in calls:
        if call.name == f"{_PREFIX}set_string" and len(call.arguments) > 2:
            text = values.text(call.arguments[2], call)
            if isinstance(text, str):
                yield text


def _elements(calls: list[Call], values: Values, remarks: list[Remark]) -> int:
    """Return the elements of the largest array that is set; those that are received may be longer."""
    counts = [
        values.number(call.arguments[3], call)
        for call in calls
        if call.name.startswith(f"{_PREFIX}set_") and _kind(call).endswith("]") and len(call.arguments) > 3
    ]
    known = [count for count in counts if isinstance(count, int)]
    if len(known) == len(counts) and not any(_receives_arrays(call) for call in calls):
        return max(known, default=_ELEMENTS)
    most = max([*known, _ELEMENTS])
    reason = f"how many elements its arrays have is not in the sources: {most} are proposed"
    remarks.append(Remark(reason, calls[0].span if calls else None))
    return most


def _receives_arrays(call: Call) -> bool:
    function = call.name.removeprefix(_PREFIX)
    return function in ("get", "get_async", "watch") or (function[:4] == "get_" and _kind(call).endswith("]"))
