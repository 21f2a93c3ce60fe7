# SPDX-License-Identifier: Apache-2.0
"""How many parameters a server has, and what their names, texts and requests take."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.model import Application, LimitRule, ParameterDecl
from microros_gen.application.parameter_rules import words_of
from microros_gen.client.plan.declared import pool
from microros_gen.client.plan.features import PlanContext, refuse_own_limits, refuse_short_doubles
from microros_gen.components.parameters.constants import (
    LONGEST_TEXT,
    entries,
    has_floating_range,
    rules_of,
    string_limit,
    tables,
    texts_of,
)
from microros_gen.components.parameters.sizes import (
    ARRAYS,
    STRINGS,
    array_string_size,
    elements_of,
    longer_than_limits,
    sizes_above_limits,
    string_size,
)
from microros_gen.components.parameters.values import Identifiers, copies, members
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

DEFAULT_PARAMETERS = 4
"""What rclc_parameter_server_init_default of rclc has."""
_REASON = 104
"""Bytes of the longest words of rclc_parameter_reason.c, the types of two values included."""
_REASON_OF_ARRAY = 107
"""The same where a parameter can be an array: the names of those types are longer."""
_SHOWN_NUMBER = 20
"""Bytes of the longest number in a reason: an int64_t with its sign."""
_SHORTEST_PARAMETER = 48
"""Bytes of an rcl_interfaces/msg/Parameter in CDR at least."""
_PACKAGE, _HELD = "rcl_interfaces", "microros_parameter_msgs"
_NAMES = {"GetParameters": "values", "GetParameterTypes": "types", "DescribeParameters": "descriptors"}
"""Services that are asked for names, and the list of their response."""
_SETS = ("SetParameters", "SetParametersAtomically")


@dataclass(frozen=True)
class ServerPlan:
    """The parameter server of a node: what is declared for it, as C. Empty for a node that declares nothing.

    `index`: of the node.
    `symbol` begins the names; `members` of the struct of its values; `entries` are the parameters, with the constants
    `tables`; `copies` fill the struct.
    """

    index: int
    node: str
    symbol: str
    entries: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    members: tuple[str, ...] = ()
    copies: tuple[str, ...] = ()
    has_floating_range: bool = False


@dataclass(frozen=True, kw_only=True)
class ParametersPlan:
    """`max` parameters of a server; sizes are bytes, those of texts with the NUL.

    `string_size`: a value; 0 where none is a string. `array_size`: the elements of a value; 0 where none is an array.
    `strings_max`, `array_string_size`: of an array of strings.
    `request_size`: the largest request of all services; `outcomes_max`: how many parameters one can have at most.
    `held`: by a server elsewhere. `servers` has one entry for each node.
    `rules`: of generate_parameter_library: 2 with those of doubles, 1 without, 0 none; `shown_size`: of a text in a
    reason.
    """

    max: int
    name_size: int
    text_size: int
    string_size: int
    one_of: bool
    array_size: int
    strings_max: int
    array_string_size: int
    request_size: int
    outcomes_max: int
    held: bool = False
    servers: tuple[ServerPlan, ...] = ()
    rules: int = 0
    shown_size: int = 0

    @property
    def has_rules(self) -> bool:
        """Whether some parameter has a rule of generate_parameter_library."""
        return self.rules > 0

    @property
    def strings(self) -> str:
        """Return what a report says of strings and arrays."""
        strings = f", strings of {self.string_size}" if self.string_size else ""
        return f"{strings}, arrays of {self.array_size}" if self.array_size else strings

    @property
    def declared(self) -> tuple[ServerPlan, ...]:
        """Return the servers whose nodes declare parameters."""
        return tuple(server for server in self.servers if server.members)

    @property
    def has_declared(self) -> bool:
        """Whether some node declares parameters."""
        return bool(self.declared)

    @property
    def handles(self) -> int:
        """Handles of all servers: RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES each."""
        return (1 if self.held else 6) * len(self.servers)


def plan(context: PlanContext, diagnostics: Diagnostics) -> ParametersPlan:
    """Return the sizes; those of requests follow from the limits of their types."""
    application = context.application
    refuse_own_limits(context, "parameters", diagnostics)
    refuse_short_doubles(context, "parameters", diagnostics)
    _refuse_small_pools(application, 1 if context.selection.has("parameters_held") else 6, diagnostics)
    declared = [parameter for node in application.nodes for parameter in node.parameters]
    diagnostics.extend(longer_than_limits(application, declared, "the default"))
    diagnostics.extend(sizes_above_limits(application, declared))
    held = context.selection.has("parameters_held")
    requests = [TypeName(_PACKAGE, "srv", f"{name}_Request") for name in (*_NAMES, *_SETS, "ListParameters")]
    requests = [TypeName(_HELD, "srv", "Exchange_Request")] if held else requests
    largest = max(context.types[name].max_encoded_size for name in requests)
    return ParametersPlan(
        max=max(pool(application, "parameters", _count(application), diagnostics), _declared(application)),
        name_size=_longest(application, "name") + 1,
        text_size=_longest(application, "description") + 1,
        string_size=string_size(application),
        one_of=any(p.one_of for node in application.nodes for p in node.parameters),
        array_size=_array_size(application),
        strings_max=elements_of(application, "string[]"),
        array_string_size=array_string_size(application) + 1 if elements_of(application, "string[]") else 0,
        request_size=largest,
        outcomes_max=largest // _SHORTEST_PARAMETER + 1,
        held=held,
        servers=tuple(_servers(application)),
        rules=rules_of(_parameters(application)),
        shown_size=_shown_size(application),
    )


def _servers(application: Application) -> Iterator[ServerPlan]:
    names = Identifiers()
    for index, node in enumerate(application.nodes):
        full = node.full_name
        symbol = names.take(full.strip("/"))
        yield ServerPlan(
            index,
            full,
            symbol,
            tuple(entries(node.parameters, symbol)),
            tuple(tables(node.parameters, symbol)),
            tuple(members(node.parameters, array_string_size(application) + 1)),
            tuple(copies(node.parameters)),
            has_floating_range(node.parameters),
        )


def record(part: ParametersPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "max": part.max,
        "sizes": [part.name_size, part.text_size, part.string_size, part.request_size, part.outcomes_max],
        **({"one_of": True} if part.one_of else {}),
        **({"held": True} if part.held else {}),
        **({"rules": [part.rules, part.shown_size]} if part.rules else {}),
        **(
            {"arrays": [part.array_size, part.strings_max, part.array_string_size]} if part.array_size else {}
        ),
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what the services and the event exchange: a message may have every parameter."""
    count = max(application.pools.get("parameters", _count(application)), _declared(application))
    name, text = _longest(application, "name"), _longest(application, "description")
    node = max((len(node.namespace) + 1 + len(node.name) for node in application.nodes), default=1)
    rules = [
        _rule("msg/ParameterDescriptor", "name", name),
        *(_rule("msg/ParameterDescriptor", part, text) for part in ("description", "additional_constraints")),
        _rule("msg/Parameter", "name", name),
        _rule("msg/ParameterValue", "string_value", max(string_size(application) - 1, 0)),
        *(
            _rule("msg/ParameterValue", ARRAYS[kind][0], None, elements_of(application, kind))
            for kind in ARRAYS
        ),
        _strings_rule(application),
    ]
    if _is_held(application):
        rules += _held_rules(application, name, node, count)
    else:
        rules += _served_rules(name, node, count, _reason(application))
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)


def _served_rules(name: int, node: int, count: int, reason: int) -> tuple[LimitRule, ...]:
    """Return the limits of the six services and of the event."""
    return (
        *(_rule(f"srv/{service}_Request", "names", name, count) for service in _NAMES),
        *(_rule(f"srv/{service}_Response", part, None, count) for service, part in _NAMES.items()),
        *(_rule(f"srv/{service}_Request", "parameters", None, count) for service in _SETS),
        _rule("srv/SetParameters_Response", "results", None, count),
        _rule("msg/SetParametersResult", "reason", reason + name),
        _rule("srv/ListParameters_Request", "prefixes", name, count),
        *(_rule("msg/ListParametersResult", part, name, count) for part in ("names", "prefixes")),
        _rule("msg/ParameterEvent", "node", node),
        # An event has no more parameters than the server, whatever it says of each.
        _rule("msg/ParameterEvent", "new_parameters", None, 1),
        _rule("msg/ParameterEvent", "changed_parameters", None, count),
        _rule("msg/ParameterEvent", "deleted_parameters", None, 1),
    )


def _parameters(application: Application) -> tuple[ParameterDecl, ...]:
    return tuple(p for node in application.nodes for p in node.parameters)


def _shown_size(application: Application) -> int:
    """Return the bytes of the longest text that a reason shows of a value; 0: there are no rules."""
    declared = _parameters(application)
    if not any(p.rules for p in declared):
        return 0
    strings = [string_limit(p) for p in declared if p.rules and p.type == "string"]
    arrays = [array_string_size(application) for p in declared if p.rules and p.type == "string[]"]
    return max([_SHOWN_NUMBER, *strings, *arrays])


def _reason(application: Application) -> int:
    """Return the bytes of the longest reason without its name."""
    shown = _shown_size(application)
    words = (
        sum(len(part.encode()) for part in words_of(rule))
        for p in _parameters(application)
        for rule in p.rules
    )
    longest = _REASON_OF_ARRAY if _array_size(application) else _REASON
    return max([longest, *(size + shown for size in words)])


def _is_held(application: Application) -> bool:
    return any(node.parameters_at and node.parameters_at.name == "agent" for node in application.nodes)


def _held_rules(application: Application, name: int, node: int, count: int) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged with a server that holds the values; a page has at least a parameter."""
    declared = [p for n in application.nodes for p in n.parameters]

    def most(kind: str) -> int:
        return max((len(p.one_of) for p in declared if p.type == kind), default=0)

    longest = max((len(str(text).encode()) for p in declared for text in p.one_of), default=0)
    strings = longest if most("string") else 0
    return (
        _rule("srv/Exchange_Request", "parameters", None, count, _HELD),
        _rule("srv/Exchange_Response", "parameters", None, 1, _HELD),
        _rule("srv/Exchange_Response", "reason", _reason(application) + name, None, _HELD),
        _rule("msg/HeldParameter", "integers", None, most("integer"), _HELD),
        _rule("msg/HeldParameter", "doubles", None, most("double"), _HELD),
        LimitRule((f"{_HELD}/msg/HeldParameter", "strings"), strings, most("string")),
        _rule("msg/Notice", "node", node, None, _HELD),
    )


def _refuse_small_pools(application: Application, handles: int, diagnostics: Diagnostics) -> None:
    """Report pools that are too small for what is declared, and for the `handles` of a server in its executor."""
    needed = _declared(application)
    in_pool = application.pools.get("parameters", needed)
    if in_pool < needed:
        diagnostics.error(
            f"'pools.parameters' is {in_pool}, and a node declares {needed} parameters",
            application.spans.get("pools.parameters"),
            f"Set parameters: {needed} or more, or remove it",
            id="MG-7049",
        )
    in_pool = application.pools.get("handles", handles)
    if in_pool < handles:
        diagnostics.error(
            f"'pools.handles' is {in_pool}, and a parameter server needs {handles} handles of its executor",
            application.spans.get("pools.handles"),
            f"Set handles: {handles} or more, or remove it",
            id="MG-7050",
        )


def _declared(application: Application) -> int:
    return max((len(node.parameters) for node in application.nodes), default=0)


def _count(application: Application) -> int:
    return _declared(application) or DEFAULT_PARAMETERS


def _longest(application: Application, part: str) -> int:
    """Return the bytes of the longest name or description; with free places not below those of rclc."""
    declared = [p for node in application.nodes for p in node.parameters]
    texts = [p.name for p in declared] if part == "name" else [t for p in declared for t in texts_of(p)]
    is_free = application.pools.get("parameters", 0) > _declared(application) or not declared
    return max([LONGEST_TEXT if is_free else 0, *(len(text.encode()) for text in texts)])


def _array_size(application: Application) -> int:
    """Return the bytes of the elements of the largest array."""
    sizes = [elements_of(application, kind) * width for kind, (_, width) in ARRAYS.items()]
    strings = elements_of(application, "string[]") * (array_string_size(application) + 1)
    return max(*sizes, strings)


def _strings_rule(application: Application) -> LimitRule:
    count = elements_of(application, "string[]")
    return LimitRule(STRINGS, array_string_size(application) if count else 0, count)


def _rule(
    name: str, member: str, string: int | None, sequence: int | None = None, package: str = _PACKAGE
) -> LimitRule:
    """Return the limits of a member; one number for a sequence says nothing of what its elements have."""
    path = (f"{package}/{name}", member)
    return (
        LimitRule(path, string, sequence)
        if string is not None
        else LimitRule(path, sequence, sequence, single=True)
    )
