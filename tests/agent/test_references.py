# SPDX-License-Identifier: Apache-2.0
"""Files of references: what they hold, what is wrong with them, and what clients get of them."""

from __future__ import annotations

import pytest

from microros_gen.agent.representation import Durability, Endpoint, Participant, Qos, References, Topic
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.agent.wire.constants import Format, Status
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.diagnostics import Source, UserError
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench
from tests.support.agent.references import INT32, PROFILES
from tests.support.ids import without_id

WRITER = Endpoint(Topic("rt/count", INT32), 0, Qos(True, Durability.VOLATILE, True, 10))


def read(text: str) -> References:
    return read_references([Source("refs.xml", text)])


def faults(*texts: str) -> list[str]:
    with pytest.raises(UserError) as caught:
        read_references([Source(f"refs{i}.xml", text) for i, text in enumerate(texts)])
    return [without_id(d.headline()) for d in caught.value.diagnostics]


def wrapped(text: str) -> str:
    return text.replace("<profiles>", "<dds xmlns='http://www.eprosima.com'><profiles>").replace(
        "</profiles>", "</profiles></dds>"
    )


@pytest.mark.parametrize("text", [PROFILES, wrapped(PROFILES), "\n".join(PROFILES.split("\n")[1:])])
def test_profiles(text: str) -> None:
    known = read(text).known
    assert known == {
        (1, "participant_profile"): Participant("counter", 0),
        (2, "count__t"): WRITER.topic,
        (5, "count__dw"): WRITER,
    }


def test_the_public_agents_other_kinds_and_older_names() -> None:
    """As in the file that comes with it: services, both kinds of endpoint, elements that are not for an agent."""
    topic = "<topic><kind>WITH_KEY</kind><name>Square</name><dataType>ShapeType</dataType></topic>"
    known = read(
        "<dds><log/><types/><profiles><transport_descriptors/>"
        f"<publisher profile_name='w'>{topic}</publisher><subscriber profile_name='r'>{topic}</subscriber>"
        "<requester profile_name='q' service_name='s' request_type='a' reply_type='b'></requester>"
        "<replier profile_name='q' service_name='s' request_type='a' reply_type='b'></replier>"
        "</profiles></dds>"
    ).known
    assert sorted(known) == [(5, "w"), (6, "r"), (7, "q"), (8, "q")]


def test_several_files_join() -> None:
    other = PROFILES.replace("count__", "other__")
    assert len(read_references([Source("a", PROFILES), Source("b", other)]).known) == 5


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("", "refs0.xml:1:1: error: not well-formed XML: no element found"),
        ("<profiles>\n  <topic></profiles>", "refs0.xml:2:12: error: not well-formed XML: mismatched tag"),
        ("<profile/>", "refs0.xml:1:1: error: <profile> contains no references. The root"),
        (
            "<dds>\n <topic/></dds>",
            "refs0.xml:2:2: error: <topic> is not allowed in <dds>. Put profiles into",
        ),
        ("<!DOCTYPE x>\n<profiles/>", "refs0.xml:1:1: error: document types and entities are not supported"),
        (
            PROFILES.replace("<topic prof", "<tpoic prof").replace(
                "</dataType></topic>\n  <", "</dataType></tpoic>\n  <"
            ),
            "refs0.xml:4:3: error: unknown kind of profile 'tpoic'. Did you mean 'topic'?",
        ),
        (
            PROFILES.replace(' profile_name="count__t"', ""),
            "refs0.xml:4:3: error: this topic has no profile_name",
        ),
        (
            PROFILES.replace("<name>rt/count</name>", "", 1),
            "refs0.xml:4:3: error: topic 'count__t': no text in 'name'",
        ),
        (
            PROFILES.replace(">RELIABLE<", ">RELIABEL<"),
            "refs0.xml:8:69: error: data_writer 'count__dw': 'qos/reliability/kind' is not one of "
            "RELIABLE, BEST_EFFORT",
        ),
        (
            PROFILES.replace(">10<", ">many<"),
            "refs0.xml:7:41: error: data_writer 'count__dw': a history depth",
        ),
    ],
)
def test_faults(text: str, wanted: str) -> None:
    found = faults(text)
    assert found[0].startswith(wanted), found


def test_all_faults_in_one_run_and_across_files() -> None:
    bad = PROFILES.replace(' profile_name="count__t"', "").replace(">10<", ">many<")
    other = PROFILES.replace(INT32, "std_msgs::msg::dds_::String_")
    found = faults(bad, PROFILES, other)
    assert [line.split(" ")[0] for line in found] == [
        "refs0.xml:4:3:",
        "refs0.xml:7:41:",
        "refs2.xml:4:3:",
        "refs2.xml:5:3:",
    ]
    assert "duplicate name 'count__t'; first in refs1.xml:4:3. Give one" in found[2]


LIBRARIES = """<dds>
<application_library name="Apps"><application name="Counter"><domain_participant name="counter" domain_id="5">
  <topic name="rt/count" register_type_ref="std_msgs::msg::dds_::Int32_"/>
  <publisher><data_writer topic_ref="rt/count"><data_writer_qos base_name="Q::Lasting"/></data_writer></publisher>
</domain_participant></application></application_library>
<qos_library name="Q"><qos_profile name="Lasting"><data_writer_qos>
  <durability><kind>TRANSIENT_LOCAL_DURABILITY_QOS</kind></durability></data_writer_qos></qos_profile>
  <qos_profile name="Deep" base_name="Q::Lasting"><data_writer_qos><history><depth>9</depth></history>
  </data_writer_qos></qos_profile></qos_library></dds>"""


def test_libraries_of_qualities_and_applications() -> None:
    """DDS-XRCE 1.0, 7.7.3.2.1 and 7.7.3.5.1: a client names an application that the agent holds."""
    references = read(LIBRARIES)
    assert sorted(references.known) == [(11, "Q::Deep"), (11, "Q::Lasting"), (12, "Apps::Counter")]
    bench = Bench(references=references)
    bench.say(CREATE_CLIENT)
    (answer,) = bench.say(message(Create(1, 0x10C, 12, Format.REFERENCE, b"Apps::Counter")))
    assert answer.endswith("00 00")
    assert bench.bridge.graph == ["5:/counter", "/count [std_msgs/msg/Int32]"]
    bench.say(message(WriteData(1, 0x105, int32_body(5)), sequence=1))
    assert len(bench.bridge.published) == 1
    (answer,) = bench.say(message(Create(1, 0x20B, 11, Format.REFERENCE, b"Q::Deep"), sequence=2))
    assert answer.endswith("00 00")


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (
            LIBRARIES.replace('base_name="Q::Lasting"/>', 'base_name="Q::Last"/>'),
            "refs0.xml:2:34: error: application 'Counter': unknown quality of service 'Q::Last'",
        ),
        (LIBRARIES.replace('name="Q"', ""), "refs0.xml:6:1: error: this qos_library has no name"),
        (
            LIBRARIES.replace(">9<", ">x<"),
            "refs0.xml:8:3: error: qos_profile 'Deep': a history depth that is not a number",
        ),
    ],
)
def test_faults_of_libraries(text: str, wanted: str) -> None:
    assert faults(text)[0].startswith(wanted), faults(text)


def creates() -> list[Create]:
    names = {0x11: b"participant_profile", 0x12: b"count__t", 0x15: b"count__dw"}
    wanted = [
        Create(
            10 + i, object_id, object_id & 15, Format.REFERENCE, name, 0x13 if object_id == 0x15 else 0x11, 7
        )
        for i, (object_id, name) in enumerate(names.items())
    ]
    publisher = Create(20, 0x13, 3, Format.XML, b"", 0x11)
    return [*wanted[:2], publisher, wanted[2]]


def test_a_client_that_names_its_entities() -> None:
    bench = Bench(references=read(PROFILES))
    bench.say(CREATE_CLIENT)
    for sequence, create in enumerate(creates()):
        (answer,) = bench.say(message(create, sequence=sequence))
        assert answer.endswith("00 00"), answer
    assert bench.bridge.graph == ["7:/counter", "/count [std_msgs/msg/Int32]"]  # the domain is the client's
    bench.say(message(WriteData(1, 0x15, int32_body(5)), sequence=9))
    assert bench.bridge.published == [("/count [std_msgs/msg/Int32]", b"\0\1\0\0" + int32_body(5))]


@pytest.mark.parametrize(
    ("references", "name", "wanted"),
    [
        (
            PROFILES,
            "count_dw",
            "unknown reference 'count_dw' among 1 of kind datawriter. Did you mean 'count__dw'?",
        ),
        (PROFILES, "zzz", "unknown reference 'zzz' among 1 of kind datawriter\n"),
        ("<profiles/>", "x", "reference 'x': the agent has no references; start it with --references FILE"),
        (PROFILES, "y" * 20_000, "' among 1 of kind datawriter\n"),
    ],
)
def test_an_unknown_reference(references: str, name: str, wanted: str) -> None:
    bench = Bench(references=read(references))
    bench.say(CREATE_CLIENT)
    (answer,) = bench.say(message(Create(10, 0x15, 5, Format.REFERENCE, name.encode(), 0x13)))
    assert answer.endswith(f"{Status.DDS_ERROR:02x} 00")  # as the public agent does
    assert wanted in bench.text.getvalue()
