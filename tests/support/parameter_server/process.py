# SPDX-License-Identifier: Apache-2.0
"""`microros-gen parameter-server` in a process."""

from __future__ import annotations

import select
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tests.support.agent.process import environment
from tests.support.patience import seconds

READY = "parameter server ready: /microros_parameters\n"


@contextmanager
def parameter_server(
    domain: int, file: Path, command: Sequence[str] = ("-m", "microros_gen", "parameter-server")
) -> Iterator[subprocess.Popen[str]]:
    """Start one in a ROS domain and wait until it serves; kill it afterwards. Its stderr is FILE.log."""
    with file.with_suffix(".log").open("a", encoding="utf-8") as log:
        process = subprocess.Popen(
            [sys.executable, *command, "--file", str(file)],
            env=environment(domain),
            stdout=subprocess.PIPE,
            stderr=log,
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
