# SPDX-License-Identifier: Apache-2.0
"""The 32-bit clock runs through 2^31 and 2^32 ms in steps of days, and everything goes on working."""

from __future__ import annotations

import pytest

from runtime.conftest import Bench
from runtime.harness import POOL, READER
from runtime.reading_agent import ReadingAgent

FIRST = POOL.publishers_max
STEP_MS = 5 * 86_400_000
STEPS = 12
"""60 days: 2^31 ms are 24.9, 2^32 ms 49.7."""


@pytest.mark.parametrize("qos", ["reliable", "best_effort"])
def test_data_flows_in_both_directions_for_sixty_days(bench: Bench, qos: str) -> None:
    agent = ReadingAgent()
    client = bench.start(READER, agent=agent)
    for call in ("init", "node 0 n -", f"publisher 0 0 Int32 out {qos}", f"read_init 0 0 Int32 go {qos}"):
        client.ok(call)
    client.spin(2)
    found, sent = [], []
    for step in range(STEPS):
        client.wait(STEP_MS)
        for value in range(step * 4, step * 4 + 4):
            client.spin(3, 1)
            client.queued += agent.numbers(FIRST, value)
            client.spin(2, 1)
            result = client.call("read_take 0")
            found += [int(line.split()[1]) for line in result.lines]
            client.ok(f"publish 0 {value}")
            sent.append(value)
    client.spin(3, 100)
    assert found == sent
    assert agent.values() == sent
    assert client.statistics()["reconnects"] == 0
