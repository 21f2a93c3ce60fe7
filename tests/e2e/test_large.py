# SPDX-License-Identifier: Apache-2.0
"""Messages of 20 KiB in fragments: firmware, network, agent, ROS 2."""

from __future__ import annotations

import random
import subprocess
import time

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images
from tests.support.e2e.relay import Fault, Relay, no_fault
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

SIZE = 20480
SAMPLES = 3
APPLICATION = """\
version: 1
profiles: [pure_sender]
transport: {{mtu: {mtu}}}
pools: {{history: 2}}
nodes:
  - name: big
    namespace: /{name}
    publishers:
      - {{topic: blob, type: std_msgs/msg/String, qos: {{durability: transient_local}}}}
limits:
  std_msgs/msg/String: {{data: 20480}}
"""


def text(i: int) -> str:
    """Return sample `i` of large.c."""
    return "".join(chr(ord("a") + (i + k + k // 97) % 26) for k in range(SIZE - i))


def lossy() -> Fault:
    """Lose one datagram in five, in both directions."""
    chance = random.Random(11)
    return lambda: [] if chance.random() < 0.2 else [0.0]


@pytest.mark.parametrize(
    ("name", "mtu", "fault", "chunks"),
    [
        ("large", 1472, no_fault, 14),
        pytest.param("large_small_mtu", 512, no_fault, 41, marks=pytest.mark.variant),
        pytest.param("large_lossy", 1472, lossy(), 14, marks=pytest.mark.variant),
    ],
)
def test_large_messages_arrive_whole(
    images: Images,
    relay: Relay,
    agent: AgentProcess,
    observer: Observer,
    name: str,
    mtu: int,
    fault: Fault,
    chunks: int,
) -> None:
    image = images.build(1, APPLICATION.format(mtu=mtu, name=name))
    program = image.application(
        C_FILES / "large.c", image.out.parent / "large", "-std=c99", f'-DLARGE_NAMESPACE="/{name}"'
    )
    observer.subscribe(f"/{name}/blob", "std_msgs/msg/String", transient_local=True)
    relay.fault = fault
    running = subprocess.Popen(
        [program, str(relay.port), str(SAMPLES)],
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert running.stdin is not None
    found: list[str] = []
    end = deadline(30)
    while len(found) < SAMPLES and time.monotonic() < end and running.poll() is None:
        found += [value["data"] for topic, value in observer.ask(do="samples") if topic == f"/{name}/blob"]
        time.sleep(0.02)
    relay.fault = no_fault
    out, errors = running.communicate("\n", timeout=seconds(30))
    assert (running.returncode, errors) == (0, "")
    assert found == [text(i) for i in range(SAMPLES)]
    sent, resent = map(int, out.split())
    assert sent >= SAMPLES * chunks
    assert (resent > 0) == (name == "large_lossy")
