# SPDX-License-Identifier: Apache-2.0
"""A server of the tool, or one that takes its place, in a process of a ROS domain."""

from __future__ import annotations

import select
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import IO

from tests.support.agent.process import environment
from tests.support.patience import seconds


@contextmanager
def server_process(
    domain: int, ready: str, command: Sequence[str], errors: IO[str] | None = None
) -> Iterator[subprocess.Popen[str]]:
    """Start Python with `command` and wait for the line `ready`; kill it afterwards. `errors` takes its stderr."""
    process = subprocess.Popen(
        [sys.executable, *command],
        env=environment(domain),
        stdout=subprocess.PIPE,
        stderr=errors,
        text=True,
    )
    assert process.stdout is not None
    try:
        assert select.select([process.stdout], [], [], seconds(15))[0]
        assert process.stdout.readline() == ready
        yield process
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
