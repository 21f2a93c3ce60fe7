# SPDX-License-Identifier: Apache-2.0
"""The commands on a graph of rclpy's nodes, as a user calls them."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
import yaml
from rosbags.highlevel import AnyReader

from microros_gen.cli.topic.record import _created
from microros_gen.diagnostics import UserError
from microros_gen.ros.known_types import KnownTypes
from microros_gen.ros_tools.mcap import McapWriter, Schema
from microros_gen.ros_tools.recording import schema_of
from tests.support.agent.process import environment, own_domain
from tests.support.patience import deadline, seconds
from tests.support.ros.running import Running, running

pytestmark = [pytest.mark.ros, pytest.mark.system]
WAIT_S = 10


@dataclass(frozen=True)
class Done:
    status: int
    out: str
    err: str


@pytest.fixture(scope="module")
def arm() -> Iterator[Running]:
    with running(own_domain(), "tests.support.ros.arm") as nodes:
        nodes.wait_for("ready")
        yield nodes


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "microros_gen", *arguments]


def call(*arguments: str, text: str | None = None) -> Done:
    done = subprocess.run(
        [*command(*arguments), "--spin-time", str(WAIT_S)],
        env=environment(own_domain()),
        input=text,
        capture_output=True,
        text=True,
        timeout=seconds(60),
        check=False,
    )
    assert "Traceback" not in done.stderr
    return Done(done.returncode, done.stdout, done.stderr)


def interrupted(*arguments: str, after: str) -> Done:
    """Run a command without an end, and interrupt it once it printed a text."""
    with running(own_domain(), "microros_gen", *arguments) as started:
        end = deadline(60)
        while not started.says_match(after):
            assert time.monotonic() < end, started.lines
            assert started.process.poll() is None, started.lines
            time.sleep(0.05)
        started.process.send_signal(signal.SIGINT)
        status = started.process.wait(seconds(20))
        started.read_to_end()
    return Done(status, "".join(f"{line}\n" for line in started.lines), "")


def test_topics_are_listed_with_types(arm: Running) -> None:
    done = call("topic", "list", "-t")
    assert done.status == 0
    assert {"/count [std_msgs/msg/Int32]", "/imu [sensor_msgs/msg/Imu]"} <= set(done.out.splitlines())
    assert "/_" not in done.out
    assert call("topic", "find", "std_msgs/msg/Int32").out.splitlines() == ["/count", "/numbers"]


def test_the_endpoints_of_a_topic_are_shown(arm: Running) -> None:
    lines = call("topic", "info", "-v", "imu").out.splitlines()
    assert lines[0] == "Type: sensor_msgs/msg/Imu"
    assert {
        "Publisher count: 1",
        "Node name: arm",
        "  Reliability: BEST_EFFORT",
        "Subscription count: 0",
    } <= set(lines)


def test_a_topic_is_printed(arm: Running) -> None:
    done = call("topic", "echo", "--once", "/imu", "--field", "header.frame_id")
    assert (done.status, done.out) == (0, "base\n---\n")
    once = call("topic", "echo", "--once", "/count").out
    assert yaml.safe_load(once.removesuffix("---\n"))["data"] > 0


def test_only_messages_for_which_the_filter_holds_are_printed(arm: Running) -> None:
    done = call("topic", "echo", "--once", "/count", "--filter", "m.data % 7 == 3", "--clear")
    assert done.status == 0, done.err
    assert int(done.out.removeprefix("data: ").removesuffix("\n---\n")) % 7 == 3, (
        "nothing is cleared in a pipe"
    )
    frame = ("/imu", "--field", "header.frame_id", "--filter", "m.startswith('b')")
    assert call("topic", "echo", "--once", *frame).out == "base\n---\n"
    silent = call("topic", "echo", "/imu", "--filter", "m.header.frame_id == 'map'", "--timeout", "1")
    assert (silent.status, silent.out) == (0, "")


def test_the_rate_of_what_the_filter_lets_pass(arm: Running) -> None:
    done = interrupted("topic", "hz", "/count", "--filter", "m.data % 2", after=r"average rate: [456]\.\d{3}")
    assert done.status == 0


def test_lost_messages_are_reported(arm: Running) -> None:
    """A process that is stopped reads nothing meanwhile: what its publisher no longer keeps is lost."""
    flood = command(
        "topic", "pub", "-r", "2000", "-p", "0", "--qos-depth", "1", "/flood", "std_msgs/msg/Int32"
    )
    with subprocess.Popen(flood, env=environment(own_domain()), stdout=subprocess.DEVNULL) as publisher:
        try:
            with running(
                own_domain(), "microros_gen", "topic", "echo", "/flood", "std_msgs/msg/Int32"
            ) as echo:
                echo.wait_for("data: 0")
                end = deadline(60)
                while not any(line.startswith("\ttotal count change:") for line in echo.lines):
                    assert time.monotonic() < end, echo.lines[-5:]
                    echo.process.send_signal(signal.SIGSTOP)
                    time.sleep(1)
                    echo.process.send_signal(signal.SIGCONT)
                    time.sleep(0.5)
                    echo.says_match("total count")
        finally:
            publisher.send_signal(signal.SIGINT)


def test_a_topic_is_printed_until_an_interrupt(arm: Running) -> None:
    done = interrupted("topic", "echo", "/count", "--flow-style", after=r"\{data: \d+\}")
    assert done.status == 0


@pytest.mark.parametrize(
    ("arguments", "identity", "hint"),
    [
        (("topic", "info", "/coun"), "MG-9812", "Did you mean '/count'?"),
        (("topic", "echo", "/imu", "--field", "header_"), "MG-9819", "Did you mean 'header'?"),
        (("topic", "delay", "/count"), "MG-9821", "microros-gen topic hz"),
        (("service", "type", "/enabl"), "MG-9813", "Did you mean '/enable'?"),
        (("node", "info", "/arms"), "MG-9811", "Did you mean '/arm'?"),
        (("param", "get", "/arm", "gian"), "MG-9827", "Did you mean 'gain'?"),
        (("lifecycle", "set", "/gripper", "activate"), "MG-9825", "Available now: configure, shutdown"),
        (("action", "info", "/fibonaci"), "MG-9824", "Did you mean '/fibonacci'?"),
        pytest.param(
            *(("action", "type", "/fibonaci"), "MG-9824", "Did you mean '/fibonacci'?"),
            marks=pytest.mark.variant,
        ),
        (("param", "delete", "/arm", "gian"), "MG-9827", "Did you mean 'gain'?"),
        (("topic", "echo", "/count", "--filter", "m.dat > 1"), "MG-9808", "Did you mean 'data'?"),
        (("topic", "hz", "/count", "--filter", "m.data >"), "MG-9806", "Example: 'm.data > 3"),
        (("topic", "echo", "/count", "--filter", "m.data / 0"), "MG-9809", "Compare before"),
        (("lifecycle", "get", "/arm"), "MG-9810", ""),
    ],
)
def test_a_mistake_has_a_proposal(arm: Running, arguments: tuple[str, ...], identity: str, hint: str) -> None:
    done = call(*arguments)
    assert done.status in (1, 2)
    assert f"[{identity}]" in done.err
    assert hint in done.err


def test_a_message_is_published(arm: Running) -> None:
    done = call(
        "topic",
        "pub",
        "--times",
        "2",
        "-r",
        "50",
        "--keep-alive",
        "2",
        "/numbers",
        "std_msgs/msg/Int32",
        "--stdin",
        text="data: 41",
    )
    assert done.status == 0, done.err
    assert "publishing #2: std_msgs.msg.Int32(data=41)" in done.out
    end = deadline(10)
    while arm.count("number 41") < 2:
        assert time.monotonic() < end, arm.lines
        time.sleep(0.05)


def test_a_publisher_without_subscriptions_gives_a_reason(arm: Running) -> None:
    done = call(
        "topic", "pub", "--once", "--max-wait-time-secs", "0.3", "/nobody", "std_msgs/msg/Int32", "data: 1"
    )
    assert done.status == 1
    assert "0 of 1 subscriptions matched within 0.3 s" in done.err


@pytest.mark.parametrize(
    ("verb", "topic", "line"),
    [
        ("hz", "/count", r"average rate: (9|10|11)\.\d{3}"),
        ("bw", "/imu", r"B/s from \d+ messages"),
        ("delay", "/imu", r"average delay: \d\.\d{3}"),
    ],
)
def test_topics_are_measured(arm: Running, verb: str, topic: str, line: str) -> None:
    assert interrupted("topic", verb, topic, after=line).status == 0


def test_a_topic_that_does_not_exist_is_waited_for_until_an_interrupt(arm: Running) -> None:
    assert interrupted("topic", "hz", "/nobody", after="does not appear to be published yet").status == 0


def test_topics_are_recorded(arm: Running, tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    done = call("topic", "record", "--regex", "^/(count|imu)$", "-o", str(path), "-d", "5")
    assert done.status == 0, done.err
    with AnyReader([path]) as reader:
        numbers = [
            vars(reader.deserialize(data, c.msgtype))["data"]
            for c, _, data in reader.messages()
            if c.topic == "/count"
        ]
        assert len(numbers) > 5
        assert numbers == sorted(set(numbers))
        assert {c.topic for c in reader.connections} == {"/count", "/imu"}
    for place, why, other in (
        (path, "it exists already", tmp_path / "x_2.mcap"),
        (tmp_path / "no" / "x.mcap", "No such file or directory", "x_2.mcap"),
    ):
        refused = call("topic", "record", "-a", "-o", str(place))
        assert refused.status == 2
        reason = f"{place} cannot be recorded to: {why}. Choose another one: -o {other} [MG-9822]"
        assert reason in refused.err


def recording(path: Path, unknown_type: str = "own_msgs/msg/Odd") -> None:
    """Write ten numbers, a tenth of a second apart, and two topics of types: one latched, one unknown."""
    known = KnownTypes().message("std_msgs/msg/Int32")
    qos = "- {reliability: reliable, durability: %s, history: keep_last, depth: 20}"
    with path.open("wb") as file:
        writer = McapWriter(file, "test")
        schema = schema_of(known.name, known.interfaces)
        type_hash = known.type_hash(known.name)
        marks = {"offered_qos_profiles": qos % "volatile", "topic_type_hash": type_hash}
        numbers = writer.add_channel("/numbers", schema, marks)
        marks = {"offered_qos_profiles": qos % "transient_local", "topic_type_hash": type_hash}
        latched = writer.add_channel("/latched", schema, marks)
        unknown = writer.add_channel("/unknown", Schema(unknown_type, "ros2msg", "int32 a\n"), {})
        for value in range(10):
            data = known.codec.encode(known.name, {"data": 700 + value})
            for channel in (numbers, latched, unknown):
                writer.add(channel, data, (50 + value) * 100_000_000, 0)
        writer.close()


def test_a_recording_is_played(arm: Running, tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    recording(path)
    done = call("bag", "play", str(path), "--rate", "0.5", "--start-offset", "0.45", "--topics", "numbers")
    assert (done.status, done.out) == (0, "played 5 messages of 1 topics\n")
    arm.wait_for("number 709")
    assert [line for line in arm.lines if line.startswith("number 70")] == [
        f"number 70{value}" for value in range(5, 10)
    ]


def test_a_recording_is_played_again_with_its_qos_until_an_interrupt(arm: Running, tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    recording(path)
    with running(own_domain(), "microros_gen", "bag", "play", "-l", "-r", "4", str(path)) as player:
        shown = call("topic", "info", "-v", "/latched").out
        assert "  Durability: TRANSIENT_LOCAL\n" in shown
        assert "  Reliability: RELIABLE\n" in shown
        end = deadline(60)
        while arm.count("number 700") < 3:
            assert time.monotonic() < end, arm.lines[-5:]
            time.sleep(0.05)
        player.process.send_signal(signal.SIGINT)
        assert player.process.wait(seconds(20)) == 0


def test_what_was_recorded_is_played(arm: Running, tmp_path: Path) -> None:
    """The recorder's file, and rosbags as a witness of what is described."""
    path = tmp_path / "x.mcap"
    assert call("topic", "record", "/count", "-o", str(path), "-d", f"{seconds(1):.0f}").status == 0
    with AnyReader([path]) as reader:
        wanted = f"Topic: /count | Type: std_msgs/msg/Int32 | Count: {reader.message_count} "
        start = reader.start_time
    described = subprocess.run(
        command("bag", "info", str(path)), capture_output=True, text=True, timeout=seconds(20), check=True
    ).stdout
    assert wanted in described
    assert f"({start // 10**9}.{start % 10**9:09})" in described


@pytest.mark.parametrize(
    ("options", "identity", "hint"),
    [
        (("--topics", "/number"), "MG-9800", "Did you mean '/numbers'?"),
        ((), "MG-9829", "Name the topics to play: --topics TOPIC"),
        (("--topics", "/x"), "MG-9800", "Available: /latched, /numbers, /unknown"),
    ],
)
def test_a_topic_that_cannot_be_played(
    tmp_path: Path, options: tuple[str, ...], identity: str, hint: str
) -> None:
    path = tmp_path / "x.mcap"
    recording(path, "Odd")
    done = call("bag", "play", str(path), *options)
    assert done.status == 2
    assert f"[{identity}]" in done.err
    assert hint in done.err


@pytest.mark.parametrize("option", ["--rate", "--start-offset"])
@pytest.mark.parametrize("number", ["nan", "inf"])
def test_a_rate_or_offset_that_is_not_finite(tmp_path: Path, option: str, number: str) -> None:
    path = tmp_path / "x.mcap"
    recording(path)
    done = call("bag", "play", str(path), option, number)
    assert done.status == 2
    assert "it must be finite" in done.err


def test_a_file_that_is_no_recording(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(b"nothing")
    done = call("bag", "play", str(path))
    assert (done.status, "cannot be read: it is no MCAP file" in done.err) == (2, True)
    assert "[MG-9828]" in done.err


def test_a_file_that_appears_before_the_recorder_has_started_stays(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(b"precious")
    with pytest.raises(UserError, match="MG-9822"):
        _created(path)
    assert path.read_bytes() == b"precious"


def test_a_service_is_called(arm: Running) -> None:
    done = call("service", "call", "/enable", "std_srvs/srv/SetBool", "data: true")
    assert done.status == 0, done.err
    assert "response:\nstd_srvs.srv.SetBool_Response(success=True, message='enabled')\n" in done.out


def test_nodes_are_shown(arm: Running) -> None:
    assert call("node", "list").out.splitlines() == ["/arm", "/gripper"]
    shown = call("node", "info", "/arm").out
    assert "  Service Servers:\n    /arm/describe_parameters" in shown
    assert "  Action Servers:\n    /fibonacci: test_msgs/action/Fibonacci\n" in shown


def test_parameters_are_set_dumped_and_loaded(arm: Running, tmp_path: Path) -> None:
    assert call("param", "set", "/arm", "gain", "2.5").out == "Set parameter successful\n"
    assert call("param", "get", "/arm", "gain").out == "Double value is: 2.5\n"
    refused = call("param", "set", "/arm", "gain", "-1.0")
    assert refused.status == 1
    assert "out of range" in refused.err
    described = call("param", "describe", "/arm", "gain").out
    assert (
        "  Description: how\n  Constraints:\n    Min value: 0.0\n    Max value: 10.0\n    Step: 0.5\n"
        in described
    )
    deleted = call("param", "delete", "/arm", "spare")
    assert (deleted.status, deleted.out) == (0, "Deleted parameter successfully\n")
    assert "spare" not in call("param", "list", "/arm").out
    kept = call("param", "delete", "/arm", "gain")
    assert (kept.status, kept.out) == (1, "")
    assert kept.err.startswith("Deleting parameter failed: ")
    file = tmp_path / "arm.yaml"
    dumped = yaml.safe_load(call("param", "dump", "/arm").out)
    values = dumped["/arm"]["ros__parameters"]
    assert (values["gain"], values["limits"], values["names"]) == (2.5, {"low": 3}, ["a", "b"])
    file.write_text(yaml.safe_dump({"/**": {"ros__parameters": {"gain": 3.5, "limits": {"low": 4}}}}))
    loaded = call("param", "load", "/arm", str(file))
    assert loaded.out.splitlines() == ["Set parameter gain successful", "Set parameter limits.low successful"]
    assert call("param", "get", "/arm", "limits.low", "--hide-type").out == "4\n"


def test_a_life_cycle_is_driven(arm: Running) -> None:
    assert call("lifecycle", "nodes").out == "/gripper\n"
    assert call("lifecycle", "set", "/gripper", "configure").out == "Transitioning successful\n"
    assert call("lifecycle", "get", "/gripper").out == "inactive [2]\n"
    transitions = call("lifecycle", "list", "/gripper").out
    assert "- activate [3]\n\tStart: inactive\n\tGoal: activating\n" in transitions
    assert call("lifecycle", "set", "/gripper", "cleanup").status == 0


def test_a_goal_is_sent_and_canceled(arm: Running) -> None:
    fibonacci = ("/fibonacci", "test_msgs/action/Fibonacci")
    assert call("action", "type", "fibonacci").out == "test_msgs/action/Fibonacci\n"
    done = call("action", "send-goal", "--feedback", *fibonacci, "order: 4")
    assert done.status == 0, done.err
    assert done.out.count("Feedback:") == 3
    result = done.out.partition("Result:\n")[2].partition("\nGoal finished")[0]
    assert yaml.safe_load(result) == {"sequence": [0, 1, 1, 2, 3]}
    assert done.out.endswith("Goal finished with status: SUCCEEDED\n")
    canceled = interrupted("action", "send_goal", *fibonacci, "order: 1000", after="Goal accepted")
    assert canceled.status == 1
    assert canceled.out.endswith("Goal canceled.\n")
    arm.wait_for("canceled")


def test_a_type_without_a_build_is_used(arm: Running, tmp_path: Path) -> None:
    folder = tmp_path / "own_msgs"
    (folder / "msg").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>own_msgs</name></package>")
    (folder / "msg" / "Speed.msg").write_text("float32 left\nfloat32 right 2.0\n")
    options = ("--interface-path", str(folder))
    publish = command("topic", "pub", "-r", "20", "/speed", "own_msgs/msg/Speed", "left: 1", *options)
    with subprocess.Popen(publish, env=environment(own_domain()), stdout=subprocess.DEVNULL) as publisher:
        try:
            done = call("topic", "echo", "--once", "--csv", "/speed", *options)
            assert (done.status, done.out) == (0, "1.0,2.0\n")
        finally:
            publisher.send_signal(signal.SIGINT)
    assert publisher.returncode == 0


def test_the_graph_is_drawn(arm: Running, tmp_path: Path) -> None:
    picture = tmp_path / "graph.svg"
    assert call("graph", "-o", str(picture)).status == 0
    text = picture.read_text(encoding="utf-8")
    assert {"node /arm", "topic /count", "service /enable", "action /fibonacci"} <= set(
        re.findall(r"<title>(.*?)</title>", text)
    )
