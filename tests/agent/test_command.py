# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent` as a program: start, readiness, signals, diagnostics, exit status."""

from __future__ import annotations

import json
import signal
import sys
from pathlib import Path

import pytest

from microros_gen.ros.libraries import INSTALL
from tests.support.agent import captured
from tests.support.agent.client import XrceClient
from tests.support.agent.command import DOMAIN, run
from tests.support.agent.process import running_agent

pytestmark = pytest.mark.builds


@pytest.mark.ros
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("script", [True, False], ids=["microros-gen", "python -m"])
def test_it_starts_and_ends_cleanly(number: int, script: bool) -> None:
    """Also with the ROS wheels, which start the interpreter again to find their libraries."""
    program = Path(sys.executable).with_name("microros-gen")
    if script and not program.exists():
        pytest.skip("the package is not installed as a program here")
    with running_agent(DOMAIN, command=[str(program)] if script else ()) as agent:
        assert agent.port > 0
        assert agent.stop(number) == 0
        agent.wait_for("agent stopped: 0 samples")


@pytest.mark.ros
def test_json_events() -> None:
    with running_agent(DOMAIN, "--log-format", "json") as agent, XrceClient(agent.port) as client:
        assert json.loads(agent.log[-1])["address"] == f"127.0.0.1:{agent.port}"
        client.connect()
        client.ping()
        event = json.loads(agent.wait_for("client_connected"))
        assert (event["client"], event["level"]) == ("A1B2C3D4", "info")
        client.socket.send(b"x")
        client.leave()
        agent.stop()
        assert json.loads(agent.wait_for('"stopped"'))["fault_short_header"] == 1


@pytest.mark.ros
def test_verbose_shows_every_message() -> None:
    with running_agent(DOMAIN, "-vv") as agent, XrceClient(agent.port) as client:
        client.connect()
        assert "CREATE_CLIENT" in agent.wait_for("from 127.0.0.1")
        assert "key a1 b2 c3 d4" in agent.wait_for("  CREATE_CLIENT: ")
        assert captured.CREATE_CLIENT[:47] in agent.wait_for("0000  ")
        assert "to 127.0.0.1" in agent.wait_for("STATUS_AGENT")
        assert "status OK" in agent.wait_for("  STATUS_AGENT: ")


@pytest.mark.ros
def test_a_port_in_use() -> None:
    with running_agent(DOMAIN) as agent:
        result = run("udp4", "--port", str(agent.port))
    assert result.returncode == 2
    wanted = f"microros-gen: error: UDP port {agent.port} is in use; choose another with --port [MG-9436]\n"
    assert result.stderr == wanted


@pytest.mark.parametrize("address", ["192.0.2.1", "no.such.host.invalid"])
def test_an_address_of_another_machine(address: str) -> None:
    result = run("udp4", "--port", "0", "--bind", address)
    assert result.returncode == 2
    assert f"'{address}' is not an IPv4 address of this machine. --bind takes one" in result.stderr


@pytest.mark.parametrize(
    ("missing", "reason"),
    [("rclpy", "is not installed"), ("rclpy.impl.implementation_singleton", "does not load")],
)
def test_without_ros_it_says_what_to_install(missing: str, reason: str) -> None:
    code = (
        f"import sys; sys.modules['{missing}'] = None; sys.modules.setdefault('rclpy', sys) ;"
        if missing != "rclpy"
        else "import sys; sys.modules['rclpy'] = None;"
    )
    code += "from microros_gen.cli.main import main; main(['agent', 'udp4', '--port', '0'])"
    result = run(code=code)
    assert result.returncode == 2
    assert reason in result.stderr
    assert INSTALL in result.stderr


@pytest.mark.parametrize("arguments", [("udp5",), ("udp4", "--port", "x"), ("udp4", "--domain", "233")])
def test_wrong_use(arguments: tuple[str, ...]) -> None:
    assert run(*arguments).returncode == 2


@pytest.mark.parametrize("arguments", [("--help",), ("udp4", "--help")])
def test_help_needs_no_ros(arguments: tuple[str, ...]) -> None:
    code = "import sys; sys.modules['rclpy'] = None; from microros_gen.cli.main import main; main("
    result = run(code=f"{code}{['agent', *arguments]!r})")
    assert result.returncode == 0
    assert "loopback" in result.stdout or "127.0.0.1" in result.stdout
