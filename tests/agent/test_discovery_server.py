# SPDX-License-Identifier: Apache-2.0
"""The agent and a node of rclpy find each other by the discovery server of Fast DDS, and by nothing else."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent

pytestmark = [pytest.mark.ros, pytest.mark.system]

PROGRAM = Path(sys.prefix) / "bin" / "fast-discovery-server"
VARIABLE = "ROS_DISCOVERY_SERVER"
INT32 = "std_msgs/msg/Int32"


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def discovery_server() -> Iterator[str]:
    """Run the server of the wheels, which has to be shown where its libraries are; give its address."""
    library = Path(sys.prefix) / "lib"
    (own,) = library.glob("python3*/site-packages/ros_fastrtps.libs")
    port = free_port()
    with subprocess.Popen(
        [str(PROGRAM), "-i", "0", "-l", "127.0.0.1", "-p", str(port)],
        env={**os.environ, "LD_LIBRARY_PATH": f"{library}:{own}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        try:
            assert process.stdout is not None
            lines: list[str] = []
            while not any("Server is running" in line for line in lines):
                line = process.stdout.readline()
                assert line, "".join(lines)
                lines.append(line)
            yield f"127.0.0.1:{port}"
        finally:
            process.terminate()


def test_samples_arrive_and_a_node_without_the_server_sees_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    domain = own_domain()
    with discovery_server() as address:
        monkeypatch.setenv(VARIABLE, address)
        with running_agent(domain) as agent, observing(domain) as served, XrceClient(agent.port) as client:
            monkeypatch.delenv(VARIABLE)
            with observing(domain) as other:
                assert client.connect() == 0
                writer = client.publisher("board", "served", INT32, domain)
                for observer in (served, other):
                    observer.subscribe("/served", INT32)
                client.wait_until_subscribed(writer, int32_body(0), served, "/served")
                served.see(lambda graph: "/board" in str(graph))
                for value in range(1, 20):
                    client.write(writer, int32_body(value))
                client.drain()
                found: list[int] = []
                while 19 not in found:
                    found += [sample["data"] for _, sample in served.got(1, topic="/served")]
                assert [value for value in found if value] == list(range(1, 20)), "0: from the discovery"
                assert other.ask(do="samples") == []
                assert "board" not in str(other.ask(do="graph"))
            monkeypatch.setenv(VARIABLE, address)
            monkeypatch.setenv("ROS_SUPER_CLIENT", "TRUE")
            with observing(domain) as tool:  # it subscribes to nothing
                graph = tool.see(lambda graph: "/served" in str(graph) and "/board" in str(graph))
                assert "/observer" in str(graph)
