# SPDX-License-Identifier: Apache-2.0
"""A list of agents: times, the option --agent, and what it cannot be combined with."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.agents.plan import AgentPlan, AgentsPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.components.rendered import planned

POOLS = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
TWO = 'transport: {agents: ["10.0.0.1:8888", "10.0.0.2:8889"]}\n'
LINES = "transport: {type: serial, agents: [/dev/ttyS0, /dev/ttyS1]}\n"
EIGHT = "transport: {agents: [" + ", ".join(f'"10.0.0.{i}:8888"' for i in range(8)) + "]}\n"


def agents_of(folder: Path, application: str) -> AgentsPlan:
    found = planned(folder, application).project.runtime.features.of("agents")
    assert isinstance(found, AgentsPlan)
    return found


def test_the_list_and_the_first_of_it(tmp_path: Path) -> None:
    runtime = planned(tmp_path, POOLS + TWO).project.runtime
    assert runtime.transport.agent_place == "10.0.0.1:8888"
    assert agents_of(tmp_path, POOLS + TWO).declared == (
        AgentPlan("10.0.0.1", 8888),
        AgentPlan("10.0.0.2", 8889),
    )


def test_the_devices_and_the_first_of_them(tmp_path: Path) -> None:
    runtime = planned(tmp_path, POOLS + LINES).project.runtime
    assert runtime.transport.device == "/dev/ttyS0"
    found = agents_of(tmp_path, POOLS + LINES)
    assert found.declared == (AgentPlan("/dev/ttyS0", 0), AgentPlan("/dev/ttyS1", 0))
    assert found.shown == "/dev/ttyS0, /dev/ttyS1"


@pytest.mark.parametrize(
    ("application", "try_ms"),
    [
        (TWO, 300),
        (LINES, 300),
        (TWO + "session: {round_trip: 500 ms}\n", 1500),
        (EIGHT, 125),
        (EIGHT + "session: {connect_timeout: 10 s}\n", 300),
    ],
    ids=["two", "lines", "slow", "eight", "eight and time"],
)
def test_each_is_tried_within_connect_timeout(tmp_path: Path, application: str, try_ms: int) -> None:
    planned_agents = agents_of(tmp_path, POOLS + application)
    times = planned(tmp_path, POOLS + application).project.runtime.times
    assert planned_agents.try_ms == try_ms
    assert planned_agents.count * try_ms <= times.connect_timeout_ms


def features(folder: Path, agent: str | None, transport: str = TWO, file: str = "list") -> str:
    """Return what OUT has of the list for a value of --agent."""
    config = folder / "microros.yaml"
    config.write_text(POOLS + transport, encoding="utf-8")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),), agent=agent)
    out = folder / "out"
    compiler.generate(options, out)
    found = out / "src" / "agents" / f"xrce_agents_{file}.c"
    return found.read_text(encoding="utf-8") if found.exists() else ""


def test_the_option_replaces_the_list(tmp_path: Path) -> None:
    assert '{"10.0.0.2", 8889}' in features(tmp_path, None)
    other = features(tmp_path, "10.0.0.3:1, 10.0.0.4:2")
    assert '{"10.0.0.3", 1}' in other
    assert '{"10.0.0.4", 2}' in other
    assert "10.0.0.1" not in other
    assert features(tmp_path, "10.0.0.5:3") == "", "one agent: nothing of the component is left"
    assert features(tmp_path, "discover") == ""
    for wrong in ("10.0.0.3:1,", "10.0.0.3:1,discover", "10.0.0.3:1,10.0.0.3:1"):
        with pytest.raises(UserError):
            features(tmp_path, wrong)


def test_the_option_replaces_the_devices(tmp_path: Path) -> None:
    assert '"/dev/ttyS1"' in features(tmp_path, None, LINES, "devices")
    other = features(tmp_path, "/dev/ttyUSB0, /dev/ttyUSB1", LINES, "devices")
    assert '  "/dev/ttyUSB0",\n  "/dev/ttyUSB1",\n' in other
    assert "ttyS" not in other
    assert features(tmp_path, "/dev/ttyUSB0", LINES, "devices") == "", (
        "one device: nothing of the component is left"
    )
    assert '"/dev/ttyUSB1"' in features(tmp_path, "/dev/ttyUSB0,/dev/ttyUSB1", "", "devices")
    for wrong in ("10.0.0.3:1,10.0.0.4:1", "/dev/ttyUSB0,10.0.0.3:1", "/dev/ttyUSB0,/dev/ttyUSB0"):
        with pytest.raises(UserError):
            features(tmp_path, wrong, LINES)


@pytest.mark.parametrize(
    ("application", "message"),
    [
        (
            POOLS + "components: [+agents]\n",
            "the component 'agents' is for several agents, and the application",
        ),
        (POOLS + TWO.replace("{", "{type: serial, "), "transport: serial has no agent addresses"),
        (POOLS + TWO.replace("{", "{type: custom, "), "transport: custom has no agent addresses"),
        (POOLS + LINES.replace("serial", "tcp"), "transport: tcp has no serial devices"),
        (
            POOLS + LINES + "target: qemu-mps2-an386\n",
            "the target 'qemu-mps2-an386' has one serial line, which leads to one agent",
        ),
        (
            POOLS + LINES.replace("agents", "device: /dev/ttyS2, agents"),
            "'transport.device' and 'transport.agents' contradict each other",
        ),
        (POOLS + LINES.replace("ttyS1", "ttyS0"), "the agent '/dev/ttyS0' is in the list twice"),
        (POOLS + LINES + "liveliness: none\n", "several agents contradict 'liveliness: none'"),
        (POOLS + TWO + "liveliness: none\n", "several agents contradict 'liveliness: none'"),
        (
            POOLS + TWO + "components: [+sleep_cycles]\n",
            "several agents contradict the component 'sleep_cycles'",
        ),
        (
            POOLS + TWO + "components: [-agents]\n",
            "drops a component that is selected by transport: {agents}",
        ),
    ],
)
def test_what_contradicts_a_list(tmp_path: Path, application: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, application)
    assert any(message in str(diagnostic) for diagnostic in caught.value.diagnostics)


def test_over_tcp_a_closed_connection_is_noticed(tmp_path: Path) -> None:
    application = POOLS + TWO.replace("{", "{type: tcp, ") + "liveliness: none\n"
    assert agents_of(tmp_path, application).count == 2
