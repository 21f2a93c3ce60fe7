# SPDX-License-Identifier: Apache-2.0
"""The endpoints of clients of parameters, and what their messages take."""

from __future__ import annotations

from collections.abc import Iterator

from microros_gen.application.model import Application, EndpointDecl, LimitRule, NodeDecl, Qos
from microros_gen.client.plan.features import PlanContext, refuse_own_limits, refuse_short_doubles
from microros_gen.components.parameter_client.sizes import VALUE_TYPES, largest
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

LONGEST_NAME = 49
"""Bytes of a parameter's name where the application has no limit, as a server's."""
LONGEST_REASON = 153
"""Bytes of a reason for which a node refuses a value: the longest of rclcpp with such a name."""
_PACKAGE = "rcl_interfaces"
EVENTS = "/parameter_events"
_EVENT = f"{_PACKAGE}/msg/ParameterEvent"
_EVENT_QOS = Qos(depth=1000)
"""rmw_qos_profile_parameter_events: other events wait at the agent."""


@dataclass(frozen=True)
class Service:
    """A call: its number is the place in SERVICES. `writes`, `reads`: what its request and response consist of."""

    call: str
    type: str
    writes: str
    reads: str

    @property
    def name(self) -> str:
        """The service below the name of the other node."""
        others = {"set_atomically": "set_parameters_atomically", "get_types": "get_parameter_types"}
        return others.get(self.call, f"{self.call}_parameters")

    @property
    def header(self) -> str:
        """The header of its type."""
        return f"{self.name}.h"


SERVICES = (
    Service("get", "GetParameters", "names", "values"),
    Service("set", "SetParameters", "parameters", "results"),
    Service("set_atomically", "SetParametersAtomically", "parameters", "result"),
    Service("list", "ListParameters", "prefixes", "names"),
    Service("describe", "DescribeParameters", "names", "descriptors"),
    Service("get_types", "GetParameterTypes", "names", "types"),
)


@dataclass(frozen=True)
class Remote:
    """Another node: its fully qualified name, the index of the own node, and what is done with its parameters."""

    name: str
    node: int
    operations: tuple[str, ...]

    @property
    def calls(self) -> tuple[str, ...]:
        """Return the names of the calls in C, in the order of SERVICES."""
        return tuple(service.call.upper() for service in SERVICES if service.call in self.operations)


@dataclass(frozen=True, kw_only=True)
class ParameterClientPlan:
    """Sizes are bytes, with the NUL of a text. `parameters` of a call; `types` of values; `elements` of an array."""

    remotes: tuple[Remote, ...]
    services: tuple[Service, ...]
    parameters: int
    types: tuple[str, ...]
    elements: int
    name_size: int
    string_size: int
    message_size: int
    watches: bool

    @property
    def count(self) -> int:
        """Return the number of clients."""
        return len(self.remotes)

    @property
    def node_size(self) -> int:
        """Return the bytes of the longest name of another node."""
        return max((len(remote.name) for remote in self.remotes), default=0) + 1

    @property
    def type_bits(self) -> int:
        """Return a bit of rcl_interfaces/msg/ParameterType for each type."""
        return sum(1 << VALUE_TYPES[kind] for kind in self.types)

    @property
    def strings(self) -> int:
        """Return the strings of an array."""
        return self.elements if "string[]" in self.types else 0

    @property
    def gets(self) -> bool:
        """Return whether a client gets."""
        return self._has("get")

    @property
    def sets(self) -> bool:
        """Return whether a client sets."""
        return self._has("set")

    @property
    def sets_atomically(self) -> bool:
        """Return whether a client sets several parameters or none."""
        return self._has("set_atomically")

    @property
    def any_sets(self) -> bool:
        """Return whether a client sets in any way."""
        return self.sets or self.sets_atomically

    @property
    def lists(self) -> bool:
        """Return whether a client lists."""
        return self._has("list")

    @property
    def describes(self) -> bool:
        """Return whether a client gets descriptors."""
        return self._has("describe")

    @property
    def gets_types(self) -> bool:
        """Return whether a client gets types."""
        return self._has("get_types")

    @property
    def any_names(self) -> bool:
        """Return whether a client asks for something of names that a node may not know."""
        return self.gets or self.describes or self.gets_types

    def _has(self, call: str) -> bool:
        return any(service.call == call for service in self.services)


def endpoints(node: NodeDecl) -> Iterator[EndpointDecl]:
    """Yield the endpoints of the clients of a node. One of each client has its handle in an executor."""
    for client in node.parameter_clients:
        called = [service for service in SERVICES if service.call in client.operations]
        for service in called:
            yield EndpointDecl(
                *("client", f"{client.node}/{service.name}", f"{_PACKAGE}/srv/{service.type}"),
                queue=1,
                stored=False,
                of_the_library=True,
                executed=service is called[0],
                span=client.span,
            )
    watched = next((client for client in node.parameter_clients if "watch" in client.operations), None)
    if watched is not None:
        yield EndpointDecl(
            *("subscription", EVENTS, _EVENT, _EVENT_QOS),
            queue=1,
            stored=False,
            of_the_library=True,
            span=watched.span,
        )


def plan(context: PlanContext, diagnostics: Diagnostics) -> ParameterClientPlan:
    """Return the sizes: those of messages follow from the limits of their types."""
    application = context.application
    refuse_own_limits(context, "parameter_client", diagnostics)
    refuse_short_doubles(context, "parameter_client", diagnostics)
    remotes = tuple(
        Remote(client.node, index, client.operations)
        for index, node in enumerate(application.nodes)
        for client in node.parameter_clients
    )
    if not remotes:
        message = "the component 'parameter_client' has no client: no node declares another one"
        span = application.spans.get("components") or application.spans.get("profiles")
        hint = "Add to a node: `parameter_clients: [{node: /motor}]`"
        diagnostics.error(message, span, hint, id="MG-7090")
    used = {operation for remote in remotes for operation in remote.operations}
    services = tuple(service for service in SERVICES if service.call in used)
    received = [TypeName(_PACKAGE, "srv", f"{service.type}_Response") for service in services]
    if "watch" in used:
        received.append(TypeName(_PACKAGE, "msg", "ParameterEvent"))
    return ParameterClientPlan(
        remotes=remotes,
        services=services,
        parameters=_most(application, "parameters"),
        types=_types(application),
        elements=_most(application, "elements"),
        name_size=LONGEST_NAME + 1,
        string_size=_string(application) + 1,
        message_size=max((largest(context.types, name) for name in received), default=0),
        watches="watch" in used,
    )


def record(part: ParameterClientPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "remotes": [
            [remote.name, remote.node, list(remote.calls), "watch" in remote.operations]
            for remote in part.remotes
        ],
        "sizes": [part.parameters, part.elements, part.name_size, part.string_size, part.message_size],
        "types": part.type_bits,
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged, which the declarations of the clients have."""
    clients = [client for node in application.nodes for client in node.parameter_clients]
    used = {operation for client in clients for operation in client.operations}
    count = _most(application, "parameters")
    rules = [*_values(application)] if used & {"get", "set", "set_atomically", "watch"} else []
    if "get" in used:
        rules.append(_rule("srv/GetParameters_Request", "names", LONGEST_NAME, count))
        rules.append(_rule("srv/GetParameters_Response", "values", None, count))
    if "set" in used:
        rules.append(_rule("srv/SetParameters_Request", "parameters", None, count))
        rules.append(_rule("srv/SetParameters_Response", "results", None, count))
    if "set_atomically" in used:
        rules.append(_rule("srv/SetParametersAtomically_Request", "parameters", None, count))
    if used & {"set", "set_atomically"}:
        rules.append(_rule("msg/SetParametersResult", "reason", LONGEST_REASON))
    if "list" in used:
        rules.append(_rule("srv/ListParameters_Request", "prefixes", LONGEST_NAME, count))
        rules += [
            _rule("msg/ListParametersResult", part, LONGEST_NAME, count) for part in ("names", "prefixes")
        ]
    if "describe" in used:
        rules += _descriptors(count, _most(application, "description"))
    if "get_types" in used:
        rules.append(_rule("srv/GetParameterTypes_Request", "names", LONGEST_NAME, count))
        rules.append(_rule("srv/GetParameterTypes_Response", "types", None, count))
    if "watch" in used:
        rules += _event(max(len(client.node) for client in clients), count)
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)


def _values(application: Application) -> Iterator[LimitRule]:
    """Yield the limits of a value: 0 for the types that no client has."""
    types, string, elements = _types(application), _string(application), _most(application, "elements")
    yield _rule("msg/Parameter", "name", LONGEST_NAME)
    yield _rule("msg/ParameterValue", "string_value", string if "string" in types else 0)
    for kind in ("byte", "bool", "integer", "double"):
        size = elements if f"{kind}[]" in types else 0
        yield _rule("msg/ParameterValue", f"{kind}_array_value", None, size)
    size = elements if "string[]" in types else 0
    yield _rule("msg/ParameterValue", "string_array_value", string if size else 0, size)


def _descriptors(count: int, text: int) -> Iterator[LimitRule]:
    yield _rule("srv/DescribeParameters_Request", "names", LONGEST_NAME, count)
    yield _rule("srv/DescribeParameters_Response", "descriptors", None, count)
    yield _rule("msg/ParameterDescriptor", "name", LONGEST_NAME)
    for member in ("description", "additional_constraints"):
        yield _rule("msg/ParameterDescriptor", member, text)


def _event(node: int, count: int) -> Iterator[LimitRule]:
    yield _rule("msg/ParameterEvent", "node", node)
    yield _rule("msg/ParameterEvent", "new_parameters", None, 1)
    yield _rule("msg/ParameterEvent", "changed_parameters", None, count)
    yield _rule("msg/ParameterEvent", "deleted_parameters", None, 1)


def _types(application: Application) -> tuple[str, ...]:
    """Return the types of values that some client has, in the order of VALUE_TYPES."""
    declared = {
        kind for node in application.nodes for client in node.parameter_clients for kind in client.types
    }
    return tuple(kind for kind in VALUE_TYPES if kind in declared)


def _string(application: Application) -> int:
    """Return the bytes of the longest string; 0 where no client has strings."""
    return _most(application, "string") if {"string", "string[]"} & {*_types(application)} else 0


def _most(application: Application, key: str) -> int:
    """Return the largest number of the clients for a key of theirs."""
    return max(
        (getattr(client, key) for node in application.nodes for client in node.parameter_clients), default=0
    )


def _rule(name: str, member: str, string: int | None, sequence: int | None = None) -> LimitRule:
    """Return the limits of a member; one number for a sequence says nothing of what its elements have."""
    path = (f"{_PACKAGE}/{name}", member)
    if string is not None:
        return LimitRule(path, string, sequence)
    return LimitRule(path, sequence, sequence, single=True)
