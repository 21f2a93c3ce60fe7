# SPDX-License-Identifier: Apache-2.0
"""Boards without an agent: system files, and what the two boards of a link have to agree about."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from tests.support.components.boards import (
    MOTOR,
    SENSOR,
    SYSTEM,
    application,
    ends,
    peers,
    planned,
    refused,
    written,
)
from tests.support.components.rendered import UNITS
from tests.support.patience import seconds


def test_both_boards_have_the_same_table(tmp_path: Path) -> None:
    sensor = application(
        "sensor",
        ends("publishers", "topic: /b, peer: only", "topic: /a, peer: also", "topic: /ros")
        + ends("subscriptions", "topic: /c, peer: only"),
    )
    motor = application(
        "motor",
        ends("publishers", "topic: /c, peer: only")
        + ends("subscriptions", "topic: /a, peer: only", "topic: /b, peer: only"),
    )
    written(tmp_path, SYSTEM, sensor, motor)
    [of_sensor], [of_motor] = peers(tmp_path, "sensor").links, peers(tmp_path, "motor").links
    assert [topic.name for topic in of_sensor.topics] == ["/a", "/b", "/c"]
    assert of_sensor.topics == of_motor.topics
    assert of_sensor.key == of_motor.key
    assert (of_sensor.position, of_motor.position) == (0, 1)
    assert (of_sensor.writers, of_sensor.readers) == (((0, 1), (1, 0)), ((0, 2),))
    assert (of_motor.writers, of_motor.readers) == (((0, 2),), ((0, 0), (1, 1)))
    assert (of_sensor.remote, of_sensor.remote_port, of_sensor.local_port) == ("10.0.0.2", 7500, 7500)
    assert not peers(tmp_path, "sensor").alone
    assert peers(tmp_path, "motor").shown == "sensor (/a, /b, /c); no agent is needed"


@pytest.mark.builds
def test_a_handle_of_a_board_may_be_an_address_in_the_upper_half(tmp_path: Path) -> None:
    """lwIP's and FreeRTOS+TCP's are pointers: below 0 as a number where RAM begins at 0x80000000."""
    (tmp_path / "own.yaml").write_text("target: own\nsummary: x\nextends: cortex-m4\ndata_model: any\n")
    sensor = SENSOR.replace("system:", "target: ../own.yaml\ntransport: {type: udp}\nsystem:")
    found = planned(written(tmp_path, sensor=sensor))
    compiler.write(compiler.render(found), tmp_path / "out")
    call: list[str | Path] = [
        "gcc",
        "-std=c99",
        f"-I{tmp_path / 'out' / 'include'}",
        UNITS / "peer_address.c",
    ]
    subprocess.run([*call, "-o", tmp_path / "unit"], check=True)
    subprocess.run([tmp_path / "unit"], check=True, timeout=seconds(60))


def test_another_table_has_another_key(tmp_path: Path) -> None:
    [first] = peers(written(tmp_path), "sensor").links
    others = written(
        tmp_path,
        SYSTEM,
        SENSOR.replace("msgs/msg/String", "msgs/msg/Int32"),
        MOTOR.replace("msgs/msg/String", "msgs/msg/Int32"),
    )
    [second] = peers(others, "sensor").links
    assert first.key != second.key


def test_the_plan_was_made_from_all_files(tmp_path: Path) -> None:
    folder = written(tmp_path)
    found = {path.resolve() for path in compiler.read_paths(planned(folder))}
    assert {folder / "system.yaml", folder / "motor" / "microros.yaml"} <= found


@pytest.mark.parametrize(
    ("sensor", "motor", "words"),
    [
        (
            "peer: only",
            "",
            "sensor/microros.yaml:8:9: error: no board that is linked with this one subscribes to '/a'",
        ),
        (
            "peer: only",
            "peer: only, type: std_msgs/msg/Int32",
            "the board 'motor' (motor/microros.yaml:8) has std_msgs/msg/Int32",
        ),
        (
            "peer: only, qos: {reliability: best_effort}",
            "peer: only",
            "sensor/microros.yaml:8:65: error: '/a' is best effort here and never matches the subscription",
        ),
        ("peer: also", "peer: also", "would arrive twice, over the link and over ROS"),
        ("peer: only, qos: {history: keep_all}", "peer: only", "has `history: keep_all`"),
        ("peer: only, qos: {durability: transient_local}", "peer: only", "has `durability: transient_local`"),
        ("peer: only, qos: {deadline: 1 s}", "peer: only", "has a deadline"),
        ("peer: only, qos: {lifespan: 1 s}", "peer: only", "has a lifespan"),
        (
            "peer: only, limits: {string: 600}, qos: {reliability: best_effort}",
            "peer: only, limits: {string: 600}, qos: {reliability: best_effort}",
            "a message of '/a' takes 617 bytes on the link, which has an MTU of 512, and only reliable messages go in "
            "fragments. Set mtu: 617 at the link, make it reliable, or lower limits",
        ),
        (
            "peer: only, limits: {string: 66000}",
            "peer: only, limits: {string: 66000}",
            "a message of '/a' takes 66017 bytes, and fragments of a link carry 65539. Lower its limits",
        ),
    ],
)
def test_ends_that_do_not_agree(tmp_path: Path, sensor: str, motor: str, words: str) -> None:
    type_ = "" if "type:" in motor else "type: std_msgs/msg/String, "
    written(
        tmp_path,
        SYSTEM,
        application("sensor", ends("publishers", f"topic: /a, {sensor}")),
        application("motor", f"    subscriptions:\n      - {{{type_}topic: /a, {motor or 'queue: 1'}}}\n"),
    )
    assert words in refused(tmp_path)


def test_a_subscription_without_a_publisher(tmp_path: Path) -> None:
    written(
        tmp_path,
        motor=application("motor", ends("subscriptions", "topic: /a, peer: only", "topic: /b, peer: only")),
    )
    assert "motor/microros.yaml:9:9: error: no board that is linked with this one publishes '/b'" in refused(
        tmp_path, "motor"
    )


def test_interface_files_that_differ(tmp_path: Path) -> None:
    folder = written(tmp_path)
    own = "interface_paths: [interfaces]\n"
    for board, text, fields in (("sensor", SENSOR, "int32 x\n"), ("motor", MOTOR, "int32 y\n")):
        messages = folder / board / "interfaces" / "robot_msgs" / "msg"
        messages.mkdir(parents=True)
        (messages / "State.msg").write_text(fields)
        (messages.parent / "package.xml").write_text("<package><name>robot_msgs</name></package>")
        config = folder / board / "microros.yaml"
        config.write_text(own + text.replace("std_msgs/msg/String", "robot_msgs/msg/State"))
    for board in ("sensor", "motor"):
        assert "robot_msgs/msg/State is defined otherwise" in refused(folder, board)
    (folder / "motor/interfaces/robot_msgs/msg/State.msg").write_text("int32 x\n")
    assert planned(folder)


@pytest.mark.parametrize(
    ("system", "words"),
    [
        (SYSTEM.replace("motor:", "arm:", 1), "system.yaml:6:49: error: the system has no board 'motor'"),
        (
            SYSTEM.replace("10.0.0.2:7500", "motor.local:7500"),
            "system.yaml:6:56: error: 'motor.local:7500' is no IPv4",
        ),
        (SYSTEM.replace("10.0.0.2:7500", "10.0.0.2"), "'10.0.0.2' is no IPv4 or IPv6 address with a port"),
        (
            SYSTEM.replace("10.0.0.2", "0.0.0.0"),
            "Write the address of this board as 192.168.1.20:7500",
        ),
        (SYSTEM.replace("10.0.0.2", "239.0.0.1"), "'239.0.0.1:7500' is not the address of one board"),
        (SYSTEM.replace("10.0.0.2", "[ff02::1]"), "'[ff02::1]:7500' is not the address of one board"),
        (SYSTEM.replace("10.0.0.2", "255.255.255.255"), "is not the address of one board"),
        (SYSTEM.replace("10.0.0.2", "240.0.0.1"), "'240.0.0.1:7500' is not the address of one board"),
        (SYSTEM.replace("10.0.0.2", "[::ffff:0.0.0.0]"), "'[::ffff:0.0.0.0]:7500' is not the address of one"),
        (SYSTEM.replace("10.0.0.2", "[::ffff:224.0.0.1]"), "is not the address of one board"),
        (
            SYSTEM + SYSTEM[SYSTEM.index("  - {type") :].replace("7500", "7501"),
            "system.yaml:7:5: error: two links join 'sensor' and 'motor'; the first is in line 6",
        ),
        (
            SYSTEM.replace(', motor: "10.0.0.2:7500"', ""),
            "two boards to their addresses or devices; it has 1",
        ),
        (SYSTEM.replace("version: 1\n", ""), "missing key 'version' in the file. Add `version: 1`"),
        (
            SYSTEM.replace("10.0.0.2", "10.0.0.1"),
            "'10.0.0.1:7500' is the end of two links; the first is in line 6",
        ),
        (SYSTEM.replace("motor/m", "engine/m"), "cannot read the application file 'engine/microros.yaml'"),
        (SYSTEM.replace("sensor/m", "motor/m"), "is another file in the system: 'motor/microros.yaml'"),
        (SYSTEM.replace("udp,", "udp, baud: 9600,"), "unknown key 'baud' in 'links[0]'"),
        (SYSTEM.replace("udp,", "serial,"), "a serial link needs `transport: {type: serial}`"),
        (
            SYSTEM.replace("{sensor:", "{third: 10.0.0.3:1, sensor:"),
            "a udp link joins two boards; this one has 3 ends",
        ),
        (SYSTEM.replace("udp,", "udp, mtu: 20,"), "must be a whole number of bytes between 64 and 16384"),
        (SYSTEM[: SYSTEM.index("links")], "no link of the system ends at the board 'sensor'"),
    ],
)
def test_faults_of_a_system_file(tmp_path: Path, system: str, words: str) -> None:
    assert words in refused(written(tmp_path, system))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("system.yaml", "systems.yaml", "cannot read the system file"),
        ("board: sensor", "board: sensors", "the system has no board 'sensors'. Did you mean 'sensor'?"),
        (
            "system: {file: ../system.yaml, board: sensor}\n",
            "",
            "`peer:` needs the system in which this board is",
        ),
        ("topic: /a, peer: only", "topic: /b", "the component 'peer' is for endpoints with `peer:`"),
        ("version: 1\n", "version: 1\non_full: drop_oldest\n", "`on_full: drop_oldest` is not for links"),
        (
            "version: 1\n",
            "version: 1\nentities: preconfigured\nsession: {key: 7}\n",
            "creates the publisher of '/a'",
        ),
    ],
)
def test_faults_of_an_application(tmp_path: Path, old: str, new: str, words: str) -> None:
    sensor = SENSOR.replace(old, new).replace("version: 1\n", "version: 1\ncomponents: [+peer]\n")
    assert words in refused(written(tmp_path, sensor=sensor))


def test_an_application_that_does_not_name_the_system(tmp_path: Path) -> None:
    motor = MOTOR.replace("board: motor", "board: sensor")
    words = "error: the application 'motor/microros.yaml' does not name this system and its"
    hint = "Write `system: {file: ../system.yaml, board: motor}` there"
    found = refused(written(tmp_path, motor=motor))
    assert f"motor/microros.yaml:4:39: {words}" in found
    assert hint in found
    elsewhere = MOTOR.replace("../system.yaml", "../other.yaml")
    found = refused(written(tmp_path, motor=elsewhere))
    assert f"motor/microros.yaml:4:16: {words}" in found
    assert hint in found


def test_a_board_without_a_link(tmp_path: Path) -> None:
    system = SYSTEM.replace(
        "links:", "  arm: {application: arm/microros.yaml}\n  hand: {application: h}\nlinks:"
    )
    folder = written(tmp_path, system)
    (folder / "arm").mkdir()
    (folder / "arm" / "microros.yaml").write_text(SENSOR.replace("board: sensor", "board: arm"))
    assert "no link of the system ends at the board 'arm'" in refused(folder, "arm")


SERIAL = (
    SYSTEM.replace("udp", "serial").replace("10.0.0.1:7500", "uart").replace("10.0.0.2:7500", "/dev/ttyS1")
)
LINE = "transport: {type: serial}\n"


@pytest.mark.parametrize(
    ("system", "sensor", "target", "words"),
    [
        (
            SERIAL,
            SENSOR,
            "host",
            "'uart' is no line of the target 'host'. For this target, write the name of its device",
        ),
        (SERIAL.replace("uart", "tty"), SENSOR, "qemu-mps2-an386", "For this target, write `uart`"),
        (
            SERIAL,
            SENSOR.replace("peer: only", "peer: also"),
            "qemu-mps2-an386",
            "has one serial line, which a link cannot share with an agent: all of them send whenever they have "
            "something, and frames on one pair of wires would collide. Write `peer: only` at all endpoints, with one "
            "link, or use links and a transport of type canfd or udp",
        ),
        (
            SERIAL.replace("uart", "/dev/ttyUSB0"),
            SENSOR.replace("peer: only", "peer: also"),
            "host",
            "'/dev/ttyUSB0' is the line to the agent, too: a serial line has two ends. Give the link another device",
        ),
        (
            SERIAL.replace("uart", "tty"),
            SENSOR.replace("{type: serial}", "{type: serial, baud: 9600}"),
            "host",
            "the baud rate is 9600 here and 115200 at the board 'motor'",
        ),
    ],
)
def test_serial_lines(tmp_path: Path, system: str, sensor: str, target: str, words: str) -> None:
    sensor = sensor.replace("version: 1\n", f"version: 1\n{LINE}") if LINE not in sensor else sensor
    if "9600" in words:
        sensor = sensor.replace("{type: serial}", "{type: serial, baud: 9600}")
    written(tmp_path, system, sensor, MOTOR.replace("version: 1\n", f"version: 1\n{LINE}"))
    assert words in refused(tmp_path, target=target)


LONGER = "'data' of '/a': up to 20 characters from "


@pytest.mark.parametrize(
    ("board", "words"),
    [
        (
            "sensor",
            f"sensor/microros.yaml:8:9: error: {LONGER}the publisher, and 8 fit the subscription of the board 'motor' "
            "(motor/microros.yaml:8)",
        ),
        (
            "motor",
            f"motor/microros.yaml:8:9: error: {LONGER}the publisher of the board 'sensor' (sensor/microros.yaml:8), "
            "and 8 fit the subscription",
        ),
    ],
)
@pytest.mark.parametrize("where", ["endpoint", "type", "anywhere"])
def test_messages_that_are_longer_than_the_subscription_takes(
    tmp_path: Path, board: str, words: str, where: str
) -> None:
    motor = MOTOR
    if where == "endpoint":
        motor = MOTOR.replace("peer: only", "peer: only, limits: {string: 8}")
    elif where == "type":
        motor = MOTOR.replace("limits: {", "limits: {std_msgs/msg/String: {data: 8}, ")
    else:
        motor = MOTOR.replace("string: 20", "string: 8")
    assert words in refused(written(tmp_path, motor=motor), board)


def test_a_subscription_that_takes_longer_messages(tmp_path: Path) -> None:
    folder = written(tmp_path, motor=MOTOR.replace("string: 20", "string: 200"))
    assert planned(folder, "sensor")
    assert planned(folder, "motor")


def test_a_sequence_of_a_nested_type_that_is_longer(tmp_path: Path) -> None:
    type_, nested = "std_msgs/msg/String", "diagnostic_msgs/msg/DiagnosticStatus"
    written(
        tmp_path,
        SYSTEM.replace("udp,", "udp, mtu: 8000,"),
        SENSOR.replace(type_, nested).replace("sequence: 2", "sequence: 3"),
        MOTOR.replace(type_, nested)
        .replace("string: 20", "string: 19")
        .replace("sequence: 2", "sequence: 1"),
    )
    text = refused(tmp_path)
    for field, sent, unit, taken in (
        ("name", 20, "characters", 19),
        ("values", 3, "elements", 1),
        ("values.key", 20, "characters", 19),
    ):
        assert f"'{field}' of '/a': up to {sent} {unit} from the publisher, and {taken} fit" in text


def test_boards_with_one_client_key(tmp_path: Path) -> None:
    def folder(sensor: int, motor: int, peer: str = "also") -> Path:
        more = "      - {{type: std_msgs/msg/String, topic: /{}}}\n"
        return written(
            tmp_path,
            sensor=SENSOR.replace("peer: only", f"peer: {peer}").replace(
                "nodes", f"session: {{key: {sensor}}}\nnodes"
            ),
            motor=MOTOR.replace("nodes", f"session: {{key: {motor}}}\nnodes") + more.format("ros"),
        )

    [warning] = [str(w) for w in planned(folder(7, 7)).warnings if "client key" in str(w)]
    assert "the board 'motor' has the same client key 7" in warning
    assert not [w for w in planned(folder(7, 8)).warnings if "client key" in str(w)]
    assert not [w for w in planned(folder(7, 7, "only")).warnings if "client key 7" in str(w)]
