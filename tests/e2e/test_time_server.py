# SPDX-License-Identifier: Apache-2.0
"""The time server, this project's agent, and an application whose clock and timer follow it."""

from __future__ import annotations

import queue
import subprocess
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.ros.peer import Peer
from tests.support.agent.process import AgentProcess, environment
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.e2e.server_process import server_process
from tests.support.e2e.simulated import APPLICATION, END_S
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros
DOUBLE = 3


class Output:
    """What the application says: a word and a number of milliseconds."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._lines: queue.Queue[tuple[str, int]] = queue.Queue()
        assert process.stdout is not None
        threading.Thread(target=self._listen, args=(process.stdout,), daemon=True).start()

    def _listen(self, lines: Iterator[str]) -> None:
        for line in lines:
            word, _, number = line.partition(" ")
            self._lines.put((word, int(number) // 1_000_000))

    def next(self, word: str) -> int:
        end = deadline(20)
        while True:
            found, number = self._lines.get(timeout=max(0.1, end - time.monotonic()))
            if found == word and number != 0:
                return number


def test_firmware_follows_pause_and_jumps(
    images: Images, image_port: Relay, agent: AgentProcess, domain: int, tmp_path: Path
) -> None:
    program = images.build(image_port.port, APPLICATION).application(
        C_FILES / "simulation.c", tmp_path / "simulation", "-std=c99", "-Wall", "-Werror"
    )
    command = ("-m", "microros_gen", "time-server", "--start", "50", "--paused")
    with (
        pytest.MonkeyPatch.context() as patch,
        server_process(domain, "time server ready: /microros_time\n", command) as server,
    ):
        for name, value in environment(domain).items():
            patch.setenv(name, value)
        with Peer("setting") as peer, started(program, str(END_S)) as process:
            client = peer.client("/microros_time/set_parameters", "rcl_interfaces/srv/SetParameters")

            def set_time(time_s: float) -> None:
                value = {"type": DOUBLE, "double_value": time_s}
                answer = client.call({"parameters": [{"name": "time", "value": value}]}, seconds(15))
                assert answer is not None
                assert answer["results"][0]["successful"]

            output = Output(process)
            assert output.next("now") == 50_000  # perhaps before its jump callback was there
            set_time(90.03)
            assert output.next("jump") == 40_030
            set_time(20.0)
            assert output.next("jump") == -70_030
            set_time(20.1)
            assert output.next("tick") == 20_100
            set_time(END_S)
            ends_well(process)
        server.terminate()  # what is killed leaves its shared memory to the next process with its ports
        assert server.wait(seconds(15)) == 0
