# SPDX-License-Identifier: Apache-2.0
"""What all boards of a CAN bus need of it: pairs without this board, agents of others, and links that a board joins."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.plan.line_load import message_sizes
from microros_gen.client.plan.line_media import can_frame_bits
from microros_gen.components.peer.bus_load import BusLoad
from tests.support.components.boards import peers, planned, refused

BOARDS = ("sensor", "motor", "arm")
ONE_LINK = "  - {type: canfd, ends: {sensor: can0, motor: can1, arm: can0}}\n"
TWO_LINKS = """\
  - {type: canfd, ends: {sensor: can0, motor: can1}}
  - {type: canfd, id: 0x20000, ends: {motor: can1, arm: can0}}
"""
BEAT, BEATS = 13, 10
"""Bytes of HEARTBEAT and ACKNACK (OMG DDS-XRCE 1.0, 8.3.5), and how many there are in a second."""
INT32 = can_frame_bits(16) + can_frame_bits(BEAT)
"""Bits of a reliable Int32 and its acknowledgement."""
CONTROL = 2 * BEATS * can_frame_bits(BEAT)
"""Bits of the HEARTBEAT messages and their answers in a second."""


def system(
    folder: Path,
    rates: tuple[str, str, str] = ("20", "7", ""),
    links: str = ONE_LINK,
    bitrate: int | None = None,
    arm: str = "",
    motor_type: str = "std_msgs/msg/String",
) -> Path:
    """Write a system: `sensor` publishes /a to both others, `motor` /b to `arm` and `arm` /c to ROS, at these rates.

    `arm`: what else the transport of that board has; with the identifier of an agent it has /c.
    """
    boards = "".join(f"  {name}: {{application: {name}/microros.yaml}}\n" for name in BOARDS)
    (folder / "system.yaml").write_text(f"version: 1\nboards:\n{boards}links:\n{links}")
    sensor, motor, its = (f", rate: {rate} Hz" if rate else "" for rate in rates)
    text = f"{{topic: /b, type: {motor_type}, peer: only"
    ends = {
        "sensor": f"    publishers: [{{topic: /a, type: std_msgs/msg/Int32, peer: only{sensor}}}]\n",
        "motor": f"    publishers: [{text}{motor}, limits: {{data: 70}}}}]\n"
        "    subscriptions: [{topic: /a, type: std_msgs/msg/Int32, peer: only}]\n",
        "arm": f"    subscriptions:\n      - {text}, limits: {{data: 70}}}}\n",
    }
    if links == ONE_LINK:
        ends["arm"] += "      - {topic: /a, type: std_msgs/msg/Int32, peer: only}\n"
    if "id:" in arm:
        ends["arm"] += f"    publishers: [{{topic: /c, type: std_msgs/msg/Int64{its}}}]\n"
    for name in BOARDS:
        more = f", bitrate: {bitrate}" if bitrate else ""
        line = f"transport: {{type: canfd{more}{arm if name == 'arm' else ''}}}\n"
        head = f"version: 1\nprofiles: [pure_sender, pure_reader]\n{line}"
        head += f"system: {{file: ../system.yaml, board: {name}}}\n"
        (folder / name).mkdir(exist_ok=True)
        (folder / name / "microros.yaml").write_text(f"{head}nodes:\n  - name: n\n{ends[name]}")
    return folder


def load(folder: Path, board: str) -> BusLoad:
    [found] = peers(folder, board).buses
    return found


def text_bits() -> int:
    """Return the bits of a text of 70 characters in fragments, each of which is acknowledged."""
    sizes = message_sizes(4 + 70 + 1, 63)
    assert len(sizes) == 2
    return sum(map(can_frame_bits, sizes)) + len(sizes) * can_frame_bits(BEAT)


@pytest.mark.parametrize("board", BOARDS)
def test_every_board_has_the_same_sum(tmp_path: Path, board: str) -> None:
    """Each of them knows two of the three pairs from its own types, and the third one from another application."""
    found = load(system(tmp_path), board)
    assert found.load == 2 * (20 * INT32 + CONTROL) + 7 * text_bits() + CONTROL
    names = {
        "sensor": ["to motor", "to arm", "motor to arm"],
        "motor": ["from sensor", "to arm", "sensor to arm"],
        "arm": ["from sensor", "from motor", "sensor to motor"],
    }
    assert [each.name for each in found.lines] == names[board]
    assert f"motor to arm: /b {7 * text_bits()}, HEARTBEAT {CONTROL}" in load(tmp_path, "sensor").shown


def test_what_has_no_rate_is_not_counted(tmp_path: Path) -> None:
    assert load(system(tmp_path, ("20", "", "")), "sensor").load == 2 * (20 * INT32 + CONTROL)
    assert peers(system(tmp_path, ("", "", "")), "sensor").buses == ()


@pytest.mark.parametrize("board", ["sensor", "motor"])
def test_the_agent_of_another_board(tmp_path: Path, board: str) -> None:
    """It is counted if that board has its agent on this bus: a reliable Int64 in one frame."""
    rates = ("20", "7", "3")
    with_agent = load(system(tmp_path, rates, arm=", id: 5, device: can0"), board)
    without = load(system(tmp_path, rates, arm=", id: 5, device: can7"), board)
    each = can_frame_bits(12 + 8) + can_frame_bits(BEAT)
    assert with_agent.load == without.load + 3 * each + CONTROL
    assert with_agent.lines[-1].name == "arm to its agent"
    assert load(tmp_path, "arm").load == without.load
    own = load(system(tmp_path, rates, arm=", id: 5, device: can0"), "arm")
    assert own.load == with_agent.load
    assert [each.name for each in own.lines][-2:] == ["agent", "sensor to motor"]


def test_a_link_of_others_on_the_same_bus(tmp_path: Path) -> None:
    """A board is no end of a link, but another one joins the buses of both links."""
    folder = system(tmp_path, links=TWO_LINKS)
    assert [each.name for each in load(folder, "sensor").lines] == ["to motor", "motor to arm"]
    assert load(folder, "sensor").load == load(folder, "motor").load == load(folder, "arm").load
    read = {path.resolve() for path in compiler.read_paths(planned(folder, "sensor"))}
    assert folder / "arm" / "microros.yaml" in read
    other = system(
        tmp_path, links=TWO_LINKS.replace("0x20000, ends: {motor: can1", "0x20000, ends: {motor: can2")
    )
    assert [each.name for each in load(other, "sensor").lines] == ["to motor"]


def test_a_change_of_another_board_is_a_new_plan(tmp_path: Path) -> None:
    """Its file and those of its types decide, so they are in the list of what the plan was made from."""
    read = {path.resolve() for path in compiler.read_paths(planned(system(tmp_path), "sensor"))}
    assert {tmp_path / name / "microros.yaml" for name in BOARDS} <= read
    assert any(path.name == "String.msg" for path in read)


@pytest.mark.parametrize(
    ("board", "place", "topic", "which"),
    [
        ("sensor", "sensor/microros.yaml:7:74", "/a", 0),
        ("motor", "motor/microros.yaml:7:75", "/b", 1),
        ("arm", "system.yaml:7:5", "/b of the board 'motor'", 1),
    ],
)
def test_the_proposed_rate_is_enough_and_the_next_one_is_not(
    tmp_path: Path, board: str, place: str, topic: str, which: int
) -> None:
    """A board that publishes nothing with a rate hears of the largest publisher of another one."""
    rates = ["60", "60", ""]
    text = refused(system(tmp_path, ("60", "60", ""), bitrate=125_000), board)
    found = re.search(
        r"(\S+): error: the messages with a rate need (\d+) bit/s on the bus '\w+', and it carries 125000 \(.*"
        r"Write `rate: ([\d.]+) Hz` at (.*) or `transport: \{bitrate: (\d+)\}` at all boards, or lower",
        text,
    )
    assert found, text
    assert (found[1], found[4]) == (place, topic)
    needed, rate, better = (Fraction(found[i]) for i in (2, 3, 5))
    assert needed > 125_000
    assert better == 250_000
    rates[which] = str(rate)
    assert planned(system(tmp_path, (rates[0], rates[1], ""), bitrate=125_000), board)
    rates[which] = str(rate + 1)
    assert "and it carries 125000" in refused(
        system(tmp_path, (rates[0], rates[1], ""), bitrate=125_000), board
    )
    assert planned(system(tmp_path, ("60", "60", ""), bitrate=int(better)), board)


def test_the_place_is_that_of_the_publisher_with_the_proposed_rate(tmp_path: Path) -> None:
    """/x is more than /a on the way to one board, and less than /a to both of them."""
    folder = system(tmp_path, ("80", "", ""), bitrate=125_000)
    more = {
        "sensor": (
            "peer: only, rate: 80 Hz}",
            ", {topic: /x, type: std_msgs/msg/Int64, peer: only, rate: 100 Hz}",
        ),
        "motor": ("Int32, peer: only}", ", {topic: /x, type: std_msgs/msg/Int64, peer: only}"),
    }
    for board, (before, after) in more.items():
        path = folder / board / "microros.yaml"
        path.write_text(path.read_text().replace(before, before + after))
    text = refused(folder, "sensor")
    assert "sensor/microros.yaml:7:74: error: the messages with a rate need 156260 bit/s" in text
    assert "Write `rate: 51 Hz` at /a or" in text


def test_a_type_of_another_board_that_does_not_exist(tmp_path: Path) -> None:
    folder = system(tmp_path, motor_type="std_msgs/msg/Strong")
    text = refused(folder, "sensor")
    assert "motor/microros.yaml:7:" in text
    assert "Strong" in text
    assert planned(system(tmp_path, ("20", "", ""), motor_type="std_msgs/msg/Strong"), "sensor"), (
        "it has no rate"
    )


def test_the_check_of_the_system_names_every_board(tmp_path: Path) -> None:
    checked = compiler.check_system(system(tmp_path, ("60", "60", ""), bitrate=125_000) / "system.yaml")
    assert [d.id for d in checked.diagnostics] == ["MG-7269"] * len(BOARDS)
    checked = compiler.check_system(system(tmp_path, bitrate=125_000) / "system.yaml")
    assert checked.result == "agrees"
    shown = [dict(board.rows)["links"] for board in checked.boards]
    sums = {found[1] for text in shown if (found := re.search(r"can\d (\d+) bit/s of 125000", text))}
    assert len(shown) == len(BOARDS)
    assert len(sums) == 1


def test_a_board_of_the_bus_that_cannot_be_read(tmp_path: Path) -> None:
    """Its fault is reported once; no board of the bus is compared, though one is not linked with it."""
    folder = system(tmp_path, links=TWO_LINKS)
    text = (folder / "arm" / "microros.yaml").read_text()
    (folder / "arm" / "microros.yaml").write_text(text.replace("profiles", "profile"))
    checked = compiler.check_system(folder / "system.yaml")
    assert [d.id for d in checked.diagnostics] == ["MG-1002"]
    assert [board.result for board in checked.boards] == ["not compared", "not compared", "differs"]
    assert "arm/microros.yaml:2:1: error: unknown key 'profile'" in refused(folder, "sensor")
