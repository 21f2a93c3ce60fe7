# SPDX-License-Identifier: Apache-2.0
"""A program on the host that queries the graph: one call a line (tests/runtime/c/graph_calls.h)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import ends_well, started
from tests.support.paths import TESTS
from tests.support.patience import deadline

STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{TESTS / 'runtime' / 'c'}")
OK = 0
CHANGES = "graph: it changes faster than it is read"
"""A query that fails so is one to repeat (docs/howto/graph.md): others come and go, on a busy machine for seconds."""
LATE = "no answer of a graph server within"
"""The beginning of another one: on a busy machine the server, which runs, may take longer than the image waits."""
LISTS_OF_NODE = ("publishers_of", "subscriptions_of", "services_of", "clients_of")


class Device(CommandedProgram):
    """The program, with the calls of these tests."""

    def lines(self, command: str) -> list[str]:
        """Return the items of a query; it is asked again where the graph changes too fast, or the server is late."""
        end = deadline(20)
        while (result := self.call(command))[1].startswith((CHANGES, LATE)):
            assert time.monotonic() < end, result[1]
            time.sleep(0.1)
        code, error, lines = result
        assert code == OK, error
        return [line.partition(" ")[2] for line in lines]

    def sorted(self, command: str) -> list[str]:
        """Return the items in their order."""
        return sorted(self.lines(command))


@contextmanager
def running(program: Path) -> Iterator[Device]:
    with started(program) as process:
        device = Device(process)
        assert device.call("init") == (OK, "", [])
        yield device
        assert device.call("end") == (OK, "", [])
        ends_well(process)


def alike(found: Callable[[], Any], wanted: Callable[[], Any], part: Any = None) -> Any:
    """Wait until both give the same, which has `part`; discovery takes a moment. Return it."""
    end = deadline(20)
    while True:
        first, second = found(), wanted()
        if first == second and (part is None or part in first):
            return first
        assert time.monotonic() < end, f"{first} is not {second}, or is without {part}"
        time.sleep(0.1)
