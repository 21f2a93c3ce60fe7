# SPDX-License-Identifier: Apache-2.0
"""The commands of docs/howto/secure_links.md, each side in a network namespace with the addresses of the page."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.ros, pytest.mark.long]

PAGE = ROOT / "docs/howto/secure_links.md"
COUNT = 20
SECRET = "a-text-that-nobody-should-read"
NEEDED = {
    "WireGuard": {"wg": "wireguard-tools", "wireguard-go": "wireguard-go", "socat": "socat"},
    "DTLS": {"socat": "socat", "openssl": "openssl"},
    "SSH": {"/usr/sbin/sshd": "openssh-server", "ssh": "openssh-client"},
}
ALLOWED = 'restrict,port-forwarding,permitopen="127.0.0.1:8888",permitlisten="127.0.0.1:1",command="false"'
SSH_CONFIG = """\
Host robot
  HostName 192.168.7.1
  Port 2222
  User root
  IdentityFile {folder}/id
  IdentitiesOnly yes
  UserKnownHostsFile {folder}/known_hosts
  StrictHostKeyChecking yes
  BatchMode yes
"""


def commands(section: str) -> list[str]:
    """Return the blocks of commands of a section of the page."""
    text = PAGE.read_text(encoding="utf-8").partition(f"\n## {section}\n")[2].partition("\n## ")[0]
    return re.findall(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def check_call(*command: str) -> None:
    subprocess.run(command, check=True, capture_output=True, timeout=seconds(30))


class Side:
    """A machine of the page: a network namespace, and the programs that its commands started."""

    def __init__(self, name: str, folder: Path) -> None:
        self.name, self.namespace = name, f"mg-{os.getpid()}-{name}"
        self.log = folder / f"{name}.log"
        self._folder = folder
        self._running: list[subprocess.Popen[bytes]] = []
        check_call("ip", "netns", "add", self.namespace)
        check_call("ip", "-n", self.namespace, "link", "set", "lo", "up", "multicast", "on")
        check_call("ip", "-n", self.namespace, "route", "add", "224.0.0.0/4", "dev", "lo")

    def start(self, command: list[str]) -> subprocess.Popen[bytes]:
        """Start a program in the folder; what it prints is in the log."""
        environment = {
            **os.environ,
            "PATH": f"{self._folder}:{Path(sys.executable).parent}:{os.environ['PATH']}",
            "PYTHONPATH": str(ROOT),
            "PYTHONUNBUFFERED": "1",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        with self.log.open("ab") as log:
            process = subprocess.Popen(
                ["ip", "netns", "exec", self.namespace, *command],
                cwd=self._folder,
                env=environment,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )
        self._running.append(process)
        return process

    def do(self, block: str) -> None:
        """Run a block of commands; those with `&` run on until the end."""
        first, *background = re.split(r"(?m)^(?=.*&$)", block)
        if first.strip():
            assert self.start(["bash", "-ec", first]).wait(timeout=seconds(60)) == 0, self.output()
        for command in background:
            self.start(["bash", "-ec", f"exec {command.strip().removesuffix('&')}"])

    def output(self) -> str:
        return self.log.read_text(errors="replace") if self.log.exists() else ""

    def wait_for(self, part: str) -> None:
        end = deadline(20)
        while part not in self.output():
            assert time.monotonic() < end, f"no {part!r}:\n{self.output()}"
            time.sleep(0.05)

    def listens(self, protocol: str, port: int) -> None:
        """Wait until a program listens at a port."""
        line = re.compile(rf":{port:04X} ", re.MULTILINE)
        end = deadline(20)
        while not line.search(self._read("cat", f"/proc/net/{protocol}")):
            assert time.monotonic() < end, f"nothing listens at {protocol} {port}:\n{self.output()}"
            time.sleep(0.05)

    def _read(self, *command: str) -> str:
        call = ["ip", "netns", "exec", self.namespace, *command]
        return subprocess.run(call, check=True, capture_output=True, text=True).stdout

    def close(self) -> None:
        for process in reversed(self._running):
            try:
                os.killpg(process.pid, signal.SIGTERM)
            except ProcessLookupError:
                continue
        for process in self._running:
            process.wait(timeout=seconds(20))
        subprocess.run(
            ["ip", "-n", self.namespace, "link", "del", f"wg-{self.name}"], capture_output=True, check=False
        )
        check_call("ip", "netns", "del", self.namespace)


class Machines:
    """`robot` and `site`, connected by a cable that is listened to."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.robot, self.site = Side("robot", folder), Side("site", folder)
        names = [f"mg{os.getpid() % 100000}{end}" for end in "ab"]
        check_call("ip", "link", "add", names[0], "type", "veth", "peer", "name", names[1])
        for side, name, address in zip(
            (self.robot, self.site), names, ("192.168.7.1", "192.168.7.2"), strict=True
        ):
            check_call("ip", "link", "set", name, "netns", side.namespace, "name", "cable")
            check_call("ip", "-n", side.namespace, "address", "add", f"{address}/24", "dev", "cable")
            check_call("ip", "-n", side.namespace, "link", "set", "cable", "up")
        check_call("ip", "-n", self.site.namespace, "address", "add", "192.168.8.1/24", "dev", "lo")
        self.spy = self.robot.start([sys.executable, "-c", SPY, str(folder / "cable")])

    def board(self, kind: str, key: str, timeout_s: float = 30.0) -> bool:
        """Let a board publish at `site`; return whether the agent has acknowledged everything."""
        module = "tests.support.agent.far_client"
        words = [sys.executable, "-m", module, kind, "192.168.8.1", "8888", key, str(COUNT), SECRET]
        board = self.site.start(words)
        try:
            return board.wait(timeout=seconds(timeout_s)) == 0
        except subprocess.TimeoutExpired:
            return False

    def on_the_cable(self) -> bytes:
        """Return all frames of the cable so far."""
        return (self.folder / "cable").read_bytes()

    def close(self) -> None:
        self.site.close()
        self.robot.close()


SPY = """
import socket, sys
with socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(3)) as cable, open(sys.argv[1], "wb", 0) as out:
    cable.bind(("cable", 0))
    while True:
        out.write(cable.recv(65536))
"""


@contextmanager
def machines(section: str, folder: Path) -> Iterator[Machines]:
    missing = [package for program, package in NEEDED[section].items() if shutil.which(program) is None]
    if missing:
        pytest.skip(f"apt-get install {' '.join(missing)}")
    if os.geteuid() != 0 or shutil.which("ip") is None:
        pytest.skip("network namespaces need root and iproute2")
    (folder / "microros-gen").write_text(f'#!/bin/sh\nexec {sys.executable} -m microros_gen "$@"\n')
    (folder / "microros-gen").chmod(0o755)
    both = Machines(folder)
    try:
        yield both
    finally:
        both.close()


def check_tunnel(both: Machines, kind: str, keys: tuple[str, ...] = ("A1B2C3D4", "A1B2C3D5")) -> None:
    """Boards publish; the agent gets all, and the cable carries much, but nothing readable."""
    for key in keys:
        assert both.board(kind, f"0x{key}"), both.site.output() + both.robot.output()
        both.robot.wait_for(f"client {key}: publisher /far")
    seen = both.on_the_cable()
    assert len(seen) > len(keys) * COUNT * len(SECRET)
    assert b"XRCE" not in seen
    assert SECRET.encode() not in seen
    send = f"import socket; socket.socket(type=socket.SOCK_DGRAM).sendto(b'{SECRET}', ('192.168.7.1', 9))"
    assert both.site.start([sys.executable, "-c", send]).wait(timeout=seconds(20)) == 0
    end = deadline(10)
    while SECRET.encode() not in both.on_the_cable():
        assert time.monotonic() < end, "what is not protected is seen"
        time.sleep(0.05)


def test_wireguard(tmp_path: Path) -> None:
    keys, robot, site = commands("WireGuard")
    with machines("WireGuard", tmp_path) as both:
        both.robot.do(keys)
        both.robot.do(robot)
        both.robot.wait_for("agent ready")
        both.site.do(site)
        both.site.listens("udp", 8888)
        check_tunnel(both, "udp")
        stranger = subprocess.run(["wg", "genkey"], capture_output=True, check=True, text=True).stdout
        (tmp_path / "stranger.key").write_text(stranger)
        both.site.do("wg set wg-site private-key stranger.key\n")
        assert not both.board("udp", "0xA1B2C3D6", timeout_s=3)
    assert "A1B2C3D6" not in both.robot.output()


def test_dtls(tmp_path: Path) -> None:
    keys, robot, site = commands("DTLS")
    with machines("DTLS", tmp_path) as both:
        both.robot.do(keys)
        both.robot.do(robot)
        both.robot.wait_for("agent ready")
        both.robot.listens("udp", 4433)
        both.site.do(site)
        both.site.listens("udp", 8888)
        check_tunnel(both, "udp", ("A1B2C3D4",))
        (tmp_path / "other").mkdir()
        both.site.do(f"cd other\n{keys}")
        both.site.do(site.replace("8888", "8889").replace("cert=site.pem", "cert=other/site.pem"))
        both.site.listens("udp", 8889)
        assert not stranger_at(both, 8889)
    assert "A1B2C3D6" not in both.robot.output()


def stranger_at(both: Machines, port: int) -> bool:
    words = ["udp", "192.168.8.1", str(port), "0xA1B2C3D6", "1", SECRET]
    stranger = both.site.start([sys.executable, "-m", "tests.support.agent.far_client", *words])
    try:
        return stranger.wait(timeout=seconds(3)) == 0
    except subprocess.TimeoutExpired:
        return False


def test_ssh(tmp_path: Path) -> None:
    robot, site = commands("SSH")
    with machines("SSH", tmp_path) as both:
        for name in ("host_key", "id"):
            check_call("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(tmp_path / name))
        host = (tmp_path / "host_key.pub").read_text()
        (tmp_path / "known_hosts").write_text(f"[192.168.7.1]:2222 {host}")
        (tmp_path / "ssh_config").write_text(SSH_CONFIG.format(folder=tmp_path))
        (tmp_path / "ssh").write_text(
            f'#!/bin/sh\nexec {shutil.which("ssh")} -F {tmp_path}/ssh_config "$@"\n'
        )
        (tmp_path / "ssh").chmod(0o755)
        allowed = f"{ALLOWED} {(tmp_path / 'id.pub').read_text()}"
        assert ALLOWED in PAGE.read_text(encoding="utf-8")
        (tmp_path / "authorized_keys").write_text(allowed)
        Path("/run/sshd").mkdir(exist_ok=True)
        options = (
            "StrictModes=no",
            "UsePAM=no",
            "PidFile=none",
            f"AuthorizedKeysFile={tmp_path}/authorized_keys",
        )
        flags = [word for option in options for word in ("-o", option)]
        both.robot.start(
            [
                "/usr/sbin/sshd",
                "-D",
                "-e",
                "-f",
                "/dev/null",
                "-p",
                "2222",
                "-h",
                f"{tmp_path}/host_key",
                *flags,
            ]
        )
        both.robot.do(robot)
        both.robot.wait_for("agent ready")
        both.robot.wait_for("Server listening on 0.0.0.0 port 2222")
        both.site.do(site)
        both.site.listens("tcp", 8888)
        check_tunnel(both, "tcp")
        assert both.site.start(["ssh", "robot", "echo", SECRET]).wait(timeout=seconds(20)) == 1
        assert SECRET not in both.site.output()
        listening = ["ssh", "-N", "-o", "ExitOnForwardFailure=yes", "-R", "22990:127.0.0.1:22", "robot"]
        assert both.site.start(listening).wait(timeout=seconds(20)) == 255
        check_call("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(tmp_path / "stranger"))
        config = (tmp_path / "ssh_config").read_text().replace(f"{tmp_path}/id", f"{tmp_path}/stranger")
        (tmp_path / "ssh_config").write_text(config)
        assert both.site.start(["ssh", "-N", "robot"]).wait(timeout=seconds(20)) == 255
        assert "Permission denied (publickey" in both.site.output()
