# SPDX-License-Identifier: Apache-2.0
"""A client of parameters on the device, and a node of rclpy that has them."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.line_process import LineProcess
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.e2e.remote_parameters import VALUES, remote_parameters
from tests.support.paths import TESTS
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameter_client, +subscribe]
session: {connect_timeout: 20 s, create_timeout: 10 s}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    parameter_clients:
      - node: /motor
        operations: [get, set, set_atomically, list, describe, get_types, watch]
        parameters: 16
        string: 20
        elements: 3
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{TESTS / 'runtime' / 'c'}")
OK, TIMEOUT, REJECTED, MISMATCH, UNKNOWN = 0, 2, 4001, 4002, 4011
SHOWN = {
    "truth": "1 1",
    "gain": "2 3",
    "rate": "3 0.5",
    "label": "4 'left'",
    "bytes": "5 0 255",
    "truths": "6 1 0",
    "counts": f"7 1 {-(2**40)}",
    "rates": "8 0.5 -2",
    "labels": "9 'a' 'left'",
}
"""The values of the peer, as the program prints them: type and value."""


class Device(CommandedProgram):
    """The program, with the calls of these tests."""

    def lines(self, command: str) -> list[str]:
        code, error, lines = self.call(command)
        assert code == OK, error
        return lines

    def until(self, command: str, *wanted: str) -> None:
        """Repeat a call until it prints these lines: discovery takes a moment."""
        end = deadline(60)
        while (result := self.call(command))[2] != list(wanted):
            assert time.monotonic() < end, result
            time.sleep(0.1)

    def event(self, wanted: str) -> None:
        """Spin until an event is printed."""
        end = deadline(60)
        while wanted not in (lines := self.lines("spin 100")):
            assert time.monotonic() < end, lines


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    folder = tmp_path_factory.mktemp("parameter_client")
    return image.application(C_FILES / "parameter_client.c", folder / "client", *STRICT)


@pytest.fixture
def device(program: Path, agent: object) -> Iterator[Device]:
    with started(program) as process:
        device = Device(process)
        assert device.call("init") == (OK, "", [])
        # A request that is sent before the node is discovered has no response: it is repeated until there is one.
        device.lines(f"timeout {int(seconds(0.5) * 1000)}")
        yield device
        assert process.stdin is not None
        process.stdin.write("end\n")
        process.stdin.flush()
        ends_well(process)


@pytest.fixture
def peer(domain: int) -> Iterator[LineProcess]:
    with remote_parameters(domain) as peer:
        peer.ask(do="start")
        yield peer


def reached(device: Device) -> None:
    """Wait until each service of the node answers."""
    device.until("names gain", "value 2 3")
    device.until("several each gain=3", "outcome 0 ''")
    device.until("several atomically gain=3", "outcome 0 ''")
    device.until("list limited", "name 'limited'")


def test_values_of_every_type(device: Device, peer: LineProcess) -> None:
    reached(device)
    for name, shown in SHOWN.items():
        assert device.lines(f"get {shown[0]} {name}") == [f"value {shown}"]
    names = device.lines("list")
    assert {f"name '{name}'" for name in VALUES} <= set(names)
    wanted: dict[str, Any] = {
        "1 truth 0": False,
        "2 gain -7": -7,
        "3 rate 2.25": 2.25,
        "4 label right": "right",
        "5 bytes 9 8 7": ["09", "08", "07"],
        "6 truths 0": [False],
        "7 counts 5 6 7": [5, 6, 7],
        "8 rates 1e100": [1e100],
        "9 labels x yy zzz": ["x", "yy", "zzz"],
    }
    for arguments, content in wanted.items():
        assert device.lines(f"set {arguments}") == []
        assert peer.ask(do="value", name=arguments.split()[1]) == content


@pytest.mark.system
def test_what_the_node_refuses(device: Device, peer: LineProcess) -> None:
    reached(device)
    code, error, _ = device.call("set 2 limited 11")
    assert code == REJECTED
    assert error.startswith("parameter not set: ")
    assert "limited" in error
    assert device.call("set 2 fixed 2")[0] == REJECTED
    assert device.call("set 4 gain text")[0] == REJECTED
    assert device.call("set 2 nothing 1")[0] == REJECTED
    code, _, lines = device.call("several each limited=5 limited=11 gain=4")
    assert (code, [line.split()[1] for line in lines]) == (REJECTED, ["0", "4001", "0"])
    assert (peer.ask(do="value", name="limited"), peer.ask(do="value", name="gain")) == (5, 4)
    code, _, lines = device.call("several atomically limited=6 limited=11")
    assert (code, len(lines), peer.ask(do="value", name="limited")) == (REJECTED, 1, 5)
    assert device.call("get 2 nothing")[0] == UNKNOWN
    assert device.call("get 3 gain")[0] == MISMATCH


@pytest.mark.system
def test_what_the_node_says_of_its_parameters(device: Device, peer: LineProcess) -> None:
    device.until("types gain labels", "type 2", "type 9")
    device.until("describe gain", "descriptor 'gain' 2 '' '' 0 0")
    assert device.lines("describe limited fixed label") == [
        "descriptor 'limited' 2 '' '' 0 0 0..10 by 1",
        "descriptor 'fixed' 2 '' '' 1 0",
        "descriptor 'label' 4 '' '' 0 0",
    ]
    assert device.lines("get_descriptor share") == [
        "descriptor 'share' 3 'Share of power' 'a multiple of 0.25' 0 0 0..1 by 0.25"
    ]
    for name, shown in SHOWN.items():
        assert device.lines(f"get_type {name}") == [f"type {shown[0]}"]
    assert device.call("describe gain nothing")[0] == UNKNOWN
    assert device.call("types nothing gain")[0] == UNKNOWN


@pytest.mark.system
def test_changes_and_a_restart_of_the_node(device: Device, peer: LineProcess) -> None:
    device.lines("watch")
    reached(device)
    end = deadline(60)
    while peer.ask(do="matched") == 0:
        assert time.monotonic() < end
        time.sleep(0.1)
    # Publisher and subscription know each other when the first of such events arrives.
    value, lines = 100, [""]
    while not any(line.startswith("event changed gain 2 1") for line in lines):
        assert time.monotonic() < end, lines
        value += 1
        peer.ask(do="set", name="gain", value=value)
        lines = device.lines("spin 300")
    peer.ask(do="set", name="label", value="middle")
    device.event("event changed label 4 'middle'")
    peer.ask(do="stop")
    device.lines("timeout 300")
    code, error, _ = device.call("get 2 gain")
    assert (code, "no response within 300 ms: start the node" in error) == (TIMEOUT, True)
    device.lines(f"timeout {int(seconds(0.5) * 1000)}")
    peer.ask(do="start")
    device.until("names gain", "value 2 3")


@pytest.mark.system
def test_asynchronous_calls(device: Device, peer: LineProcess) -> None:
    reached(device)
    device.lines("async_names gain label")
    end = deadline(30)
    lines: list[str] = []
    while "done 0 ''" not in lines:
        assert time.monotonic() < end, lines
        lines = device.lines("spin 100")
    assert lines == ["done 0 ''", "value 2 3", "value 4 'left'"]
