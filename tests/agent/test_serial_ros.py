# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent serial` and `pty` as programs, from a client at a device to rclpy in another process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.agent.wire.constants import Format
from tests.support.agent.cable import Cable
from tests.support.agent.client import BEST_EFFORT, XrceClient, int32_body
from tests.support.agent.entities_file import content
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import environment, own_domain, running_agent
from tests.support.agent.references import PROFILES
from tests.support.agent.ros_client import INT32, gone, matched
from tests.support.agent.serial_link import SerialLink
from tests.support.patience import seconds

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running


def send_and_see(client: XrceClient, writer: int, observer: Observer, topic: str) -> None:
    client.wait_until_subscribed(writer, int32_body(-1), observer, topic)
    for value in range(100):
        client.write(writer, int32_body(value), BEST_EFFORT if value % 2 else 0x80)
    client.drain()
    values = [value["data"] for _, value in observer.got(100)]
    assert sorted(v for v in values if v >= 0) == list(range(100))


def test_pty(domain: int, observer: Observer, tmp_path: Path) -> None:
    observer.subscribe("/pty/count", INT32)
    link = tmp_path / "board"
    with running_agent(domain, transport=("pty", "--link", str(link))) as agent:
        assert agent.device == str(link)
        with XrceClient(SerialLink(str(link))) as client:
            assert client.connect() == 0
            writer = client.publisher("pty_node", "pty/count", INT32, domain)
            observer.see(matched("/pty/count", "/pty_node"))
            send_and_see(client, writer, observer, "/pty/count")
            client.leave()
        assert agent.stop(signal.SIGINT) == 0
        assert not link.is_symlink()


def test_serial_with_references_unplugged_and_plugged_in_again(
    domain: int, observer: Observer, tmp_path: Path
) -> None:
    observer.subscribe("/count", INT32)
    (tmp_path / "refs.xml").write_text(PROFILES)
    device, cable = tmp_path / "tty", Cable()
    device.symlink_to(cable.device)
    with running_agent(
        domain, "--references", str(tmp_path / "refs.xml"), transport=("serial", "--dev", str(device))
    ) as agent:
        assert agent.device == str(device)
        for turn in range(2):
            client = XrceClient(SerialLink(cable.end))
            assert client.connect() == 0
            assert client.create(0x11, Format.REFERENCE, b"participant_profile", 0, domain) in (0, 1)
            assert client.create(0x13, Format.XML, b"", 0x11) in (0, 1)
            assert client.create(0x15, Format.REFERENCE, b"count_dw", 0x13) == 0x80
            assert "Did you mean 'count__dw'?" in agent.wait_for("refused")
            assert client.create(0x15, Format.REFERENCE, b"count__dw", 0x13) in (0, 1)
            observer.see(matched("/count", "/counter"))
            send_and_see(client, 0x15, observer, "/count")
            if turn == 0:
                cable.pull()
                agent.wait_for("is gone")
                device.unlink()
                cable = Cable()
                device.symlink_to(cable.device)
                agent.wait_for("is back")
        client.leave()
        observer.see(gone("/counter"))
        cable.pull()


def test_preconfigured_entities(domain: int, observer: Observer, tmp_path: Path) -> None:
    observer.subscribe("/given_count", INT32)
    data = content("*")
    data["clients"][0]["objects"][0]["domain"] = 255  # the agent's own
    data["clients"][0]["objects"][0]["name"] = "given"
    data["clients"][0]["objects"][1]["name"] = "rt/given_count"
    data["clients"][0]["objects"][3]["reliability"] = "reliable"
    (tmp_path / "entities.json").write_text(json.dumps(data))
    with (
        running_agent(domain, "--entities", str(tmp_path / "entities.json"), transport=("pty",)) as agent,
        XrceClient(SerialLink(agent.device)) as client,
    ):
        assert client.connect() == 0
        observer.see(matched("/given_count", "/given"))
        send_and_see(client, 5, observer, "/given_count")
        client.leave()
        observer.see(gone("/given"))


def run(*arguments: str, path: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "microros_gen", "agent", *arguments],
        env=environment(own_domain()),
        text=True,
        capture_output=True,
        timeout=seconds(20),
        check=False,
        cwd=path,
    )


def test_faults_of_both_files_in_one_run(tmp_path: Path) -> None:
    (tmp_path / "r.xml").write_text("<profiles>\n  <topic/>\n</profiles>")
    (tmp_path / "e.json").write_text('{"version": 1, "clients": 3}')
    result = run(
        "pty", "--references", "r.xml", "--entities", "e.json", "--entities", "no.json", path=tmp_path
    )
    assert result.returncode == 2
    assert "r.xml:2:3: error: this topic has no profile_name" in result.stderr
    assert "e.json:1:27: error: 'clients' must be a list" in result.stderr
    assert "error: no.json cannot be read: No such file or directory" in result.stderr
    assert "Traceback" not in result.stderr


def test_a_path_that_is_no_device(tmp_path: Path) -> None:
    result = run("serial", "--dev", os.devnull, path=tmp_path)
    assert (result.returncode, result.stdout) == (2, "")
    assert "/dev/null is not a serial device. Give a terminal device" in result.stderr


@pytest.mark.parametrize("name", ["udp4", "serial", "pty"])
def test_help_has_an_example(name: str, tmp_path: Path) -> None:
    result = run(name, "--help", path=tmp_path)
    assert f"microros-gen agent {name}" in result.stdout
    assert "--references, --refs FILE" in result.stdout
    assert "--entities FILE" in result.stdout
