# SPDX-License-Identifier: Apache-2.0
"""How soon the callback of a device knows of a set in rclpy: compared with the round trip of a service in that run."""

from __future__ import annotations

from pathlib import Path
from statistics import median

import pytest

from tests.support.agent.line_process import LineProcess, serving
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images, started
from tests.support.e2e.relay import Relay
from tests.support.e2e.serving import await_line
from tests.support.patience import seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+services, +parameters]
nodes:
  - name: timed
    namespace: /parameter_times
    services: [{name: turn, type: std_srvs/srv/SetBool, limits: {message: 20}}]
    parameters: [{name: steps, type: integer}]
"""
TIMES = 300
MOST = 1.1
"""Of the round trip of a service."""


@pytest.mark.system
def test_a_set_reaches_the_callback_within_a_round_trip(
    images: Images, image_port: Relay, agent: AgentProcess, domain: int, tmp_path: Path
) -> None:
    image = images.build(image_port.port, APPLICATION)
    program = image.application(C_FILES / "parameter_times.c", tmp_path / "times", f"-DTIMES={TIMES}")
    with serving("tests.support.e2e.parameter_times_peer", domain) as peer, started(program) as process:
        await_line(process, "ready")
        found = LineProcess(peer).ask(
            node="/parameter_times/timed",
            service="/parameter_times/turn",
            parameter="steps",
            times=TIMES,
            timeout=seconds(30),
        )
        out, errors = process.communicate(timeout=seconds(30))
    assert (process.returncode, errors) == (0, "")
    called_ns = [int(line) for line in out.split() if line.isdigit()]
    waited_ns = [called - at for called, at in zip(called_ns, found["set_at_ns"], strict=True)]
    assert min(waited_ns) > 0
    ratio = median(waited_ns) / median(found["round_trips_ns"])
    print(
        f"set to callback {median(waited_ns) / 1000:.0f} us, round trip {median(found['round_trips_ns']) / 1000:.0f} us"
    )
    assert ratio <= MOST
