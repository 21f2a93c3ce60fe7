# SPDX-License-Identifier: Apache-2.0
"""The table of attacks against an agent process; and that an honest client notices none of them, nor all at once.

`nice -n -10 pytest -m long -s tests/agent/test_under_attack.py` prints the table, ATTACK_SECONDS for each attack.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.bench.agent_attackers import ATTACKS
from tests.bench.agent_attacks import ALL, HEAD, Line, echo, measure
from tests.support.agent.process import own_domain
from tests.support.slices import first

pytestmark = [pytest.mark.ros]
SECONDS = float(os.environ.get("ATTACK_SECONDS", "6"))
P99_MS = 50.0
QUIET_MS = 10.0
"""A round trip that 99 % are not slower than without any attack, on a machine that does little else."""


@pytest.fixture(scope="module")
def domain() -> Iterator[int]:
    number = own_domain()
    with echo(number):
        yield number


@pytest.fixture(scope="module")
def quiet(domain: int) -> Line:
    line = measure([], "none", domain, SECONDS)
    print(f"\n{HEAD}\n{line}", flush=True)
    return line


@pytest.mark.long
@pytest.mark.parametrize("name", [*ATTACKS, ALL])
def test_an_honest_client_notices_nothing(name: str, domain: int, quiet: Line) -> None:
    line = measure(list(ATTACKS) if name == ALL else [name], name, domain, SECONDS)
    print(f"\n{line}", flush=True)
    assert line.sessions_lost == 0
    assert line.lost == 0
    assert line.memory_mb < line.limit_mb
    if quiet.trip_ms(0.99) < QUIET_MS:  # else others use the machine, and its times say nothing of the agent
        assert line.trip_ms(0.99) < P99_MS


@pytest.mark.parametrize("name", first(["S4", "S12"]))
def test_an_honest_client_keeps_its_session_and_loses_nothing(name: str, domain: int) -> None:
    line = measure([name], name, domain, 1.0)
    assert line.samples >= 20
    assert (line.sessions_lost, line.lost) == (0, 0)
