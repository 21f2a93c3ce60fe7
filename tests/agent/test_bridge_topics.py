# SPDX-License-Identifier: Apache-2.0
"""Topics through the bridge: raw samples both ways, of any type, and when the bridge names a source."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from microros_gen.agent.representation import Durability, Qos, Topic
from microros_gen.agent.ros.bridge import BridgeError, BusyError, Reader, Writer
from microros_gen.agent.ros.endpoints import FULL_S
from microros_gen.agent.wire.constants import Status
from microros_gen.interfaces.type_hashes import type_hashes
from microros_gen.ros import raw_types
from tests.support.agent.bridging import Bridged, opened
from tests.support.agent.observer import Observer, observing
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

INT32 = "std_msgs/msg/Int32"
DDS_INT32 = "std_msgs::msg::dds_::Int32_"


def int32(value: int) -> bytes:
    return b"\0\1\0\0" + value.to_bytes(4, "little", signed=True)


def is_seen(observer: Observer, topic: str, count: int = 1) -> Callable[[], bool]:
    """Return whether an observer knows so many endpoints of the bridge."""
    return lambda: len(observer.ask(do="endpoints", topic=topic)) >= count


def test_samples_of_a_client_in_either_byte_order(bridged: Bridged, bridge_observer: Observer) -> None:
    bridge_observer.subscribe("/orders", INT32)
    node = bridged.bridge.create_node("orders", bridged.domain)
    writer = node.create_writer(
        Topic("rt/orders", DDS_INT32), Qos(durability=Durability.TRANSIENT_LOCAL, depth=9)
    )
    bridge_observer.subscribe("/orders", INT32, transient_local=True)
    assert writer.label == "/orders [std_msgs/msg/Int32]"
    writer.publish(int32(-5))
    writer.publish(b"\0\0\0\0" + (1000).to_bytes(4, "big"))
    values = [value["data"] for _, value in bridge_observer.got(2)]
    assert set(values) == {-5, 1000}
    node.destroy()


def publish_patiently(writer: Writer, sample: bytes) -> None:
    """Publish as the core does: again, while DDS waits for acknowledgements."""
    end = deadline(15)
    while True:
        try:
            writer.publish(sample)
        except BusyError:
            assert time.monotonic() < end
            time.sleep(FULL_S)
        else:
            return


def test_a_reader_of_the_agent_that_was_full_gets_every_sample(bridged: Bridged) -> None:
    """DDS has room for 5,000 samples in it; within a process Fast DDS would not deliver what came afterwards."""
    node = bridged.bridge.create_node("full", bridged.domain)
    reader = node.create_reader(Topic("rt/full", DDS_INT32), Qos(keep_last=False))
    writer = node.create_writer(Topic("rt/full", DDS_INT32), Qos(keep_last=False))
    sent = received = 0
    for more in (7_000, 60):
        for _ in range(more):
            publish_patiently(writer, int32(sent))
            sent += 1
        for sample in bridged.take(reader, sent - received):
            assert sample == int32(received)
            received += 1
    assert reader.take() is None
    node.destroy()


def test_samples_for_a_client_are_the_bytes_of_ros(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("listener", bridged.domain)
    qos = Qos(durability=Durability.TRANSIENT_LOCAL, depth=200)
    reader = node.create_reader(Topic("rt/names", "std_msgs::msg::dds_::String_"), qos)
    values = [{"data": "s" * i} for i in range(150)]
    ask = {"topic": "/names", "type": "std_msgs/msg/String", "transient_local": True}
    sent = bridge_observer.ask(do="publish", values=values, **ask)
    taken = bridged.take(reader, 150)
    assert [_unpadded(sample, size // 2) for sample, size in zip(taken, map(len, sent), strict=True)] == sent
    assert reader.take() is None
    # What was published before a reader is there comes as well, and wakes it up.
    late = node.create_reader(Topic("rt/names", "std_msgs::msg::dds_::String_"), qos)
    assert bridged.take(late, 150) == taken
    node.destroy()


def _unpadded(sample: bytes, size: int) -> str:
    """Take off what rmw_fastrtps adds to a multiple of four bytes."""
    assert len(sample) - size < 4
    assert not any(sample[size:])
    return sample[:size].hex()


def test_a_source_is_named_again_for_what_is_new_only(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("slow", bridged.domain)
    qos = Qos(durability=Durability.TRANSIENT_LOCAL, depth=50)
    readers = [node.create_reader(Topic(f"rt/slow{i}", DDS_INT32), qos) for i in range(2)]
    named: list[object] = []

    def publish(topic: str, *values: int) -> None:
        found = [{"data": value} for value in values]
        bridge_observer.ask(do="publish", topic=topic, type=INT32, values=found, transient_local=True)

    def next_of(reader: Reader) -> bytes:
        end = deadline(15)
        while time.monotonic() < end:
            if reader in bridged.named(0.05) and (taken := reader.take()) is not None:
                return taken
        raise AssertionError("nothing came")

    publish("/slow0", 1, 2, 3)
    assert next_of(readers[0]) == int32(1)
    end = time.monotonic() + 0.3
    while time.monotonic() < end:
        bridged.named(0.01)  # the others are on their way
    for _ in range(20):
        named += [s for s in bridged.named(0.01) if s in readers]
    assert named == [], "two samples are left, but nothing new came"
    publish("/slow1", 7)
    assert next_of(readers[1]) == int32(7)
    assert [readers[0].take(), readers[0].take(), readers[0].take()] == [int32(2), int32(3), None]
    publish("/slow0", 4)
    assert next_of(readers[0]) == int32(4)
    node.destroy()


def test_a_type_without_a_python_package(bridged: Bridged, bridge_observer: Observer, tmp_path: Path) -> None:
    """From its interface file alone: right name, right hash, bytes both ways."""
    folder = tmp_path / "acme_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Thing.msg").write_text("std_msgs/Header header\nfloat64[<=4] values\n")
    hash_of = type_hashes([tmp_path])
    expected = hash_of("acme_msgs/msg/Thing")
    assert expected is not None
    assert expected.startswith("RIHS01_")
    topics = [Topic(f"rt/things_{way}", "acme_msgs::msg::dds_::Thing_") for way in ("out", "in")]
    node = bridged.bridge.create_node("maker", bridged.domain, hash_of)
    reader = node.create_reader(topics[1], Qos(depth=5))
    writer = node.create_writer(topics[0], Qos(durability=Durability.TRANSIENT_LOCAL, depth=5))
    bridge_observer.ask(do="subscribe_raw", topic="/things_out", type="acme_msgs/msg/Thing", hash=expected)
    bridged.wait(is_seen(bridge_observer, "/things_out", 2))
    bridged.wait(is_seen(bridge_observer, "/things_in"))
    for topic in ("/things_out", "/things_in"):
        found = bridge_observer.ask(do="endpoints", topic=topic)
        assert {(endpoint["type"], endpoint["hash"]) for endpoint in found} == {
            ("acme_msgs/msg/Thing", expected)
        }
    sample = b"\0\1\0\0" + bytes(range(40))
    bridged.wait(lambda: _published(writer, sample, bridge_observer))
    node.destroy()
    assert reader.take() is None


def _published(writer, sample: bytes, observer: Observer) -> bool:  # type: ignore[no-untyped-def]
    writer.publish(sample)
    return ["/things_out", sample.hex()] in observer.ask(do="samples")


def test_quality_of_service_in_the_graph(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("robot/arm/qos", bridged.domain)
    lasting = Qos(True, Durability.TRANSIENT, keep_last=False, deadline_ms=250, lifespan_ms=1500)
    node.create_writer(Topic("rt/qos", DDS_INT32), lasting)
    node.create_reader(Topic("rt/qos", DDS_INT32), Qos(reliable=False, depth=3))

    def found() -> object:
        seen = bridge_observer.ask(do="endpoints", topic="/qos")
        return len(seen) == 2 and {endpoint["node"] for endpoint in seen} == {"/robot/arm/qos"}

    bridged.wait(found)
    writer, reader = sorted(
        bridge_observer.ask(do="endpoints", topic="/qos"), key=lambda endpoint: str(endpoint["kind"])
    )
    assert (writer["kind"], writer["reliability"], writer["durability"]) == (
        "PUBLISHER",
        "RELIABLE",
        "TRANSIENT_LOCAL",
    )
    assert (writer["deadline_ns"], writer["lifespan_ns"]) == (250_000_000, 1_500_000_000)
    assert writer["liveliness"] == "AUTOMATIC"
    assert (reader["kind"], reader["reliability"], reader["durability"]) == (
        "SUBSCRIPTION",
        "BEST_EFFORT",
        "VOLATILE",
    )
    assert reader["deadline_ns"] > 1e18, "no deadline"
    node.destroy()
    bridged.wait(lambda: not bridge_observer.ask(do="endpoints", topic="/qos"))


def test_what_is_destroyed_gives_everything_back(bridged: Bridged) -> None:
    def descriptors() -> int:
        """Count eventfds: Fast DDS opens and closes its own files."""
        return sum(_target(fd) == "anon_inode:[eventfd]" for fd in Path("/proc/self/fd").iterdir())

    topic = Topic("rt/again", DDS_INT32)
    bridged.bridge.create_node("first", bridged.domain).destroy()
    before = descriptors()
    for _ in range(5):
        node = bridged.bridge.create_node("again", bridged.domain)
        reader, writer = node.create_reader(topic, Qos()), node.create_writer(topic, Qos())
        assert descriptors() == before + 2, "one for the reader, one for events of the node"
        writer.publish(int32(1))
        reader.destroy()
        reader.destroy()
        assert reader.take() is None
        node.destroy()  # the writer goes with it
        with pytest.raises(BridgeError, match="/again"):
            writer.publish(int32(1))
        assert descriptors() == before


def _target(descriptor: Path) -> str:
    try:
        return str(descriptor.readlink())
    except OSError:
        return ""


def _has_node(name: str, graph: dict[str, Any]) -> bool:
    return name in graph["nodes"]


def test_domains_are_apart(bridged: Bridged, bridge_observer: Observer) -> None:
    other = bridged.domain + 1
    with observing(other) as other_observer:
        nodes = [bridged.bridge.create_node(f"in_{d}", d) for d in (bridged.domain, other)]
        for node in nodes:
            node.create_writer(Topic("rt/apart", DDS_INT32), Qos())
        here_seen, there_seen = (
            watching.see(partial(_has_node, name))["nodes"]
            for watching, name in (
                (bridge_observer, f"/in_{bridged.domain}"),
                (other_observer, f"/in_{other}"),
            )
        )
        assert f"/in_{other}" not in here_seen
        assert f"/in_{bridged.domain}" not in there_seen
        for node in nodes:
            node.destroy()


def test_the_agent_keeps_its_place_in_the_graph_when_clients_go(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    """A client that comes back is seen at once: others need not discover the agent again."""
    bridged.bridge.create_node("first", bridged.domain).destroy()
    own = f"/_microros_agent_{os.getpid()}"
    bridge_observer.see(lambda g: own in g["nodes"] and "/first" not in g["nodes"])
    with opened(bridged.domain) as another:
        another.bridge.create_node("second", bridged.domain).destroy()
        bridge_observer.see(lambda g: g["nodes"].count(own) == 2)
    bridge_observer.see(lambda g: g["nodes"].count(own) == 1)


def test_domains_are_limited_and_reused() -> None:
    with opened(3, maximum_domains=1) as small:
        node = small.bridge.create_node("one", 3)
        with pytest.raises(BridgeError, match="domains are in use") as caught:
            small.bridge.create_node("two", 4)
        assert caught.value.status is Status.RESOURCES
        with pytest.raises(BridgeError, match="does not exist"):
            small.bridge.create_node("two", 233)
        node.destroy()
        small.bridge.create_node("two", 4).destroy()


def test_types_are_limited_and_nothing_is_imported_for_them(
    bridged: Bridged, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A type name from the network must not run a module that happens to be installed, nor fill the memory."""
    package = tmp_path / "evil_package"
    (package / "msg").mkdir(parents=True)
    (package / "__init__.py").write_text(f"raise SystemExit({os.getpid()})\n")
    (package / "msg" / "__init__.py").write_text("class X: pass\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    node = bridged.bridge.create_node("evil", bridged.domain)
    node.create_writer(Topic("rt/evil", "evil_package::msg::dds_::X_"), Qos())
    monkeypatch.setattr(raw_types, "MAXIMUM_HANDLES", 1)
    node.create_writer(Topic("rt/evil", "evil_package::msg::dds_::X_"), Qos())
    with pytest.raises(BridgeError, match="types were used") as caught:
        node.create_writer(Topic("rt/evil2", "evil_package::msg::dds_::Y_"), Qos())
    assert caught.value.status is Status.RESOURCES
    node.destroy()


def test_what_is_not_possible_is_refused_by_name(bridged: Bridged) -> None:
    node = bridged.bridge.create_node("impossible", bridged.domain)
    node.create_writer(Topic("rt/taken", DDS_INT32), Qos())
    for create in (node.create_writer, node.create_reader):
        with pytest.raises(BridgeError, match="/impossible has this topic with the type std_msgs/msg/Int32"):
            create(Topic("rt/taken", "std_msgs::msg::dds_::String_"), Qos())
    with pytest.raises(BridgeError, match="is not a type hash"):
        bridged.bridge.create_node("wrong", bridged.domain, lambda _name: "RIHS01_12").create_reader(
            Topic("rt/wrong", DDS_INT32), Qos()
        )
    node.destroy()
