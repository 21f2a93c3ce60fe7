# SPDX-License-Identifier: Apache-2.0
"""Parser of policy files (`microros-gen agent … --policy`). Every fault is reported with its position, in one run.

The structure is defined by policy.schema.json, which editors use as well.
"""

from __future__ import annotations

import contextlib
import ipaddress
import re
from pathlib import Path
from typing import cast

from microros_gen.agent.policy.checks import check_rules
from microros_gen.agent.policy.model import (
    LISTS,
    WORK,
    ClientRule,
    Keys,
    NameRule,
    Network,
    Policy,
    QosRule,
)
from microros_gen.agent.policy.patterns import is_pattern
from microros_gen.diagnostics import Diagnostics, Source, reads
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    child_text,
    entries,
    int_of,
    items,
    number_of,
    span_of,
    text_of,
)
from microros_gen.documents.yaml_tree import ScalarNode, SequenceNode, YamlNode, parse_yaml

SCHEMA = Path(__file__).with_name("policy.schema.json")
_KEYS = re.compile(r"(0[xX][0-9a-fA-F]{1,8})(?:-(0[xX][0-9a-fA-F]{1,8}))?")
_DEVICE = re.compile(r"(/|unix:/)\S+|(?!tty|pts)[^/\s]+")


@reads
def parse_policy(source: Source, diagnostics: Diagnostics) -> Policy:
    """Return the rules of the file; report faults to `diagnostics` and then return a Policy without rules."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    policy = Policy()
    if tree is not None and not found.has_errors():
        nodes = items(child(tree, "clients"))
        policy = Policy(tuple(_rule(node, found) for node in nodes))
        check_rules(policy, nodes, found)
    diagnostics.extend(found)
    return Policy() if found.has_errors() else policy


def _rule(node: YamlNode, diagnostics: Diagnostics) -> ClientRule:
    common = _qos(child(node, "qos"), QosRule())
    limits = {
        e.key: value for e in entries(child(node, "limits")) if (value := number_of(e.value)) is not None
    }
    domains, nodes = child(node, "domains"), child(node, "nodes")
    return ClientRule(
        name=child_text(node, "name"),
        keys=tuple(keys for item in items(child(node, "keys")) if (keys := _keys(item, diagnostics))),
        addresses=tuple(
            network for item in items(child(node, "addresses")) if (network := _network(item, diagnostics))
        ),
        devices=tuple(
            device for item in items(child(node, "devices")) if (device := _device(item, diagnostics))
        ),
        refuse=bool_of(child(node, "refuse")) or False,
        domain=int_of(child(node, "domain")),
        domains=None if domains is None else tuple(cast(int, int_of(item)) for item in items(domains)),
        nodes=None if nodes is None else tuple(_name(item, QosRule(), diagnostics) for item in items(nodes)),
        lists=tuple(
            (key, tuple(_name(item, common, diagnostics) for item in items(child(node, key))))
            for key in LISTS
            if child(node, key) is not None
        ),
        graph=bool_of(child(node, "graph")) or False,
        limits=tuple((key, value) for key, value in limits.items() if key != WORK),
        work_ms=limits.get(WORK),
        span=span_of(child(node, "name")),
    )


def _keys(node: YamlNode, diagnostics: Diagnostics) -> Keys | None:
    text = node.text if isinstance(node, ScalarNode) else ""
    match = _KEYS.fullmatch(text)
    first = int(match[1], 16) if match else 0
    last = int(match[2] or match[1], 16) if match else 0
    if first == 0 or last == 0:
        message = f"'{text}' is not a client key: a hexadecimal number from 0x1 to 0xFFFFFFFF is expected"
        hint = "Write 0xA1B2C3D4, or 0xA1B20000-0xA1B2FFFF for a range"
        diagnostics.error(message, node.span, hint, id="MG-9503")
        return None
    if last < first:
        hint = f"Write 0x{last:X}-0x{first:X}"
        diagnostics.error("this range of keys ends before it begins", node.span, hint, id="MG-9504")
        return None
    return Keys(first, last, node.span)


def _network(node: YamlNode, diagnostics: Diagnostics) -> Network | None:
    text = text_of(node) or ""
    try:
        return ipaddress.ip_network(text)
    except ValueError as error:
        hint = "Write an address or a network, such as 192.168.10.7, 192.168.10.0/24 or fd00::/8"
        with contextlib.suppress(ValueError):
            meant = ipaddress.ip_network(text, strict=False)
            hint = f"Write {meant} for the network, or the address without /"
        diagnostics.error(f"'{text}' is no network: {error}", node.span, hint, id="MG-9505")
        return None


def _device(node: YamlNode, diagnostics: Diagnostics) -> str | None:
    text = text_of(node) or ""
    if _DEVICE.fullmatch(text):
        return text
    hint = "Write a path from / on, such as /dev/ttyUSB0 or /dev/serial/by-id/usb-*, or can0"
    diagnostics.error(f"'{text}' is neither an absolute path nor an interface", node.span, hint, id="MG-9506")
    return None


def _name(node: YamlNode, common: QosRule, diagnostics: Diagnostics) -> NameRule:
    place = child(node, "name") or node
    text = text_of(place) or ""
    if not is_pattern(text):
        clean = re.sub(r"[^A-Za-z0-9_*?/]", "_", text).strip("/")
        hint = f"Write /{clean}" if clean else "Write a name such as /arm/state, or a pattern such as /arm/**"
        message = f"'{text}' is not a pattern of absolute ROS names"
        diagnostics.error(message, place.span, hint, id="MG-9507")
    return NameRule(text, bool_of(child(node, "refuse")) or False, _qos(node, common), place.span)


def _qos(node: YamlNode | None, common: QosRule) -> QosRule:
    """Return the QoS that a mapping permits; what it does not mention is as in `common`."""
    depth = int_of(child(node, "depth"))
    return QosRule(
        _several(child(node, "reliability"), common.reliability),
        _several(child(node, "durability"), common.durability),
        _several(child(node, "history"), common.history),
        common.depth if depth is None else depth,
    )


def _several(node: YamlNode | None, common: tuple[str, ...] | None) -> tuple[str, ...] | None:
    if isinstance(node, SequenceNode):
        return tuple(text_of(item) or "" for item in node.items)
    text = text_of(node)
    return common if text is None else (text,)
