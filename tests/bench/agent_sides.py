# SPDX-License-Identifier: Apache-2.0
"""What stands on the sides of the agent in its bench: an XRCE client whose load is C, a ROS 2 peer in C, and the agent.

The client opens its session and creates its entities in Python (tests/support/agent/client.py); then agent_load.c
continues with its socket and sequence numbers. The peer is rcl and rmw_fastrtps_cpp alone (agent_peer.c).
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import DeliveryControl, ReadData
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.client import (
    BEST_EFFORT,
    RELIABLE,
    XrceClient,
    dds_type,
    participant_blob,
    reader_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.process import environment, running_agent

HERE = Path(__file__).resolve().parent
TYPE = "std_msgs/msg/String"
KEEP_ALL_RELIABLE, KEEP_ALL_BEST_EFFORT = 1, 0
"""EndpointQosFlags without the bit of KEEP_LAST."""
KEEP_LAST_RELIABLE, DEPTH = 3, 10
"""EndpointQosFlags and depth of the default QoS of ROS 2."""
WRITER, READER = 5, 6
"""Kinds of objects."""
FLAGS = ["-std=gnu99", "-O2", "-Wall", "-Wextra", "-Werror"]
TIMEOUT_S = 180
RUN_LIBRARY = """\
import ctypes, sys
words = [word.encode() for word in sys.argv[1:]]
sys.exit(ctypes.CDLL(sys.argv[1]).main(len(words), (ctypes.c_char_p * len(words))(*words)))
"""


@dataclass(frozen=True)
class Programs:
    """The two sides, compiled."""

    load: Path
    library: Path
    """The peer: a library, since libraries of the wheels need those of Python."""

    def peer(self, *arguments: object) -> list[str]:
        """Return the command line of agent_peer."""
        return [sys.executable, "-c", RUN_LIBRARY, str(self.library), *map(str, arguments)]


def build_programs(work: Path) -> Programs | None:
    """Compile both sides against the ROS 2 wheels of this environment; None if none exists."""
    include, library = Path(sys.prefix) / "include", Path(sys.prefix) / "lib"
    if not (include / "rcl").exists() or shutil.which("cc") is None:
        return None
    work.mkdir(parents=True, exist_ok=True)
    programs = Programs(work / "agent_load", work / "agent_peer.so")
    folders = [word for f in sorted(include.iterdir()) if f.is_dir() for word in ("-isystem", str(f))]
    names = ("rcl", "rmw", "rcutils", "std_msgs__rosidl_typesupport_c")
    link = [
        f"-L{library}",
        f"-Wl,-rpath,{library}",
        "-Wl,--allow-shlib-undefined",
        *(f"-l{n}" for n in names),
    ]
    for command in (
        ["cc", *FLAGS, str(HERE / "agent_load.c"), "-o", str(programs.load)],
        [
            "cc",
            *FLAGS,
            "-shared",
            "-fPIC",
            *folders,
            str(HERE / "agent_peer.c"),
            "-o",
            str(programs.library),
            *link,
        ],
    ):
        subprocess.run(command, check=True)
    return programs


@dataclass(frozen=True)
class Target:
    """An agent that is measured: its UDP port, its process, and the ROS domain."""

    port: int
    process: int
    domain: int

    def cpu_s(self) -> float:
        """Return the seconds of processor, user and system, that it has used so far."""
        fields = Path(f"/proc/{self.process}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def memory_mb(self) -> float:
        """Return its resident memory, in 10^6 bytes."""
        status = Path(f"/proc/{self.process}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) * 1024 / 1e6

    def threads(self) -> int:
        """Return how many threads it has."""
        return len(list(Path(f"/proc/{self.process}/task").iterdir()))


@contextmanager
def own_agent(domain: int) -> Iterator[Target]:
    """Start this project's agent as its command does, for as long as the context lasts."""
    with running_agent(domain, "--limit", "messages_per_second=1000000") as agent:
        yield Target(agent.port, agent.process.pid, domain)


class LoadClient(XrceClient):
    """A client that hands its session over to agent_load."""

    def __init__(self, target: Target, key: int, mtu: int = 512) -> None:
        super().__init__(target.port, key=key, mtu=mtu)
        self.domain = target.domain
        assert self.connect() == 0, "the agent refuses a session"

    def __enter__(self) -> LoadClient:
        return self

    @property
    def descriptor(self) -> int:
        """The socket, for agent_load."""
        assert isinstance(self.socket, socket.socket)
        return self.socket.fileno()

    def make(
        self,
        topic: str,
        flags: int = KEEP_ALL_RELIABLE,
        number: int = 1,
        ways: Sequence[int] = (WRITER, READER),
        depth: int = 0,
    ) -> tuple[int, int]:
        """Create a node, a topic, and a data writer, a data reader or both; return the ids of the two.

        `depth` is for `flags` with KEEP_LAST; 0 for KEEP_ALL.
        """
        ids = {kind: number << 4 | kind for kind in range(1, 7)}
        bodies = [
            (1, participant_blob(f"bench_{self.key.hex()}"), 0),
            (2, topic_blob(f"rt/{topic}", dds_type(TYPE)), ids[1]),
        ]
        if WRITER in ways:
            bodies += [(3, b"\0\0", ids[1]), (WRITER, writer_blob(ids[2], flags, depth), ids[3])]
        if READER in ways:
            bodies += [(4, b"\0\0", ids[1]), (READER, reader_blob(ids[2], flags, depth), ids[4])]
        for kind, body, parent in bodies:
            status = self.create(ids[kind], Format.BINARY, body, parent, self.domain)
            assert status in (0, 1), f"{kind}: status {status:#04x}"
        return ids[WRITER], ids[READER]

    def read(self, reader: int, stream: int) -> None:
        """Ask for all samples of a reader."""
        self.send(RELIABLE, encode(ReadData(0x20, reader, stream, 0, None, DeliveryControl(0xFFFF))))
        self.drain()

    def numbers(self, stream: int) -> tuple[int, int]:
        """Return the next sequence numbers of a stream, out and in."""
        return self._sequence[stream], self._next_in if stream == RELIABLE else 0


@dataclass
class Load:
    """A run of agent_load or agent_peer."""

    process: subprocess.Popen[str]
    extra: list[int] = field(default_factory=list)

    def wait_until_ready(self) -> None:
        """Wait for the peer's word that it found its counterpart."""
        line = self._line()
        assert line == "ready", line

    def result(self) -> dict[str, Any]:
        """Return what it says in the end."""
        seen: dict[str, Any] = json.loads(self._line())
        return seen

    def _line(self) -> str:
        assert self.process.stdout is not None
        line = self.process.stdout.readline().strip()
        assert line, f"{self.process.args!r} ended with {self.process.wait(TIMEOUT_S)}"
        return line


@contextmanager
def started(
    command: list[str], domain: int, stdin: int | IO[str] | None = None, descriptors: tuple[int, ...] = ()
) -> Iterator[Load]:
    """Run a side; end it when the context ends."""
    with subprocess.Popen(
        command,
        stdin=stdin if stdin is not None else subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(domain),
        pass_fds=descriptors,
    ) as process:
        try:
            yield Load(process)
            process.wait(TIMEOUT_S)
        finally:
            process.kill()


def load_command(
    programs: Programs,
    task: str,
    client: LoadClient,
    entity: int,
    stream: int,
    size: int,
    count: int,
    rate: int = 0,
    progress: int = -1,
) -> list[str]:
    """Return the command line of agent_load for a client."""
    out, into = client.numbers(stream)
    numbers = (client.descriptor, entity, size, count, client.mtu, stream, out, into, rate, progress)
    return [str(programs.load), task, *map(str, numbers)]


__all__ = [
    "BEST_EFFORT",
    "DEPTH",
    "KEEP_ALL_BEST_EFFORT",
    "KEEP_ALL_RELIABLE",
    "KEEP_LAST_RELIABLE",
    "READER",
    "RELIABLE",
    "TYPE",
    "WRITER",
    "Load",
    "LoadClient",
    "Programs",
    "Target",
    "build_programs",
    "load_command",
    "own_agent",
    "started",
]
