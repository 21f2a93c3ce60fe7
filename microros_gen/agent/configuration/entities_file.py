# SPDX-License-Identifier: Apache-2.0
"""Parser of entities files (`microros-gen agent … --entities`): clients and their objects.

The file is JSON, a subset of YAML. All faults are reported in one run, each with its position.

    {"version": 1, "clients": [{"key": "0xAABBCCDD", "objects": [
      {"id": "0x0001", "kind": "participant", "name": "imu_node", "domain": 0},
      {"id": "0x0002", "kind": "topic", "parent": "0x0001", "name": "rt/imu", "type": "sensor_msgs::msg::dds_::Imu_"},
      {"id": "0x0003", "kind": "publisher", "parent": "0x0001"},
      {"id": "0x0005", "kind": "data_writer", "parent": "0x0003", "topic": "0x0002", "reliability": "reliable",
       "durability": "volatile", "history": "keep_last", "depth": 10},
      {"id": "0x0018", "kind": "replier", "parent": "0x0001", "name": "/arm",
       "request_type": "std_srvs::srv::dds_::SetBool_Request_",
       "reply_type": "std_srvs::srv::dds_::SetBool_Response_"}]}]}

Subscribers and data readers have the same keys as publishers and data writers, requesters the same as repliers. Topics
of services are derived from the name (`rq/armRequest`, `rr/armReply`) unless `request_topic` and `reply_topic` are set.

`key` "*" applies to every client without an entry. `adopt: true` is for a client without liveliness, which never opens
its session again: the agent accepts its samples even after the agent restarted (agent/preconfigured.py).
"""

from __future__ import annotations

import re
from collections.abc import Container, Mapping, Sequence
from types import MappingProxyType

from microros_gen.agent.configuration.entities import PreconfiguredClient, PreconfiguredObject
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.tree_read import check_keys, expect_mapping, read_choice, read_text
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode, parse_yaml

VERSION = 1
KINDS: Mapping[str, int] = MappingProxyType(
    {
        "participant": 1,
        "topic": 2,
        "publisher": 3,
        "subscriber": 4,
        "data_writer": 5,
        "data_reader": 6,
        "requester": 7,
        "replier": 8,
    }
)
"""Kinds of objects and the low four bits of their ids."""

_QOS = ("reliability", "durability", "history", "depth")
_TYPES = ("request_type", "reply_type")
_TOPICS = ("request_topic", "reply_topic")
_KEYS: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = MappingProxyType(
    {
        "participant": (("id", "kind", "name"), ("domain",)),
        "topic": (("id", "kind", "parent", "name", "type"), ()),
        "publisher": (("id", "kind", "parent"), ()),
        "subscriber": (("id", "kind", "parent"), ()),
        "data_writer": (("id", "kind", "parent", "topic"), _QOS),
        "data_reader": (("id", "kind", "parent", "topic"), _QOS),
        "requester": (("id", "kind", "parent", "name", *_TYPES), _TOPICS),
        "replier": (("id", "kind", "parent", "name", *_TYPES), _TOPICS),
    }
)
"""Required and optional keys of each kind of object."""
_PARENT: Mapping[str, str] = MappingProxyType(
    {
        "topic": "participant",
        "publisher": "participant",
        "subscriber": "participant",
        "data_writer": "publisher",
        "data_reader": "subscriber",
        "requester": "participant",
        "replier": "participant",
    }
)
_READ = ("data_reader", "requester", "replier")
_DURABILITIES = ("volatile", "transient_local", "transient", "persistent")
_HEX = re.compile(r"0[xX][0-9a-fA-F]{1,8}")
_DOMAINS = (*range(233), 255)
_DEPTHS = range(65_536)


def parse_preconfigured(
    sources: Sequence[Source], diagnostics: Diagnostics
) -> tuple[PreconfiguredClient, ...]:
    """Return the clients of all files; report faults to `diagnostics`."""
    found = [client for source in sources for client in _clients(source, diagnostics)]
    if not diagnostics.has_errors():
        _check_distinct(found, diagnostics)
    return tuple(found)


def _clients(source: Source, diagnostics: Diagnostics) -> list[PreconfiguredClient]:
    # Tabs are valid white space between the values of JSON, but not in YAML; texts in JSON contain none.
    tree = parse_yaml(Source(source.name, source.text.replace("\t", " ")), diagnostics)
    if tree is None:
        if not source.text.strip():
            place = Span(source, 1, 1)
            diagnostics.error(
                "this file is empty", place, 'Begin with {"version": 1, "clients": [...]}', id="MG-9401"
            )
        return []
    root = expect_mapping(tree, "an entities file", diagnostics)
    if root is None:
        return []
    check_keys(root, ("version", "clients"), ("version", "clients"), diagnostics)
    version = root.get("version")
    if version is not None and not (isinstance(version, ScalarNode) and version.value == VERSION):
        diagnostics.error("unknown version of the file", version.span, f"Write {VERSION}", id="MG-9402")
    clients = [_client(node, diagnostics) for node in _items(root, "clients", diagnostics)]
    return [client for client in clients if client]


def _client(node: YamlNode, diagnostics: Diagnostics) -> PreconfiguredClient | None:
    client = expect_mapping(node, "a client", diagnostics)
    if client is None:
        return None
    check_keys(client, ("key", "objects", "adopt"), ("key", "objects"), diagnostics)
    reader = _Objects(diagnostics)
    for item in _items(client, "objects", diagnostics):
        reader.read(item)
    key = _key(client, diagnostics)
    adopt = client.get("adopt")
    if adopt is not None and not (isinstance(adopt, ScalarNode) and isinstance(adopt.value, bool)):
        diagnostics.error("'adopt' must be true or false", adopt.span, id="MG-9403")
    adopted = isinstance(adopt, ScalarNode) and adopt.value is True
    if adopted and key is None and adopt is not None:
        diagnostics.error(
            "a client of any key cannot be adopted", adopt.span, "Give its key, or leave it out", id="MG-9404"
        )
    reads = [item for item in reader.found.values() if item.kind in _READ]
    if adopted and adopt is not None and reads:
        diagnostics.warning(
            f"after a restart of the agent this client receives nothing from ROS 2: {len(reads)} of its objects read,"
            " and without liveliness it does not ask again",
            adopt.span,
            "Give it `liveliness: ping` or `acknack` in its application file; then it needs no 'adopt'",
            id="MG-9405",
        )
    entry = client.entries.get("key")
    return PreconfiguredClient(
        key, tuple(reader.found.values()), adopted, entry.value.span if entry else client.span
    )


def _key(client: MappingNode, diagnostics: Diagnostics) -> bytes | None:
    node = client.get("key")
    text = node.text if isinstance(node, ScalarNode) else ""
    if node is None or text == "*":
        return None
    if not _HEX.fullmatch(text) or int(text, 16) == 0:
        hint = 'Write "0xAABBCCDD", or "*" for all others'
        diagnostics.error(
            "a client key is a hexadecimal number from 0x1 to 0xFFFFFFFF", node.span, hint, id="MG-9406"
        )
        return None
    return int(text, 16).to_bytes(4, "big")


def _check_distinct(clients: list[PreconfiguredClient], diagnostics: Diagnostics) -> None:
    first: dict[bytes | None, PreconfiguredClient] = {}
    for client in clients:
        other = first.setdefault(client.key, client)
        if other is not client:
            name = "*" if client.key is None else f"0x{client.key.hex().upper()}"
            diagnostics.error(
                f"duplicate client {name}; first in {other.span}",
                client.span,
                "Merge them",
                id="MG-9407",
            )


class _Objects:
    """Reader of the objects of one client, in order; each object may refer to earlier ones."""

    def __init__(self, diagnostics: Diagnostics) -> None:
        self._diagnostics = diagnostics
        self._unsure = False  # an id or kind was wrong, so references to that object are not reported
        self.found: dict[int, PreconfiguredObject] = {}

    def read(self, item: YamlNode) -> None:
        """Read one object and add it to `found` if its kind is known and its id is new."""
        node = expect_mapping(item, "an object", self._diagnostics)
        if node is None:
            return
        kind = read_choice(node, "kind", tuple(KINDS), self._diagnostics)
        if kind is None:
            self._unsure = True
            if "kind" not in node.entries:
                self._diagnostics.error("missing key 'kind'", node.span, 'Add "kind": …', id="MG-9408")
            return
        required, optional = _KEYS[kind.name]
        check_keys(node, (*required, *optional), required, self._diagnostics)
        identifier = self._own_id(node, kind.name)
        found = PreconfiguredObject(
            identifier,
            kind.name,
            self._reference(node, "parent", _PARENT.get(kind.name, "")),
            self._name(node, "name"),
            self._number(node, "domain", _DOMAINS, "from 0 to 232, or 255 for the agent's own"),
            self._name(node, "type"),
            self._reference(node, "topic", "topic"),
            self._choice(node, "reliability", ("reliable", "best_effort")) == "reliable",
            self._choice(node, "durability", _DURABILITIES),
            self._choice(node, "history", ("keep_last", "keep_all")) == "keep_last",
            self._number(node, "depth", _DEPTHS, "from 0 to 65535"),
            self._name(node, "request_type"),
            self._name(node, "reply_type"),
            self._name(node, "request_topic"),
            self._name(node, "reply_topic"),
            node.span,
        )
        self.found.setdefault(identifier, found)

    def _choice(self, node: MappingNode, key: str, choices: tuple[str, ...]) -> str:
        chosen = read_choice(node, key, choices, self._diagnostics)
        return chosen.name if chosen else choices[0]

    def _own_id(self, node: MappingNode, kind: str) -> int:
        identifier = self._id(node, "id")
        entry = node.get("id")
        if entry is None or identifier is None:
            self._unsure = True
            return 0
        if identifier & 0x0F != KINDS[kind]:
            self._unsure = True
            wanted = identifier & 0xFFF0 | KINDS[kind]
            self._diagnostics.error(
                f"the last digit of a {kind}'s id is {KINDS[kind]}",
                entry.span,
                f'Perhaps "{wanted:#06x}"',
                id="MG-9409",
            )
        elif identifier in self.found:
            self._diagnostics.error(
                f"duplicate id {identifier:#06x}; first in line {self._line_of(identifier)}",
                entry.span,
                "Give each object a different id",
                id="MG-9410",
            )
        return identifier

    def _line_of(self, identifier: int) -> int:
        span = self.found[identifier].span
        return span.line if span else 0

    def _id(self, node: MappingNode, key: str) -> int | None:
        value = node.get(key)
        if value is None:
            return None
        text = value.text if isinstance(value, ScalarNode) else ""
        if not _HEX.fullmatch(text) or not 0 < int(text, 16) <= 0xFFFF:
            hint = 'Write "0x0015": the index, then the kind as last digit'
            self._diagnostics.error(
                f"'{key}' must be an object id, 0x0001 to 0xFFFF", value.span, hint, id="MG-9411"
            )
            return None
        return int(text, 16)

    def _reference(self, node: MappingNode, key: str, kind: str) -> int:
        identifier = self._id(node, key)
        value = node.get(key)
        if identifier is None or value is None or not kind:
            return 0
        referred = self.found.get(identifier)
        if not self._unsure and (referred is None or referred.kind != kind):
            known = [f"{o.id:#06x}" for o in self.found.values() if o.kind == kind]
            hint = nearest(f"{identifier:#06x}", known) or f"Put the {kind} before what names it"
            self._diagnostics.error(
                f"unknown {kind} {identifier:#06x}: no earlier object has this id",
                value.span,
                hint,
                id="MG-9412",
            )
        return identifier

    def _name(self, node: MappingNode, key: str) -> str:
        text = read_text(node, key, self._diagnostics, default=" ")
        if not text:
            value = node.get(key)
            self._diagnostics.error(f"'{key}' is empty", value.span if value else None, id="MG-9413")
        return text.strip()

    def _number(self, node: MappingNode, key: str, choices: Container[int], range_text: str) -> int:
        value = node.get(key)
        if value is None:
            return 0
        number = value.value if isinstance(value, ScalarNode) else None
        if isinstance(number, int) and not isinstance(number, bool) and number in choices:
            return number
        self._diagnostics.error(f"'{key}' must be a number {range_text}", value.span, id="MG-9414")
        return 0


def _items(node: MappingNode, key: str, diagnostics: Diagnostics) -> tuple[YamlNode, ...]:
    value = node.get(key)
    if isinstance(value, SequenceNode):
        return value.items
    if value is not None:
        diagnostics.error(f"'{key}' must be a list", value.span, f'Write "{key}": [...]', id="MG-9415")
    return ()
