# SPDX-License-Identifier: Apache-2.0
"""An executor over a custom transport rests in the application's read function: not busy, and awake when data comes."""

from __future__ import annotations

import socket
import subprocess
import threading
import time
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support.runtime.harness import EXECUTOR, build, components, render
from tests.support.runtime.reading_agent import ReadingAgent

PLAN = replace(
    EXECUTOR,
    transport="custom",
    timers_max=0,
    connect_timeout_ms=10_000,
    create_timeout_ms=10_000,
    liveliness_period_ms=5000,
)


@pytest.mark.parametrize("framing", ["off", "either"])
def test_the_processor_rests(framing: str, tmp_path: Path) -> None:
    plan = replace(PLAN, framing=framing)
    tree = render(tmp_path, plan, components(plan))
    program = build(tree, ["types_read.c", "custom_wait.c"], "custom_wait")
    agent = ReadingAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        peers: list[tuple[str, int]] = []

        def serve() -> None:
            while True:
                try:
                    datagram, peer = served.recvfrom(2048)
                except OSError:
                    return
                peers.append(peer)
                for answer in agent.receive(datagram):
                    served.sendto(answer, peer)

        threading.Thread(target=serve, daemon=True).start()
        with subprocess.Popen(
            [program, str(served.getsockname()[1])], text=True, stdout=subprocess.PIPE
        ) as process:
            assert process.stdout is not None
            reads, busy_ms, took_ms = (int(word) for word in process.stdout.readline().split())
            time.sleep(0.2)
            sent = time.monotonic()
            for answer in agent.numbers(plan.publisher_places, 7):
                served.sendto(answer, peers[-1])
            came = float(process.stdout.readline())
            assert process.wait(timeout=20) == 0
    assert took_ms >= 999
    assert reads <= 250, "two for each rest of 10 ms"
    assert busy_ms < took_ms / 3
    assert came - sent < 2, "not at the end of the wait of five seconds"
