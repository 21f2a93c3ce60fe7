# SPDX-License-Identifier: Apache-2.0
"""OUT/agent/: what the agent must hold, and what the application file cannot ask of it."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from microros_gen import compiler
from microros_gen.client.plan.creation import CreateNames, create_size
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.ids import without_id

NODES = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu
    namespace: /arm
    domain_id: 7
    publishers:
      - {topic: data, type: std_msgs/msg/Int32, qos: {reliability: best_effort, depth: 1}}
      - {topic: /state, type: std_msgs/msg/String, qos: {durability: transient_local, history: keep_all}}
limits: {"*": {string: 16}}
"""
SECOND = """\
  - name: leg
    publishers: [{topic: /state, type: std_msgs/msg/String, qos: {durability: transient_local, history: keep_all}}]
"""


def two_nodes() -> str:
    return NODES.replace("limits:", SECOND + "limits:")


def rendered(folder: Path, text: str) -> dict[str, bytes]:
    """Return the files of an application by their paths; UserError where it is refused."""
    config = folder / "microros.yaml"
    config.write_text(text, encoding="utf-8")
    planned = compiler.plan(
        compiler.resolve(compiler.read(compiler.Options(config=config, interface_paths=(shipped_folder(),))))
    )
    return compiler.render(planned)


def refused(folder: Path, text: str) -> str:
    with pytest.raises(UserError) as caught:
        rendered(folder, text)
    (diagnostic,) = caught.value.diagnostics
    return without_id(diagnostic.headline())


def profiles(files: dict[str, bytes]) -> dict[tuple[str, str], ElementTree.Element]:
    root = ElementTree.fromstring(files["agent/references.xml"])
    assert root.tag == "profiles"
    return {(element.tag, element.attrib["profile_name"]): element for element in root}


def test_references_have_the_names_of_micro_ros(tmp_path: Path) -> None:
    found = profiles(rendered(tmp_path, NODES + "entities: reference\n"))
    assert set(found) == {
        ("participant", "participant_profile"),
        ("topic", "arm/data__t"),
        ("data_writer", "arm/data__dw"),
        ("topic", "state__t"),
        ("data_writer", "state__dw"),
    }
    assert found["participant", "participant_profile"].findtext("rtps/name") == "/arm/imu"
    assert found["topic", "arm/data__t"].findtext("name") == "rt/arm/data"
    assert found["topic", "state__t"].findtext("dataType") == "std_msgs::msg::dds_::String_"
    writer = found["data_writer", "state__dw"]
    assert [writer.findtext(path) for path in ("topic/name", "topic/historyQos/kind")] == [
        "rt/state",
        "KEEP_ALL",
    ]
    assert writer.findtext("qos/durability/kind") == "TRANSIENT_LOCAL"
    assert writer.findtext("qos/reliability/kind") == "RELIABLE"
    best_effort = found["data_writer", "arm/data__dw"]
    assert best_effort.findtext("topic/historyQos/depth") == "1"
    assert best_effort.findtext("qos/reliability/kind") == "BEST_EFFORT"


def test_several_nodes_have_references_of_their_own_and_share_what_is_alike(tmp_path: Path) -> None:
    found = profiles(rendered(tmp_path, two_nodes() + "entities: reference\n"))
    assert [name for tag, name in found if tag == "participant"] == ["arm/imu__p", "leg__p"]
    assert [name for tag, name in found if tag == "data_writer"] == ["arm/data__dw", "state__dw"]


@pytest.mark.parametrize(
    "change",
    [
        ("keep_all}}]", "keep_last}}]"),
        ("[{topic: /state, type: std_msgs/msg/String", "[{topic: /state, type: std_msgs/msg/Int32"),
    ],
)
def test_one_reference_for_two_is_refused(tmp_path: Path, change: tuple[str, str]) -> None:
    text = two_nodes().replace(*change)
    assert text != two_nodes()
    error_text = refused(tmp_path, text + "entities: reference\n")
    assert error_text.partition("microros.yaml:")[2].startswith("11:")
    assert (
        "two publishers of /state differ in type or QoS and would get the same reference name, 'state__dw'"
        in error_text
    )
    assert "microros.yaml:9:" in error_text
    rendered(tmp_path, text)


SERVICES = """\
version: 1
profiles: [pure_sender]
components: [+services]
nodes:
  - name: arm
    namespace: /left
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    services: [{name: grip, type: std_srvs/srv/SetBool}]
    clients:
      - {name: ~/ask, type: std_srvs/srv/Empty}
      - {name: ~/ask, type: std_srvs/srv/Empty}
limits: {"*": {string: 16}}
"""


def test_services_have_their_topics_and_types(tmp_path: Path) -> None:
    found = profiles(rendered(tmp_path, SERVICES + "entities: reference\n"))
    replier = found["replier", "left/grip__rp"]
    assert replier.attrib["service_name"] == "/left/grip"
    assert replier.attrib["reply_type"] == "std_srvs::srv::dds_::SetBool_Response_"
    assert replier.findtext("request_topic_name") == "rq/left/gripRequest"
    assert replier.findtext("subscriber/topic/historyQos/depth") == "10"
    requester = found["requester", "left/arm/ask__rq"]
    assert requester.attrib["request_type"] == "std_srvs::srv::dds_::Empty_Request_"
    assert requester.findtext("reply_topic_name") == "rr/left/arm/askReply"
    files = rendered(tmp_path, SERVICES + "entities: preconfigured\n")
    objects = json.loads(files["agent/entities.json"])["clients"][0]["objects"]
    ids = [(entry["id"], entry["kind"], entry["parent"]) for entry in objects[-3:]]
    assert ids == [
        ("0x0018", "replier", "0x0001"),
        ("0x0027", "requester", "0x0001"),
        ("0x0037", "requester", "0x0001"),
    ]


@pytest.mark.parametrize(
    ("kind", "other", "place", "error_text"),
    [
        ("services", "{name: /left/grip, type: std_srvs/srv/SetBool}", "10:16", "two servers for /left/grip"),
        (
            "clients",
            "{name: grip, type: std_srvs/srv/Empty}",
            "11:28",
            "/left/grip has the type std_srvs/srv/Empty here",
        ),
    ],
)
def test_a_service_has_one_server_and_one_type(
    tmp_path: Path, kind: str, other: str, place: str, error_text: str
) -> None:
    start, end = SERVICES.split("    services: [")
    first = end.partition("]")[0]
    limits = 'limits: {"*": {string: 16}}\n'
    both = f"    services:\n      - {first}\n"
    text = start + both + ("" if kind == "services" else "    clients:\n") + f"      - {other}\n" + limits
    line = refused(tmp_path, text)
    assert error_text in line
    assert line.partition("microros.yaml:")[2].startswith(f"{place}:")


def test_pools_get_what_the_example_creates(tmp_path: Path) -> None:
    files = rendered(
        tmp_path, "version: 1\nprofiles: [static_configured_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
    )
    assert set(profiles(files)) == {
        ("participant", "participant_profile"),
        ("topic", "int32__t"),
        ("data_writer", "int32__dw"),
    }
    readme = files["README.md"].decode()
    assert "`-r agent/references.xml`" in readme
    assert "`a/b__t`" in readme


def test_entities_are_the_objects_of_the_client(tmp_path: Path) -> None:
    files = rendered(tmp_path, two_nodes() + "entities: preconfigured\nsession: {key: 0xA1B2C3D4}\n")
    content = json.loads(files["agent/entities.json"])
    assert content["version"] == 1
    (client,) = content["clients"]
    assert client["key"] == "0xA1B2C3D4"
    ids = [(entry["id"], entry["kind"], entry.get("parent")) for entry in client["objects"]]
    assert ids == [
        ("0x0001", "participant", None),
        ("0x0002", "topic", "0x0001"),
        ("0x0003", "publisher", "0x0001"),
        ("0x0005", "data_writer", "0x0003"),
        ("0x0012", "topic", "0x0001"),
        ("0x0013", "publisher", "0x0001"),
        ("0x0015", "data_writer", "0x0013"),
        ("0x0011", "participant", None),
        ("0x0022", "topic", "0x0011"),
        ("0x0023", "publisher", "0x0011"),
        ("0x0025", "data_writer", "0x0023"),
    ]
    assert client["objects"][0] == {"id": "0x0001", "kind": "participant", "name": "/arm/imu", "domain": 7}
    assert client["objects"][6]["topic"] == "0x0012"
    assert client["objects"][6]["history"] == "keep_all"
    assert client["objects"][3]["reliability"] == "best_effort"
    assert "--entities\nagent/entities.json`" in files["README.md"].decode()


def test_a_device_s_own_key_is_any(tmp_path: Path) -> None:
    files = rendered(tmp_path, NODES + "entities: preconfigured\nsession: {key: device}\n")
    assert json.loads(files["agent/entities.json"])["clients"][0]["key"] == "*"


def test_a_client_that_never_reconnects_has_to_be_adopted(tmp_path: Path) -> None:
    silent = "entities: preconfigured\nliveliness: none\n"
    (client,) = json.loads(rendered(tmp_path, NODES + silent)["agent/entities.json"])["clients"]
    assert client["adopt"] is True
    device = rendered(tmp_path, NODES + silent + "session: {key: device}\n")
    assert "adopt" not in device["agent/entities.json"].decode()


@pytest.mark.parametrize("entities", ["binary", "xml"])
def test_an_agent_with_all_options_needs_no_file(tmp_path: Path, entities: str) -> None:
    files = rendered(tmp_path, NODES + f"entities: {entities}\n")
    assert not [path for path in files if path.startswith("agent/")]
    assert f"({entities})" in files["README.md"].decode()


def test_the_files_are_in_the_manifest(tmp_path: Path) -> None:
    files = rendered(tmp_path, NODES + "entities: reference\n")
    assert "agent/references.xml" in json.loads(files["manifest.json"])["outputs"]


def test_preconfigured_needs_nodes(tmp_path: Path) -> None:
    error_text = refused(
        tmp_path,
        "version: 1\nprofiles: [pure_sender]\nentities: preconfigured\ninterfaces: [std_msgs/msg/Int32]\n",
    )
    assert "microros.yaml:3:11: error: entities: preconfigured" in error_text
    assert "needs `nodes:`" in error_text
    assert error_text.endswith("Declare the nodes and their endpoints, or write `entities: reference`")


@pytest.mark.parametrize("entities", ["binary", "xml", "reference"])
def test_sizes_of_create(entities: str) -> None:
    """Counted by hand from the captured messages: rt/chatter of String in my_node."""
    names = CreateNames(len("my_node"), len("rt/chatter"), len("std_msgs::msg::dds_::String_"), 19)
    captured = {
        "binary": 4 + 4 + 0x43,
        "xml": 20
        + len(
            "<dds><data_writer><topic><kind>NO_KEY</kind><name>rt/chatter</name><dataType>std_msgs::msg::dds_::String_"
        )
        + len(
            "</dataType><historyQos><kind>KEEP_LAST</kind><depth>65535</depth></historyQos></topic><qos><durability>"
        )
        + len(
            "<kind>TRANSIENT_LOCAL</kind></durability><reliability><kind>BEST_EFFORT</kind></reliability></qos>"
        )
        + len("</data_writer></dds>")
        + 1
        + 2,
        "reference": 20 + len("participant_profile") + 1 + 2,
    }
    assert create_size(names, entities) == captured[entities]
