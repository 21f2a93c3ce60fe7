# SPDX-License-Identifier: Apache-2.0
"""How much of the graph one response has: from the limits of microros_graph_msgs."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

LONGEST_NAME = 95
"""Bytes of a name or type, without its NUL, where the application has no limit."""
NAMES, TYPES, ENDPOINTS = 2, 2, 1
"""Names of a response, types of a name and endpoints of a response where the application has no limits."""
_PACKAGE = "microros_graph_msgs"


@dataclass(frozen=True, kw_only=True)
class GraphPlan:
    """`name_size` is the bytes of a name or type with its NUL; the others are counts, 0 without a graph server."""

    name_size: int
    names: int
    types: int
    endpoints: int

    @property
    def texts(self) -> int:
        """Names and types that one response has at most."""
        return max(self.names * (1 + self.types), self.endpoints * 2)


def plan(context: PlanContext, diagnostics: Diagnostics) -> GraphPlan:
    """Return the sizes: what every name and every response has room for."""
    refuse_own_limits(context, "graph", diagnostics)
    if context.selection.has("graph_topic"):
        name_size = _bounds(context, "micro_ros_msgs", "msg", "Entity")["name"][0] + 1
        return GraphPlan(name_size=name_size, names=0, types=0, endpoints=0)
    name, endpoint = _bounds(context, _PACKAGE, "msg", "Name"), _bounds(context, _PACKAGE, "msg", "Endpoint")
    names = _bounds(context, _PACKAGE, "srv", "ListNames_Response")["names"][1]
    endpoints = _bounds(context, _PACKAGE, "srv", "ListEndpoints_Response")["endpoints"][1]
    strings = (name["name"], name["types"], endpoint["node"], endpoint["type"])
    return GraphPlan(
        name_size=min(string for string, _ in strings) + 1,
        names=names,
        types=name["types"][1],
        endpoints=endpoints,
    )


def record(part: GraphPlan) -> object:
    """Return what the plan id is made of."""
    return [part.name_size, part.names, part.types, part.endpoints]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of requests and responses; those of requests follow the application's bound of a name.

    None where another source than the graph server answers.
    """
    if not any(e.type.startswith(_PACKAGE) for node in application.nodes for e in node.endpoints):
        return ()
    own_rules = {rule.path: rule for rule in application.limits}
    own = own_rules.get((f"{_PACKAGE}/msg/Name", "name"))
    longest = own.string if own is not None and own.string is not None else LONGEST_NAME
    rules = (
        _rule("msg/Name", "name", longest),
        _rule("msg/Name", "types", longest, TYPES),
        _rule("msg/Endpoint", "node", longest),
        _rule("msg/Endpoint", "type", longest),
        _rule("srv/ListNames_Request", "node", longest),
        _rule("srv/ListNames_Request", "filter", 0),
        _rule("srv/ListNames_Response", "names", None, NAMES),
        _rule("srv/ListEndpoints_Request", "name", longest),
        _rule("srv/ListEndpoints_Request", "matched_by", longest),
        _rule("srv/ListEndpoints_Response", "endpoints", None, ENDPOINTS),
    )
    return tuple(rule for rule in rules if rule.path not in own_rules)


def _rule(name: str, member: str, string: int | None, sequence: int | None = None) -> LimitRule:
    """Return the limits of a member; one number for a sequence says nothing of what its elements have."""
    path = (f"{_PACKAGE}/{name}", member)
    if string is None:
        return LimitRule(path, sequence, sequence, single=True)
    return LimitRule(path, string, sequence)


def _bounds(context: PlanContext, package: str, kind: str, name: str) -> dict[str, tuple[int, int]]:
    """Return the bound of the string and of the sequence of each member that has one."""
    planned = context.types[TypeName(package, kind, name)]
    fields = planned.limits.fields if planned.limits is not None else ()
    return {
        member.name: (bound.string or 0, bound.sequence or 0)
        for member, bound in zip(planned.message.fields, fields, strict=True)
        if bound is not None
    }
