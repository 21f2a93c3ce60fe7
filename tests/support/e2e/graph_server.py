# SPDX-License-Identifier: Apache-2.0
"""`microros-gen graph-server` in a process, or a program in its place."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from tests.support.e2e.server_process import server_process

READY = "graph server ready: /microros_graph\n"


SHORT = ("-m", "tests.support.graph_server.short_server")
"""A program in its place, for `command`."""


@contextmanager
def graph_server(
    domain: int, command: Sequence[str] = ("-m", "microros_gen", "graph-server")
) -> Iterator[subprocess.Popen[str]]:
    """Start one in a ROS domain and wait until it serves; kill it afterwards."""
    with server_process(domain, READY, command) as process:
        yield process
