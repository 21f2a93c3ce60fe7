# SPDX-License-Identifier: Apache-2.0
"""Applications with a list of agents, and live.c with such a list."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from tests.support.e2e.images import POOLS
from tests.support.e2e.live import Live
from tests.support.patience import deadline


def listed(
    ports: Sequence[int], times: str, application: str = POOLS, kind: str = "udp", host: str = "127.0.0.1"
) -> str:
    """Return an application file with agents at these ports; `times` are entries of `session:`."""
    agents = ", ".join(f'"{host}:{port}"' for port in ports)
    return f"{application}transport: {{type: {kind}, agents: [{agents}]}}\nsession: {{{times}}}\n"


def listed_lines(devices: Sequence[Path], times: str, application: str = POOLS) -> str:
    """Return an application file with agents at these serial devices; `times` as above."""
    agents = ", ".join(map(str, devices))
    return f"{application}transport: {{type: serial, agents: [{agents}]}}\nsession: {{{times}}}\n"


def agent_of(live: Live) -> tuple[int, int, int]:
    """Return port, index and changes of what rmw_uros_get_agent says."""
    (line,) = live.ok("agent").lines
    _, host, *numbers = line.split()
    assert host in ("127.0.0.1", "::1") or host.startswith("/")
    port, index, changes = map(int, numbers)
    return port, index, changes


def wait_for_agent(live: Live, index: int, timeout_s: float = 15.0) -> None:
    """Wait until all entities exist at this agent."""
    end = deadline(timeout_s)
    while live.call("connected").code != 1 or agent_of(live)[1] != index:
        assert time.monotonic() < end, f"agent {index} is not used: {agent_of(live)}"
        time.sleep(0.01)
