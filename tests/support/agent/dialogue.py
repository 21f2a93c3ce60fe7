# SPDX-License-Identifier: Apache-2.0
"""Messages of a client that publishes, and a bench that has one."""

from __future__ import annotations

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import Submessage, encode
from tests.support.agent.captured import CREATE_CLIENT, STATUS_AGENT
from tests.support.agent.client import dds_type, participant_blob, topic_blob, writer_blob
from tests.support.agent.fakes import Bench

WRITE = "07 01 08 00 00 05 00 15 2a 00 00 00"
GRAPH = ["0:/a", "/a [std_msgs/msg/Int32]"]


def message(*submessages: Submessage, stream: int = 1, sequence: int = 0, little: bool = True) -> bytes:
    return join(Header(0x81, stream, sequence), [encode(s, little) for s in submessages])


def entities(number: int = 1, mode: str = "reuse replace", topic: str = "a") -> list[Create]:
    ids = [number << 4 | kind for kind in (1, 2, 3, 5)]
    flags = ("reuse" in mode, "replace" in mode)
    int32 = dds_type("std_msgs/msg/Int32")
    return [
        Create(10, ids[0], 1, Format.BINARY, participant_blob("a"), 0, 0, *flags),
        Create(11, ids[1], 2, Format.BINARY, topic_blob(f"rt/{topic}", int32), ids[0], 0, *flags),
        Create(12, ids[2], 3, Format.BINARY, b"\0\0", ids[0], 0, *flags),
        Create(13, ids[3], 5, Format.BINARY, writer_blob(ids[1], 3, 10), ids[2], 0, *flags),
    ]


def connected(limits: Limits | None = None) -> Bench:
    bench = Bench(limits)
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]
    return bench


def publishing(limits: Limits | None = None) -> Bench:
    bench = connected(limits)
    for sequence, create in enumerate(entities()):
        (answer,) = bench.say(message(create, sequence=sequence))
        assert answer.endswith("00 00")
    assert bench.bridge.graph == GRAPH
    return bench
