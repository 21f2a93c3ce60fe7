# SPDX-License-Identifier: Apache-2.0
"""CREATE and DELETE of objects, and the tree of them that refer to one another."""

from __future__ import annotations

from microros_gen.agent.entities import Home
from microros_gen.agent.objects import ObjectTree
from microros_gen.agent.representation import References
from microros_gen.agent.wire.constants import Format, Status
from microros_gen.agent.wire.entity_messages import Create
from tests.support.agent.client import dds_type, participant_blob, topic_blob, writer_blob
from tests.support.agent.fakes import FakeBridge

INT32 = dds_type("std_msgs/msg/Int32")
NODE, TOPIC, PUBLISHER, SUBSCRIBER, WRITER, READER = 0x11, 0x12, 0x13, 0x14, 0x15, 0x16


def tree(maximum: int = 100) -> tuple[ObjectTree, FakeBridge]:
    bridge = FakeBridge()
    return ObjectTree(Home(bridge, "fallback"), References(), maximum), bridge


def make(
    object_id: int,
    body: bytes | str,
    parent: int = 0,
    mode: str = "",
    form: int | None = None,
    kind: int | None = None,
    domain: int = 0,
) -> Create:
    """Return a CREATE; a text body is XML, bytes are binary."""
    raw = body.encode() if isinstance(body, str) else body
    form = form or (Format.XML if isinstance(body, str) else Format.BINARY)
    kind = kind or object_id & 0x0F
    return Create(1, object_id, kind, form, raw, parent, domain, "reuse" in mode, "replace" in mode)


NODE_A, NODE_B = participant_blob("a"), participant_blob("b")
TOPIC_A, TOPIC_B = topic_blob("rt/a", INT32), topic_blob("rt/b", INT32)
WRITER_A, WRITER_B = writer_blob(TOPIC, 3, 10), writer_blob(TOPIC, 2, 10)
GROUP = b"\0\0"


def complete() -> tuple[ObjectTree, FakeBridge]:
    objects, bridge = tree()
    for create in (
        make(NODE, NODE_A),
        make(TOPIC, TOPIC_A, NODE),
        make(PUBLISHER, GROUP, NODE),
        make(SUBSCRIBER, GROUP, NODE),
        make(WRITER, WRITER_A, PUBLISHER),
    ):
        assert objects.create(create).status is Status.OK
    assert bridge.graph == ["0:/a", "/a [std_msgs/msg/Int32]"]
    return objects, bridge
