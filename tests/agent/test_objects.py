# SPDX-License-Identifier: Apache-2.0
"""Creation modes, references between objects, deletion in any order, sleep."""

from __future__ import annotations

import pytest

from microros_gen.agent.wire.constants import Format, ObjectKind, Status
from microros_gen.agent.wire.entity_messages import Create
from tests.support.agent import captured
from tests.support.agent.client import dds_type, reader_blob, topic_blob, writer_blob
from tests.support.agent.objects import (
    GROUP,
    INT32,
    NODE,
    NODE_A,
    NODE_B,
    PUBLISHER,
    READER,
    SUBSCRIBER,
    TOPIC,
    TOPIC_A,
    TOPIC_B,
    WRITER,
    WRITER_A,
    WRITER_B,
    complete,
    make,
    tree,
)


@pytest.mark.parametrize("form", ["binary", "xml"])
@pytest.mark.parametrize(
    ("mode", "same", "different"),
    [
        ("", Status.ALREADY_EXISTS, Status.ALREADY_EXISTS),
        ("reuse", Status.OK_MATCHED, Status.MISMATCH),
        ("replace", Status.OK, Status.OK),
        ("reuse replace", Status.OK_MATCHED, Status.OK),
    ],
)
def test_creation_modes(form: str, mode: str, same: Status, different: Status) -> None:
    """DDS-XRCE 1.0, table 7; the statuses are those that the public agent was seen to give."""
    objects, bridge = tree()
    a: bytes | str = NODE_A if form == "binary" else captured.PARTICIPANT_XML.replace("p1", "a")
    b: bytes | str = NODE_B if form == "binary" else captured.PARTICIPANT_XML.replace("p1", "b")
    assert objects.create(make(NODE, a, mode=mode)).status is Status.OK
    assert objects.create(make(NODE, a, mode=mode)).status is same
    assert objects.create(make(NODE, b, mode=mode)).status is different
    assert bridge.graph == ["0:/b" if "replace" in mode else "0:/a"]


@pytest.mark.parametrize(
    ("create", "status"),
    [
        (make(0x22, TOPIC_A, 0x21), Status.UNKNOWN_REFERENCE),
        (make(0x23, GROUP, 0x21), Status.UNKNOWN_REFERENCE),
        (make(0x25, WRITER_A, 0x23), Status.UNKNOWN_REFERENCE),
        (make(0x25, writer_blob(0x92, 3, 1), PUBLISHER), Status.UNKNOWN_REFERENCE),
        (make(0x21, b"\0"), Status.INVALID_DATA),
        (make(0x22, b"\0\0\0\0\0\0", NODE), Status.INVALID_DATA),
        (make(0x21, "<dds><participant>"), Status.INVALID_DATA),
        (make(0x21, "<dds></dds>"), Status.INVALID_DATA),
        (make(0x22, "<dds><topic><name>rt/a</name></topic></dds>", NODE), Status.INVALID_DATA),
        (make(0x21, "<!DOCTYPE a [<!ENTITY b 'c'>]><dds/>"), Status.INVALID_DATA),
        (make(0x21, "default", form=Format.REFERENCE), Status.DDS_ERROR),
        (make(READER, reader_blob(TOPIC, 3, 10), 0x24), Status.UNKNOWN_REFERENCE),
        (make(0x17, b"", NODE), Status.INVALID_DATA),
        (make(0x18, b"", NODE), Status.INVALID_DATA),
        (make(0x1A, "x"), Status.INVALID_DATA),
        (make(0x1B, "<types/>"), Status.INVALID_DATA),
        (make(0x1C, "<application_library/>"), Status.INVALID_DATA),
        (make(0x1A, b"x"), Status.DENIED),
        (make(0x1B, "x", form=Format.REFERENCE), Status.DDS_ERROR),
        (make(0x16, reader_blob(TOPIC, 3, 10, content_filter="x > 5"), SUBSCRIBER), Status.INCOMPATIBLE),
        (make(0x23, bytes.fromhex("00 01 01 00 01000000 02000000 6100 00"), NODE), Status.INCOMPATIBLE),
    ],
)
def test_refused_with_a_reason_and_nothing_changed(create: Create, status: Status) -> None:
    objects, bridge = complete()
    outcome = objects.create(create)
    assert (outcome.status, len(objects), len(bridge.graph)) == (status, 5, 2)
    assert outcome.reason


@pytest.mark.parametrize(
    ("topic", "type_name", "status"),
    [
        ("rt/x", dds_type("no_such_package/msg/X"), Status.DDS_ERROR),
        ("x", INT32, Status.INVALID_DATA),
        ("rt/1x", INT32, Status.INVALID_DATA),
        ("rt/x", "Int32", Status.INVALID_DATA),
        ("rt/x", "os::msg::dds_::path/../../X_", Status.INVALID_DATA),
    ],
)
def test_a_writer_that_ros_cannot_have(topic: str, type_name: str, status: Status) -> None:
    objects, bridge = complete()
    assert objects.create(make(0x22, topic_blob(topic, type_name), NODE)).status is Status.OK
    outcome = objects.create(make(0x25, writer_blob(0x22, 3, 1), PUBLISHER))
    assert outcome.status is status
    assert topic in outcome.reason or type_name.split("::")[0] in outcome.reason
    assert len(bridge.graph) == 2


def test_the_kind_of_the_representation_counts_in_ids() -> None:
    """As with the public agent: the low four bits of an id in a CREATE are taken from what is created."""
    objects, _ = tree()
    assert objects.create(make(0x1F, NODE_A, kind=ObjectKind.PARTICIPANT)).status is Status.OK
    assert objects.create(make(TOPIC, TOPIC_A, 0x10)).status is Status.OK
    assert objects.delete(0x11) is Status.OK


def test_xml_writers_need_no_topic_object() -> None:
    objects, bridge = tree()
    objects.create(make(NODE, captured.PARTICIPANT_XML))
    objects.create(make(PUBLISHER, "", NODE))
    assert objects.create(make(WRITER, captured.WRITER_XML, PUBLISHER)).status is Status.OK
    assert bridge.graph == ["0:/p1", "/chatter [std_msgs/msg/String]"]


def test_without_a_name_the_client_names_the_node() -> None:
    objects, bridge = tree()
    objects.create(make(NODE, b"\0\0"))
    assert bridge.graph == ["0:/fallback"]


@pytest.mark.parametrize(
    ("replacement", "left", "graph"),
    [
        (make(NODE, NODE_B, mode="replace"), {NODE}, ["0:/b"]),
        (make(NODE, NODE_A, mode="replace", domain=3), {NODE}, ["3:/a"]),
        (make(TOPIC, TOPIC_B, NODE, mode="replace"), {NODE, PUBLISHER, SUBSCRIBER, TOPIC}, ["0:/a"]),
        (
            make(WRITER, WRITER_B, PUBLISHER, mode="reuse replace"),
            {NODE, TOPIC, PUBLISHER, SUBSCRIBER, WRITER},
            ["0:/a", "/a [std_msgs/msg/Int32]"],
        ),
    ],
)
def test_what_was_made_from_a_replaced_object_goes_with_it(
    replacement: Create, left: set[int], graph: list[str]
) -> None:
    objects, bridge = complete()
    assert objects.create(replacement).status is Status.OK
    assert ({e.id for e in objects}, bridge.graph) == (left, graph)
    assert set(objects.publish) == left & {WRITER}


def test_a_matching_writer_of_a_new_topic_is_no_match() -> None:
    objects, bridge = complete()
    assert objects.delete(TOPIC) is Status.OK
    assert objects.create(make(TOPIC, TOPIC_B, NODE)).status is Status.OK
    again = objects.create(make(WRITER, WRITER_A, PUBLISHER, mode="reuse replace"))
    assert again.status is Status.OK
    assert bridge.graph == ["0:/a", "/b [std_msgs/msg/Int32]"]


@pytest.mark.parametrize(
    "order",
    [
        [TOPIC, WRITER, PUBLISHER, NODE],  # micro-ROS
        [PUBLISHER, WRITER, TOPIC, NODE],
        [NODE, PUBLISHER, WRITER, TOPIC],
        [WRITER, PUBLISHER, TOPIC, NODE],
    ],
)
def test_every_order_of_cleaning_up_succeeds(order: list[int]) -> None:
    objects, bridge = complete()
    assert [objects.delete(i) for i in order] == [Status.OK] * 4
    assert bridge.graph == []
    assert objects.delete(WRITER) is Status.UNKNOWN_REFERENCE


def test_a_writer_outlives_the_delete_of_its_topic() -> None:
    objects, bridge = complete()
    objects.delete(TOPIC)
    assert WRITER in objects.publish
    assert len(bridge.graph) == 2


def test_the_number_of_objects_is_limited() -> None:
    objects, _ = tree(maximum=2)
    assert objects.create(make(NODE, NODE_A)).status is Status.OK
    assert objects.create(make(TOPIC, TOPIC_A, NODE)).status is Status.OK
    assert objects.create(make(PUBLISHER, GROUP, NODE)).status is Status.RESOURCES
    assert objects.create(make(TOPIC, TOPIC_B, NODE, mode="replace")).status is Status.OK


def test_sleep_leaves_the_graph_and_waking_returns() -> None:
    objects, bridge = complete()
    before = list(bridge.graph)
    objects.delete(TOPIC)
    objects.suspend()
    assert bridge.graph == []
    assert objects.publish == {}
    assert objects.resume() == []
    assert bridge.graph == before
    objects.publish[WRITER](b"x")
    assert bridge.published == [("/a [std_msgs/msg/Int32]", b"x")]


def test_what_cannot_return_is_dropped_with_what_hangs_on_it(monkeypatch: pytest.MonkeyPatch) -> None:
    from microros_gen.agent.ros.bridge import BridgeError

    objects, bridge = complete()
    objects.suspend()

    def refuse(name: str, domain: int, hash_of: object = None) -> None:
        raise BridgeError("no")

    monkeypatch.setattr(bridge, "create_node", refuse)
    failed = objects.resume()
    assert [e.id for e, _ in failed] == [NODE, WRITER]
    assert len(objects) == 0
    assert objects.publish == {}
