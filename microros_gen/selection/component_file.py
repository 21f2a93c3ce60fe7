# SPDX-License-Identifier: Apache-2.0
"""`component.yaml` → Component. The format: docs/architecture.md, "What a component brings"."""

from __future__ import annotations

from microros_gen.application.kinds import NAMES
from microros_gen.application.limits import endpoint_limits
from microros_gen.application.model import Qos
from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.documents.tree_read import check_keys, expect_mapping, read_choice, read_names, read_text
from microros_gen.documents.tree_values import bool_of, entries, int_of, items, text_of
from microros_gen.documents.yaml_tree import MappingNode, SequenceNode, YamlNode, parse_yaml
from microros_gen.selection.component import Ask, Component, Implied, Provision, SourceFile
from microros_gen.selection.contribution import Conditions
from microros_gen.selection.contribution_file import KEYS, read_conditions, read_contributions
from microros_gen.selection.presence_file import KEYS as PRESENCE_KEYS
from microros_gen.selection.presence_file import read_presence
from microros_gen.selection.xrce import OBJECT_KINDS, SUBMESSAGES, XRCE_PROFILES

LAYERS = ("micro-ROS", "middleware", "port")
_REQUIRED = ("component", "summary", "layer", "status")
_LISTS = ("needs", "asks", "xrce", "sends", "receives", "objects", "headers", "sources", "implies", "pools")
_FILLS = "fills_messages"
_COMMON = "common"
"""Read where templates are compiled ahead (documents/templates.py), before all components are."""
_IMPLIED = ("type", "every_node", "queue", "qos", "limits", "executed", "storage", "unless", "outside_ros")
_PROVISION = ("sources", "asks", "always", "waits_for_room")
_STATUS = ("ready", "planned")


@reads
def parse_component(source: Source, diagnostics: Diagnostics) -> Component | None:
    """Return the component that `source` describes; None and errors in `diagnostics` where it is not one."""
    before = diagnostics.has_errors()
    node = expect_mapping(parse_yaml(source, diagnostics), "a component file", diagnostics)
    if node is None:
        if not diagnostics.has_errors():
            diagnostics.error(f"the component file '{source.name}' is empty", id="MG-4004")
        return None
    check_keys(
        node,
        (*_REQUIRED, *_LISTS, _FILLS, _COMMON, "provides", *KEYS, *PRESENCE_KEYS),
        _REQUIRED,
        diagnostics,
    )
    layer = read_choice(node, "layer", LAYERS, diagnostics)
    status = read_choice(node, "status", _STATUS, diagnostics)
    component = Component(
        name=read_text(node, "component", diagnostics),
        summary=read_text(node, "summary", diagnostics),
        layer=layer.name if layer else "",
        ready=status is not None and status.name == "ready",
        needs=_names(node, "needs", diagnostics),
        xrce=_names(node, "xrce", diagnostics, XRCE_PROFILES),
        sends=_names(node, "sends", diagnostics, tuple(SUBMESSAGES)),
        receives=_names(node, "receives", diagnostics, tuple(SUBMESSAGES)),
        objects=_names(node, "objects", diagnostics, tuple(OBJECT_KINDS)),
        headers=_names(node, "headers", diagnostics),
        sources=_sources(node, diagnostics),
        asks=_asks(node, diagnostics),
        provides=_provides(node, diagnostics),
        implies=_implies(node, diagnostics),
        pools=_names(node, "pools", diagnostics),
        fills_messages=bool_of(node.get(_FILLS)) or False,
        contributes=read_contributions(node, diagnostics),
        presence=read_presence(node),
    )
    return component if before or not diagnostics.has_errors() else None


def _sources(node: MappingNode, diagnostics: Diagnostics) -> tuple[SourceFile, ...]:
    """Read a list of `x.c` and `{file: x.c, when: {on_full: error}}`."""
    value = node.get("sources")
    if value is not None and not isinstance(value, SequenceNode):
        diagnostics.error("'sources' must be a list", value.span, "Write `sources: [a.c, b.c]`", id="MG-4005")
    found = [(item, _source(item)) for item in items(value)]
    for item, source in found:
        if source is None:
            hint = "Write `x.c` or `{file: x.c, when: {on_full: error}}`"
            diagnostics.error("'sources' must list files", item.span, hint, id="MG-4006")
    return tuple(source for _, source in found if source is not None)


def _source(item: YamlNode) -> SourceFile | None:
    found = _conditional(item, "file")
    return SourceFile(*found) if found else None


def _asks(node: MappingNode, diagnostics: Diagnostics) -> tuple[Ask, ...]:
    """Read a list of `time` and `{capability: lock, when: {session.multithread: true}}`."""
    value = node.get("asks")
    if value is not None and not isinstance(value, SequenceNode):
        diagnostics.error("'asks' must be a list", value.span, "Write `asks: [time, sleep]`", id="MG-4007")
    found = [(item, _conditional(item, "capability")) for item in items(value)]
    for item, ask in found:
        if ask is None:
            hint = "Write `time` or `{capability: lock, when: {session.multithread: true}}`"
            diagnostics.error("'asks' must list capabilities", item.span, hint, id="MG-4008")
    return tuple(Ask(*ask) for _, ask in found if ask is not None)


def _provides(node: MappingNode, diagnostics: Diagnostics) -> tuple[Provision, ...]:
    """Read `time: {sources: [a.c], asks: [idle], always: true}` for each capability."""
    value = node.get("provides")
    if value is not None and not isinstance(value, MappingNode):
        diagnostics.error(
            "'provides' must be a mapping",
            value.span,
            "Write `provides: {time: {sources: [a.c]}}`",
            id="MG-4009",
        )
    found = []
    for entry in entries(value):
        provision = expect_mapping(entry.value, f"'provides.{entry.key}'", diagnostics)
        if provision is None:
            continue
        check_keys(provision, _PROVISION, ("sources",), diagnostics)
        always = bool_of(provision.get("always")) or False
        sources, asks = _sources(provision, diagnostics), _asks(provision, diagnostics)
        waits_for_room = bool_of(provision.get("waits_for_room")) or False
        found.append(Provision(entry.key, sources, asks, always, waits_for_room))
    return tuple(found)


def _implies(node: MappingNode, diagnostics: Diagnostics) -> tuple[Implied, ...]:
    """Read a list of `{subscription: /clock, type: …, every_node: true, queue: 1, qos: {…}, limits: {…}}`."""
    found = []
    for item in items(node.get("implies")):
        item_node = expect_mapping(item, "an item of 'implies'", diagnostics)
        kind = next((k for k in NAMES if item_node is not None and k in item_node.entries), None)
        if item_node is None or kind is None:
            hint = f"Write one of {', '.join(f'`{k}: NAME`' for k in NAMES)}"
            diagnostics.error("'implies' must list endpoints", item.span, hint, id="MG-4010")
            continue
        check_keys(item_node, (kind, *_IMPLIED), (kind, "type"), diagnostics)
        every_node = bool_of(item_node.get("every_node")) or False
        name, type_ = read_text(item_node, kind, diagnostics), read_text(item_node, "type", diagnostics)
        queue = int_of(item_node.get("queue"))
        qos, limits = _qos(item_node.get("qos"), diagnostics), endpoint_limits(item_node.get("limits"), type_)
        executed, storage = bool_of(item_node.get("executed")) or False, text_of(item_node.get("storage"))
        found.append(
            Implied(
                *(kind, name, type_, qos, queue, every_node, limits, executed),
                stored=storage is None,
                unless=text_of(item_node.get("unless")) or "",
                streamed=storage == "streamed",
                outside_ros=bool_of(item_node.get("outside_ros")) or False,
            )
        )
    return tuple(found)


def _qos(node: YamlNode | None, diagnostics: Diagnostics) -> Qos:
    mapping = expect_mapping(node, "'qos'", diagnostics) if node is not None else None
    if mapping is None:
        return Qos()
    check_keys(mapping, ("reliability", "durability", "depth"), (), diagnostics)
    reliability = read_choice(mapping, "reliability", ("reliable", "best_effort"), diagnostics)
    durability = read_choice(mapping, "durability", ("volatile", "transient_local"), diagnostics)
    depth = int_of(mapping.get("depth"))
    default = Qos()
    return Qos(
        reliability=reliability.name if reliability else default.reliability,
        durability=durability.name if durability else default.durability,
        depth=default.depth if depth is None else depth,
    )


def _conditional(item: YamlNode, key: str) -> tuple[str, Conditions] | None:
    """Return `x` or `{key: x, when: {…}}` as its text and conditions; None for anything else."""
    if not isinstance(item, MappingNode):
        text = text_of(item)
        return (text, ()) if text else None
    text, when = text_of(item.get(key)), read_conditions(item.get("when"))
    return (text, when) if text and when and set(item.entries) == {key, "when"} else None


def _names(
    node: MappingNode, key: str, diagnostics: Diagnostics, known: tuple[str, ...] | None = None
) -> tuple[str, ...]:
    return tuple(name.name for name in read_names(node, key, diagnostics, known))
