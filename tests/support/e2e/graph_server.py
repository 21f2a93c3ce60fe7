# SPDX-License-Identifier: Apache-2.0
"""`microros-gen graph-server` in a process."""

from __future__ import annotations

import select
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from tests.support.agent.process import environment
from tests.support.patience import seconds

READY = "graph server ready: /microros_graph\n"


@contextmanager
def graph_server(domain: int) -> Iterator[subprocess.Popen[str]]:
    """Start one in a ROS domain and wait until it serves; kill it afterwards."""
    process = subprocess.Popen(
        [sys.executable, "-m", "microros_gen", "graph-server"],
        env=environment(domain),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    try:
        assert select.select([process.stdout], [], [], seconds(15))[0]
        assert process.stdout.readline() == READY
        yield process
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
