# SPDX-License-Identifier: Apache-2.0
"""Links over CAN FD: the boards of a bus, their identifiers, and what the bus carries."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.application.system_can import CanEnd, can_end
from microros_gen.client.plan.line_media import can_frame_bits
from microros_gen.components.peer.bus_load import BusLoad
from tests.support.components.boards import MOTOR, SENSOR, application, ends, peers, planned, refused, written

SYSTEM = """\
version: 1
boards:
  sensor: {application: sensor/microros.yaml}
  motor: {application: motor/microros.yaml}
links:
  - {type: canfd, ends: {sensor: can0, motor: "can1:0x21"}}
"""
LINE = "transport: {type: canfd}\n"
CAN_SENSOR, CAN_MOTOR = (text.replace("limits", f"{LINE}limits", 1) for text in (SENSOR, MOTOR))
ARM = "  arm: {application: arm/microros.yaml}\n"
WRITE, BEAT = 16, 13
"""Bytes of WRITE_DATA with an Int32, and of HEARTBEAT and ACKNACK (OMG DDS-XRCE 1.0, 8.3.5)."""


def bus(folder: Path, system: str = SYSTEM, sensor: str = CAN_SENSOR, motor: str = CAN_MOTOR) -> Path:
    return written(folder, system, sensor, motor)


def three(folder: Path, arm: str, link: str = '{sensor: can0, motor: "can1:0x21", arm: can0}') -> Path:
    """Write a system with a third board on the bus."""
    system = SYSTEM.replace("links:", f"{ARM}links:").replace('{sensor: can0, motor: "can1:0x21"}', link)
    bus(folder, system)
    (folder / "arm").mkdir(exist_ok=True)
    (folder / "arm" / "microros.yaml").write_text(arm.replace("limits", f"{LINE}limits", 1))
    return folder


@pytest.mark.parametrize(
    ("text", "device", "number"),
    [
        ("can0", "can0", 3),
        ("can0:0x21", "can0", 0x21),
        ("can0:255", "can0", 255),
        ("unix:/tmp/bus", "unix:/tmp/bus", 3),
        ("unix:/tmp/bus:9", "unix:/tmp/bus", 9),
    ],
)
def test_ends(text: str, device: str, number: int) -> None:
    assert can_end("a", text, 2) == CanEnd("a", device, number)


@pytest.mark.parametrize("text", ["", ":1", "can0:", "can0:0", "can0:256", "can0:x", "can0:0x100", "a b"])
def test_what_is_no_end(text: str) -> None:
    assert can_end("a", text, 0) is None


def test_what_one_board_sends_the_other_one_receives(tmp_path: Path) -> None:
    folder = bus(tmp_path)
    [sensor], [motor] = peers(folder, "sensor").links, peers(folder, "motor").links
    assert (sensor.sent_id, sensor.received_id) == (0x10121, 0x12101)
    assert (motor.sent_id, motor.received_id) == (0x12101, 0x10121)
    assert (sensor.remote, motor.remote, sensor.mtu) == ("can0", "can1", 63)
    assert sensor.key == motor.key
    assert peers(folder, "sensor").frames_table[2:] == ("  {0x00010121u, 0x00012101u},", "};")
    shifted = bus(tmp_path, SYSTEM.replace("canfd,", "canfd, id: 0x1fff0000,"))
    assert peers(shifted, "sensor").links[0].sent_id == 0x1FFF0121
    least = bus(tmp_path, SYSTEM.replace("canfd,", "canfd, id: 0,"))
    assert peers(least, "sensor").links[0].sent_id == 0x121


def test_a_board_without_an_agent_needs_no_identifier_for_it(tmp_path: Path) -> None:
    assert planned(bus(tmp_path))
    also = bus(tmp_path, sensor=CAN_SENSOR.replace("only", "also"))
    assert "needs the identifier of this client's frames" in refused(also)


def test_each_pair_that_exchanges_something_has_a_link(tmp_path: Path) -> None:
    arm = application("arm", ends("subscriptions", "topic: /a, peer: only"))
    folder = three(tmp_path, arm)
    assert [(link.board, link.sent_id) for link in peers(folder, "sensor").links] == [
        ("motor", 0x10121),
        ("arm", 0x10103),
    ]
    for board, identifier in (("motor", 0x12101), ("arm", 0x10301)):
        [link] = peers(folder, board).links
        assert (link.board, link.sent_id, link.position) == ("sensor", identifier, 1)
    # The plan of a board changes with what the others of the bus exchange, so it was made from their files, too.
    read = {path.resolve() for path in compiler.read_paths(planned(folder, "motor"))}
    assert folder / "arm" / "microros.yaml" in read


def test_a_service_on_a_bus(tmp_path: Path) -> None:
    kind = "type: std_srvs/srv/Trigger, peer: only"
    more = "components: [+services]\n"
    sensor = application("sensor", f"    clients:\n      - {{name: /go, {kind}}}\n", more)
    motor = application("motor", f"    services:\n      - {{name: /go, {kind}, queue: 5}}\n", more)
    folder = bus(tmp_path, sensor=LINE + sensor, motor=LINE + motor)
    assert peers(folder, "sensor").calls
    assert peers(folder, "motor").serves


@pytest.mark.parametrize(
    ("system", "words"),
    [
        (
            SYSTEM.replace("can1:0x21", "can1:0x211"),
            "system.yaml:6:47: error: 'can1:0x211' is no CAN device with a number of 1 to 255. Write it as can0:0x21",
        ),
        (
            SYSTEM.replace("0x21", "1"),
            "system.yaml:6:47: error: the boards 'sensor' and 'motor' have the number 1 on one bus. Write another "
            "one: can1:2",
        ),
        (
            SYSTEM + '  - {type: canfd, ends: {motor: "can1:0x21", sensor: "can3:1"}}\n',
            "system.yaml:7:5: error: frames of this link and of that in line 6 have the same identifier 0x12101, and a "
            "board joins their buses. Write another `id:` at one of them, such as 0x20000",
        ),
        (
            SYSTEM.replace("canfd,", "canfd, mtu: 64,"),
            "6:24: error: a canfd link has no `mtu`: a frame of CAN FD",
        ),
        (
            SYSTEM.replace("canfd, ends", "udp, id: 7, ends"),
            "a udp link has no `id`: only frames of CAN FD have identifiers. Remove `id`",
        ),
        (
            SYSTEM.replace("canfd,", "canfd, id: 0x1fff0001,"),
            "must be a whole number between 0 and 0x1fff0000",
        ),
        (SYSTEM.replace("canfd", "can"), "Did you mean 'canfd'?"),
        (SYSTEM.replace("canfd", "serial"), "a serial link needs `transport: {type: serial}`"),
    ],
)
def test_faults_of_a_system_file(tmp_path: Path, system: str, words: str) -> None:
    assert words in refused(bus(tmp_path, system))


def test_identifiers_of_two_buses_may_be_alike(tmp_path: Path) -> None:
    arm = application("arm", ends("subscriptions", "topic: /a, peer: only"))
    buses = (
        '{sensor: can0, motor: "can1:0x21"}}\n  - {type: canfd, ends: {arm: "can7:0x21", sensor: "can3:1"}'
    )
    motor, other = peers(three(tmp_path, arm, buses), "sensor").links
    assert (motor.board, motor.received_id) == ("motor", other.received_id) != (other.board, 0)


def test_two_buses_with_the_same_boards(tmp_path: Path) -> None:
    """Boards that exchange something are on one bus; what joins two buses may be on both with others."""
    second = "  - {type: canfd, id: 0x20000, ends: {motor: can7, sensor: can3}}\n"
    words = "two links join 'sensor' and 'motor'; the first is in line 6: messages would arrive twice"
    assert words in refused(bus(tmp_path, SYSTEM + second))
    silent = CAN_MOTOR.replace("peer: only", "peer: never")
    apart = bus(tmp_path, SYSTEM + second, CAN_SENSOR.replace("peer: only", "peer: never"), silent)
    assert words not in refused(apart)


AGENT = "transport: {type: canfd, device: DEVICE, id: NUMBER}\n"


def with_agents(folder: Path, device: str, sensor: str, motor: str = "1") -> Path:
    """Write a system in which both boards have an agent on their bus, too."""
    own = AGENT.replace("DEVICE", device).replace("NUMBER", sensor)
    other = AGENT.replace("DEVICE", "can1").replace("NUMBER", motor)
    more = "      - {type: std_msgs/msg/String, topic: /ros}\n"
    return bus(
        folder, sensor=CAN_SENSOR.replace(LINE, own) + more, motor=CAN_MOTOR.replace(LINE, other) + more
    )


def test_the_agent_on_the_same_bus(tmp_path: Path) -> None:
    taken = with_agents(tmp_path, "can0", "0x12101")
    assert (
        "sensor/microros.yaml:3:40: error: the identifier 0x12101 is that of the frames from motor to"
        in refused(taken)
    )
    alike = with_agents(tmp_path, "can0", "0x1")
    assert "the board 'motor' has the same identifier 0x1 on the bus: both boards would read" in refused(
        alike
    )
    assert planned(with_agents(tmp_path, "can0", "0x2"))
    for number in ("0x12101", "0x1"):
        assert planned(with_agents(tmp_path, "can7", number)), "another bus"


def test_two_bit_rates(tmp_path: Path) -> None:
    def folder(sensor: str, motor: str) -> Path:
        return bus(
            tmp_path,
            sensor=CAN_SENSOR.replace("canfd}", f"canfd{sensor}}}"),
            motor=CAN_MOTOR.replace("canfd}", f"canfd{motor}}}"),
        )

    assert "the bit rate is 500000 here and 250000 at the board 'motor'" in refused(
        folder(", bitrate: 500000", ", bitrate: 250000")
    )
    for same in ((", bitrate: 500000", ""), (", bitrate: 500000", ", bitrate: 500000")):
        assert not [w for w in planned(folder(*same)).warnings if w.id == "MG-7133"]


def test_a_best_effort_message_fits_a_frame(tmp_path: Path) -> None:
    best = "peer: only, limits: {string: 60}, qos: {reliability: best_effort}"
    sensor, motor = (text.replace("peer: only", best) for text in (CAN_SENSOR, CAN_MOTOR))
    words = "a message of '/a' takes 77 bytes on the link, which has an MTU of 63, and only reliable messages go in "
    assert f"{words}fragments. Make it reliable, or lower limits" in refused(
        bus(tmp_path, sensor=sensor, motor=motor)
    )
    long = "peer: only, limits: {string: 60}"
    sensor, motor = (text.replace("peer: only", long) for text in (CAN_SENSOR, CAN_MOTOR))
    assert peers(bus(tmp_path, sensor=sensor, motor=motor), "sensor").fragments


def rated(folder: Path, rate: str, bitrate: str = "", back: str = "") -> Path:
    """Write a system in which `sensor` publishes /a, and `motor` /b where `back` is a rate."""
    kind = "type: std_msgs/msg/Int32, peer: only"

    def board(name: str, sends: str, speed: str, takes: str) -> str:
        text = f"{LINE.replace('canfd', f'canfd{bitrate}')}version: 1\nprofiles: [pure_sender, pure_reader]\n"
        text += f"system: {{file: ../system.yaml, board: {name}}}\nnodes:\n  - name: n\n"
        text += f"    publishers:\n      - {{topic: {sends}, {kind}{speed}}}\n"
        return text + f"    subscriptions:\n      - {{topic: {takes}, {kind}}}\n"

    return bus(
        folder,
        sensor=board("sensor", "/a", f", rate: {rate} Hz", "/b"),
        motor=board("motor", "/b", f", rate: {back} Hz" if back else "", "/a"),
    )


def load(folder: Path, board: str = "sensor") -> BusLoad:
    [found] = peers(folder, board).buses
    return found


def test_both_directions_and_their_answers_share_the_bus(tmp_path: Path) -> None:
    message, beat = can_frame_bits(WRITE), can_frame_bits(BEAT)
    forth = load(rated(tmp_path, "20"))
    beats = 2 * 10 * beat  # a HEARTBEAT in 100 ms, and its answer
    assert forth.load == 20 * (message + beat) + beats
    assert forth.shown.endswith("; the application has no `bitrate`")
    folder = rated(tmp_path, "20", ", bitrate: 500000", "7")
    both = load(folder)
    assert both.load == forth.load + 7 * (message + beat) + beats == load(folder, "motor").load
    assert both.shown == (
        f"can0 {both.load} bit/s of 500000 (to motor: /a {20 * (message + beat)}, HEARTBEAT {beats}; from motor: "
        f"/b {7 * (message + beat)}, HEARTBEAT {beats})"
    )


def test_what_is_proposed_is_enough_and_the_next_one_is_not(tmp_path: Path) -> None:
    text = refused(rated(tmp_path, "500", ", bitrate: 125000", "7"))
    found = re.search(
        r"need (\d+) bit/s on the bus 'can0', and it carries 125000 \(to motor.*"
        r"Write `rate: ([\d.]+) Hz` at /a or `transport: \{bitrate: (\d+)\}` at all boards",
        text,
    )
    assert found, text
    needed, rate, better = (Fraction(each) for each in found.groups())
    assert needed > 125000
    assert planned(rated(tmp_path, str(rate), ", bitrate: 125000", "7"))
    assert "and it carries 125000" in refused(rated(tmp_path, str(rate + 1), ", bitrate: 125000", "7"))
    assert planned(rated(tmp_path, "500", f", bitrate: {better}", "7"))
    # The board that only subscribes to it has the same sum; it can lower its own rate alone.
    assert "and it carries 125000" in refused(rated(tmp_path, "500", ", bitrate: 125000", "7"), "motor")
