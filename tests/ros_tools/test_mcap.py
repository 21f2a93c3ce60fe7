# SPDX-License-Identifier: Apache-2.0
"""Recordings, read by the package rosbags; and those that it wrote, read here."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from microros_gen.ros.known_types import KnownType, KnownTypes
from microros_gen.ros.qos import Qos
from microros_gen.ros_tools.mcap import MAGIC, McapWriter
from microros_gen.ros_tools.mcap_reader import Channel, McapError, McapReader
from microros_gen.ros_tools.playing import offered_qos
from microros_gen.ros_tools.recording import schema_of
from tests.support.ros.values import random_value

CHUNKS = (1, 200, 1 << 20)
"""Bytes: a chunk for each message, for a few, for all."""


@pytest.fixture(scope="module")
def known() -> KnownType:
    return KnownTypes().message("diagnostic_msgs/msg/DiagnosticArray")


@pytest.mark.parametrize("chunk_bytes", CHUNKS)
def test_messages_are_read_back(tmp_path: Path, known: KnownType, chunk_bytes: int) -> None:
    source = random.Random(7)
    path = tmp_path / "x.mcap"
    written: list[tuple[str, int, bytes]] = []
    with path.open("wb") as file:
        writer = McapWriter(file, "test", chunk_bytes)
        schema = schema_of(known.name, known.interfaces)
        channels = [writer.add_channel(topic, schema, {"k": "v"}) for topic in ("/a", "/b")]
        for number in range(20):
            channel = source.choice(channels)
            value = random_value(known.interfaces.messages, known.name, source)
            data = known.codec.encode(known.name, value)
            written.append((("/a", "/b")[channel], 1000 + number, data))
            writer.add(channel, data, 1000 + number, 900 + number)
        writer.close()
    with AnyReader([path]) as reader:
        read = [(c.topic, time, bytes(data)) for c, time, data in reader.messages()]
        assert read == written
        assert (reader.start_time, reader.end_time) == (1000, 1020)
        connection, _, data = next(iter(reader.messages()))
        message = reader.deserialize(data, connection.msgtype)
        assert len(vars(message)["status"]) == len(known.codec.decode(known.name, bytes(data))["status"])


def test_messages_out_of_order_are_found_by_time(tmp_path: Path, known: KnownType) -> None:
    path = tmp_path / "x.mcap"
    data = known.codec.encode(known.name, {})
    with path.open("wb") as file:
        writer = McapWriter(file, "test", 1)
        channel = writer.add_channel("/a", schema_of(known.name, known.interfaces), {})
        for time in (3000, 1000, 2000):
            writer.add(channel, data, time, time)
        writer.close()
    with AnyReader([path]) as reader:
        assert [time for _, time, _ in reader.messages()] == [1000, 2000, 3000]
        assert [time for _, time, _ in reader.messages(start=1500, stop=2500)] == [2000]


def test_an_empty_recording_is_a_file(tmp_path: Path, known: KnownType) -> None:
    path = tmp_path / "x.mcap"
    with path.open("wb") as file:
        McapWriter(file, "test").close()
    data = path.read_bytes()
    assert data.startswith(MAGIC)
    assert data.endswith(MAGIC)


def test_types_of_idl_files_are_recorded_as_idl(tmp_path: Path) -> None:
    folder = tmp_path / "own_msgs"
    (folder / "msg").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>own_msgs</name></package>")
    (folder / "msg" / "Letter.idl").write_text(
        "module own_msgs { module msg { struct Letter { wchar letter; }; }; };\n"
    )
    known = KnownTypes([folder]).message("own_msgs/msg/Letter")
    schema = schema_of(known.name, known.interfaces)
    assert schema.encoding == "ros2idl"
    assert "IDL: own_msgs/msg/Letter\n" in schema.text


def recording(path: Path, times: tuple[int, ...], chunk_bytes: int = 1) -> None:
    with path.open("wb") as file:
        writer = McapWriter(file, "test", chunk_bytes)
        channels = [writer.add_channel(topic, None, {"k": topic}) for topic in ("/a", "/b")]
        for number, time in enumerate(times):
            writer.add(channels[number % 2], bytes((number,)) * 9, time, time)
        writer.close()


@pytest.mark.parametrize("chunk_bytes", CHUNKS)
def test_a_recording_is_read_in_the_order_of_time(tmp_path: Path, chunk_bytes: int) -> None:
    path, times = tmp_path / "x.mcap", (3000, 1000, 2000, 2000, 5000, 4000)
    recording(path, times, chunk_bytes)
    reader = McapReader(path)
    assert (reader.first, reader.last, reader.complete) == (1000, 5000, True)
    assert reader.channels[1] == Channel("/b", "", "cdr", {"k": "/b"})
    assert dict(reader.counts) == {0: 3, 1: 3}
    found = [(message.time, message.data[0]) for message in reader.messages((0, 1))]
    assert found == sorted((time, number) for number, time in enumerate(times))
    assert [m.data[0] for m in reader.messages((1,), 2000)] == [3, 5]


def test_a_recording_of_rosbags_is_read(tmp_path: Path) -> None:
    store = get_typestore(Stores.ROS2_JAZZY)
    kind = store.types["std_msgs/msg/String"]
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/text", kind.__msgtype__, typestore=store)
        for number in range(50):
            data = store.serialize_cdr(kind(data=f"text {number}"), kind.__msgtype__)
            writer.write(connection, 1_000 + number, data)
    reader = McapReader(tmp_path / "bag" / "bag.mcap")
    known = KnownTypes().message("std_msgs/msg/String")
    ((number, channel),) = reader.channels.items()
    assert (channel.topic, channel.type, channel.encoding) == ("/text", "std_msgs/msg/String", "cdr")
    texts = [known.codec.decode(known.name, m.data)["data"] for m in reader.messages((number,))]
    assert texts == [f"text {number}" for number in range(50)]


def test_a_file_that_ends_anywhere_is_read_up_to_its_last_whole_chunk(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    recording(path, tuple(range(1, 11)))
    whole, found = path.read_bytes(), []
    for size in range(len(MAGIC), len(whole), 7):
        path.write_bytes(whole[:size])
        reader = McapReader(path)
        messages = list(reader.messages(reader.channels))
        assert len(messages) == reader.counts.total()
        assert [message.time for message in messages] == list(range(1, len(messages) + 1))
        assert not reader.complete or len(messages) == 10
        found.append(len(messages))
    assert sorted(set(found)) == list(range(11))


def test_a_damaged_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    recording(path, tuple(range(1, 6)), 1 << 20)
    whole = path.read_bytes()
    refused = 0
    for place in range(len(whole)):
        path.write_bytes(whole[:place] + bytes((whole[place] ^ 0x55,)) + whole[place + 1 :])
        try:
            reader = McapReader(path)
            list(reader.messages(reader.channels))
        except McapError:
            refused += 1
    assert refused > len(whole) // 4
    path.write_bytes(b"SQLite format 3")
    with pytest.raises(McapError, match="no MCAP file"):
        McapReader(path)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", (Qos(), False)),
        (
            "- {reliability: best_effort, durability: volatile, history: keep_last, depth: 5}",
            (Qos(reliable=False, depth=5), False),
        ),
        (
            "- {reliability: 1, durability: 1, history: 3, depth: 0, deadline: {sec: 9223372036, nsec: 854775807}}",
            (Qos(transient_local=True), False),
        ),
        (
            "- {reliability: 2, durability: 2, history: 2, lifespan: {sec: 1, nsec: 500000001}, liveliness: 3,"
            " liveliness_lease_duration: {sec: 2, nsec: 0}}",
            (Qos(reliable=False, depth=None, lifespan_ms=1501, manual_liveliness=True, lease_ms=2000), False),
        ),
        (
            "- {reliability: reliable, durability: volatile}\n"
            "- {reliability: best_effort, durability: transient_local}",
            (Qos(transient_local=True), True),
        ),
        ("[1, {", (Qos(), False)),
        ("7", (Qos(), False)),
        *((text, (Qos(), False)) for text in ("!!timestamp 'abc'", "!!int ''", "!!bool x")),
    ],
)
def test_the_qos_of_a_recording(text: str, expected: tuple[Qos, bool]) -> None:
    assert offered_qos(Channel("/a", "", "cdr", {"offered_qos_profiles": text})) == expected
