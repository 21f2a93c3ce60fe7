# SPDX-License-Identifier: Apache-2.0
"""Clients that come and go for long: nothing stays in the graph, in memory or unaccounted for."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from tests.support import patience
from tests.support.agent.process import own_domain
from tests.support.agent.soak import Place, World
from tests.support.agent.soak_processes import Peer, agent_process
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

TOLERATED = {"fault_late_reply", "fault_unfinished", "fault_frame_noise", "fault_operations_wait"}
"""A client that crashed and came again is not told what it asked for before; one that did not come again had begun a
sample in fragments, or a frame on its line. One that came again at once creates its objects faster than it may, and
waits."""
GROWTH_KIB = 16_384
"""What the process may grow after it is warm; each of many thousand lives would cost more if it left anything."""


def soak(
    folder: Path, places: int, seconds: float, timeout_s: float, sleeping: bool
) -> tuple[World, dict[str, object]]:
    """Let clients live; return what was seen, and the agent's last words.

    `timeout_s` is longer than any stop of this process on a busy machine: who is silent for longer crashed.
    """
    domain = own_domain()
    with agent_process(folder, domain, timeout_s, forget_s=4 * timeout_s) as agent:
        peer = Peer(domain)
        world = World(agent, domain, seconds, min(seconds / 2, 10), sleeping)
        try:
            world.run([Place(number, world) for number in range(places)])
            end = deadline(60) + timeout_s
            while nodes := [name for name in peer.nodes() if name.startswith("/soak/node_")]:
                assert time.monotonic() < end, f"still in the graph: {nodes}"
                time.sleep(0.2)
        finally:
            print(
                f"after {time.monotonic() - world.began:.0f} s: {dict(world.count)}, ends of lives {dict(world.ends)}"
            )
            minutes = range(int(world.rss[-1][0]) // 60 + 1 if world.rss else 0)
            print(
                "RSS of the agent in MiB, most of each minute:", [world.rss_of(m)[1] // 1024 for m in minutes]
            )
            peer.close()
        agent.process.terminate()
        assert agent.process.wait(timeout=patience.seconds(60)) == 0
        events = agent.events()
    (stopped,) = (event for event in events if event["event"] == "stopped")
    for event in events:
        if event["level"] in ("warning", "error"):
            world.count[f"log {event['event']}"] += 1
        elif event["event"].startswith("client_"):  # type: ignore[attr-defined]
            world.count[str(event["event"])] += 1
    return world, stopped


def check(world: World, stopped: dict[str, object]) -> None:
    """Hold what was seen to account."""
    faults = {key: n for key, n in stopped.items() if key.startswith("fault_")}
    assert set(faults) <= TOLERATED, faults
    warnings = {key: n for key, n in world.count.items() if key.startswith("log ")}
    assert set(warnings) <= {"log bad_input"}, warnings
    assert world.count["accounts that are right"] > 0
    assert world.count["samples down"] > 0


@pytest.mark.system
def test_clients_connect_and_leave(tmp_path: Path) -> None:
    """Sleep is left out here: test_ros_sleepers.py has it."""
    world, stopped = soak(tmp_path, places=20, seconds=2, timeout_s=6, sleeping=False)
    check(world, stopped)


@pytest.mark.long
def test_a_hundred_clients_connect_and_leave_for_ten_minutes(tmp_path: Path) -> None:
    seconds = float(os.environ.get("SOAK_SECONDS", "600"))
    world, stopped = soak(tmp_path, places=100, seconds=seconds, timeout_s=30, sleeping=True)
    warm = [kib for at, kib in world.rss if seconds / 4 < at < seconds / 2]
    late = [kib for at, kib in world.rss if 3 * seconds / 4 < at < seconds]
    print(dict(world.count), dict(world.ends))
    print(f"RSS in MiB: warm {max(warm) / 1024:.1f}, late {max(late) / 1024:.1f}; last words: {stopped}")
    check(world, stopped)
    assert max(late) - max(warm) < GROWTH_KIB
