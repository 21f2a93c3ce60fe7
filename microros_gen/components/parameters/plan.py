# SPDX-License-Identifier: Apache-2.0
"""How many parameters a server has, and what their names, texts and requests take."""

from __future__ import annotations

import json
from collections.abc import Iterator

from microros_gen.application.model import Application, LimitRule, ParameterDecl
from microros_gen.client.plan.declared import pool
from microros_gen.client.plan.features import Given, refuse_own_limits
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

DEFAULT_PARAMETERS = 4
"""What rclc_parameter_server_init_default of rclc has."""
LONGEST_TEXT = 49
"""Bytes of a name or description without its NUL, as in rclc."""
_REASON = 104
"""Bytes of the longest words of rclc_parameter_reason.c, the types of two values included."""
_SHORTEST_PARAMETER = 48
"""Bytes of an rcl_interfaces/msg/Parameter in CDR at least."""
_PACKAGE = "rcl_interfaces"
_NAMES = {"GetParameters": "values", "GetParameterTypes": "types", "DescribeParameters": "descriptors"}
"""Services that are asked for names, and the list of their response."""
_SETS = ("SetParameters", "SetParametersAtomically")
_STRING_VALUE = (f"{_PACKAGE}/msg/ParameterValue", "string_value")
_KINDS = {"bool": "bool", "integer": "int", "double": "double", "string": "string"}
"""Type in the application file → as functions and constants of rclc call it."""
_ARRAYS = ("byte_array_value", "bool_array_value", "integer_array_value", "double_array_value")


@dataclass(frozen=True)
class ServerPlan:
    """The parameter server of a node in the example: the calls that follow its initialization, as C; `{}` is it."""

    calls: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class ParametersPlan:
    """`max` parameters of a server; sizes are bytes, those of texts with the NUL.

    `string_size`: a value; 0 where none is a string.
    `request_size`: the largest request of all services; `outcomes_max`: how many parameters one can have at most.
    `servers` has one entry for each node.
    """

    max: int
    name_size: int
    text_size: int
    string_size: int
    request_size: int
    outcomes_max: int
    servers: tuple[ServerPlan, ...] = ()

    @property
    def strings(self) -> str:
        """Return what a report says of strings."""
        return f", strings of {self.string_size}" if self.string_size else ""

    @property
    def handles(self) -> int:
        """Handles of all servers: RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES each."""
        return 6 * len(self.servers)


def plan(given: Given, diagnostics: Diagnostics) -> ParametersPlan:
    """Return the sizes; those of requests follow from the limits of their types."""
    application = given.application
    refuse_own_limits(given, "parameters", diagnostics)
    requests = [TypeName(_PACKAGE, "srv", f"{name}_Request") for name in (*_NAMES, *_SETS, "ListParameters")]
    largest = max(given.types[name].max_encoded_size for name in requests)
    return ParametersPlan(
        max=max(pool(application, "parameters", _count(application), diagnostics), _declared(application)),
        name_size=_longest(application, "name") + 1,
        text_size=_longest(application, "description") + 1,
        string_size=_string_size(application),
        request_size=largest,
        outcomes_max=largest // _SHORTEST_PARAMETER + 1,
        servers=tuple(ServerPlan(tuple(_calls(node.parameters))) for node in application.nodes),
    )


def record(part: ParametersPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "max": part.max,
        "sizes": [part.name_size, part.text_size, part.string_size, part.request_size, part.outcomes_max],
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what the services and the event exchange: a message may have every parameter."""
    count = max(application.pools.get("parameters", _count(application)), _declared(application))
    name, text = _longest(application, "name"), _longest(application, "description")
    node = max((len(node.namespace) + 1 + len(node.name) for node in application.nodes), default=1)
    rules = [
        *(_rule(f"srv/{service}_Request", "names", name, count) for service in _NAMES),
        *(_rule(f"srv/{service}_Response", part, None, count) for service, part in _NAMES.items()),
        *(_rule(f"srv/{service}_Request", "parameters", None, count) for service in _SETS),
        _rule("srv/SetParameters_Response", "results", None, count),
        _rule("msg/SetParametersResult", "reason", _REASON + name),
        _rule("srv/ListParameters_Request", "prefixes", name, count),
        *(_rule("msg/ListParametersResult", part, name, count) for part in ("names", "prefixes")),
        _rule("msg/ParameterDescriptor", "name", name),
        *(_rule("msg/ParameterDescriptor", part, text) for part in ("description", "additional_constraints")),
        _rule("msg/Parameter", "name", name),
        _rule("msg/ParameterValue", "string_value", max(_string_size(application) - 1, 0)),
        *(_rule("msg/ParameterValue", part, None, 0) for part in _ARRAYS),
        _rule("msg/ParameterValue", "string_array_value", 0, 0),
        _rule("msg/ParameterEvent", "node", node),
        # An event has no more parameters than the server, whatever it says of each.
        _rule("msg/ParameterEvent", "new_parameters", None, 1),
        _rule("msg/ParameterEvent", "changed_parameters", None, count),
        _rule("msg/ParameterEvent", "deleted_parameters", None, 1),
    ]
    given = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in given)


def _declared(application: Application) -> int:
    return max((len(node.parameters) for node in application.nodes), default=0)


def _count(application: Application) -> int:
    return _declared(application) or DEFAULT_PARAMETERS


def _longest(application: Application, part: str) -> int:
    """Return the bytes of the longest name or description, where nothing else than what is declared has a place."""
    if application.pools.get("parameters", 0) > _declared(application) or not _declared(application):
        return LONGEST_TEXT
    texts = (str(getattr(p, part)) for node in application.nodes for p in node.parameters)
    return max(len(text.encode()) for text in texts)


def _string_size(application: Application) -> int:
    """Return the bytes of the longest value with its NUL: what is declared, or the application's own limit."""
    own = next(
        (rule.string for rule in application.limits if rule.path == _STRING_VALUE and rule.string), None
    )
    sizes = [string_limit(p) for node in application.nodes for p in node.parameters if p.type == "string"]
    longest = own if own is not None else max(sizes, default=0)
    return longest + 1 if longest else 0


def string_limit(parameter: ParameterDecl) -> int:
    """Return the most bytes of a string, without the NUL."""
    return parameter.size or max(LONGEST_TEXT, len(str(parameter.default or "").encode()))


def _calls(parameters: tuple[ParameterDecl, ...]) -> Iterator[str]:
    """Yield the calls that add parameters and say what is declared of them."""
    for parameter in parameters:
        kind = _KINDS.get(parameter.type)
        if kind is None:
            continue
        name = json.dumps(parameter.name)
        yield f"rclc_add_parameter({{}}, {name}, RCLC_PARAMETER_{kind.upper()})"
        if parameter.type == "string":
            yield f"rclc_add_parameter_constraint_string({{}}, {name}, {string_limit(parameter)})"
        if parameter.default is not None:
            value = _literal(parameter.default, parameter.type)
            yield f"rclc_parameter_set_{kind}({{}}, {name}, {value})"
        if parameter.description:
            text = json.dumps(parameter.description, ensure_ascii=False)
            yield f'rclc_add_parameter_description({{}}, {name}, {text}, "")'
        if parameter.minimum is not None and parameter.maximum is not None:
            ends = (parameter.minimum, parameter.maximum, parameter.step or 0)
            numbers = ", ".join(_literal(end, parameter.type) for end in ends)
            yield f"rclc_add_parameter_constraint_{parameter.type}({{}}, {name}, {numbers})"
        if parameter.read_only:
            yield f"rclc_set_parameter_read_only({{}}, {name}, true)"


def _literal(value: bool | int | float | str, kind: str) -> str:
    if kind == "string":
        return json.dumps(value, ensure_ascii=False)
    if kind == "bool":
        return "true" if value else "false"
    return str(int(value)) if kind == "integer" else repr(float(value))


def _rule(name: str, member: str, string: int | None, sequence: int | None = None) -> LimitRule:
    """Return the limits of a member; one number for a sequence says nothing of what its elements have."""
    path = (f"{_PACKAGE}/{name}", member)
    return (
        LimitRule(path, string, sequence)
        if string is not None
        else LimitRule(path, sequence, sequence, single=True)
    )
