# SPDX-License-Identifier: Apache-2.0
"""A board whose node has a life cycle: its application file, and the instructions of what it does."""

from __future__ import annotations

from dataclasses import dataclass

from tests.support.firmware.board import Builds, target
from tests.support.firmware.footprint import AGENT_FUNCTIONS, INTERRUPTS
from tests.support.firmware.instructions import counted_regions

APPLICATION = """\
version: 1
profiles: [managed_service]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes: [{name: device, namespace: /arm}]
"""
"""That of c/lifecycle.c and c/measured_lifecycle.c."""
_TIMES = 8
"""Of c/measured_lifecycle.c."""


@dataclass(frozen=True)
class Work:
    """Instructions of the client alone.

    `init`: the state machine with its publisher and five services, three of them added to an executor, and four
    callbacks. `change` and `get`: change_state with its callback and two events, and get_state, from a request that
    waits to its reply.
    """

    init: int
    change: int
    get: int


def work(builds: Builds, name: str) -> Work:
    """Count the instructions on a board, with the agent of c/measured.h."""
    built = builds.build(name, f"{APPLICATION}transport: {{type: udp}}\n")
    image = builds.application(built, "measured_lifecycle.c")
    empty, _, init, *others = counted_regions(target(name), image, (*AGENT_FUNCTIONS, *INTERRUPTS))
    assert len(others) == 4 * _TIMES + 1, "the program ended early"
    return Work(init - empty, others[-4] - empty, others[-2] - empty)
