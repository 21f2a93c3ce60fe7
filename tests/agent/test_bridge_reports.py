# SPDX-License-Identifier: Apache-2.0
"""What the bridge tells about the ROS graph: matches, other qualities of service, other types, other hashes."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from typing import Any

import pytest

from microros_gen.agent.log import EventLog
from microros_gen.agent.representation import Durability, Qos, Topic
from microros_gen.agent.ros.bridge import (
    GraphReport,
    HashMismatch,
    HashUnknown,
    Incompatible,
    Matched,
    NoClient,
    NoServer,
    OtherDomain,
    ServerFound,
    TypeMismatch,
)
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.interfaces.type_hashes import type_hashes
from tests.support.agent.bridging import GET_TYPES, Bridged, get_types
from tests.support.agent.observer import Observer

pytestmark = pytest.mark.ros

INT32 = "std_msgs/msg/Int32"
DDS_INT32 = "std_msgs::msg::dds_::Int32_"
WRONG = "RIHS01_" + "5" * 64


def is_reported(bridged: Bridged, wanted: GraphReport) -> Callable[[], bool]:
    return lambda: wanted in bridged.reports


def test_matches_and_departures_are_reported(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("ns/matching", bridged.domain)
    reader = node.create_reader(Topic("rt/matched", DDS_INT32), Qos())
    writer = node.create_writer(Topic("rt/matched", DDS_INT32), Qos())
    label = f"/matched [{INT32}]"
    bridged.wait(is_reported(bridged, Matched("/ns/matching", "publisher", label, 1)))
    bridge_observer.subscribe("/matched", INT32)
    bridged.wait(is_reported(bridged, Matched("/ns/matching", "publisher", label, 2)))
    writer.destroy()
    bridged.wait(is_reported(bridged, Matched("/ns/matching", "subscription", label, 0)))
    reader.destroy()
    node.destroy()


def test_an_incompatible_qos_is_reported_by_policy(bridged: Bridged, bridge_observer: Observer) -> None:
    bridge_observer.subscribe("/picky", INT32, transient_local=True)
    bridge_observer.ask(do="publish", topic="/plain", type=INT32, values=[], reliable=False)
    node = bridged.bridge.create_node("qos_of_another", bridged.domain)
    node.create_writer(Topic("rt/picky", DDS_INT32), Qos())
    node.create_reader(Topic("rt/plain", DDS_INT32), Qos())
    offered = Incompatible("/qos_of_another", "publisher", f"/picky [{INT32}]", "durability", 1)
    wanted = Incompatible("/qos_of_another", "subscription", f"/plain [{INT32}]", "reliability", 1)
    bridged.wait(is_reported(bridged, offered))
    bridged.wait(is_reported(bridged, wanted))
    assert "another quality of service, durability" in str(offered)
    node.destroy()


def test_another_definition_is_reported_with_both_hashes(bridged: Bridged, bridge_observer: Observer) -> None:
    right = type_hashes()(INT32)
    assert right is not None
    bridge_observer.subscribe("/defined", INT32)
    manifest = {INT32: WRONG}.get
    node = bridged.bridge.create_node("old_firmware", bridged.domain, manifest)
    node.create_writer(Topic("rt/defined", DDS_INT32), Qos())
    label = f"/defined [{INT32}]"
    bridged.wait(is_reported(bridged, HashMismatch("/old_firmware", label, WRONG, "/observer", right)))
    node.destroy()
    # The same with the right hash: it is compared, and nothing is told.
    before = len(bridged.reports)
    node = bridged.bridge.create_node("new_firmware", bridged.domain, type_hashes())
    node.create_writer(Topic("rt/defined", DDS_INT32), Qos())
    bridged.wait(is_reported(bridged, Matched("/new_firmware", "publisher", label, 1)))
    bridged.wait_for(0.8)
    assert not [r for r in bridged.reports[before:] if isinstance(r, HashMismatch)]
    node.destroy()


def test_another_definition_of_a_service_is_reported(bridged: Bridged, bridge_observer: Observer) -> None:
    right = type_hashes()
    bridge_observer.ask(do="serve", service="/serves", type=GET_TYPES, hold=1)
    manifest = {f"{GET_TYPES}_Response": WRONG}.get
    node = bridged.bridge.create_node("old_asker", bridged.domain, manifest)
    node.create_requester(get_types("serves"))
    expected = right(f"{GET_TYPES}_Response")
    assert expected is not None
    mismatch = HashMismatch("/old_asker", f"/serves [{GET_TYPES}]", WRONG, "/observer", expected)
    bridged.wait(is_reported(bridged, mismatch))
    node.destroy()


def test_another_type_of_the_same_topic_is_reported(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("numbers", bridged.domain)
    node.create_writer(Topic("rt/confused", DDS_INT32), Qos())
    bridge_observer.subscribe("/confused", "std_msgs/msg/String")
    wanted = TypeMismatch("/numbers", f"/confused [{INT32}]", "/observer", "std_msgs/msg/String")
    bridged.wait(is_reported(bridged, wanted))
    node.destroy()


def test_a_type_without_definition_is_reported_once() -> None:
    from tests.support.agent.bridging import opened

    with opened(5, hash_of=lambda _name: None) as blind:
        node = blind.bridge.create_node("blind", 5)
        for i in range(2):
            node.create_writer(Topic(f"rt/blind{i}", DDS_INT32), Qos(durability=Durability.PERSISTENT))
        assert blind.reports.count(HashUnknown(INT32)) == 1
        node.destroy()


@pytest.mark.parametrize(
    ("reported", "level", "event"),
    [
        (Matched("/n", "publisher", "/t [a/msg/B]", 2), "debug", "matched"),
        (Incompatible("/n", "publisher", "/t [a/msg/B]", "deadline", 1), "warning", "incompatible_qos"),
        (HashMismatch("/n", "/t [a/msg/B]", "RIHS01_0", "/o", "RIHS01_1"), "warning", "type_hash_mismatch"),
        (TypeMismatch("/n", "/t [a/msg/B]", "/o", "a/msg/C"), "warning", "type_mismatch"),
        (HashUnknown("a/msg/B"), "warning", "type_hash_unknown"),
        (NoServer("/n", "/s [a/srv/B]", "gone", 1), "warning", "no_server"),
        (ServerFound("/n", "/s [a/srv/B]", 1), "info", "server_found"),
        (NoClient("/n", "/s [a/srv/B]", 1), "info", "no_client"),
    ],
)
def test_reports_in_the_log(reported: Any, level: str, event: str) -> None:
    out = io.StringIO()
    graph_reporter(EventLog(out, as_json=True, verbosity=1))(reported)
    line = json.loads(out.getvalue())
    assert (line["level"], line["event"], line["message"]) == (level, event, str(reported))
    out = io.StringIO()
    graph_reporter(EventLog(out))(reported)
    assert out.getvalue() == {"debug": "", "info": f"{reported}\n"}.get(level, f"{level}: {reported}\n")


def test_a_domain_other_than_the_shells_is_reported_once(bridged: Bridged) -> None:
    """A client of domain 0 where ROS_DOMAIN_ID is another: nothing is wrong, and `ros2` sees nothing of it."""
    other = bridged.domain % 100 + 101
    nodes = [bridged.bridge.create_node(f"elsewhere_{n}", other) for n in range(2)]
    own = bridged.bridge.create_node("here", bridged.domain)
    assert [node.domain for node in (*nodes, own)] == [other, other, bridged.domain]
    reported = [report for report in bridged.reports if isinstance(report, OtherDomain)]
    assert reported == [OtherDomain("/elsewhere_0", other, bridged.domain)]
    assert f"Start the agent with --domain {bridged.domain}" in str(reported[0])
    for node in (*nodes, own):
        node.destroy()
