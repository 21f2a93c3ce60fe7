# SPDX-License-Identifier: Apache-2.0
"""Recordings, read by the package rosbags."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

from microros_gen.ros.known_types import KnownType, KnownTypes
from microros_gen.ros_tools.mcap import MAGIC, McapWriter
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
