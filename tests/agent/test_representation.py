# SPDX-License-Identifier: Apache-2.0
"""Binary and XML representations come to the same description."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.agent.representation import (
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    References,
    Service,
    Topic,
    describe,
)
from microros_gen.agent.representation.description import UnsupportedKindError
from microros_gen.agent.representation.reference import UnknownReferenceError
from microros_gen.agent.wire.constants import Format, ObjectKind
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.errors import MalformedError
from tests.support.agent import captured
from tests.support.examples import examples

STRING = "std_msgs::msg::dds_::String_"
CHATTER = Topic("rt/chatter", STRING)
SERVICE = Service(
    "/set_bool",
    "std_srvs::srv::dds_::SetBool_Request_",
    "std_srvs::srv::dds_::SetBool_Response_",
    "rq/set_boolRequest",
    "rr/set_boolReply",
)
SERVICE_XML = (
    '<dds><{0} profile_name="p" service_name="/set_bool"'
    ' request_type="std_srvs::srv::dds_::SetBool_Request_"'
    ' reply_type="std_srvs::srv::dds_::SetBool_Response_"><request_topic_name>rq/set_boolRequest'
    "</request_topic_name><reply_topic_name>rr/set_boolReply</reply_topic_name></{0}></dds>"
)
FULL_WRITER_XML = (
    "<dds><data_writer><qos><durability><kind>VOLATILE</kind></durability><reliability>"
    "<kind>RELIABLE</kind></reliability></qos><topic><kind>NO_KEY</kind><name>rt/chatter</name>"
    f"<dataType>{STRING}</dataType><historyQos><kind>KEEP_LAST</kind><depth>10</depth></historyQos>"
    "</topic></data_writer></dds>"
)


def of(kind: int, form: int, body: bytes, domain: int = 0, little: bool = True) -> Description:
    return describe(Create(1, 0x10 | kind, kind, form, body, 0, domain, little=little), References())


def service_blob() -> bytes:
    from microros_gen.agent.wire.cdr import Writer

    blob = Writer().string(SERVICE.name).string(SERVICE.request_type).string(SERVICE.reply_type)
    return blob.flag(True).string(SERVICE.request_topic).flag(True).string(SERVICE.reply_topic).content()


@pytest.mark.parametrize(
    ("kind", "blob", "description"),
    [
        (1, captured.PARTICIPANT_BLOB, Participant("my_node", 77)),
        (2, captured.TOPIC_BLOB, CHATTER),
        (3, "00 00", Group()),
        (4, "00 00", Group()),
        (5, captured.WRITER_BLOB, Endpoint(None, 0x12, Qos(True, Durability.VOLATILE, True, 10))),
        (
            5,
            captured.WRITER_BLOB_WITHOUT_DEPTH,
            Endpoint(None, 0x12, Qos(False, Durability.TRANSIENT_LOCAL, True, 0)),
        ),
        (5, "00 12 00", Endpoint(None, 0x12, Qos())),
        (6, captured.READER_BLOB, Endpoint(None, 0x22, Qos(True, Durability.VOLATILE, True, 10))),
        (7, service_blob().hex(), SERVICE),
        (8, service_blob().hex(), SERVICE),
        # publisher with a name and two partitions
        (
            3,
            "01 000000 02000000 7000 01 01 02000000 02000000 6100 0000 02000000 6200",
            Group("p", ("a", "b")),
        ),
    ],
)
def test_binary(kind: int, blob: str, description: Description) -> None:
    domain = 77 if kind == 1 else 0
    assert of(kind, Format.BINARY, bytes.fromhex(blob), domain) == description


def test_binary_in_big_endian() -> None:
    blob = bytes.fromhex("00 12 01 00 00 09 01 00 00 05 01 00 00 00 00 64 00 00 00")
    wanted = Qos(True, Durability.TRANSIENT_LOCAL, False, 5, deadline_ms=100)
    assert of(5, Format.BINARY, blob, little=False) == Endpoint(None, 0x12, wanted)


@pytest.mark.parametrize(
    ("bits", "durability"),
    [
        (0, Durability.VOLATILE),
        (8, Durability.TRANSIENT_LOCAL),
        (16, Durability.TRANSIENT),
        (32, Durability.PERSISTENT),
    ],
)
def test_durability_bits(bits: int, durability: Durability) -> None:
    blob = bytes.fromhex(f"0012 01 00 {bits:02x}00 00 00 00 00 00")
    description = of(5, Format.BINARY, blob)
    assert isinstance(description, Endpoint)
    assert description.qos == Qos(False, durability, False, 0)


@pytest.mark.parametrize(
    ("kind", "text", "description"),
    [
        (1, captured.PARTICIPANT_XML, Participant("p1", 77)),
        (1, "<dds><participant profile_name='x'/></dds>", Participant("", 77)),
        (2, captured.TOPIC_XML, CHATTER),
        (3, "", Group()),
        (4, "", Group()),
        (3, "<dds><publisher name='p'/></dds>", Group("p")),
        (5, FULL_WRITER_XML, Endpoint(CHATTER, 0, Qos(True, Durability.VOLATILE, True, 10))),
        (5, captured.WRITER_XML, Endpoint(CHATTER, 0, Qos(True, Durability.TRANSIENT_LOCAL, True, 1))),
        (
            6,
            captured.WRITER_XML.replace("data_writer", "data_reader"),
            Endpoint(CHATTER, 0, Qos(False, Durability.VOLATILE, True, 1)),
        ),
        (7, SERVICE_XML.format("requester"), SERVICE),
        (8, SERVICE_XML.format("replier"), SERVICE),
        (2, captured.TOPIC_XML.replace("<dds>", "<dds xmlns='http://www.eprosima.com'>"), CHATTER),
    ],
)
def test_xml(kind: int, text: str, description: Description) -> None:
    domain = 77 if kind == 1 else 0
    assert of(kind, Format.XML, text.encode(), domain) == description


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<dds>",
        "<dds/>",
        "no xml",
        "<?xml version='1.0' encoding='nonsense'?><dds/>",
        "<!DOCTYPE dds><dds/>",
        FULL_WRITER_XML.replace("RELIABLE", "PERHAPS"),
        FULL_WRITER_XML.replace(">10<", ">many<"),
        FULL_WRITER_XML.replace(">10<", ">65536<"),
        FULL_WRITER_XML.replace(">10<", f">{'9' * 5000}<"),
        FULL_WRITER_XML.replace(">rt/chatter<", "><"),
    ],
)
def test_bad_xml_is_malformed(text: str) -> None:
    with pytest.raises(MalformedError):
        of(5, Format.XML, text.encode())


def test_kinds_without_a_representation() -> None:
    """7.7.3.2, 7.7.3.3, 7.7.3.5: these have no binary form."""
    for kind in (ObjectKind.TYPE, ObjectKind.QOSPROFILE, ObjectKind.APPLICATION):
        with pytest.raises(UnsupportedKindError):
            of(kind, Format.BINARY, b"")


def test_references_are_defined_at_the_agent() -> None:
    known = References({(ObjectKind.TOPIC, "chatter"): CHATTER})
    create = Create(1, 0x12, ObjectKind.TOPIC, Format.REFERENCE, b"chatter")
    assert describe(create, known) == CHATTER
    with pytest.raises(UnknownReferenceError, match="chatter"):
        describe(create, References())


@settings(max_examples=examples(300), deadline=None)
@given(st.sampled_from(range(1, 9)), st.binary(max_size=60), st.booleans())
def test_any_blob_is_described_or_malformed(kind: int, blob: bytes, little: bool) -> None:
    with contextlib.suppress(MalformedError):
        of(kind, Format.BINARY, blob, little=little)
