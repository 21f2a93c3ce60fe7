# SPDX-License-Identifier: Apache-2.0
"""The standard's own XML (DDS-XRCE 1.0, 7.7.3): types, qualities of service, applications, and what they name."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.agent.representation import Durability, Endpoint, Qos, QosProfile, TypeDefinition
from microros_gen.agent.representation.description import UnknownNameError
from microros_gen.agent.representation.xml import from_xml
from microros_gen.agent.wire.constants import Format, ObjectKind, Status
from microros_gen.agent.wire.errors import MalformedError
from tests.support.agent.client import dds_type
from tests.support.agent.objects import (
    NODE,
    PUBLISHER,
    READER,
    SUBSCRIBER,
    TOPIC,
    WRITER,
    complete,
    make,
    tree,
)
from tests.support.examples import examples

INT32 = dds_type("std_msgs/msg/Int32")
TYPES = """<types><module name="MyModule"><struct name="Inner" nested="true"/>
<struct name="ShapeType"><member name="color" key="true" type="string"/></struct></module></types>"""
QOS = """<qos_library name="MyQosLib"><qos_profile name="MyProfile">
<data_writer_qos><reliability><kind>BEST_EFFORT_RELIABILITY_QOS</kind></reliability>
<durability><kind>TRANSIENT_LOCAL_DURABILITY_QOS</kind></durability></data_writer_qos>
<data_reader_qos><reliability><kind>RELIABLE_RELIABILITY_QOS</kind></reliability>
<history><kind>KEEP_LAST_HISTORY_QOS</kind><depth>7</depth></history></data_reader_qos>
</qos_profile></qos_library>"""
MODIFIED = """<qos_library name="MyQosLib"><qos_profile name="Modified" base_name="MyQosLib:MyProfile">
<data_reader_qos><deadline><period><sec>120</sec></period></deadline></data_reader_qos></qos_profile></qos_library>"""
APPLICATION = f"""<application_library name="MyAppLibrary"><application name="Both">
<domain_participant name="talker" domain_id="3">
  <register_type name="Int" type_ref="{INT32}"/>
  <topic name="rt/count" register_type_ref="Int"/><topic name="rt/echo" register_type_ref="Int"/>
  <publisher name="p"><data_writer name="w" topic_ref="rt/count"/>
    <data_writer name="v" topic_ref="rt/echo"/></publisher>
</domain_participant>
<domain_participant name="listener" domain_id="4">
  <topic name="rt/count" register_type_ref="{INT32}"/>
  <subscriber name="s"><data_reader name="r" topic_ref="rt/count">
    <data_reader_qos base_name="MyQosLib::MyProfile"/></data_reader></subscriber>
</domain_participant></application></application_library>"""
READER_QOS = Qos(True, Durability.VOLATILE, True, 7)
GRAPH = [
    "3:/talker",
    "/count [std_msgs/msg/Int32]",
    "/echo [std_msgs/msg/Int32]",
    "4:/listener",
    "/count [std_msgs/msg/Int32]",
]


def test_a_type() -> None:
    """7.7.3.3.2: one type that is not nested; it is referenced by its name with its modules."""
    assert from_xml(ObjectKind.TYPE, TYPES, 0) == TypeDefinition("MyModule::ShapeType", TYPES)


def test_a_quality_of_service() -> None:
    """7.7.3.2.2"""
    found = from_xml(ObjectKind.QOSPROFILE, QOS, 0)
    writer = Qos(False, Durability.TRANSIENT_LOCAL)
    assert found == QosProfile("MyQosLib::MyProfile", writer, READER_QOS)


def test_types_and_qualities_are_made_named_and_deleted() -> None:
    objects, bridge = complete()
    assert objects.create(make(0x1A, TYPES)).status is Status.OK
    assert objects.create(make(0x2A, "MyModule::Other", form=Format.REFERENCE)).status is Status.OK
    assert objects.create(make(0x1A, TYPES, mode="reuse")).status is Status.OK_MATCHED
    assert objects.create(make(0x1A, TYPES.replace("color", "x"), mode="reuse")).status is Status.MISMATCH
    assert objects.create(make(0x1B, MODIFIED)).status is Status.UNKNOWN_REFERENCE
    assert objects.create(make(0x1B, QOS)).status is Status.OK
    assert objects.create(make(0x2B, MODIFIED)).status is Status.OK
    text = '<data_reader name="r" topic_ref="rt/a"><data_reader_qos base_name="MyQosLib::Modified"/></data_reader>'
    assert objects.create(make(READER, text, SUBSCRIBER)).status is Status.OK
    (reader,) = bridge.sources
    assert reader.qos == Qos(True, Durability.VOLATILE, True, 7, deadline_ms=120_000)  # type: ignore[attr-defined]
    assert [objects.delete(i) for i in (0x1A, 0x1B, 0x2B, 0x2A)] == [Status.OK] * 4
    assert bridge.sources == [reader], "it has what it needs"
    assert objects.delete(0x1B) is Status.UNKNOWN_REFERENCE


def test_topics_writers_and_readers() -> None:
    """7.7.3.7.2, 7.7.3.10.1, 7.7.3.11.1: an endpoint names a topic of its participant."""
    objects, bridge = complete()
    assert (
        objects.create(make(0x22, f'<topic name="rt/b" register_type_ref="{INT32}"/>', NODE)).status
        is Status.OK
    )
    writer = make(0x25, '<data_writer name="w" topic_ref="rt/b"/>', PUBLISHER)
    assert objects.create(writer).status is Status.OK
    assert bridge.graph[-1] == "/b [std_msgs/msg/Int32]"
    other = make(0x35, '<data_writer name="w" topic_ref="rt/c"/>', PUBLISHER)
    outcome = objects.create(other)
    assert (outcome.status, outcome.reason) == (
        Status.UNKNOWN_REFERENCE,
        "data_writer 'w': unknown topic 'rt/c'",
    )
    filtered = (
        '<data_reader name="r" topic_ref="rt/b"><content_filter name="f"><expression> x &gt; 5 </expression>'
        "</content_filter></data_reader>"
    )
    refused = objects.create(make(0x26, filtered, SUBSCRIBER))
    assert (refused.status, refused.reason) == (
        Status.INCOMPATIBLE,
        "ROS 2 cannot filter by content: 'x > 5'",
    )
    slow = filtered.split("<content_filter")[0] + (
        "<data_reader_qos><time_based_filter><minimum_separation><sec>10</sec></minimum_separation>"
        "</time_based_filter></data_reader_qos></data_reader>"
    )
    outcome = objects.create(make(0x26, slow, SUBSCRIBER))
    assert outcome.entity is not None
    assert isinstance(outcome.entity.description, Endpoint)
    assert outcome.entity.description.separation_ms == 10_000


def test_a_participant() -> None:
    """7.7.3.6.2; objects within it would have no ids, so they are refused by name."""
    objects, bridge = tree()
    text = '<domain_participant_library name="L"><domain_participant name="p"/></domain_participant_library>'
    assert objects.create(make(NODE, text, domain=9)).status is Status.OK
    assert bridge.graph == ["9:/p"]
    inside = text.replace("/></", '><topic name="t"/></domain_participant></')
    assert "as an application" in objects.create(make(0x21, inside)).reason
    group = make(PUBLISHER, '<publisher><data_writer name="w" topic_ref="x"/></publisher>', NODE)
    assert objects.create(group).status is Status.INVALID_DATA


def test_an_application_makes_its_objects() -> None:
    """7.7.3.5 and table 6; the n-th object of a kind has the number of the application plus n."""
    objects, bridge = tree()
    assert objects.create(make(0x1B, QOS)).status is Status.OK
    assert objects.create(make(0x101C, APPLICATION)).status is Status.OK
    assert bridge.graph == GRAPH
    ids = {0x101C, 0x1011, 0x1021, 0x1012, 0x1022, 0x1032, 0x1013, 0x1014, 0x1015, 0x1025, 0x1016}
    assert {e.id for e in objects} == ids | {0x1B}
    assert set(objects.publish) == {0x1015, 0x1025}
    reader = objects.find(0x1016)
    assert reader is not None
    assert isinstance(reader.description, Endpoint)
    assert reader.description.qos == READER_QOS
    assert objects.create(make(0x101C, APPLICATION, mode="reuse")).status is Status.OK_MATCHED
    assert objects.create(make(0x101C, APPLICATION, mode="replace")).status is Status.OK
    assert bridge.graph == GRAPH
    assert objects.delete(0x101C) is Status.OK
    assert bridge.graph == []
    assert {e.id for e in objects} == {0x1B}


def test_an_application_sleeps_and_wakes_as_others() -> None:
    objects, bridge = tree()
    objects.create(make(0x1B, QOS))
    objects.create(make(0x101C, APPLICATION))
    objects.suspend()
    assert bridge.graph == []
    assert objects.resume() == []
    assert bridge.graph == GRAPH


@pytest.mark.parametrize(
    ("text", "status"),
    [
        (APPLICATION.replace("std_msgs", "no_such_package"), Status.DDS_ERROR),
        (APPLICATION.replace('topic_ref="rt/echo"', 'topic_ref="rt/x"'), Status.UNKNOWN_REFERENCE),
        (APPLICATION.replace("MyProfile", "Mine"), Status.UNKNOWN_REFERENCE),
        (APPLICATION.replace('domain_id="3"', 'domain_id="x"'), Status.INVALID_DATA),
        (APPLICATION.replace(' register_type_ref="Int"', ""), Status.INVALID_DATA),
        (APPLICATION.replace("application", "domain"), Status.INVALID_DATA),
    ],
)
def test_of_an_application_nothing_stays_when_a_part_fails(text: str, status: Status) -> None:
    """7.8.3.1: the failure to create any nested entity is a failure of what contains it."""
    objects, bridge = tree()
    objects.create(make(0x1B, QOS))
    outcome = objects.create(make(0x101C, text))
    assert outcome.status is status, outcome
    assert outcome.reason
    assert bridge.graph == []
    assert [e.id for e in objects] == [0x1B]


def test_an_application_does_not_take_ids_that_are_used() -> None:
    objects, bridge = complete()
    objects.create(make(0x1B, QOS))
    before = list(bridge.graph)
    outcome = objects.create(make(0x001C, APPLICATION))
    assert outcome.status is Status.ALREADY_EXISTS
    assert bridge.graph == before
    assert {e.id for e in objects} == {NODE, TOPIC, PUBLISHER, SUBSCRIBER, WRITER, 0x1B}


def test_an_application_keeps_to_the_limit() -> None:
    objects, bridge = tree(maximum=5)
    objects.create(make(0x1B, QOS))
    assert objects.create(make(0x101C, APPLICATION)).status is Status.RESOURCES
    assert bridge.graph == []
    assert len(objects) == 1


chunks = st.sampled_from(
    [
        "types", "struct", "qos_library", "qos_profile", "application_library", "application", "topic",
        "domain_participant", "publisher", "data_writer", "data_writer_qos", "reliability", "kind", "deadline",
        "period", "sec", "history", "depth", "name='a'", "topic_ref='a'", "base_name='a::b'", "<", ">", "/>", "</",
        "RELIABLE", "99999999999", "-1", "\u0660",
    ]
)  # fmt: skip


@settings(max_examples=examples(300), deadline=None)
@given(st.sampled_from((1, 2, 3, 5, 6, 10, 11, 12)), st.lists(chunks, max_size=20))
def test_any_text_is_described_or_refused(kind: int, words: list[str]) -> None:
    with contextlib.suppress(MalformedError, UnknownNameError):
        from_xml(kind, "".join(words), 0)


@settings(max_examples=examples(200), deadline=None)
@given(st.sampled_from([TYPES, QOS, MODIFIED, APPLICATION]), st.data())
def test_any_damaged_text_is_described_or_refused(text: str, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(text)))
    broken = text[:at] + data.draw(st.text(max_size=3)) + text[at + data.draw(st.integers(0, 3)) :]
    for kind in (ObjectKind.TYPE, ObjectKind.QOSPROFILE, ObjectKind.APPLICATION):
        with contextlib.suppress(MalformedError, UnknownNameError):
            from_xml(kind, broken, 0)
