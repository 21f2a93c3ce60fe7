# SPDX-License-Identifier: Apache-2.0
"""Records topics of any type to an MCAP file."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from microros_gen.diagnostics import UserError
from microros_gen.interfaces.interface_set import InterfaceSet
from microros_gen.interfaces.msg.text import message_text
from microros_gen.interfaces.omg_idl.text import idl_text
from microros_gen.interfaces.types import Message, Primitive, TypeName, element_of
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import GraphEndpoint
from microros_gen.ros.peer import Peer
from microros_gen.ros_tools.mcap import McapWriter, Schema
from microros_gen.ros_tools.quality import PRESETS, hash_text, matching, recorded
from microros_gen.ros_tools.texts import dump

_SEPARATOR = "=" * 80
Tell = Callable[[str], object]


class Recorder:
    """Subscribes to topics and writes what arrives; `messages` and `size` count what was recorded."""

    def __init__(self, peer: Peer, writer: McapWriter, tell: Tell) -> None:
        """Record with the node `peer`; `tell` is called with a line for each topic and each problem."""
        self._peer = peer
        self._writer = writer
        self._tell = tell
        self.topics: set[str] = set()
        self.messages = 0
        self.size = 0

    def add(self, topic: str, type_name: str) -> None:
        """Record a topic of the graph with the QoS that all its publishers match."""
        self.topics.add(topic)
        publishers = self._peer.graph().publishers(topic)
        qos, notes = matching(publishers, PRESETS["default"])
        for note in notes:
            self._tell(f"{topic}: {note}")
        name = TypeName(*type_name.split("/"))
        schema = self._schema(type_name)
        if schema is None:
            self._tell(f"{topic}: no interface file of {type_name} is found: recorded without its definition")
        hashes = sorted({text for text in map(hash_text, publishers) if text})
        channel = self._writer.add_channel(topic, schema, _metadata(publishers, hashes))
        type_hash = hashes[0] if hashes else None
        self._peer.subscribe_raw(topic, name, type_hash, partial(self._record, channel), qos)
        self._tell(f"Subscribed to topic '{topic}'")

    def _record(self, channel: int, data: bytes, info: Mapping[str, Any]) -> None:
        now = time.time_ns()
        self._writer.add(channel, data, now, info.get("source_timestamp") or now)
        self.messages += 1
        self.size += len(data)

    def _schema(self, type_name: str) -> Schema | None:
        try:
            known = self._peer.types.message(type_name)
        except (UserError, RosError):
            return None
        return schema_of(known.name, known.interfaces)


def schema_of(name: TypeName, interfaces: InterfaceSet) -> Schema:
    """Return the definition of a message and all its nested types, as rosbag2 puts it into MCAP files."""
    messages = [interfaces.message(part) for part in (name, *interfaces.closure(name))]
    if all(map(_in_msg, messages)):
        first, *others = messages
        texts = [message_text(first)]
        texts += [f"{_SEPARATOR}\nMSG: {_short(m.name)}\n{message_text(m)}" for m in others]
        return Schema(str(name), "ros2msg", "\n".join(text.rstrip("\n") for text in texts) + "\n")
    texts = [f"{_SEPARATOR}\nIDL: {m.name}\n{idl_text(m)}" for m in messages]
    return Schema(str(name), "ros2idl", "\n".join(text.rstrip("\n") for text in texts) + "\n")


def _in_msg(message: Message) -> bool:
    kinds = map(element_of, (field.type for field in message.fields))
    return all(kind.in_msg for kind in kinds if isinstance(kind, Primitive))


def _short(name: TypeName) -> str:
    return f"{name.package}/{name.name}"


def _metadata(publishers: tuple[GraphEndpoint, ...], hashes: list[str]) -> dict[str, str]:
    offered = dump([recorded(publisher) for publisher in publishers])
    return {"offered_qos_profiles": offered, "topic_type_hash": hashes[0] if hashes else ""}
