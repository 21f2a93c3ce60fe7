# SPDX-License-Identifier: Apache-2.0
"""Runs a POSIX image against a scripted agent while time stands still, and records each message of both sides."""

from __future__ import annotations

import os
import socket
import subprocess
from pathlib import Path

from tests.support.patience import seconds
from tests.support.runtime.serving_agent import ServingAgent, identity
from tests.support.runtime.wires import Datagrams, Frames, Lengths, Wire

WIRES: dict[str, type[Wire]] = {"udp": Datagrams, "tcp": Lengths, "serial": Frames}
OFFER_MS = 400
"""The agent has a sample for every reader, and a request for every replier, so often."""
HEARTBEAT_MS = 100
SAMPLE = bytes([1, 0, 0, 0]) + bytes(60)
"""Decodes as every message of the recorded applications: Int32 1, an empty string, true."""
READER, REPLIER = 6, 8
SEARCH = bytes.fromhex("80000000 02010800 0009fffd 03000000")
"""GET_INFO of a client that searches for an agent."""
FOUND = bytes.fromhex(
    "80000000 06012c00 0009fffd 0000 010d 58524345 0100010f 00 010d 00 0100 0000 01000000 01 7f000001 00 b822"
)
"""INFO of an agent at 127.0.0.1:8888."""


class Peer:
    """The agent and its calendar; `lines` are the recorded messages."""

    def __init__(self, agent: ServingAgent, wire: Wire) -> None:
        self.agent = agent
        self.lines: list[str] = []
        self._wire = wire
        self._next = {OFFER_MS: OFFER_MS, HEARTBEAT_MS: HEARTBEAT_MS}
        self._requests = 0

    def sent(self, now: int, data: bytes) -> list[bytes]:
        """Take what the program sent; return what it gets for it."""
        answers = []
        for message in self._wire.messages(data):
            self.lines.append(f"{now:6} > {message.hex()}")
            answers += [FOUND] if message == SEARCH else self.agent.receive(message)
        return self._carried(now, answers)

    def passed(self, start: int, end: int) -> tuple[int, list[bytes]]:
        """Let time pass up to `end` or the first thing that the agent has to say; return when, and what."""
        while (due := min(self._next.values())) <= end:
            datagrams = []
            for period, at in list(self._next.items()):
                if at == due:
                    self._next[period] = at + period
                    datagrams += self._offers() if period == OFFER_MS else self.agent.tick()
            if datagrams:
                now = max(due, start)
                return now, self._carried(now, datagrams)
        return end, []

    def _carried(self, now: int, messages: list[bytes]) -> list[bytes]:
        self.lines += [f"{now:6} < {message.hex()}" for message in messages]
        return [self._wire.carried(message) for message in messages]

    def _offers(self) -> list[bytes]:
        datagrams: list[bytes] = []
        for target in sorted(self.agent.reading):
            kind = target[1] & 15
            if kind == READER:
                datagrams += self.agent.give(target, SAMPLE)
            elif kind == REPLIER:
                self._requests += 1
                datagrams += self.agent.give(target, identity(self._requests) + SAMPLE)
        calls, self.agent.calls = self.agent.calls, []
        for target, request, _ in calls:
            datagrams += self.agent.give(target, request + target + SAMPLE)
        return datagrams


def record(image: Path, still_time: Path, transport: str, duration_ms: int, agent: ServingAgent) -> list[str]:
    """Run `image` for `duration_ms` of the simulated time; return its messages and the agent's, a line each."""
    ours, theirs = socket.socketpair()
    peer = Peer(agent, WIRES[transport]())
    environment = {
        **os.environ,
        "LD_PRELOAD": str(still_time),
        "EXCHANGE_FD": str(theirs.fileno()),
        "EXCHANGE_MS": str(duration_ms),
    }
    with (
        subprocess.Popen(
            [image],
            env=environment,
            pass_fds=(theirs.fileno(),),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        ) as process,
        ours,  # closed first: the program ends when nobody answers, also after an error of the agent
    ):
        theirs.close()
        with ours.makefile("rw") as stream:
            for line in stream:
                word, *rest = line.split()
                if word == "S":
                    now, answers = int(rest[0]), peer.sent(int(rest[0]), bytes.fromhex(rest[1]))
                else:
                    now, answers = peer.passed(int(rest[0]), int(rest[1]))
                stream.writelines(f"R {now} {answer.hex()}\n" for answer in answers)
                stream.write(f". {now}\n" if not answers else ".\n")
                stream.flush()
        _, errors = process.communicate(timeout=seconds(60))
    assert process.returncode == 0, errors
    return peer.lines
