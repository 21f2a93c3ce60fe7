# SPDX-License-Identifier: Apache-2.0
"""An XRCE client that reads and serves, with rclpy on the other side."""

from __future__ import annotations

import time
from collections.abc import Callable

from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import DeliveryControl, ReadData
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.bridging import GET_TYPES
from tests.support.agent.client import (
    RELIABLE,
    XrceClient,
    dds_type,
    participant_blob,
    reader_blob,
    service_blob,
    topic_blob,
)
from tests.support.patience import deadline

INT32 = "std_msgs/msg/Int32"
LITTLE = b"\0\1\0\0"
READER_QOS_RELIABLE_KEEP_LAST = 3
IDENTITY = 24
REQUEST_PREFIX = 4


def subscription(client: XrceClient, node: str, topic: str, type_name: str, domain: int) -> int:
    """Create node, topic, subscriber and reader, ask for all samples; return the reader's id."""
    create(client, 0x11, participant_blob(node), 0, domain)
    create(client, 0x12, topic_blob(f"rt/{topic}", dds_type(type_name)), 0x11)
    create(client, 0x14, b"\0\0", 0x11)
    create(client, 0x16, reader_blob(0x12, READER_QOS_RELIABLE_KEEP_LAST, 200), 0x14)
    ask_for_all(client, 0x16)
    return 0x16


def service(client: XrceClient, object_id: int, node: str, name: str, domain: int) -> int:
    """Create a node and a replier or a requester, ask for all that comes; return its id."""
    create(client, 0x11, participant_blob(node), 0, domain)
    create(client, object_id, service_blob(name, GET_TYPES), 0x11)
    ask_for_all(client, object_id)
    return object_id


def create(client: XrceClient, object_id: int, body: bytes, parent: int, domain: int = 0) -> None:
    status = client.create(object_id, Format.BINARY, body, parent, domain)
    assert status in (0, 1), f"{object_id:#06x}: {status:#04x}"


def ask_for_all(client: XrceClient, object_id: int) -> None:
    question = ReadData(client._next_request(), object_id, RELIABLE, delivery=DeliveryControl(0xFFFF))
    client.send(RELIABLE, encode(question))


def until(done: Callable[[], object], timeout_s: float = 15.0) -> None:
    end = deadline(timeout_s)
    while not done():
        assert time.monotonic() < end
        time.sleep(0.02)
