# SPDX-License-Identifier: Apache-2.0
"""Tables of modes as C, and the limits of messages whose texts are the names of modes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from microros_gen.application.mode_decl import DEFAULT_MODE, ModeDecl
from microros_gen.application.model import Application, EndpointDecl, LimitRule, NodeDecl, ParameterDecl
from microros_gen.application.modes import set_parameters, start_value, value_in
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.components.parameters.constants import KINDS, start_table, start_value_of, string_limit
from microros_gen.components.parameters.sizes import longer_than_limits
from microros_gen.components.parameters.values import Identifiers
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass
from microros_gen.typesupport.views.text import string

HANDLES = 3
"""Services that the executor of the application runs, for each node with modes."""
_PACKAGE = "system_modes_msgs"
_NOTHING = ".value = {.integer_value = 0}"
_NO_ELEMENTS = '.start = "", .start_bytes = 0u'
"""Members of the value of an array without elements."""
_SERVICES = {
    "change_mode": "ChangeMode",
    "get_available_modes": "GetAvailableModes",
    "get_mode": "GetMode",
}


@dataclass(frozen=True)
class ModePlan:
    """A mode as C: `symbol` names its `values`, which need the constants `tables`; `constant` is its position."""

    name: str
    constant: str
    symbol: str
    tables: tuple[str, ...]
    values: tuple[str, ...]
    entry: str


@dataclass(frozen=True)
class NodePlan:
    """A node with modes as C: `index` of the node, `symbol` begins the names.

    `entries` are the parameters that modes set.
    """

    index: int
    name: str
    symbol: str
    entries: tuple[str, ...]
    modes: tuple[ModePlan, ...]


@dataclass(frozen=True, kw_only=True)
class NodeModesPlan:
    """The nodes that have modes. `requested`: the device itself requests some, at an error of a check."""

    declared: tuple[NodePlan, ...] = ()
    requested: bool = False

    @property
    def count(self) -> int:
        """Return the number of modes of all nodes."""
        return sum(len(node.modes) for node in self.declared)

    @property
    def handles(self) -> int:
        """Return the handles of the executor: RCLC_EXECUTOR_MODES_HANDLES of each node."""
        return HANDLES * len(self.declared)

    @property
    def shown(self) -> str:
        """Return what a report says: each node with its modes."""
        return "; ".join(
            f"{node.name} {', '.join(mode.name for mode in node.modes)}" for node in self.declared
        )


def plan(context: PlanContext, diagnostics: Diagnostics) -> NodeModesPlan:
    """Return the tables; what the storage of a parameter does not hold is an error."""
    application = context.application
    refuse_own_limits(context, "node_modes", diagnostics)
    if not any(node.modes for node in application.nodes):
        message = "the component 'node_modes' is for nodes with modes, and no node has any"
        hint = "Write `modes: {SLOW: {speed: 0.2}}` at a node, with its own parameters"
        diagnostics.error(message, application.spans.get("components"), hint, id="MG-7091")
    for node in application.nodes:
        diagnostics.extend(longer_than_limits(application, _written(node), "the value"))
        _check_texts(node, diagnostics)
    checks = application.diagnosis.checks if application.diagnosis is not None else ()
    return NodeModesPlan(declared=tuple(_nodes(application)), requested=any(check.mode for check in checks))


def _written(node: NodeDecl) -> Iterator[ParameterDecl]:
    """Yield each parameter with each value that a mode writes, at the place of the value."""
    declared = {parameter.name: parameter for parameter in set_parameters(node)}
    for mode in node.modes:
        for value in mode.values:
            if value.value is not None and value.parameter in declared:
                yield replace(declared[value.parameter], default=value.value, span=value.span)


def _check_texts(node: NodeDecl, diagnostics: Diagnostics) -> None:
    """Report texts that are longer than the storage of a parameter without `size`."""
    declared = {parameter.name: parameter for parameter in set_parameters(node)}
    for having in _written(node):
        size = len(having.default.encode()) if isinstance(having.default, str) else 0
        most = string_limit(declared[having.name])
        if size > most:
            message = f"the value of the parameter '{having.name}' has {size} bytes, and it holds {most}"
            hint = f"Write size: {size} at the parameter"
            diagnostics.error(message, having.span, hint, id="MG-7092")


def _nodes(application: Application) -> Iterator[NodePlan]:
    names = Identifiers()
    for index, node in enumerate(application.nodes):
        full = node.full_name
        symbol = names.take(full.strip("/"))
        parameters = set_parameters(node)
        if node.modes and parameters:
            kinds = tuple(
                f"{{{string(p.name)}, (uint8_t)RCLC_PARAMETER_{KINDS[p.type].upper()}}}" for p in parameters
            )
            yield NodePlan(index, full, symbol, kinds, tuple(_modes(node, symbol, parameters)))


def _modes(node: NodeDecl, symbol: str, parameters: tuple[ParameterDecl, ...]) -> Iterator[ModePlan]:
    constants, symbols = Identifiers(), Identifiers()
    default = symbols.take(f"mode_of_{symbol}_DEFAULT")
    for mode in node.modes:
        is_default = mode.name == DEFAULT_MODE
        constant = constants.take(f"{symbol}_mode_{'DEFAULT' if is_default else mode.name}")
        own = default if is_default else symbols.take(f"mode_of_{symbol}_{mode.name}")
        yield _mode(node, mode, parameters, _Names(constant, own, default))


@dataclass(frozen=True)
class _Names:
    constant: str
    symbol: str
    default: str


def _mode(node: NodeDecl, mode: ModeDecl, parameters: tuple[ParameterDecl, ...], names: _Names) -> ModePlan:
    """Return a mode; a text or array that it inherits is the constant of `__DEFAULT__`."""
    tables: list[str] = []
    values: list[str] = []
    is_set: list[bool] = []
    for index, parameter in enumerate(parameters):
        value = value_in(node, mode, parameter)
        is_given = value is None or not value.parent
        start = start_value(parameter) if value is None else value.value
        having = replace(parameter, default=start)
        is_own = names.symbol == names.default or mode.value(parameter.name) is not None
        name = f"{names.symbol if is_own else names.default}__{index}"
        if is_given and is_own:
            tables += start_table(having, name)
        values.append(f"{{{_members(having, name) if is_given else _NOTHING}}}")
        is_set.append(is_given)
    if not all(is_set):
        elements = ", ".join("true" if item else "false" for item in is_set)
        tables.append(f"static const bool {names.symbol}__given[] = {{{elements}}};")
    entry = f"{string(mode.name)}, {names.symbol}, {'NULL' if all(is_set) else f'{names.symbol}__given'}"
    return ModePlan(mode.name, names.constant, names.symbol, tuple(tables), tuple(values), entry)


def _members(parameter: ParameterDecl, start: str) -> str:
    return _NO_ELEMENTS if parameter.default == () else start_value_of(parameter, start)


def record(part: NodeModesPlan) -> object:
    """Return what the plan id is made of: the positions of modes, which applications are compiled with."""
    return [[node.index, [mode.name for mode in node.modes], len(node.entries)] for node in part.declared]


def endpoints(node: NodeDecl) -> Iterator[EndpointDecl]:
    """Yield the services and the publisher of a node with modes."""
    if not node.modes:
        return
    for name, kind in _SERVICES.items():
        yield EndpointDecl(
            *("service", f"~/{name}", f"{_PACKAGE}/srv/{kind}"),
            queue=1,
            stored=False,
            of_the_library=True,
            executed=True,
            span=node.modes[0].span,
        )
    yield EndpointDecl(
        *("publisher", "~/mode_event", f"{_PACKAGE}/msg/ModeEvent"),
        stored=False,
        of_the_library=True,
        span=node.modes[0].span,
    )


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of what is exchanged: names of modes."""
    names = [mode.name for node in application.nodes for mode in node.modes]
    longest = max((len(name.encode()) for name in names), default=1)
    most = max((len(node.modes) for node in application.nodes), default=1)
    rules = (
        LimitRule((f"{_PACKAGE}/msg/Mode", "label"), longest),
        LimitRule((f"{_PACKAGE}/srv/ChangeMode_Request", "mode_name"), longest),
        LimitRule((f"{_PACKAGE}/srv/GetMode_Response", "current_mode"), longest),
        LimitRule((f"{_PACKAGE}/srv/GetAvailableModes_Response", "available_modes"), longest, most),
    )
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)
