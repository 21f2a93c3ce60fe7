# SPDX-License-Identifier: Apache-2.0
"""`rate:` of publishers against the links that their messages use."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path

import pytest

from microros_gen.agent.framing import encode_frame
from microros_gen.components.peer.load import LinkLoad
from tests.support.components.boards import SYSTEM, application, peers, planned, refused, written

SERIAL = SYSTEM.replace("udp", "serial").replace("10.0.0.1:7500", "/dev/a").replace("10.0.0.2:7500", "/dev/b")
NUMBERS = "type: std_msgs/msg/Int32, peer: only"
BEST = "qos: {reliability: best_effort}"
MESSAGE, BEAT = 16, 13
"""Bytes of WRITE_DATA with an Int32, and of HEARTBEAT and ACKNACK (OMG DDS-XRCE 1.0, 8.3.5)."""


def frame(size: int) -> int:
    """Return the length of the longest frame around a message: every byte but the flag is stuffed."""
    return 1 + 2 * (len(encode_frame(bytes(size), 0, 0)) - 1)


def pair(folder: Path, sensor: str, motor: str = "", kind: str = SERIAL, baud: int = 115200) -> Path:
    """Write a system in which `sensor` publishes /a and `motor` subscribes to it, and the other way round for /b."""
    line = f"transport: {{type: {'serial' if kind == SERIAL else 'udp'}, baud: {baud}}}\n"
    line = line if kind == SERIAL else ""
    two = (
        _board("sensor", f"{{topic: /a, {sensor}}}", "/b" if motor else "", line),
        _board("motor", f"{{topic: /b, {motor}}}" if motor else "", "/a", line),
    )
    return written(folder, kind, *two)


def _board(name: str, publisher: str, subscription: str, more: str) -> str:
    text = f"    publishers: [{publisher}]\n" if publisher else ""
    if subscription:
        text += f"    subscriptions: [{{topic: {subscription}, {NUMBERS}, {BEST}}}]\n"
    return application(name, text, more)


def load(folder: Path, board: str = "sensor") -> LinkLoad:
    [found] = peers(folder, board).loads
    return found


def test_the_sum_of_both_directions(tmp_path: Path) -> None:
    """A reliable sample takes a frame there and an ACKNACK back, and so does each HEARTBEAT."""
    session = "session: {heartbeat: 200 ms}\n"
    folder = pair(tmp_path, f"{NUMBERS}, rate: 20 Hz", f"{NUMBERS}, rate: 7 Hz, {BEST}")
    for board in ("sensor", "motor"):
        config = folder / board / "microros.yaml"
        config.write_text(config.read_text().replace("nodes:", f"{session}nodes:"))
    forth, back = load(folder).line, load(folder, "motor").line
    assert forth.load == 20 * frame(MESSAGE) + 5 * frame(BEAT)
    assert back.load == 7 * frame(MESSAGE) + (20 + 5) * frame(BEAT)
    assert load(folder).shown == (
        f"motor {math.ceil(forth.load)} bytes/s of 11520 if every byte is stuffed"
        f" (/a {20 * frame(MESSAGE)}, HEARTBEAT {5 * frame(BEAT)})"
    )


def test_best_effort_is_not_acknowledged(tmp_path: Path) -> None:
    folder = pair(tmp_path, f"{NUMBERS}, rate: 20 Hz, {BEST}")
    assert load(folder).line.load == 20 * frame(MESSAGE)
    assert peers(folder, "motor").loads == ()


@pytest.mark.parametrize("baud", [2400, 9600, 115200])
def test_what_is_proposed_is_enough_and_the_next_one_is_not(tmp_path: Path, baud: int) -> None:
    text = refused(pair(tmp_path, f"{NUMBERS}, rate: 900 Hz", baud=baud))
    found = re.search(
        r"need (\d+) bytes/s on the line to the board 'motor', and it carries (\d+) with .*"
        r"Write `rate: ([\d.]+) Hz` at /a or `transport: \{baud: (\d+)\}` at both boards",
        text,
    )
    assert found, text
    needed, carried, rate, better = (Fraction(each) for each in found.groups())
    assert carried == baud // 10 < needed
    assert planned(pair(tmp_path, f"{NUMBERS}, rate: {rate} Hz", baud=baud))
    assert "the messages with a rate need" in refused(
        pair(tmp_path, f"{NUMBERS}, rate: {rate + 1} Hz", baud=baud)
    )
    assert planned(pair(tmp_path, f"{NUMBERS}, rate: 900 Hz", baud=int(better)))
    worse = {460800: 230400, 921600: 460800}[int(better)]
    assert "the messages with a rate need" in refused(pair(tmp_path, f"{NUMBERS}, rate: 900 Hz", baud=worse))


def test_acknowledgments_alone_can_be_too_much(tmp_path: Path) -> None:
    """The board that only receives has no rate to lower."""
    folder = pair(tmp_path, f"{NUMBERS}, rate: 400 Hz")
    text = refused(folder, "motor")
    assert "system.yaml:6:5: error: the messages with a rate need" in text
    assert "on the line to the board 'sensor', and it carries 11520 with `baud: 115200` (ACKNACK" in text
    assert "Write `transport: {baud: 230400}` at both boards" in text
    assert planned(pair(tmp_path, f"{NUMBERS}, rate: 400 Hz", baud=230400), "motor")


def test_nothing_is_known_of_udp(tmp_path: Path) -> None:
    folder = pair(tmp_path, f"{NUMBERS}, rate: 100000 Hz, {BEST}", kind=SYSTEM)
    assert load(folder).shown == "motor 1600000 bytes/s (/a 1600000); the rate of a UDP link is not known"


def test_each_link_has_its_own_sum_and_the_agent_another_one(tmp_path: Path) -> None:
    folder = pair(tmp_path, f"{NUMBERS.replace('only', 'also')}, rate: 20 Hz, {BEST}")
    project = planned(folder).project
    assert project.line is not None
    assert project.line.load < load(folder).line.load == 20 * frame(MESSAGE)


def test_a_rate_on_a_link_has_an_effect(tmp_path: Path) -> None:
    folder = pair(tmp_path, f"{NUMBERS}, rate: 20 Hz, {BEST}")
    assert [w.id for w in planned(folder).warnings if w.id == "MG-7131"] == []


def test_without_rates_nothing_is_said(tmp_path: Path) -> None:
    folder = pair(tmp_path, f"{NUMBERS}, {BEST}")
    assert peers(folder, "sensor").loads == ()
